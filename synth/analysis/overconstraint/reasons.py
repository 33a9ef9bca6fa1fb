"""Special geometry that makes closure equations redundant, where it is recognised, by its name.

Each reason is a property of the axes of some loops, tested to a part of the extent; or the directions of axes
alone decide, where self-stresses are couples. Theory: docs/theory/overconstraint.md.
"""

from collections.abc import Iterator
from math import pi

import numpy as np

from graphs.geometry import lines_meet, rigid_motion, sectors, unit
from graphs.joints.linkage import JointedLinkage, JointKind, Leg, legs, plain_vector
from graphs.joints.revolutes import recognised
from graphs.loops.loop import Centre
from graphs.mechanism.solids import HingedSolids
from graphs.rank.singular_values import null_space, singular_values
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Flags, Floats, Ints
from synth.analysis.motion.linkage import Linkage, LinkageLoop, axis_lengths
from synth.analysis.overconstraint.redundancy import FirstOrderClosure


def reasons_of(linkage: Linkage, loops: tuple[int, ...], tolerances: Tolerances = DOUBLE) -> list[str]:
    """Return the special geometry of a set of loops, by name; none where no reason known here fits."""
    chosen = [linkage.loops[loop] for loop in loops]
    turned = tolerances.parallel / axis_lengths(linkage)
    near = [float(turned[list(loop.joints)].sum()) for loop in chosen]  # what rounding of all its axes comes to
    if len(chosen) == 1:
        return list(_of_one_loop(linkage, chosen[0], near[0]))
    return list(_of_vertices(linkage, chosen, near))


def _of_one_loop(linkage: Linkage, loop: LinkageLoop, near: float) -> Iterator[str]:
    """Yield reasons that one loop shows where lengths, in units of the extent, and angles are wrong by so much."""
    points, axes = linkage.points[list(loop.joints)], linkage.directions[list(loop.joints)]
    if set(loop.joints) & set(linkage.slides):
        return
    if loop.centre is not Centre.NONE:
        spread = axes if loop.centre is Centre.FINITE else np.vstack([axes[:1], points - points[0]])
        if singular_values(spread)[-1] <= near:
            yield "all axes in one plane, at this configuration"
        return
    if _parallel(axes, axes[0], near).all():
        yield "all axes parallel: a planar loop"
    elif lines_meet(points, axes).off.max() <= near:
        yield "all axes through one point: a spherical loop"
    else:
        yield from _of_two_directions(axes, near)
        yield from _of_equal_links(points, axes, near)
        yield from _of_symmetry(points, axes, near)


def _of_two_directions(axes: Floats, near: float) -> Iterator[str]:
    parallel = _parallel(axes[:, None], axes[None], near)
    sizes = sorted(int(row.sum()) for row in np.unique(parallel, axis=0))
    if sizes == [3, 3]:
        yield "two triples of parallel axes (Sarrus)"
    elif len(sizes) > 1 and sizes[-1] > 3:
        yield f"{sizes[-1]} parallel axes in a row of {len(axes)}"


def _of_equal_links(points: Floats, axes: Floats, near: float) -> Iterator[str]:
    lengths, twists = _links(points, axes, near)
    if len(axes) == 4:
        alike = np.abs(lengths - np.roll(lengths, 2)).max() <= near
        turned = np.abs(np.sin(twists) - np.sin(np.roll(twists, 2))).max() <= near
        ratio = lengths[0] * np.sin(twists[1]) - lengths[1] * np.sin(twists[0])
        if alike and turned and abs(ratio) <= near:
            yield "opposite links equal, lengths proportional to the sines of the twists (Bennett)"
    elif np.abs(np.cos(twists)).max() <= near and np.ptp(lengths) <= near:
        yield "twists of 90° and equal lengths (kaleidocycle)"
    elif len(axes) == 6 and np.abs(np.cos(twists)).max() <= near:
        before, after = _feet(points, axes, near)
        alternate = (lengths**2) @ np.array([1.0, -1.0] * 3)
        if np.abs(after - before).max() <= near and abs(float(alternate)) <= near:
            yield "twists of 90°, no offsets, equal sums of squares of alternate lengths (Bricard's trihedral)"


def _of_symmetry(points: Floats, axes: Floats, near: float) -> Iterator[str]:
    count = len(axes)
    if count % 2 == 0 and _is_symmetry(points, axes, np.roll(np.arange(count), count // 2), near, half_turn=True):
        yield "line symmetry: a half-turn maps each axis to the opposite one"
    for shift in range(count):
        if _is_symmetry(points, axes, (shift - np.arange(count)) % count, near, half_turn=False):
            yield "plane symmetry: a reflection maps the axes to each other"
            return


def _is_symmetry(points: Floats, axes: Floats, image: Ints, near: float, *, half_turn: bool) -> bool:
    """Check whether half a turn about a line, or a mirror, takes each axis to its image.

    Points of lines: the two feet on the axes of the links beside, which a symmetry takes to each other.
    """
    before, after = _feet(points, axes, near)
    if half_turn:
        there = np.concatenate([before[image], after[image]])
    else:
        there = np.concatenate([after[image], before[image]])
    here = np.concatenate([before, after])
    turn, shift = rigid_motion(here, there, mirrored=not half_turn)
    twice = np.abs(turn @ turn - np.eye(3)).max() <= near  # of order two; no identity, no inversion
    if not twice or abs(float(np.trace(turn)) + (1.0 if half_turn else -1.0)) > near:
        return False
    moved = np.abs(here @ turn.T + shift - there).max() <= near
    return bool(moved and _parallel(axes @ turn.T, axes[image], near).all())


def _of_vertices(linkage: Linkage, loops: list[LinkageLoop], near: list[float]) -> Iterator[str]:
    """Vertices of four creases that fold flat keep the ratios of their half-angle tangents."""
    if all(loop.centre is Centre.FINITE and len(loop.joints) == 4 for loop in loops):
        round_each = [(*_sectors(linkage, loop), error) for loop, error in zip(loops, near, strict=True)]
        if all(abs(a + c - pi) <= error and abs(b + d - pi) <= error for a, b, c, d, error in round_each):
            yield (
                "flat-foldable degree-4 vertices: half-angle tangents keep their ratios, and the ratios agree "
                "round these vertices at this configuration, hence along the whole branch"
            )
        elif all(abs(a - c) <= error and abs(b - d) <= error for a, b, c, d, error in round_each):
            yield "degree-4 vertices with equal opposite sector angles: opposite creases have equal fold angles"


def _sectors(linkage: Linkage, loop: LinkageLoop) -> list[float]:
    """Return the angles between creases, as they go out from the vertex."""
    outwards = linkage.directions[list(loop.joints)] * np.array(loop.signs, dtype=float)[:, None]
    return [float(sector) for sector in sectors(outwards)]


def _links(points: Floats, axes: Floats, near: float) -> tuple[Floats, Floats]:
    """Return lengths of common normals and twists between successive axes."""
    before, after = _feet(points, axes, near)
    lengths = np.linalg.norm(np.roll(before, -1, axis=0) - after, axis=1)
    twists = sectors(axes)
    return lengths, np.minimum(twists, pi - twists)


def _feet(points: Floats, axes: Floats, near: float) -> tuple[Floats, Floats]:
    """Return, on each axis, the feet of the common normals with the axis before it and with that after it."""
    after = _foot(points, axes, np.roll(points, -1, axis=0), np.roll(axes, -1, axis=0), near)
    before = _foot(points, axes, np.roll(points, 1, axis=0), np.roll(axes, 1, axis=0), near)
    return before, after


def _foot(points: Floats, axes: Floats, others: Floats, directions: Floats, near: float) -> Floats:
    cosines = (axes * directions).sum(axis=1, keepdims=True)
    sines = 1.0 - cosines**2
    along = ((others - points) * (axes - cosines * directions)).sum(axis=1, keepdims=True)
    parallel = _parallel(axes, directions, near)[:, None]
    level = ((others - points) * axes).sum(axis=1, keepdims=True) / 2.0  # parallel: half-way between the points
    return np.asarray(points + np.where(parallel, level, along / np.where(parallel, 1.0, sines)) * axes)


def _parallel(axes: Floats, other: Floats, near: float) -> Flags:
    """Check which axes are parallel, whichever way they run."""
    return np.asarray(np.linalg.norm(np.cross(axes, other), axis=-1) <= near)


_SCREW = 6


def turning_reasons(
    linkage: Linkage,
    order: FirstOrderClosure,
    loops: tuple[int, ...],
    tolerances: Tolerances = DOUBLE,
    seen: JointedLinkage | None = None,
) -> Iterator[str]:
    """Yield why rotational equations of a set of spatial loops depend on each other, if only these do.

    Legs are those of the linkage as it is `seen` with joints of all kinds; by default such joints are recognised.
    """
    if any(linkage.loops[loop].centre is not Centre.NONE for loop in loops) or not _couples_only(order, loops):
        return
    near = float(tolerances.parallel / axis_lengths(linkage).min()) * len(linkage.directions)
    if _legs_are_parallel(seen or _recognised(linkage), near):
        yield (
            "axes parallel in each leg: each leg rotates its end about one direction, "
            "together they prevent every rotation"
        )
    else:
        yield "directions of axes alone: the rotational closure equations are dependent"


def _couples_only(order: FirstOrderClosure, loops: tuple[int, ...]) -> bool:
    """Check whether self-stresses of some loops hold no forces, in loops that have no such stress by themselves."""
    rows = np.flatnonzero(np.isin(order.loop_of, loops))
    stresses = null_space(order.matrix[rows].T, DOUBLE.singular)
    own = {loop: null_space(order.matrix[order.loop_of == loop].T, DOUBLE.singular) for loop in loops}
    shared = [loop for loop in loops if len(loops) == 1 or not _largest(own[loop][_SCREW // 2 :])]
    forces = [stresses[order.loop_of[rows] == loop][_SCREW // 2 :] for loop in shared]
    return bool(shared and stresses.size and not _largest(np.concatenate(forces)))


def _largest(forces: Floats) -> float:
    """Return the largest force, 0 if none is larger than what rounding leaves."""
    largest = float(np.abs(forces).max(initial=0.0))
    return largest if largest > DOUBLE.singular else 0.0


def _recognised(linkage: Linkage) -> JointedLinkage:
    """Return a linkage of revolutes with the joints that rows of them stand for."""
    axes = {
        joint: (plain_vector(point), plain_vector(axis))
        for joint, point, axis in zip(linkage.graph.joints, linkage.points, linkage.directions, strict=True)
    }
    return recognised(HingedSolids(linkage.graph, axes))


def _legs_are_parallel(seen: JointedLinkage, near: float) -> bool:
    """Check whether each row of joints between binary links turns about one direction, however it slides."""
    rows = [leg for leg in legs(seen.chain) if len(leg.joints) > 1]
    return len(rows) > 1 and all(_turns_about_one(seen, row, near) for row in rows)


def _turns_about_one(seen: JointedLinkage, row: Leg, near: float) -> bool:
    """Check whether all axes of rotation in a leg have one direction."""
    kinds = [seen.kinds[joint] for joint in row.joints]
    if JointKind.SPHERICAL in kinds:
        return False
    turning = [joint for joint in row.joints if seen.kinds[joint] is not JointKind.PRISMATIC]
    directions: Floats = unit([axis for joint in turning for axis in seen.places[joint].axes])
    return bool(np.linalg.norm(np.cross(directions, directions[0]), axis=1).max() <= near) if turning else False
