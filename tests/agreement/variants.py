"""One mechanism in many guises: rounded, turned, scaled, mirrored, without its assignment, frame by frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from graphs.errors import InvariantError
from graphs.joints.linkage import JointedLinkage, JointPlace
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from tests.agreement.specimens import Placed

__all__ = ["VARIANTS", "variants_of"]

Change = Callable[[np.ndarray], np.ndarray]
"""Of points or directions, float[n, 3]."""

_DECIMALS = (6, 4, 3)
_LARGE, _SMALL = 1e6, 1e-6
_TURN = np.linalg.qr(np.array([[0.3, -0.8, 0.5], [0.9, 0.2, 0.4], [-0.1, 0.6, 0.7]]))[0]
_TURN = _TURN * np.linalg.det(_TURN)
_SHIFT = np.array([0.37, -1.21, 0.58])
_MIRROR = np.diag([-1.0, 1.0, 1.0])


@dataclass(frozen=True, slots=True)
class Map:
    """What is done to points, directions and lengths, and whether it turns left into right."""

    points: Change
    directions: Change
    factor: float = 1.0
    mirrored: bool = False


def _same(places: np.ndarray) -> np.ndarray:
    return places


def _rounded(decimals: int) -> Map:
    return Map(lambda points: points.round(decimals) + 0.0, lambda axes: axes.round(decimals) + 0.0)


MAPS = {
    **{f"{decimals} decimals": _rounded(decimals) for decimals in _DECIMALS},
    "turned and moved": Map(lambda points: points @ _TURN.T + _SHIFT, lambda axes: axes @ _TURN.T),
    "scaled by 1e6": Map(lambda points: _LARGE * points, _same, _LARGE),
    "scaled by 1e-6": Map(lambda points: _SMALL * points, _same, _SMALL),
    "mirrored": Map(lambda points: points @ _MIRROR, lambda axes: axes @ _MIRROR, mirrored=True),
}
VARIANTS = ("as it is", *MAPS, "without assignment", "frame")
"""Each guise by its name; frames are followed by their numbers."""


def variants_of(thing: Placed) -> Iterator[tuple[str, Placed]]:
    """Yield a mechanism in each guise; those are left out that repeat it as it is or are no mechanism."""
    placed = thing
    if isinstance(thing, Sheet) and thing.frames is not None:
        placed = thing.frames.first_placed()
    yield "as it is", thing
    for name, change in MAPS.items():
        try:
            changed = _mapped(placed, change)
        except InvariantError:  # rounded, the axes of a universal joint are not at a right angle
            continue
        if "decimals" not in name or _numbers(changed) != _numbers(placed):
            yield name, changed
    if isinstance(placed, Sheet):
        if set(placed.assignments) & set("MV"):
            letters = placed.assignments.translate(str.maketrans("MV", "UU"))
            yield "without assignment", replace(placed, assignments=letters, frames=None)
        if isinstance(thing, Sheet) and thing.frames is not None and thing.frames.others:
            last = thing.frames.others
            for number in sorted({0, 1, last // 2, last}):
                frame = thing.frames.frame(number)
                if frame.coordinates is not None:
                    yield f"frame {number}", replace(frame, frames=None)


def _mapped(thing: Placed, change: Map) -> Placed:
    if isinstance(thing, Sheet):
        faces = tuple(face[::-1] for face in thing.faces) if change.mirrored else thing.faces
        points = _points(thing.coordinates, change.points)
        spread = thing.spread * change.factor
        return replace(thing, coordinates=points, faces=faces, spread=spread, precision=None, frames=None)
    if isinstance(thing, HingedSolids):
        return HingedSolids(
            thing.chain,
            {
                joint: (*_points([point], change.points), *_points([axis], change.directions))
                for joint, (point, axis) in thing.axes.items()
            },
        )
    if isinstance(thing, JointedLinkage):
        places = {
            joint: JointPlace(*_points([place.point], change.points), _points(place.axes, change.directions))
            for joint, place in thing.places.items()
        }
        return JointedLinkage(thing.chain, thing.kinds, places)
    coordinates = dict(zip(thing.nodes, _points(list(thing.coordinates.values()), change.points), strict=True))
    return PolyhedronModel(
        thing.nodes, thing.edges, coordinates=coordinates, centres=thing.centres, on_line=thing.on_line,
        on_plane=thing.on_plane, scissors=thing.scissors, ground=thing.ground, links=thing.links,
    )  # fmt: skip


def _points(given, change: Change) -> tuple[tuple[float, ...], ...]:
    """Return points after a change; those in the plane z = 0 that stay there keep as many numbers."""
    after = change(in_space(given))
    width = len(given[0]) if len(given) else 3
    flat = width == 2 and not after[:, 2].any()
    return tuple(map(tuple, after[:, : 2 if flat else 3].tolist()))


def _numbers(thing: Placed) -> object:
    """Return all numbers that a mechanism lies at."""
    if isinstance(thing, Sheet):
        return thing.coordinates
    if isinstance(thing, HingedSolids):
        return list(thing.axes.values())
    if isinstance(thing, JointedLinkage):
        return list(thing.places.values())
    return list(thing.coordinates.values())
