"""The verdict on a crease pattern with coordinates: its ways to move, followed or proved.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence

import networkx as nx
import numpy as np
from scipy.optimize import linprog

from graphs.arrays import Floats
from graphs.ids import JointId, LinkId
from graphs.mechanism.precision import Precision
from graphs.rank.pose import pose_mobility_of_axes
from synth.folding.branches import Branch, Certainty
from synth.folding.linkage import PosedLinkage
from synth.folding.path import PathOptions, driven_path
from synth.folding.placement import moved
from synth.folding.prepared import Prepared
from synth.folding.second_order import rates_near
from synth.folding.singular.quadrics import quadrics_of
from synth.folding.singular.sampling import FOLLOWED, rates_towards
from synth.folding.verdict.verdict import Verdict, Way
from synth.folding.verdict.words import Told, flaps_of, text_of_motion

__all__ = ["verdict_of_motion"]

_STILL = 1e-9
_FLAT = 1e-9
_CLOSED = Precision(1e-11, "closed loops")


def verdict_of_motion(pattern: Prepared, generic: int | None = None) -> Verdict:
    """Say how a crease pattern moves from its pose.

    Parameters
    ----------
    pattern : Prepared
    generic : int, optional
        The mobility of its type, with which the sentence compares.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.prepared import prepared
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> print(verdict_of_motion(prepared(Sheet(5, (), "", faces, corners)), 1))
    Folds with 1 freedom from flat, in 2 ways.
    """
    linkage = pattern.linkage
    if not linkage.graph.joints:
        return Verdict(0, "motion", "proved", "Nothing to fold: there are no creases between panels.")
    if pattern.branches is None:
        return _of_large(pattern, generic)
    found = pattern.branches
    ways = tuple(_way(linkage, branch) for branch in found.branches)
    known = found.complete and all(way.freedoms is not None for way in ways)
    still = _common(linkage, ways) if known else ()
    chosen, agree = _chosen(found.branches, pattern.marks, _is_flat(linkage))
    told = Told(
        linkage,
        ways,
        flat=_is_flat(linkage),
        marked=agree,
        complete=found.complete,
        generic=generic,
        stiff=still,
    )
    freedoms, certainty = _answer(ways, chosen, found.exhaustive)
    text = text_of_motion(told, freedoms, certainty)
    return Verdict(
        freedoms,
        "pose" if found.regular and certainty == "proved" else "motion",
        certainty,
        text,
        ways,
        found.exhaustive,
        still,
        _clusters(linkage, still),
        _places(pattern, still),
    )


def _way(linkage: PosedLinkage, branch: Branch) -> Way:
    joints = list(linkage.graph.joints)
    apart = np.abs(branch.sample - linkage.angles) > _STILL
    still = [joint for place, joint in enumerate(joints) if place in branch.still and not apart[place]]
    return Way(branch.signs, branch.freedoms, branch.certainty, tuple(still))


def _answer(ways: Sequence[Way], chosen: int | None, exhaustive: bool) -> tuple[int | None, Certainty]:
    """Return the freedoms that are told, and how they are known."""
    if not ways:
        return 0, "proved" if exhaustive else "not known"
    if chosen is not None:
        return ways[chosen].freedoms, ways[chosen].certainty
    known = [way for way in ways if way.freedoms is not None]
    if not known:
        return None, "not known"
    best = max(known, key=lambda way: way.freedoms or 0)
    return best.freedoms, best.certainty


def _chosen(branches: Sequence[Branch], marks: Floats, flat: bool) -> tuple[int | None, bool | None]:
    """Return the branch that marks choose, of several that have them all the freest; and whether one has."""
    if not flat or not marks.any() or not branches:
        return None, None
    agree = [number for number, branch in enumerate(branches) if _has(branch, marks)]
    if not agree:
        return None, False
    return max(agree, key=lambda number: (branches[number].freedoms or 0, -number)), True


def _has(branch: Branch, marks: Floats) -> bool:
    """Tell whether a branch can begin with all marked joints as they are marked."""
    marked = marks != 0.0
    for signs in (marks, -marks):  # a branch is one up to the sign of all rates
        if branch.space.left:
            rates = rates_towards(branch.space, signs)
            if (rates[marked] * signs[marked] > _STILL).all():
                return True
            continue
        rows = -signs[marked, None] * branch.space.basis[marked]
        found = linprog(
            np.zeros(rows.shape[1]), A_ub=rows, b_ub=-np.ones(len(rows)), bounds=(None, None), method="highs"
        )
        if found.status == 0:
            return True
    return False


def _common(linkage: PosedLinkage, ways: Sequence[Way]) -> tuple[JointId, ...]:
    """Return the joints that move on no way."""
    if not ways:
        return tuple(linkage.graph.joints)
    still = set(ways[0].stiff_joints).intersection(*(way.stiff_joints for way in ways))
    return tuple(joint for joint in linkage.graph.joints if joint in still)


def _clusters(linkage: PosedLinkage, still: Sequence[JointId]) -> tuple[tuple[LinkId, ...], ...]:
    """Return links that stiff joints make one."""
    together = nx.Graph()
    together.add_edges_from(linkage.graph.joints[joint] for joint in still)
    order = {link: place for place, link in enumerate(linkage.graph)}
    found = [tuple(sorted(links, key=order.__getitem__)) for links in nx.connected_components(together)]
    return tuple(sorted(found, key=lambda links: order[links[0]]))


def _places(
    pattern: Prepared, joints: Sequence[JointId]
) -> dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]]:
    corners = pattern.sheet.coordinates
    assert corners is not None
    ends = {joint: pattern.mechanism.hinges[joint] for joint in joints}  # type: ignore[index]
    return {joint: (tuple(corners[a]), tuple(corners[b])) for joint, (a, b) in ends.items()}


def _is_flat(linkage: PosedLinkage) -> bool:
    return bool(np.abs(linkage.angles).max(initial=0.0) <= _FLAT)


def _of_large(pattern: Prepared, generic: int | None) -> Verdict:
    """Follow one motion of a linkage that is too large for all its branches to be looked for."""
    linkage, closure = pattern.linkage, pattern.closure
    wanted = pattern.marks if pattern.marks.any() else np.ones(len(linkage.angles))
    rates = rates_near(closure, linkage.angles, quadrics_of(linkage), wanted)
    flat = _is_flat(linkage)
    if rates is None or len(flaps_of(linkage.graph)) == len(linkage.graph.joints):
        text = text_of_motion(Told(linkage, (), flat, None, False, generic, ()), None, "not known")
        return Verdict(None, "motion", "not known", text)
    rates = rates / np.abs(rates).max()
    driver = int(np.abs(rates).argmax())
    goal = linkage.angles[driver] + FOLLOWED * np.sign(rates[driver])
    path = driven_path(closure, linkage.angles, [driver], goal, options=PathOptions(rates, straight=True))
    if path.stopped:
        text = text_of_motion(Told(linkage, (), flat, None, False, generic, ()), None, "not known")
        return Verdict(None, "motion", "not known", text)
    end = path.angles[-1]
    there = moved(linkage, end)
    axes = {
        joint: (tuple(point), tuple(direction))
        for joint, point, direction in zip(linkage.graph.joints, there.points, there.directions, strict=True)
    }
    pose = pose_mobility_of_axes(linkage.graph, axes, _CLOSED)
    signs = "".join("0" if abs(rate) <= 1e-7 else "+-"[int(rate < 0)] for rate in rates)
    still = tuple(
        joint
        for joint, rate, change in zip(linkage.graph.joints, rates, end - linkage.angles, strict=True)
        if abs(rate) <= _STILL and abs(change) <= _STILL
    )
    certainty: Certainty = "not known" if pose.dof is None else "numerical"
    way = Way(signs, pose.dof, certainty, still)
    stiff = still if pose.dof == 1 and not flat else ()
    told = Told(linkage, (way,), flat, None, False, generic, stiff)
    text = text_of_motion(told, pose.dof, certainty)
    return Verdict(pose.dof, "motion", certainty, text, (way,), False, stiff, _clusters(linkage, stiff))
