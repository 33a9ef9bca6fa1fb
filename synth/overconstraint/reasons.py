"""Special geometry that makes equations idle, where it can be told: which, by its name.

Each reason is a property of the axes of some loops, tested to a part of the extent. Theory:
docs/theory/overconstraint.md.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graphs.arrays import Floats, Ints
from graphs.loops.loop import Centre
from synth.motion.linkage import PosedLinkage, PosedLoop
from synth.moving.made import off_one_point

__all__ = ["reasons_of"]

_NEAR = 1e-6
"""Of directions, and of lengths in units of the extent."""


def reasons_of(linkage: PosedLinkage, loops: tuple[int, ...]) -> list[str]:
    """Say which special geometry a set of loops has; none where no reason that is known here fits.

    Examples
    --------
    >>> from synth.moving.made import configuration_of
    >>> from synth.patterns import generate
    >>> reasons_of(configuration_of(generate("bricard-plane-symmetric").mechanism).linkage, (0,))
    ['plane symmetry: a mirror takes the axes to each other']
    """
    chosen = [linkage.loops[loop] for loop in loops]
    if len(chosen) == 1:
        return list(_of_one_loop(linkage, chosen[0]))
    return list(_of_vertices(linkage, chosen))


def _of_one_loop(linkage: PosedLinkage, loop: PosedLoop) -> Iterator[str]:
    points, axes = linkage.points[list(loop.joints)], linkage.directions[list(loop.joints)]
    if loop.centre is not Centre.NONE:
        spread = axes if loop.centre is Centre.FINITE else np.vstack([axes[:1], points - points[0]])
        if np.linalg.svd(spread, compute_uv=False)[-1] <= _NEAR:
            yield "all axes in one plane, at this pose"
        return
    if _are_parallel(axes):
        yield "all axes parallel: a planar loop"
    elif off_one_point(points, axes) <= _NEAR:
        yield "all axes through one point: a spherical loop"
    else:
        yield from _of_two_directions(axes)
        yield from _of_equal_links(points, axes)
        yield from _of_symmetry(points, axes)


def _of_two_directions(axes: Floats) -> Iterator[str]:
    parallel = np.linalg.norm(np.cross(axes[:, None], axes[None]), axis=2) <= _NEAR
    sizes = sorted(int(row.sum()) for row in np.unique(parallel, axis=0))
    if sizes == [3, 3]:
        yield "two triples of parallel axes (Sarrus)"
    elif len(sizes) > 1 and sizes[-1] > 3:
        yield f"{sizes[-1]} parallel axes in a row of {len(axes)}"


def _of_equal_links(points: Floats, axes: Floats) -> Iterator[str]:
    lengths, twists = _links(points, axes)
    if len(axes) == 4:
        alike = np.abs(lengths - np.roll(lengths, 2)).max() <= _NEAR
        turned = np.abs(np.sin(twists) - np.sin(np.roll(twists, 2))).max() <= _NEAR
        ratio = lengths[0] * np.sin(twists[1]) - lengths[1] * np.sin(twists[0])
        if alike and turned and abs(ratio) <= _NEAR:
            yield "opposite links alike, lengths as the sines of the twists (Bennett)"
    elif np.abs(np.cos(twists)).max() <= _NEAR and np.ptp(lengths) <= _NEAR:
        yield "right twists and equal lengths (kaleidocycle)"
    elif len(axes) == 6 and np.abs(np.cos(twists)).max() <= _NEAR:
        before, after = _feet(points, axes)
        alternate = (lengths**2) @ np.array([1.0, -1.0] * 3)
        if np.abs(after - before).max() <= _NEAR and abs(float(alternate)) <= _NEAR:
            yield "right twists, no offsets, squares of alternate lengths alike in sum (Bricard's trihedral)"


def _of_symmetry(points: Floats, axes: Floats) -> Iterator[str]:
    count = len(axes)
    if count % 2 == 0 and _is_symmetry(points, axes, np.roll(np.arange(count), count // 2), half_turn=True):
        yield "line symmetry: half a turn takes each axis to its opposite"
    for shift in range(count):
        if _is_symmetry(points, axes, (shift - np.arange(count)) % count, half_turn=False):
            yield "plane symmetry: a mirror takes the axes to each other"
            return


def _is_symmetry(points: Floats, axes: Floats, image: Ints, *, half_turn: bool) -> bool:
    """Tell whether half a turn about a line, or a mirror, takes each axis to its image.

    Points of lines: the two feet on the axes of the links beside, which a symmetry takes to each other.
    """
    before, after = _feet(points, axes)
    if half_turn:
        there = np.concatenate([before[image], after[image]])
    else:
        there = np.concatenate([after[image], before[image]])
    here = np.concatenate([before, after])
    middle = here.mean(axis=0)
    if np.abs(there.mean(axis=0) - middle).max() > _NEAR:
        return False
    u, _, v = np.linalg.svd((here - middle).T @ (there - middle))
    wanted = 1.0 if half_turn else -1.0
    turn = v.T @ np.diag([1.0, 1.0, wanted * np.sign(np.linalg.det(v.T @ u.T))]) @ u.T
    squares = np.abs(turn @ turn - np.eye(3)).max() <= _NEAR  # of order two, and no inversion
    if not squares or abs(float(np.trace(turn)) + wanted) > _NEAR:
        return False
    moved = np.abs((here - middle) @ turn.T + middle - there).max()
    directed = np.linalg.norm(np.cross(axes @ turn.T, axes[image]), axis=1).max()
    return bool(max(moved, directed) <= _NEAR)


def _of_vertices(linkage: PosedLinkage, loops: list[PosedLoop]) -> Iterator[str]:
    """Vertices of four creases that fold flat keep the ratios of their half-angle tangents."""
    if all(loop.centre is Centre.FINITE and len(loop.joints) == 4 for loop in loops):
        axes = [linkage.directions[list(loop.joints)] for loop in loops]
        if all(_folds_flat(one, loop) for one, loop in zip(axes, loops, strict=True)):
            yield (
                "vertices of four creases that fold flat: half-angle tangents keep their ratios there, and as "
                "these agree round the vertices at this pose they agree at all"
            )
        elif all(_opposite_sectors_alike(one, loop) for one, loop in zip(axes, loops, strict=True)):
            yield "vertices of four creases with opposite sectors alike: opposite creases turn alike"


def _folds_flat(axes: Floats, loop: PosedLoop) -> bool:
    """Tell whether every other of four sectors add up to half a turn."""
    first, second, third, fourth = _sectors(axes, loop)
    return abs(first + third - np.pi) <= _NEAR and abs(second + fourth - np.pi) <= _NEAR


def _opposite_sectors_alike(axes: Floats, loop: PosedLoop) -> bool:
    first, second, third, fourth = _sectors(axes, loop)
    return abs(first - third) <= _NEAR and abs(second - fourth) <= _NEAR


def _sectors(axes: Floats, loop: PosedLoop) -> list[float]:
    """Return the angles between creases, as they go out from the vertex."""
    outwards = axes * np.array(loop.signs, dtype=float)[:, None]
    cosines = np.clip((outwards * np.roll(outwards, -1, axis=0)).sum(axis=1), -1.0, 1.0)
    return [float(one) for one in np.arccos(cosines)]


def _links(points: Floats, axes: Floats) -> tuple[Floats, Floats]:
    """Return lengths of common normals and twists between successive axes."""
    before, after = _feet(points, axes)
    lengths = np.linalg.norm(np.roll(before, -1, axis=0) - after, axis=1)
    cosines = np.abs((axes * np.roll(axes, -1, axis=0)).sum(axis=1))
    return lengths, np.arccos(np.clip(cosines, 0.0, 1.0))


def _feet(points: Floats, axes: Floats) -> tuple[Floats, Floats]:
    """Return, on each axis, the feet of the common normals with the axis before it and with that after it."""
    after = _foot(points, axes, np.roll(points, -1, axis=0), np.roll(axes, -1, axis=0))
    before = _foot(points, axes, np.roll(points, 1, axis=0), np.roll(axes, 1, axis=0))
    return before, after


def _foot(points: Floats, axes: Floats, others: Floats, directions: Floats) -> Floats:
    cosines = (axes * directions).sum(axis=1, keepdims=True)
    sines = 1.0 - cosines**2
    along = ((others - points) * (axes - cosines * directions)).sum(axis=1, keepdims=True)
    parallel = sines <= _NEAR**2
    level = ((others - points) * axes).sum(axis=1, keepdims=True) / 2.0  # parallel: half-way between the points
    return np.asarray(points + np.where(parallel, level, along / np.where(parallel, 1.0, sines)) * axes)


def _are_parallel(axes: Floats) -> bool:
    return bool(np.linalg.norm(np.cross(axes, axes[0]), axis=1).max() <= _NEAR)
