"""Geometry of points, directions and rotations: arrays in, arrays out, over any leading axes.

Nothing here depends on the last bit: where several planes, lines or rotations are equally good, the one returned
depends on the points alone. Points may coincide, lie in one line, and be 1e40 or 1e-40 apart. Zero here means
rounding; callers judge what is zero for the precision of a file (`graphs.tolerances`).
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from graphs.tolerances import MARGIN, canonical_basis
from graphs.types import Flags, Floats

__all__ = [
    "Fit",
    "Meeting",
    "across",
    "angles_between",
    "area_vector",
    "best_line",
    "best_plane",
    "common_direction",
    "crossing",
    "facing",
    "frame_about",
    "lines_meet",
    "nearest_rotation",
    "principal_axes",
    "rigid_motion",
    "rotated",
    "rotations",
    "sectors",
    "signed_area",
    "unit",
]

# Part of the largest extent. A decomposition rounds by some 1e-16 times the root of the number of points; this holds
# for any number of points, and is far below the errors of drawn coordinates, 1e-6 and more.
_ROUNDING = 1e-12


def unit(vectors: npt.ArrayLike) -> Floats:
    """Return vectors, float[..., d], of length one; zero vectors stay zero."""
    array = np.asarray(vectors, dtype=float)
    lengths = np.linalg.norm(array, axis=-1, keepdims=True)
    return np.asarray(array / np.where(lengths > 0.0, lengths, 1.0))


def across(vectors: npt.ArrayLike, axes: npt.ArrayLike) -> Floats:
    """Return the parts of vectors, float[..., d], across axes of any length; zero axes take nothing away."""
    array, along = np.asarray(vectors, dtype=float), unit(axes)
    return np.asarray(array - (array * along).sum(axis=-1, keepdims=True) * along)


def crossing(vectors: npt.ArrayLike) -> Floats:
    """Return the matrices, float[..., 3, 3], of cross products with vectors, float[..., 3]."""
    array = np.asarray(vectors, dtype=float)
    x, y, z = array[..., 0], array[..., 1], array[..., 2]
    matrices = np.zeros((*array.shape, 3))
    matrices[..., 2, 1], matrices[..., 1, 2] = x, -x
    matrices[..., 0, 2], matrices[..., 2, 0] = y, -y
    matrices[..., 1, 0], matrices[..., 0, 1] = z, -z
    return matrices


def frame_about(directions: npt.ArrayLike) -> Floats:
    """Return right-handed frames about directions of any length, float[..., 3]: float[..., 3, 3].

    Rows are orthonormal: one across the coordinate axis flattest to the direction, another, the direction.
    """
    axes = unit(directions)
    sizes = np.abs(axes)
    flattest = (sizes <= sizes.min(axis=-1, keepdims=True) + MARGIN).argmax(axis=-1)
    first = unit(np.cross(axes, np.eye(3)[flattest]))
    return np.stack([first, np.cross(axes, first), axes], axis=-2)


def angles_between(one: npt.ArrayLike, other: npt.ArrayLike) -> Floats:
    """Return the angles between vectors of any length, 0 to pi; small ones have all their digits."""
    a, b = unit(one), unit(other)
    return np.asarray(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(axis=-1)))


def sectors(directions: npt.ArrayLike) -> Floats:
    """Return the angles, 0 to pi, from each direction, float[..., n, 3], to the next in a ring: float[..., n]."""
    array = np.asarray(directions, dtype=float)
    return angles_between(array, np.roll(array, -1, axis=-2))


def rotations(axes: npt.ArrayLike, angles: npt.ArrayLike) -> Floats:
    """Return the matrices, float[..., 3, 3], of rotations about unit vectors by angles in radians (Rodrigues)."""
    along = np.asarray(axes, dtype=float)
    x, y, z = np.moveaxis(along, -1, 0)
    c, s = np.cos(angles), np.sin(angles)
    v = 1.0 - c
    m = np.empty((*np.broadcast_shapes(along.shape[:-1], np.shape(angles)), 3, 3))
    m[..., 0, 0], m[..., 0, 1], m[..., 0, 2] = c + x * x * v, x * y * v - z * s, x * z * v + y * s
    m[..., 1, 0], m[..., 1, 1], m[..., 1, 2] = x * y * v + z * s, c + y * y * v, y * z * v - x * s
    m[..., 2, 0], m[..., 2, 1], m[..., 2, 2] = x * z * v - y * s, y * z * v + x * s, c + z * z * v
    return m


def rotated(vectors: npt.ArrayLike, axis: npt.ArrayLike, angle: npt.ArrayLike) -> Floats:
    """Return vectors rotated about a unit vector by radians, right-handed (Rodrigues), without the matrix."""
    v, e = np.asarray(vectors, dtype=float), np.asarray(axis, dtype=float)
    angle = np.asarray(angle, dtype=float)[..., np.newaxis]
    along = (v * e).sum(axis=-1, keepdims=True) * e
    return np.asarray(along + np.cos(angle) * (v - along) + np.sin(angle) * np.cross(e, v))


def nearest_rotation(matrices: npt.ArrayLike, *, mirrored: bool = False) -> Floats:
    """Return the rotations nearest to matrices, float[..., d, d], by the sum of squared entries.

    ``mirrored`` returns orthogonal matrices of determinant -1 instead. Where several are equally near (points in
    one line, in one place), it is the one that turns least. Source: W. Kabsch, A solution for the best rotation to
    relate two sets of vectors, Acta Cryst. A32 (1976) 922-923.
    """
    array = np.asarray(matrices, dtype=float)
    handed = -1.0 if mirrored else 1.0
    left, sizes, right = np.linalg.svd(array)
    nearest = left @ right
    wrong = np.linalg.det(nearest) * handed < 0.0
    nearest = nearest - 2.0 * np.where(wrong[..., None, None], left[..., :, -1:] @ right[..., -1:, :], 0.0)
    if array.shape[-1] > 1:
        free = sizes[..., -2] <= _ROUNDING * sizes[..., 0]
        tied = wrong & (sizes[..., -2] - sizes[..., -1] <= MARGIN * sizes[..., 0])
        for place in map(tuple, np.argwhere(free | tied)):
            nearest[place] = _least_turn(left[place], sizes[place], right[place], handed)
    return np.asarray(nearest)


def _least_turn(left: Floats, sizes: Floats, right: Floats, handed: float) -> Floats:
    """Return one of many nearest rotations by a rule.

    In directions that the matrix says nothing of, it turns least. If one of several directions that it says as
    little of has to be mirrored, that is the last of their canonical basis.
    """
    rank = int((sizes > _ROUNDING * sizes[0]).sum())
    if rank < len(sizes) - 1:
        there, here = canonical_basis(left[:, rank:]), canonical_basis(right[rank:].T)
        known = left[:, :rank] @ right[:rank]
        mirrored = np.linalg.det(known + there @ here.T) * handed < 0.0
        return np.asarray(known + there @ nearest_rotation(there.T @ here, mirrored=mirrored) @ here.T)
    tied = right[sizes - sizes[-1] <= MARGIN * sizes[0]].T
    mirror = canonical_basis(tied)[:, -1]
    return np.asarray(left @ right @ (np.eye(len(sizes)) - 2.0 * np.outer(mirror, mirror)))


def rigid_motion(before: npt.ArrayLike, after: npt.ArrayLike, *, mirrored: bool = False) -> tuple[Floats, Floats]:
    """Return the motion that takes points, float[..., n, d], nearest to others, by the sum of squared distances.

    A point p goes to rotation @ p + shift, float[..., d, d] and float[..., d]; ``mirrored``: by a mirroring
    motion.
    """
    start, end = np.asarray(before, dtype=float), np.asarray(after, dtype=float)
    here, there = start.mean(axis=-2, keepdims=True), end.mean(axis=-2, keepdims=True)
    rotation = nearest_rotation(np.swapaxes(end - there, -1, -2) @ (start - here), mirrored=mirrored)
    return rotation, (there - here @ np.swapaxes(rotation, -1, -2))[..., 0, :]


@dataclass(frozen=True, slots=True)
class Fit:
    """A plane or a line fitted to points.

    ``middle``, float[..., d], is the mean of the points; ``direction``, float[..., d], the unit normal or the
    direction, its largest component positive; ``off``, float[...], the greatest distance of a point from it.
    """

    middle: Floats
    direction: Floats
    off: Floats


def principal_axes(points: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Return the directions in which points, float[..., n, d], are long, less long and short, about their mean.

    These are sizes, float[..., d], the roots of the sums of squared distances along each, descending, and axes,
    float[..., d, d], whose rows are orthonormal, the largest component of each positive. Directions of equal size
    are those of the canonical basis of their space.
    """
    array = np.asarray(points, dtype=float)
    sizes, axes = _axes(array - array.mean(axis=-2, keepdims=True))
    tied = _tied(sizes)
    for place in map(tuple, np.argwhere(tied.any(axis=-1))):
        ends = [0, *(np.flatnonzero(~tied[place]) + 1).tolist(), array.shape[-1]]
        for first, last in pairwise(ends):
            axes[place][first:last] = canonical_basis(axes[place][first:last].T).T
    return sizes, facing(axes)


def best_plane(points: npt.ArrayLike) -> Fit:
    """Return the plane (in two dimensions: the line) nearest to points, by the sum of squared distances.

    If the points, float[..., n, d], lie in one line or place, the normal is the last vector of the canonical basis
    of all.
    """
    middle, around, axes, tied = _fitted(points)
    normal = axes[..., -1, :].copy()
    for place in map(tuple, np.argwhere(tied[..., -1])):
        first = int(np.flatnonzero(np.append(False, ~tied[place]))[-1]) if not tied[place].all() else 0
        normal[place] = canonical_basis(axes[place][first:].T)[:, -1]
    normal = facing(normal)
    off = np.abs((around * normal[..., None, :]).sum(axis=-1)).max(axis=-1, initial=0.0)
    return Fit(middle, normal, off)


def best_line(points: npt.ArrayLike) -> Fit:
    """Return the line nearest to points, float[..., n, d], by the sum of squared distances.

    If they spread equally in several directions, it is along the first vector of their canonical basis.
    """
    middle, around, axes, tied = _fitted(points)
    direction = _longest(axes, tied)
    off = np.linalg.norm(across(around, direction[..., None, :]), axis=-1).max(axis=-1, initial=0.0)
    return Fit(middle, direction, off)


def common_direction(directions: npt.ArrayLike) -> Floats:
    """Return the mean direction of nearly parallel lines, whichever way each runs: unit vectors, float[..., d].

    Of directions, float[..., k, d], long ones weigh more; the largest component of the mean is positive.
    """
    sizes, axes = _axes(np.asarray(directions, dtype=float))
    return _longest(axes, _tied(sizes))


def _longest(axes: Floats, tied: Flags) -> Floats:
    """Return the first of axes; of several that are equal, the first of their canonical basis."""
    direction = axes[..., 0, :].copy()
    for place in map(tuple, np.argwhere(tied[..., 0])):
        last = int(np.append(tied[place], False).argmin()) + 1
        direction[place] = canonical_basis(axes[place][:last].T)[:, 0]
    return facing(direction)


def _fitted(points: npt.ArrayLike) -> tuple[Floats, Floats, Floats, Flags]:
    """Return the mean of points, the points about it, their axes, and which axes are as long as the next."""
    array = np.asarray(points, dtype=float)
    middle = array.mean(axis=-2)
    around = array - middle[..., None, :]
    sizes, axes = _axes(around)
    return middle, around, axes, _tied(sizes)


def _axes(around: Floats) -> tuple[Floats, Floats]:
    """Return all singular values and right singular vectors: also where there are fewer points than dimensions."""
    fewer = around.shape[-1] - around.shape[-2]
    if fewer > 0:
        around = np.concatenate([around, np.zeros((*around.shape[:-2], fewer, around.shape[-1]))], axis=-2)
    _, sizes, axes = np.linalg.svd(around, full_matrices=False)
    return sizes, axes


def _tied(sizes: Floats) -> Flags:
    """Return which sizes are equal to the next: to a millionth, or both by rounding: bool[..., d - 1]."""
    return np.asarray(sizes[..., :-1] - sizes[..., 1:] <= MARGIN * sizes[..., :-1] + _ROUNDING * sizes[..., :1])


def facing(directions: Floats) -> Floats:
    """Return directions or their negatives: those whose largest component is positive, the first of equal ones."""
    sizes = np.abs(directions)
    place = (sizes >= (1.0 - MARGIN) * sizes.max(axis=-1, keepdims=True)).argmax(axis=-1)
    ahead = np.take_along_axis(directions, place[..., None], axis=-1) >= 0.0
    return np.where(ahead, directions, -directions) + 0.0


@dataclass(frozen=True, slots=True)
class Meeting:
    """Where lines meet.

    ``point``, float[..., d], is nearest to all lines, by the sum of squared distances; for parallel lines, that
    abreast of the mean of the points on them. ``off``, float[..., k], is its distance from each line. ``spread``,
    float[...], is how clearly the point is known: the least singular value of the equations over the largest; 0
    for parallel lines, sin(a / 2) / cos(a / 2) for two at an angle a in the plane.
    """

    point: Floats
    off: Floats
    spread: Floats


def lines_meet(points: npt.ArrayLike, directions: npt.ArrayLike) -> Meeting:
    """Return the point nearest to lines: a point on each and a direction of any length, float[..., k, d]."""
    on, along = np.asarray(points, dtype=float), unit(directions)
    middle = on.mean(axis=-2)
    around = on - middle[..., None, :]
    dimensions = on.shape[-1]
    projections = np.eye(dimensions) - along[..., :, None] * along[..., None, :]
    stacked = projections.reshape(*on.shape[:-2], -1, dimensions)
    left, sizes, right = np.linalg.svd(stacked, full_matrices=False)
    clear = sizes > _ROUNDING * sizes[..., :1]
    feet = across(around, along).reshape(*on.shape[:-2], -1, 1)
    parts = (np.swapaxes(left, -1, -2) @ feet)[..., 0] * np.where(clear, 1.0 / np.where(clear, sizes, 1.0), 0.0)
    place = (np.swapaxes(right, -1, -2) @ parts[..., None])[..., 0]
    off = np.linalg.norm(across(place[..., None, :] - around, along), axis=-1)
    spread = sizes[..., -1] / np.where(sizes[..., 0] > 0.0, sizes[..., 0], 1.0)
    return Meeting(middle + place, off, np.asarray(spread))


def area_vector(corners: npt.ArrayLike) -> Floats:
    """Return the area of polygons, float[..., n, 3], as a vector to the side where they run counter-clockwise.

    For a polygon that is not planar, the vector does not depend on how it is filled.
    """
    array = np.asarray(corners, dtype=float)
    if not array.shape[-2]:
        return np.zeros((*array.shape[:-2], 3))
    arms = array - array[..., :1, :]
    return np.asarray(np.cross(arms, np.roll(arms, -1, axis=-2)).sum(axis=-2) / 2.0)


def signed_area(corners: npt.ArrayLike) -> Floats:
    """Return the area of polygons in the plane, float[..., n, 2], counter-clockwise positive."""
    array = np.asarray(corners, dtype=float)
    if not array.shape[-2]:
        return np.zeros(array.shape[:-2])
    x, y = np.moveaxis(array - array[..., :1, :], -1, 0)
    return np.asarray((x * np.roll(y, -1, axis=-1) - y * np.roll(x, -1, axis=-1)).sum(axis=-1) / 2.0)
