"""Diagonals of panels, what a crease along each does to the closure equations, and the smallest sets to crease.

A panel that is creased becomes two, and the loops that pass from one to the other get a joint more: the closure
equations a column more, the axis of the diagonal in these loops. What the columns do to a rank is what they are on
the self-stresses. A set brings as many rates as it has creases, less the rank of its columns on the self-stresses,
and no more freedoms than that. So only sets of which enough columns depend on others are creased and folded.
Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np

from graphs.creasing.edits import crease_sheet, lock_crease
from graphs.errors import NumericalError
from graphs.geometry import principal_axes, signed_area
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.rank.singular_values import split
from graphs.tolerances import DOUBLE
from graphs.types import Floats, LinkId
from synth.analysis.advice.locks import GeneralConfiguration
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.linkage import Linkage, LinkageLoop
from synth.analysis.motion.walk.step import Allowance


@dataclass(frozen=True, slots=True)
class Diagonal:
    """A straight line across a panel that is one face.

    Attributes
    ----------
    panel : int
        The link.
    face : int
    corners : (int, int)
        Places in the face, the smaller first.
    ends : (int, int)
        The vertices.
    """

    panel: int
    face: int
    corners: tuple[int, int]
    ends: tuple[int, int]

    def crosses(self, other: Diagonal) -> bool:
        """Check whether two diagonals of a panel meet inside it."""
        (a, b), (c, d) = self.corners, other.corners
        return self.face == other.face and (a < c < b < d or c < a < d < b)


def diagonals_of(general: GeneralConfiguration, protected: Collection[LinkId] = ()) -> list[Diagonal]:
    """Return the diagonals of all unprotected panels that are one face.

    A diagonal joins two corners, inside the panel and past its other corners. Those that would part the pieces of
    a hinge are left out: they would make two joints of it.
    """
    if general.sheet is None or general.mechanism is None:
        return []
    points = _points(general)
    diagonals = []
    for panel, faces in enumerate(general.mechanism.panels):
        if panel in protected or len(faces) != 1:
            continue
        around = general.sheet.faces[faces[0]]
        corners = _in_plane(points[list(around)])
        for pair in combinations(range(len(around)), 2):
            diagonal = Diagonal(panel, faces[0], pair, (around[pair[0]], around[pair[1]]))
            if _is_inside(corners, pair) and not _parts_a_hinge(general, diagonal):
                diagonals.append(diagonal)
    return diagonals


def loads_on_stresses(general: GeneralConfiguration, diagonals: Sequence[Diagonal]) -> tuple[Floats, list[bool]]:
    """Return what creases along diagonals do to each self-stress, float[s, D], and which of them are in no loop.

    A set of creases brings as many rates as it has creases, less the rank of its columns: a zero column is a
    crease that brings a rate by itself. A crease in no loop only cuts a corner off, which hangs on it. All loops
    close by six equations here, so that no crease has to pass through a centre. Raise `NumericalError` if the rank
    of the closure equations is not that of the equations about centres.
    """
    linkage = general.linkage
    matrix = np.zeros((6 * len(linkage.loops), len(linkage.angles)))
    for number, loop in enumerate(linkage.loops):
        for joint, sign in zip(loop.joints, loop.signs, strict=True):
            twist = _twist(linkage.points[joint], linkage.directions[joint])
            matrix[6 * number : 6 * number + 6, joint] += sign * twist
    parts = split(matrix)
    expected = len(linkage.angles) - general.rates.shape[1]
    if parts.rank != expected:
        raise NumericalError(
            f"the closure equations in space have rank {parts.rank} at this configuration; "
            f"expected {expected}, as about centres"
        )
    columns = np.array([_column(general, one) for one in diagonals]).reshape(len(diagonals), len(matrix))
    flaps = [not column.any() for column in columns]
    return parts.cokernel.T @ columns.T, flaps


def _points(general: GeneralConfiguration) -> Floats:
    """Return the vertices where the axes are: in units of the extent, about the middle."""
    assert general.sheet is not None
    assert general.sheet.coordinates is not None
    return (in_space(general.sheet.coordinates) - general.linkage.middle) / general.linkage.extent


def _column(general: GeneralConfiguration, diagonal: Diagonal) -> Floats:
    """Return the derivatives of all loops, six equations each, by the fold along a diagonal: float[6 L]."""
    beyond = _joints_at(general, _sides(general, diagonal)[0])
    start, end = _points(general)[list(diagonal.ends)]
    twist = _twist(start, (end - start) / float(np.linalg.norm(end - start)))
    return np.concatenate([np.zeros(0), *(_passes(general.linkage, loop, diagonal.panel, beyond) * twist
                                          for loop in general.linkage.loops)])  # fmt: skip


def _passes(linkage: Linkage, loop: LinkageLoop, panel: LinkId, beyond: Collection[int]) -> int:
    """Return how often a loop passes a diagonal to the joints beyond it, less how often it comes back."""
    pairs = list(linkage.graph.joints.values())
    times = 0
    following = (*loop.joints[1:], loop.joints[0])
    for joint, sign, after in zip(loop.joints, loop.signs, following, strict=True):
        if pairs[joint][1 if sign > 0 else 0] == panel:
            times += (after in beyond) - (joint in beyond)
    return times


def _parts_a_hinge(general: GeneralConfiguration, diagonal: Diagonal) -> bool:
    """Check whether a joint has edges on both sides of a diagonal."""
    between, around = _sides(general, diagonal)
    return not _joints_at(general, between).isdisjoint(_joints_at(general, around))


def _sides(general: GeneralConfiguration, diagonal: Diagonal) -> tuple[set[frozenset[int]], set[frozenset[int]]]:
    """Return the sides of a panel between the two corners of a diagonal, and the others."""
    assert general.sheet is not None
    first, last = diagonal.corners
    every = list(map(frozenset, sides_of_face(general.sheet.faces[diagonal.face])))
    return set(every[first:last]), {*every[:first], *every[last:]}


def _joints_at(general: GeneralConfiguration, edges: Collection[frozenset[int]]) -> set[int]:
    """Return the places of the joints that have one of some edges."""
    assert general.mechanism is not None
    pieces = general.mechanism.pieces
    return {
        place
        for place, joint in enumerate(general.linkage.graph.joints)
        if any(frozenset(edge) in edges for edge in pieces[joint])  # type: ignore[index]  # numbers of edges
    }


def _twist(point: Floats, direction: Floats) -> Floats:
    return np.concatenate([direction, np.cross(point, direction)])


def _in_plane(points: Floats) -> Floats:
    """Return points of a panel in its plane: float[n, 2]."""
    return np.asarray((points - points.mean(axis=0)) @ principal_axes(points)[1][:2].T)


def _is_inside(corners: Floats, pair: tuple[int, int]) -> bool:
    """Check whether the line between two corners of a polygon parts it in two."""
    first, last = pair
    parts = (corners[first : last + 1], np.concatenate([corners[last:], corners[: first + 1]]))
    if min(map(len, parts)) < 3:
        return False
    whole, areas = signed_area(corners), [signed_area(part) for part in parts]
    if min(area * np.sign(whole) for area in areas) <= DOUBLE.same_point:
        return False
    start, end = corners[list(pair)]
    count = len(corners)
    others = [
        (i, (i + 1) % count)
        for i in range(count)
        if first not in (i, (i + 1) % count) and last not in (i, (i + 1) % count)
    ]
    return not any(_meet(start, end, corners[i], corners[j]) for i, j in others)


def _meet(a: Floats, b: Floats, c: Floats, d: Floats) -> bool:
    """Check whether two segments share a point."""
    over, under = signed_area([[(a, b, c), (a, b, d)], [(c, d, a), (c, d, b)]])
    near = DOUBLE.same_point
    return all(min(areas) <= near and max(areas) >= -near for areas in (over, under))


MOST_FOLDED = 100
"""Sheets with diagonals that are folded, of one size: a few seconds."""


@dataclass(frozen=True, slots=True)
class Candidates:
    """Diagonals to choose from, what each does to the self-stresses (float[s, D]), and how many may be added."""

    diagonals: Sequence[Diagonal]
    loads: Floats
    allowance: Allowance

    def grown(self, chosen: tuple[int, ...], loads: Floats, rank: int, size: int) -> Iterator[tuple[int, ...]]:
        """Yield sets without crossings that begin with some; loads across theirs are left, and rank at most."""
        if len(chosen) == size:
            yield chosen
            return
        for place in range(chosen[-1] + 1 if chosen else 0, len(self.diagonals)):
            if not self.allowance.take():
                return
            if any(self.diagonals[place].crosses(self.diagonals[other]) for other in chosen):
                continue
            load = loads[:, place]
            length = float(np.linalg.norm(load))
            if length <= DOUBLE.zero:
                yield from self.grown((*chosen, place), loads, rank, size)
            elif rank:
                along = load / length
                yield from self.grown((*chosen, place), loads - np.outer(along, along @ loads), rank - 1, size)


class Bounds(NamedTuple):
    """What is searched for: the freedoms and rates there are, the freedoms wanted, the largest size of a set."""

    freedoms: int
    rates: int
    wanted: int
    largest: int


@dataclass(frozen=True, slots=True)
class DiagonalSets:
    """The smallest sets that have the freedoms when folded, and the largest size that was searched.

    `more`: there may be more sets of that size, since a limit was reached; `refused` counts sets that have the
    rates but, folded, not the freedoms; `used_up`: the search ended at its work limit.
    """

    sets: tuple[tuple[int, ...], ...]
    searched: int
    more: bool
    refused: int
    used_up: bool = False


def smallest_sets(sheet: Sheet, candidates: Candidates, bounds: Bounds, limit: int) -> DiagonalSets:
    """Return the smallest sets of diagonals, up to a limit, that give a general configuration its freedoms."""
    refused = 0
    for size in range(bounds.wanted - bounds.freedoms, bounds.largest + 1):
        sets: list[tuple[int, ...]] = []
        more = False
        rank = size - (bounds.wanted - bounds.rates)  # more would leave fewer rates than are wanted
        for folded, places in enumerate(candidates.grown((), candidates.loads, rank, size)):
            if len(sets) == limit or folded == MOST_FOLDED:
                more = True
                break
            if freedoms_when_creased(sheet, [candidates.diagonals[place] for place in places]) == bounds.wanted:
                sets.append(places)
            else:
                refused += 1
        used_up = candidates.allowance.left < 0
        if sets or more or used_up:
            return DiagonalSets(tuple(sets), size, more or used_up, refused, used_up)
    return DiagonalSets((), bounds.largest, False, refused)


def freedoms_when_creased(sheet: Sheet, diagonals: Sequence[Diagonal]) -> int | None:
    """Return the freedoms of a sheet with creases along diagonals, on its freest branch; None if unknown."""
    for diagonal in diagonals:
        sheet = crease_sheet(sheet, *diagonal.ends).sheet
    return _freest(sheet)


def freedoms_when_left_out(sheet: Sheet, joints: Sequence[int]) -> int | None:
    """Return the freedoms of a sheet without some creases, on its freest branch; None if unknown."""
    for joint in joints:
        sheet = lock_crease(sheet, joint).sheet
    return _freest(sheet)


def _freest(sheet: Sheet) -> int | None:
    pattern = configuration_of_sheet(sheet)
    if not pattern.linkage.graph.joints:
        return 0
    branches = pattern.branches
    if branches is None:
        return None
    known = [branch.freedoms for branch in branches.branches if branch.certainty != "not known"]
    if any(freedoms is None for freedoms in known):
        return None
    return max((freedoms for freedoms in known if freedoms is not None), default=0 if branches.exhaustive else None)
