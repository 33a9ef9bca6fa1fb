"""Drawings of a pattern in the plane, one after the other: each from another start, to other lengths.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphs.types import Floats
from synth.motion.walk.allowance import Allowance
from synth.realisation.figures import crossings
from synth.realisation.improving import improved
from synth.realisation.measures import opened_angles
from synth.realisation.pattern import Pattern
from synth.realisation.pointing import first_unknowns
from synth.realisation.starting import barycentric_start
from synth.realisation.wanted.wishes import Wishes

__all__ = ["Drawn", "drawings"]

_VARIED = 0.35
_APART = 1e-3
"""Centres nearer to each other or to a vertex than this, in units of the extent, are taken as one."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A drawing: places of the vertices, with edges about 1 long, and angles of the corners of panels, radians.

    `convex` says whether the border was kept convex, `number` which try it is.
    """

    places: Floats
    angles: Floats
    convex: bool
    number: int


_NONE = Wishes()


def drawings(
    pattern: Pattern,
    seed: int,
    tries: int,
    wishes: Wishes = _NONE,
    allowance: Allowance | None = None,
    *,
    first: int = 0,
) -> Iterator[Drawn]:
    """Yield drawings without crossings, each panel strictly convex where it can be, creases to their centres.

    The first is as even as possible, every other aims at random lengths. The border is convex; where creases point
    to centres across holes every third drawing may have another. The allowance counts steps of improvement, of all
    drawings together: where it is used up there is no other drawing. Tries are numbered from `first`.
    """
    conditions, symmetry = wishes.conditions(pattern), wishes.symmetry
    for number in range(first, first + tries):
        if allowance is not None and number > first and allowance.left <= 0:
            return
        random = np.random.default_rng((seed, number))
        convex = not pattern.pointings or number % 3 < 2
        start = barycentric_start(pattern, random if number and symmetry is None else None)
        aims = _VARIED * random.standard_normal(len(pattern.edges)) if number or seed else None
        if aims is not None and symmetry is not None:
            aims = symmetry.evened(aims)
        unknowns = first_unknowns(pattern, *start)
        found = improved(pattern, unknowns, convex=convex, aims=aims, conditions=conditions, allowance=allowance)
        if found is None:
            continue
        places = found[: pattern.vertices]
        if crossings(pattern, places) or not _are_apart(pattern, found):
            continue
        if symmetry is not None:
            places = symmetry.upright(places)
        yield Drawn(places, opened_angles(pattern, places)[0], convex, number)


def _are_apart(pattern: Pattern, unknowns: Floats) -> bool:
    """Tell whether centres across holes are different from each other and from the vertices."""
    free = [one for one in pattern.pointings if one.vertex is None]
    finite = [pattern.vertices + place for place, one in enumerate(free) if not one.infinite]
    extent = np.ptp(unknowns[: pattern.vertices], axis=0).max()
    for place in finite:
        others = np.delete(unknowns[: pattern.vertices + len(free)], place, axis=0)
        if np.linalg.norm(others - unknowns[place], axis=1).min() < _APART * extent:
            return False
    return True
