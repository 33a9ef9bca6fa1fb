"""What shall be locked, what shall be creased? Too many freedoms, or too few.

Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from math import inf, isfinite
from typing import NamedTuple

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, check_argument, numbered, shown
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sheet import Sheet
from graphs.rank.singular_values import spectrum, split
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId, LinkId
from synth.advice.answer import Advice, Creased, Locked
from synth.advice.diagonals import Diagonal, diagonals_of, loads_on_stresses
from synth.advice.general_pose import GeneralPose, general_pose
from synth.advice.locks import Cost, cheapest_sets, held
from synth.advice.search import Bounds, Candidates, freedoms_when_left_out, smallest_sets
from synth.folding.configuration import SheetConfiguration
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration
from synth.motion.walk.allowance import Allowance
from synth.moving.made import Movable, configuration_of

__all__ = ["advise"]

_LIMIT = 20
_WORK = 2_000_000_000
"""Numbers of matrices that a search goes through, be they few large or many small ones: some seconds."""
_STEPS = 300_000
"""Steps of a search, however small the matrices."""
_ONE_MORE = 1
"""Diagonals beyond the fewest that are looked for if nothing is said."""
_DIGITS = 6
"""Of how much joints move: what moves alike is told apart by its place."""


@dataclass(frozen=True, slots=True)
class _Kept:
    """What is to stay as it is."""

    joints: Collection[JointId] = ()
    links: Collection[LinkId] = ()
    flaps: bool = False
    weights: Mapping[JointId, float] = field(default_factory=dict)


class _Locks(NamedTuple):
    """Sets of joints to lock, whether there are or may be more, and whether the search was ended."""

    sets: tuple[Locked, ...]
    more: bool
    used_up: bool


def advise(
    thing: Movable,
    freedoms: int,
    *,
    branch: int | str | None = None,
    weights: Mapping[JointId, float] | None = None,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    flaps: bool = True,
    limit: int = _LIMIT,
    size: int | None = None,
    leave_out: bool = False,
) -> Advice:
    """Say which joints to lock, or which panels to crease, for a number of freedoms.

    Parameters
    ----------
    thing : Mechanism
        With coordinates. Only panels of a sheet can be creased.
    freedoms : int
        That are wanted, K. Of M that there are, M - K joints are locked, or K - M diagonals and more are creased.
    branch : int or str, optional
        From a singular pose, a flat sheet above all: the way to move of which this is asked, by its number or
        signs. By default that which marks choose.
    weights : mapping of joint id to float, optional
        What it costs to lock a joint, 0 or more; 1 where nothing is said.
    joints, links : collection of ids, optional
        Protected: the joints, and all joints of the links, are not locked; the links are not creased.
    flaps : bool, optional
        Whether joints in no loop may be locked, and corners be cut off to hang as flaps.
    limit : int, optional
        So many sets are listed at most.
    size : int, optional
        Of the largest set of diagonals that is looked for; by default one more than K - M.
    leave_out : bool, optional
        Tell of each set to lock what a flat sheet has without these creases, too: left out they stay at 0, which
        is a special angle.

    Raises
    ------
    InvariantError
        If a number is out of range, or there is no such joint, link or branch.
    UnsolvableError
        If the thing has no coordinates, nothing moves, what is protected leaves too few joints, or there are no
        panels to crease.
    NumericalError
        If no general pose is found.

    Examples
    --------
    A vertex of six creases has three freedoms; three creases are locked, not the one that is dear:

    >>> from math import cos, pi, sin
    >>> around = [(cos(k * pi / 3 + 0.1 * (k % 2)), sin(k * pi / 3 + 0.1 * (k % 2))) for k in range(6)]
    >>> faces = tuple((0, 1 + k, 1 + (k + 1) % 6) for k in range(6))
    >>> sheet = Sheet(7, tuple((0, k) for k in range(1, 7)), "MVVMVV", faces, ((0.0, 0.0), *around))
    >>> advice = advise(sheet, 0, weights={0: 5.0}, limit=1)
    >>> advice, advice.locks[0].joints, advice.locks[0].weight
    (<Advice: 3 to 0 freedoms, 1 sets>, (1, 3, 4), 3.0)
    """
    check_argument("advise", thing, Movable)
    kept = _Kept(frozenset(joints), frozenset(links), not flaps, dict(weights or {}))
    _check_number("freedoms", freedoms, 0)
    _check_number("limit", limit, 1)
    at = configuration_of(thing)
    sheet = at.drawn if isinstance(at, SheetConfiguration) else None
    pose = general_pose(at, branch)
    _check_names(pose, kept)
    every = list(pose.linkage.graph.joints)
    flapping = tuple(every[place] for place in pose.flaps)
    if freedoms <= pose.freedoms:
        found = _locks(pose, pose.freedoms - freedoms, kept, limit)
        locks = tuple(_with_left_out(lock, sheet) for lock in found.sets) if leave_out else found.sets
        return Advice(
            at,
            pose.freedoms,
            freedoms,
            pose.branch,
            flapping,
            locks,
            more=found.more,
            used_up=found.used_up,
        )
    largest = freedoms - pose.freedoms + _ONE_MORE if size is None else size
    _check_number("size", largest, freedoms - pose.freedoms)
    return _creased(at, pose, freedoms, kept, (largest, limit))


def _locks(pose: GeneralPose, size: int, kept: _Kept, limit: int) -> _Locks:
    """Return the cheapest sets of joints to lock."""
    if not size:
        return _Locks((), False, False)
    allowed = _free_joints(pose, kept)
    most = held(pose.rates, allowed)
    if most < size:
        least = pose.freedoms - most
        raise UnsolvableError(
            f"at least {least} of {numbered(pose.freedoms, 'degree of freedom', 'degrees of freedom')} remain: "
            f"locking all joints that are not protected removes {most}, and {size} are to be removed"
        )
    flaps = set(pose.flaps)
    moves = np.round((pose.rates**2).sum(axis=1), _DIGITS)
    costs: list[Cost] = [
        (kept.weights.get(joint, 1.0), float(place in flaps), -float(moves[place]))
        for place, joint in enumerate(pose.linkage.graph.joints)
    ]
    allowance = _allowance(pose.rates)
    first = list(islice(cheapest_sets(pose.rates, size, costs, allowed, allowance), limit + 1))
    more = len(first) > limit or allowance.left < 0
    return _Locks(tuple(_locked(pose, places, costs) for places in first[:limit]), more, allowance.left < 0)


def _allowance(matrix: Floats) -> Allowance:
    """Return the steps that a search may take, each of which goes through a matrix."""
    return Allowance(min(_STEPS, _WORK // max(matrix.size, 1)))


def _with_left_out(lock: Locked, sheet: Sheet | None) -> Locked:
    """Return a set with what a flat sheet has without its creases."""
    if sheet is None or not lies_flat(sheet):
        raise UnsolvableError("creases are left out of flat sheets only; those of a folded one can be locked")
    joints = [joint for joint in lock.joints if isinstance(joint, int)]  # numbers of edges
    return replace(lock, left_out=freedoms_when_left_out(sheet, joints))


def _free_joints(pose: GeneralPose, kept: _Kept) -> list[int]:
    """Return the places of the joints that may be locked."""
    flaps = set(pose.flaps) if kept.flaps else set()
    return [
        place
        for place, (joint, ends) in enumerate(pose.linkage.graph.joints.items())
        if joint not in kept.joints and place not in flaps and not set(ends) & set(kept.links)
    ]


def _locked(pose: GeneralPose, places: tuple[int, ...], costs: Sequence[Cost]) -> Locked:
    """Return a set of joints with what comes of locking them, its freedoms by a rank."""
    every = list(pose.linkage.graph.joints)
    chosen = set(places)
    parts = split(pose.rates[list(places)])
    still = np.abs(pose.rates @ parts.right[len(places) :].T).max(axis=1, initial=0.0) <= DOUBLE.zero_rate
    flaps = set(pose.flaps)
    return Locked(
        tuple(every[place] for place in places),
        sum(costs[place][0] for place in places),
        tuple(every[place] for place in places if place in flaps),
        tuple(joint for place, joint in enumerate(every) if place not in chosen and still[place]),
        float(1.0 / parts.values[-1]) if parts.values[-1] else inf,
        _freedoms_without(pose, places),
    )


def _freedoms_without(pose: GeneralPose, places: tuple[int, ...]) -> int | None:
    """Return the freedoms with joints locked: those left, less the rank of their closure equations."""
    matrix: Floats = ClosureEquations(pose.linkage).at(pose.linkage.angles)[1].toarray()
    others = np.delete(matrix, list(places), axis=1)
    rank = spectrum(others, DOUBLE.derivative).rank
    return None if rank is None else others.shape[1] - rank


def _creased(at: Configuration, pose: GeneralPose, freedoms: int, kept: _Kept, most: tuple[int, int]) -> Advice:
    """Return the smallest sets of diagonals that bring the freedoms wanted."""
    if pose.sheet is None or not isinstance(at, SheetConfiguration):
        raise UnsolvableError(
            f"{numbered(pose.freedoms, 'degree of freedom', 'degrees of freedom')}, and {freedoms} required: "
            "only panels of a sheet can be creased"
        )
    largest, limit = most
    diagonals = diagonals_of(pose, kept.links)
    loads, flaps = loads_on_stresses(pose, diagonals)
    chosen = [place for place, flap in enumerate(flaps) if not (flap and kept.flaps)]
    candidates = Candidates([diagonals[place] for place in chosen], loads[:, chosen], _allowance(loads))
    bounds = Bounds(pose.freedoms, pose.rates.shape[1], freedoms, largest)
    found = smallest_sets(pose.sheet, candidates, bounds, limit)
    creases = tuple(
        Creased(
            tuple(_as_given(candidates.diagonals[place], at.drawn) for place in places),
            sum(flaps[chosen[place]] for place in places),
            freedoms,
        )
        for places in found.sets
    )
    every = list(pose.linkage.graph.joints)
    return Advice(
        at,
        pose.freedoms,
        freedoms,
        pose.branch,
        tuple(every[place] for place in pose.flaps),
        creases=creases,
        more=found.more,
        used_up=found.used_up,
        searched=found.searched,
        refused=found.refused,
    )


def _as_given(diagonal: Diagonal, sheet: Sheet) -> Diagonal:
    """Return a diagonal with the vertices that the sheet had before it was opened along its cuts."""
    around = sheet.faces[diagonal.face]
    first, last = diagonal.corners
    return Diagonal(diagonal.panel, diagonal.face, diagonal.corners, (around[first], around[last]))


def _check_number(what: str, number: int, least: int) -> None:
    if number < least:
        raise InvariantError(what, f"{what}: {number}", f"{least} or more")


def _check_names(pose: GeneralPose, kept: _Kept) -> None:
    """Refuse joints and links that are not there, and weights that are none."""
    graph = pose.linkage.graph
    for joint in (*kept.joints, *kept.weights):
        if joint not in graph.joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint", known(graph.joints, str(joint)))
    for link in kept.links:
        if link not in graph:
            raise InvariantError("link", f"{shown(link)} is no link", known(graph.nodes, str(link)))
    for joint, weight in kept.weights.items():
        if not isfinite(weight) or weight < 0.0:
            raise InvariantError("weight", f"the weight of joint {shown(joint)} is {weight:g}", "0 or more")
