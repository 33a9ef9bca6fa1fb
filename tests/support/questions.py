"""Questions to a file that may be anything: the whole front door, or only what the file says."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import synth
from graphs.convert.conversions import CONVERSIONS, FORMS, Mechanism, to_sc
from graphs.convert.duality import mechanism_of_sheet
from graphs.count.report import mobility_report
from graphs.errors import SynthedraError
from graphs.files.formats import WRITERS, read_all
from synth.analysis.verdict import mobility_of_type

Question = Callable[[], object]

_SHARE = 4
"""One file in so many is asked everything and its answers laid out, the others how they move."""

_MOST = 3
"""Mechanisms of one file that are asked everything."""


def refusal(ask: Question) -> str | None:
    """Return the line with which a question is refused; None if it is answered."""
    try:
        ask()
    except SynthedraError as error:
        return str(error)
    return None


def count_only(path: Path, _rng: random.Random) -> Iterator[str | None]:
    """Read a file and count the freedoms of each mechanism: the cheapest answer."""

    def count() -> None:
        for entry in read_all(path):
            thing = entry.mechanism
            if isinstance(thing, synth.Sheet):
                thing = mechanism_of_sheet(thing).sc
            told = mobility_report(thing if isinstance(thing, synth.PolyhedronModel) else to_sc(thing)).to_json()
            json.dumps(told, allow_nan=False)

    yield refusal(count)


def front_door(path: Path, rng: random.Random) -> Iterator[str | None]:
    """Read a file and ask how each mechanism moves; then, of some files, for finite motion and all else."""
    mechanisms: list[Mechanism] = []
    everything = rng.randrange(_SHARE) == 0

    def moves() -> None:
        mechanisms.extend(entry.mechanism for entry in read_all(path))
        for mechanism in mechanisms:
            answer = synth.mobility(mechanism, motion=None if everything else False)
            _told(answer, laid_out=everything)

    yield refusal(moves)
    if everything:
        for mechanism in islice(mechanisms, _MOST):
            yield from (refusal(ask) for ask in _other_questions(mechanism, path.parent, rng))


def _told(answer: Any, *, laid_out: bool = True) -> None:
    """Tell an answer as scripts read it, and as people do: to lay tables out takes longer than all else."""
    json.dumps(answer.to_json(), allow_nan=False)
    if laid_out:
        str(answer)
    else:
        answer.blocks()


def _other_questions(mechanism: Mechanism, folder: Path, rng: random.Random) -> Iterator[Question]:
    """Yield the questions about type, reduction, drawing and conversion."""
    rule, kind, form = (
        rng.choice(["ride-along", "dyad"]),
        rng.choice([None, *CONVERSIONS]),
        rng.choice([None, *FORMS]),
    )
    place = folder / f"written{rng.choice(sorted(WRITERS))}"
    yield lambda: _told(synth.identify(mechanism))
    yield lambda: json.dumps(synth.reduce(mechanism, rule=rule).to_json(), allow_nan=False)
    yield lambda: _told(synth.reconstruct(mechanism))
    yield lambda: _written_and_read(mechanism, kind, form, place)


def _written_and_read(mechanism: Mechanism, kind: str | None, form: str | None, place: Path) -> None:
    """Convert a mechanism, write it whatever is lost, read it again."""
    synth.write(synth.convert(mechanism, kind, form=form), place, lossy=True, force=True)
    try:
        again = synth.read(place)
    except SynthedraError as error:
        raise AssertionError(f"what was written is not read: {error}") from None
    _told(mobility_of_type(again, exact=False))
