"""The mechanisms with coordinates that all verbs are asked about: the project's own, generated ones, other people's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import chain
from math import radians
from pathlib import Path
from tempfile import TemporaryDirectory

from graphs.errors import SynthedraError
from graphs.files.formats import READERS, read
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns._generate import generate
from synth.catalogue.patterns.generator import Generator
from synth.catalogue.patterns.generators import GENERATORS
from synth.making.drawing.space.motion_files import write_motion
from tests.support.real_patterns import folder_of_patterns, names_of_patterns

__all__ = ["MOST_PANELS", "Placed", "Specimen", "is_placed", "is_wanted", "named_specimens", "specimens"]

ROOT = Path(__file__).resolve().parents[2]
MOST_PANELS = 400
"""Crease patterns by other people are taken up to this size."""
_FOLDED = radians(60.0)

Placed = Sheet | HingedSolids | JointedLinkage | PolyhedronModel


@dataclass(frozen=True, slots=True)
class Specimen:
    """A mechanism by its name, and its file where it has one; it is read or made where it is asked about."""

    name: str
    load: Callable[[], Placed]
    file: Path | None = None


def named_specimens() -> Iterator[Specimen]:
    """Yield all that may be mechanisms with coordinates, each source in its order; none is read yet."""
    return chain(_of_the_project(), _generated(), _with_frames(), _by_other_people())


def specimens(part: str = "") -> Iterator[Specimen]:
    """Yield all mechanisms with coordinates whose names contain a text."""
    for specimen in named_specimens():
        if part in specimen.name and is_wanted(specimen):
            yield specimen


def is_placed(thing: object) -> bool:
    """Tell whether a mechanism has coordinates."""
    if isinstance(thing, Sheet):
        return (thing if thing.frames is None else thing.frames.first_placed()).coordinates is not None
    if isinstance(thing, PolyhedronModel):
        return thing.coordinates is not None and bool(thing.coordinates)
    return isinstance(thing, HingedSolids) or (isinstance(thing, JointedLinkage) and bool(thing.places))


def is_wanted(specimen: Specimen) -> bool:
    """Tell whether a mechanism can be made, has coordinates, and if it is other people's is not too large."""
    try:
        thing = specimen.load()
    except SynthedraError:  # no mechanism, or parameters that do not go together
        return False
    too_large = specimen.name.startswith("fold/") and isinstance(thing, Sheet) and len(thing.faces) > MOST_PANELS
    return is_placed(thing) and not too_large


def _of_the_project() -> Iterator[Specimen]:
    for file in sorted((ROOT / "data").rglob("*")):
        if file.suffix in READERS:
            yield Specimen(str(file.relative_to(ROOT)), partial(read, file), file)


def _by_other_people() -> Iterator[Specimen]:
    for name in names_of_patterns():
        file = folder_of_patterns() / name
        yield Specimen(f"fold/{name}", partial(read, file), file)


def _generated() -> Iterator[Specimen]:
    for name, generator in GENERATORS.items():
        for size in ("small", "medium", "large"):
            yield Specimen(f"generate/{name}-{size}", partial(generator.make, **_values(generator, size)))
        if generator.foldable:
            yield Specimen(f"generate/{name}-folded", partial(_folded, name))


def _with_frames() -> Iterator[Specimen]:
    """Yield a fan of four creases at a vertex in three poses, in one file."""
    yield Specimen("frames/four-bar-vertex", _folding_in_frames)


def _folding_in_frames() -> Placed:
    flat = read(ROOT / "data" / "patterns" / "four-bar-vertex.fold")
    with TemporaryDirectory() as folder:
        file = Path(folder) / "frames.fold"
        write_motion(fold(flat, frames=2), file)
        return read(file)


def _folded(name: str) -> Placed:
    return generate(name, fold=_FOLDED).mechanism


def _values(generator: Generator, size: str) -> dict[str, float]:
    """Return parameters: counts one less or more than usual; where nothing is counted, lengths and angles differ."""
    step = {"small": -1, "medium": 0, "large": 1}[size]
    counted = [one for one in generator.parameters if one.unit == "count"]
    given = {
        one.name: min(max(one.default + step, one.least), one.most)
        if counted
        else min(max(one.default * 1.1**step, one.least), one.most)
        for one in counted or generator.parameters
    }
    return generator.values(given)
