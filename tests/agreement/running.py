"""All verbs asked about all variants of mechanisms, one after the other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import synth
from graphs.mechanism.sheet import Sheet
from tests.agreement.comparison import Disagreement, Who, disagreements
from tests.agreement.specimens import Placed, Specimen
from tests.agreement.variants import variants_of
from tests.agreement.verbs import DOORS, VERBS, Outcome, Subject, Verb, asked

__all__ = ["Comparison", "comparisons"]


@dataclass(frozen=True, slots=True)
class Comparison:
    """What all verbs said of one configuration.

    Attributes
    ----------
    file, variant : str
    outcomes : dict of who to Outcome
    disagreements : list of Disagreement
    """

    file: str
    variant: str
    outcomes: dict[Who, Outcome]
    disagreements: list[Disagreement]


def comparisons(
    specimens: Iterable[Specimen],
    folder: Path,
    *,
    variants: str = "",
    verbs: Iterable[Verb] = VERBS,
    doors: Iterable[str] = DOORS,
    seconds: float | None = None,
) -> Iterator[Comparison]:
    """Yield what verbs say of each variant of each mechanism.

    Both doors are given what one file says: variants are written, and read again.

    Parameters
    ----------
    specimens : iterable of Specimen
    folder : Path
        For files.
    variants : str, optional
        Only those whose names contain it.
    verbs, doors : iterable, optional
    seconds : float, optional
        What takes longer is left out.
    """
    for specimen in specimens:
        for variant, thing in variants_of(specimen.load()):
            if variants in variant:
                file = specimen.file if variant == "as it is" else None
                subject = _subject(thing, folder, file)
                outcomes = {(verb.name, door): asked(verb, door, subject, seconds) for verb in verbs for door in doors}
                if variant.startswith("frame"):
                    outcomes |= _by_frame(specimen, subject, int(variant.split()[1]), seconds)
                yield Comparison(specimen.name, variant, outcomes, disagreements(outcomes))


def _by_frame(specimen: Specimen, subject: Subject, frame: int, seconds: float | None) -> dict[Who, Outcome]:
    """Ask for the mobility of a frame by its number, in the file that has them all."""
    whole = Subject(specimen.load(), subject.file, subject.folder, frame)
    return {("mobility", "by frame"): asked(VERBS[0], "python", whole, seconds)}


def _subject(thing: Placed, folder: Path, file: Path | None) -> Subject:
    if file is None:
        file = folder / ("variant.fold" if isinstance(thing, Sheet) else "variant.json")
        synth.write(thing, file, lossy=True, force=True)
    return Subject(synth.read(file), file, folder)
