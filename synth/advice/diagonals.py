"""Diagonals of panels: which there are, and what a crease along each does to the closure equations.

A panel that is creased becomes two, and the loops that pass from one to the other get a joint more: the closure
equations a column more, the axis of the diagonal in these loops. What the columns do to a rank is what they are on
the self-stresses. Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from graphs.errors import NumericalError
from graphs.geometry import principal_axes, signed_area
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import sides_of_face
from graphs.rank.singular_values import split
from graphs.tolerances import DOUBLE
from graphs.types import Floats, LinkId
from synth.advice.general_pose import GeneralPose
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = ["Diagonal", "diagonals_of", "loads_on_stresses"]


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
        """Tell whether two diagonals of a panel meet inside it.

        Examples
        --------
        >>> Diagonal(0, 0, (0, 2), (4, 6)).crosses(Diagonal(0, 0, (1, 3), (5, 7)))
        True
        """
        (a, b), (c, d) = self.corners, other.corners
        return self.face == other.face and (a < c < b < d or c < a < d < b)


def diagonals_of(pose: GeneralPose, protected: Collection[LinkId] = ()) -> list[Diagonal]:
    """Return the diagonals of all panels that are one face, and are not protected.

    A diagonal joins two corners, inside the panel and past its other corners. Those that would part the pieces of
    a hinge are left out: they would make two joints of it.
    """
    if pose.sheet is None or pose.mechanism is None:
        return []
    points = _points(pose)
    found = []
    for panel, faces in enumerate(pose.mechanism.panels):
        if panel in protected or len(faces) != 1:
            continue
        around = pose.sheet.faces[faces[0]]
        corners = _in_plane(points[list(around)])
        for pair in combinations(range(len(around)), 2):
            diagonal = Diagonal(panel, faces[0], pair, (around[pair[0]], around[pair[1]]))
            if _is_inside(corners, pair) and not _parts_a_hinge(pose, diagonal):
                found.append(diagonal)
    return found


def loads_on_stresses(pose: GeneralPose, diagonals: Sequence[Diagonal]) -> tuple[Floats, list[bool]]:
    """Return what creases along diagonals do to each self-stress, and which of them are in no loop.

    A set of creases brings as many rates as it has creases, less the rank of its columns. Returns the loads,
    float[s, D], zero for a crease that brings a rate by itself, and for each diagonal whether its crease only cuts
    a corner off, which hangs on it. All loops close by six equations here, so that no crease has to pass through a
    centre. Raises `NumericalError` if the rank of the closure equations is not that of the equations about
    centres.
    """
    linkage = pose.linkage
    matrix = np.zeros((6 * len(linkage.loops), len(linkage.angles)))
    for number, loop in enumerate(linkage.loops):
        for joint, sign in zip(loop.joints, loop.signs, strict=True):
            twist = _twist(linkage.points[joint], linkage.directions[joint])
            matrix[6 * number : 6 * number + 6, joint] += sign * twist
    parts = split(matrix)
    expected = len(linkage.angles) - pose.rates.shape[1]
    if parts.rank != expected:
        raise NumericalError(
            f"the closure equations in space have rank {parts.rank} at this pose; "
            f"expected {expected}, as about centres"
        )
    columns = np.array([_column(pose, one) for one in diagonals]).reshape(len(diagonals), len(matrix))
    flaps = [not column.any() for column in columns]
    return parts.cokernel.T @ columns.T, flaps


def _points(pose: GeneralPose) -> Floats:
    """Return the vertices where the axes are: in units of the extent, about the middle."""
    assert pose.sheet is not None
    assert pose.sheet.coordinates is not None
    return (in_space(pose.sheet.coordinates) - pose.linkage.middle) / pose.linkage.extent


def _column(pose: GeneralPose, diagonal: Diagonal) -> Floats:
    """Return the derivatives of all loops, six equations each, by the fold along a diagonal: float[6 L]."""
    beyond = _beyond(pose, diagonal)
    start, end = _points(pose)[list(diagonal.ends)]
    twist = _twist(start, (end - start) / float(np.linalg.norm(end - start)))
    return np.concatenate([np.zeros(0), *(_passes(pose.linkage, loop, diagonal.panel, beyond) * twist
                                          for loop in pose.linkage.loops)])  # fmt: skip


def _passes(linkage: PosedLinkage, loop: PosedLoop, panel: LinkId, beyond: Collection[int]) -> int:
    """Return how often a loop passes a diagonal to the joints beyond it, less how often it comes back."""
    pairs = list(linkage.graph.joints.values())
    times = 0
    following = (*loop.joints[1:], loop.joints[0])
    for joint, sign, after in zip(loop.joints, loop.signs, following, strict=True):
        if pairs[joint][1 if sign > 0 else 0] == panel:
            times += (after in beyond) - (joint in beyond)
    return times


def _beyond(pose: GeneralPose, diagonal: Diagonal) -> set[int]:
    """Return the places of the joints of a panel that are between the two corners of a diagonal."""
    return _joints_at(pose, _sides(pose, diagonal)[0])


def _parts_a_hinge(pose: GeneralPose, diagonal: Diagonal) -> bool:
    """Tell whether a joint has edges on both sides of a diagonal."""
    between, around = _sides(pose, diagonal)
    return not _joints_at(pose, between).isdisjoint(_joints_at(pose, around))


def _sides(pose: GeneralPose, diagonal: Diagonal) -> tuple[set[frozenset[int]], set[frozenset[int]]]:
    """Return the sides of a panel between the two corners of a diagonal, and the others."""
    assert pose.sheet is not None
    first, last = diagonal.corners
    every = list(map(frozenset, sides_of_face(pose.sheet.faces[diagonal.face])))
    return set(every[first:last]), {*every[:first], *every[last:]}


def _joints_at(pose: GeneralPose, edges: Collection[frozenset[int]]) -> set[int]:
    """Return the places of the joints that have one of some edges."""
    assert pose.mechanism is not None
    pieces = pose.mechanism.pieces
    return {
        place
        for place, joint in enumerate(pose.linkage.graph.joints)
        if any(frozenset(edge) in edges for edge in pieces[joint])  # type: ignore[index]  # numbers of edges
    }


def _twist(point: Floats, direction: Floats) -> Floats:
    return np.concatenate([direction, np.cross(point, direction)])


def _in_plane(points: Floats) -> Floats:
    """Return points of a panel in its plane: float[n, 2]."""
    return np.asarray((points - points.mean(axis=0)) @ principal_axes(points)[1][:2].T)


def _is_inside(corners: Floats, pair: tuple[int, int]) -> bool:
    """Tell whether the line between two corners of a polygon parts it in two."""
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
    """Tell whether two segments share a point."""
    over, under = signed_area([[(a, b, c), (a, b, d)], [(c, d, a), (c, d, b)]])
    near = DOUBLE.same_point
    return all(min(areas) <= near and max(areas) >= -near for areas in (over, under))
