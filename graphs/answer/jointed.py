"""How a linkage with joints of all kinds moves at its pose, and which of its freedoms are passive.

A freedom is *passive* if it moves links of one leg, a row of binary links, and nothing else: the spinning of a leg
between two spherical joints. Theory: docs/theory/joints.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphs.answer.counted_joints import report_of_joints
from graphs.answer.planar import with_planar_loops
from graphs.answer.ranks import notes_of_pose
from graphs.answer.report import MobilityAnswer
from graphs.arrays import Floats
from graphs.count.equations import traditional_cgk
from graphs.errors import numbered, shown
from graphs.geometry import frame_about, unit
from graphs.ids import JointId
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, Leg, legs
from graphs.joints.placing import placed
from graphs.joints.revolutes import revolutes_of
from graphs.loops.cycle_space import signed_cycle
from graphs.mechanism.precision import extent_of
from graphs.mechanism.sc import SCGraph
from graphs.rank.closure import independent_cycles
from graphs.rank.pose import pose_mobility_of_axes
from graphs.rank.singular_values import spectrum
from graphs.tolerances import DOUBLE

__all__ = ["Passive", "freedoms_by_screws", "mobility_of_jointed", "passive_freedoms"]

_FEW = 3
_ROD = 2
"""Joints of a rod between balls."""


@dataclass(frozen=True, slots=True)
class Passive:
    """Freedoms of one leg, by its joints, that move its own links only.

    `spins`: it is one, a turn about the line through two spherical joints.
    """

    joints: tuple[JointId, ...]
    freedoms: int
    spins: bool


def mobility_of_jointed(linkage: JointedLinkage) -> MobilityAnswer:
    """Return how a linkage with joints of all kinds moves: by count of its joints, and at its pose as revolutes.

    Loops that are planar as it lies count three equations each. ``counts["passive"]`` are the passive freedoms,
    ``counts["revolutes"]`` the revolutes whose axes give the freedoms at the pose. Without places there is no
    pose; a note gives the freedoms of a generic realisation.

    >>> leg = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], ground=0)
    >>> kinds = {1: JointKind.SPHERICAL, 2: JointKind.SPHERICAL, 3: JointKind.REVOLUTE}
    >>> answer = mobility_of_jointed(placed(JointedLinkage(leg, kinds)))
    >>> answer.mobility, answer.counts["passive"], answer.pose.dof
    (2, 1, 2)
    """
    whole = placed(linkage)
    solids = revolutes_of(whole)
    pose = pose_mobility_of_axes(solids.chain, solids.axes)
    counted = with_planar_loops(linkage)
    report = report_of_joints(counted)
    passive = passive_freedoms(whole)
    notes = [*report.warnings, f"joints: {linkage.told_kinds}"]
    found = len(counted.chain.centred_loops) - len(linkage.chain.centred_loops)
    if found:
        notes.append(f"{numbered(found, 'loop')} planar at this configuration: 3 equations each")
    notes += _if_planar(linkage)
    general: dict[str, int] = {}
    if not linkage.places:
        general = {} if pose.dof is None else {"general_member": pose.dof}
        freedom = numbered(pose.dof or 0, "degree of freedom", "degrees of freedom")
        known = "degrees of freedom are unknown" if pose.dof is None else f"result is {freedom}"
        notes.append(f"a type without places: for a generic realisation, placed at random, the {known}")
    notes += _passive_notes(passive)
    counts = {
        **report.counts,
        "passive": sum(one.freedoms for one in passive),
        "revolutes": len(solids.chain.joints),
        **general,
    }
    answer = replace(MobilityAnswer.of(report), counts=counts, warnings=tuple(notes))
    return replace(answer, pose=pose).with_notes(warnings=notes_of_pose(pose)) if linkage.places else answer


def _if_planar(linkage: JointedLinkage) -> Iterator[str]:
    """Say what a type counts in a plane, if its joints allow it and nothing says in which space its loops are."""
    chain = linkage.chain
    if linkage.places or chain.loops or not chain.independent_loops:
        return
    if all(kind.planar for kind in linkage.kinds.values()):
        links = len(chain) - chain.components + 1
        planar = traditional_cgk(links, [kind.freedoms for kind in linkage.kinds.values()], 3)
        yield f"no loop has a centre: all are spatial; if all are planar (centre infinite), Eq. 1 gives {planar}"


def passive_freedoms(linkage: JointedLinkage) -> tuple[Passive, ...]:
    """Return the freedoms that move links of one leg only: those it has with both its ends held.

    The linkage has places. Of a leg with an open end, one that comes back to its first link, and a lone ring, each
    row between successive spherical joints is examined; the ground is held, or the longest row of a ring without
    one.
    """
    screws = _screws(linkage)
    found = []
    for row in (row for leg in legs(linkage.chain) for row in _rows_between_ends(linkage, leg)):
        columns = np.hstack([screws[joint] for joint in row])
        rank = spectrum(columns, DOUBLE.closed).rank
        if rank is not None and rank < columns.shape[1]:
            free = columns.shape[1] - rank
            found.append(Passive(row, free, free == 1 and _spins(linkage, row)))
    return tuple(found)


def _rows_between_ends(linkage: JointedLinkage, leg: Leg) -> list[tuple[JointId, ...]]:
    """Return the rows of a leg that may move while both their ends are held."""
    degree = dict(linkage.chain.degree)
    first, last = leg.links[0], leg.links[-1]
    if first != last and min(degree[first], degree[last]) > 1:
        return [leg.joints]
    balls = [place for place, joint in enumerate(leg.joints) if linkage.kinds[joint] is JointKind.SPHERICAL]
    rows = [leg.joints[a : b + 1] for a, b in pairwise(balls)]
    if first != last:
        return rows
    lone = degree[first] == 2
    if rows and lone and first != linkage.chain.ground:
        rows.append(leg.joints[balls[-1] :] + leg.joints[: balls[0] + 1])
        rows.remove(max(rows, key=len))
    # a lone ring of which all joints are between two balls is their line, about which the rest turns
    return [row for row in rows if not lone or len(row) < len(leg.joints) or len(row) == _ROD]


def freedoms_by_screws(linkage: JointedLinkage) -> int | None:
    """Return the freedoms at the pose by the screws of the joints, without revolutes; None if not known.

    The linkage has places, and all loops close with six equations.
    """
    screws = _screws(linkage)
    chain = linkage.chain
    columns = {joint: place for place, joint in enumerate(chain.joints)}
    widths = [screws[joint].shape[1] for joint in chain.joints]
    starts = np.concatenate([[0], np.cumsum(widths)])
    cycles = independent_cycles(SCGraph(chain.nodes, chain.joints))
    matrix = np.zeros((6 * len(cycles), int(starts[-1])))
    for row, loop in enumerate(cycles):
        for joint, sign in signed_cycle(loop.joints, chain.joints):
            place = columns[joint]
            matrix[6 * row : 6 * row + 6, starts[place] : starts[place + 1]] = sign * screws[joint]
    rank = spectrum(matrix, DOUBLE.closed).rank
    return None if rank is None else int(starts[-1]) - rank


def _passive_notes(passive: tuple[Passive, ...]) -> Iterator[str]:
    """Yield the notes on passive degrees of freedom."""
    spinning = [one for one in passive if one.spins]
    others = [one for one in passive if not one.spins]
    for legs_, doing in ((spinning, "spin about the line through their spherical joints"), (others, "move alone")):
        if legs_:
            total = sum(one.freedoms for one in legs_)
            names = "; ".join(", ".join(map(shown, one.joints)) for one in legs_[:_FEW])
            more = f" and {len(legs_) - _FEW} more" if len(legs_) > _FEW else ""
            freedoms = numbered(total, "passive degree of freedom", "passive degrees of freedom")
            yield f"{freedoms}: legs that {doing} (joints {names}{more})"


def _spins(linkage: JointedLinkage, row: tuple[JointId, ...]) -> bool:
    """Tell whether a row that moves between ends held is one that turns between two spherical joints."""
    return sum(linkage.kinds[joint] is JointKind.SPHERICAL for joint in row) == 2


def _screws(linkage: JointedLinkage) -> dict[JointId, Floats]:
    """Return the screws of all joints, lengths in units of the extent: joint to float[6, freedoms]."""
    points = np.array([place.point for place in linkage.places.values()], dtype=float).reshape(-1, 3)
    points = (points - points.mean(axis=0)) / (extent_of(points) or 1.0) if len(points) else points
    return {
        joint: _screws_of(linkage.kinds[joint], place, point)
        for (joint, place), point in zip(linkage.places.items(), points, strict=True)
    }


def _screws_of(kind: JointKind, place: JointPlace, point: Floats) -> Floats:
    axes = unit(np.reshape(place.axes, (-1, 3)))
    turns = np.eye(3) if kind is JointKind.SPHERICAL else axes[:0] if kind is JointKind.PRISMATIC else axes
    shifts = axes[:0]
    if kind in (JointKind.PRISMATIC, JointKind.CYLINDRICAL):
        shifts = axes
    elif kind is JointKind.PLANAR:
        shifts = frame_about(axes[0])[:2]
    turning = np.hstack([turns, np.cross(point, turns)]) if len(turns) else np.zeros((0, 6))
    sliding = np.hstack([np.zeros_like(shifts), shifts]) if len(shifts) else np.zeros((0, 6))
    return np.asarray(np.vstack([turning, sliding]).T)
