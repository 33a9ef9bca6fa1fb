"""How many branches a flat sheet of degree-4 vertices has, counted vertex by vertex without a list.

Where opposite sectors make 180 degrees, each mode of a vertex keeps tan(fold / 2) of its four creases in fixed
proportion. A branch chooses modes: creases that move connect vertices to clusters with one freedom each, in which all
proportions agree. Choices that agree are counted along the sheet: of all choices at the vertices so far only what
they make of the creases between these and the others matters, and how many choices make the same of them (a transfer
over the frontier, as for layer orders). What is counted are branches on which every vertex moves; whether others exist
is looked at apart. Theory: docs/theory/branches.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np

from graphs.rank.singular_values import inertia, null_space
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.singular.second_order import Quadric, quadrics_of

MOST_STATES = 4_000
"""So many different frontiers are kept at most; sheets of equal rows need a few."""
_DIGITS = 7
"""Decimals of the logarithm of a proportion by which two are told to be equal: proportions are known to 1e-9."""

_AGREE = 1e-5
"""Logarithms of proportions round a panel that differ by less are equal: errors add up along a sheet."""

Mode = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class ModeCount:
    """How many branches move every vertex, by their freedoms; `all` says that there are no others."""

    kinds: Counter[int | None]
    all: bool


def modes_of(linkage: Linkage) -> list[tuple[Mode, ...]] | None:
    """Return the one or two modes of each loop, the parts of its creases; None where a vertex has none or no such."""
    by_joints = {quadric.joints: quadric for quadric in quadrics_of(linkage)}
    every = []
    for loop in linkage.loops:
        axes = (linkage.directions[list(loop.joints)] * np.array(loop.signs, dtype=float)[:, None]).T
        rates = null_space(axes)
        if len(loop.joints) != 4 or rates.shape[1] != 2:
            return None
        modes = _modes(rates, by_joints.get(loop.joints))
        if not modes:
            return None
        every.append(modes)
    return every


def _modes(rates: Floats, quadric: Quadric | None) -> tuple[Mode, ...]:
    if quadric is None:
        return ()
    form = rates.T @ quadric.form @ rates
    signs = inertia(form, DOUBLE.zero)
    if signs.positive != 1 or signs.negative != 1:
        return ()
    up, down = np.sqrt(signs.values[1]) * signs.vectors[:, 1], np.sqrt(-signs.values[0]) * signs.vectors[:, 0]
    modes = []
    for normal in (up + down, up - down):
        mode = rates @ np.array([-normal[1], normal[0]])
        mode = mode / np.abs(mode).max()
        modes.append(tuple(np.where(np.abs(mode) > DOUBLE.zero_rate, mode, 0.0).tolist()))
    return tuple(modes)


def count_of_modes(linkage: Linkage) -> ModeCount | None:
    """Return how many branches choose a mode at every vertex; None if modes are no such, or frontiers are too many."""
    modes = modes_of(linkage)
    if not modes:
        return None
    kinds = _transferred(linkage, dict(enumerate(modes)))
    if kinds is None:
        return None
    loose = len(linkage.angles) - len(_loops_of_joints(linkage))  # creases in no loop are free on every branch
    freedoms: Counter[int | None] = Counter({(own or 0) + loose: number for own, number in kinds.items()})
    return ModeCount(freedoms, kinds.total() > 0 and _no_vertex_rests(linkage, modes))


_State = tuple[tuple[int, ...], tuple[tuple[int, float], ...]]
"""For each crease of the frontier its cluster, -1 at rest, and its part there: sign and logarithm of its size."""


def _transferred(linkage: Linkage, modes: Mapping[int, Sequence[Mode]]) -> Counter[int | None] | None:
    """Return how many choices of modes of some loops agree, by freedoms; None if frontiers are too many.

    Along lines of creases that rest in one mode, such as the zigzags of a Miura sheet, or along those that hold each
    other: what is free along one multiplies along the other.
    """
    for groups in (nx.connected_components(_weakly(linkage, modes)), [set(modes)]):
        kinds = _transferred_along(linkage, modes, _order(linkage, modes, list(groups)))
        if kinds is not None:
            return kinds
    return None


def _transferred_along(
    linkage: Linkage, modes: Mapping[int, Sequence[Mode]], order: Sequence[int]
) -> Counter[int | None] | None:
    """Return the same, with the loops in an order."""
    last: dict[int, int] = {}
    for place, number in enumerate(order):
        last |= dict.fromkeys(linkage.loops[number].joints, place)
    states: dict[_State, tuple[_State, Counter[int | None]]] = {((), ()): (((), ()), Counter({0: 1}))}
    frontier: tuple[int, ...] = ()
    for place, number in enumerate(order):
        joints = linkage.loops[number].joints
        after = tuple(joint for joint in dict.fromkeys((*frontier, *joints)) if last[joint] > place)
        following: dict[_State, tuple[_State, Counter[int | None]]] = {}
        for state, freedoms in states.values():
            for mode in modes[number]:
                new = _extended(state, frontier, joints, mode, after)
                if new is None:
                    continue
                total = following.setdefault(_rounded(new[0]), (new[0], Counter()))[1]
                for dimension, times in freedoms.items():
                    total[(dimension or 0) + new[1]] += times
        if len(following) > MOST_STATES:
            return None
        states, frontier = following, after
    return sum((freedoms for _, freedoms in states.values()), Counter[int | None]())


def _rounded(state: _State) -> _State:
    """Return what tells states apart; those at the edge of rounding may be kept twice, and are counted right."""
    return state[0], tuple((sign, round(size, _DIGITS) + 0.0) for sign, size in state[1])


def _order(linkage: Linkage, modes: Mapping[int, Sequence[Mode]], groups: Sequence[Collection[int]]) -> list[int]:
    """Return loops in an order in which each shares as many joints as possible with those before, group by group."""
    loops_of = _loops_of_joints(linkage)
    group = {loop: number for number, members in enumerate(groups) for loop in members}
    beside = {one: {other for joint in linkage.loops[one].joints for other in loops_of[joint]} - {one} for one in modes}
    left, shared, met = dict.fromkeys(modes), Counter[int](), dict[int, int]()
    order: list[int] = []
    while left:
        near = [number for number in met if number in left] or list(left)
        now = group[order[-1]] if order else None
        number = max(near, key=lambda one: (group[one] == now, shared[one], -met.get(one, 0), -len(beside[one])))
        del left[number]
        order.append(number)
        for other in sorted(beside[number] & left.keys()):
            shared[other] += 1
            met.setdefault(other, len(met))
    return order


def _weakly(linkage: Linkage, modes: Mapping[int, Sequence[Mode]]) -> nx.Graph:
    """Return a graph with an edge between vertices whose common crease rests in some mode of each."""
    weak = nx.Graph()
    weak.add_nodes_from(modes)
    ends: dict[int, list[int]] = {}
    for number in modes:
        for place, joint in enumerate(linkage.loops[number].joints):
            if not all(mode[place] for mode in modes[number]):
                ends.setdefault(joint, []).append(number)
    weak.add_edges_from(pair for pair in ends.values() if len(pair) == 2)
    return weak


def _held(linkage: Linkage, modes: Mapping[int, Sequence[Mode]]) -> nx.DiGraph:
    """Return a graph with an edge from a vertex to each that rests if it does, by the crease between them."""
    holds = nx.DiGraph()
    holds.add_nodes_from(modes)
    loops_of = _loops_of_joints(linkage)
    for number in modes:
        for place, joint in enumerate(linkage.loops[number].joints):
            if all(mode[place] for mode in modes[number]):
                holds.add_edges_from((other, number) for other in loops_of[joint] if other != number and other in modes)
    return holds


def _loops_of_joints(linkage: Linkage) -> dict[int, list[int]]:
    loops_of: dict[int, list[int]] = {}
    for number, loop in enumerate(linkage.loops):
        for joint in loop.joints:
            loops_of.setdefault(joint, []).append(number)
    return loops_of


def _extended(
    state: _State, frontier: tuple[int, ...], joints: Sequence[int], mode: Mode, after: tuple[int, ...]
) -> tuple[_State, int] | None:
    """Return the frontier with one more vertex in a mode, and how many clusters end; None if creases disagree."""
    clusters = dict(zip(frontier, state[0], strict=True))
    parts = dict(zip(frontier, state[1], strict=True))
    own = {joint: _part(value) for joint, value in zip(joints, mode, strict=True) if value}
    fresh = max(clusters.values(), default=-1) + 1
    known = [joint for joint in joints if joint in clusters]
    if any((clusters[joint] >= 0) != (joint in own) for joint in known):
        return None
    shift: dict[int, tuple[int, float]] = {}
    for joint in known:
        if joint not in own:
            continue
        sign, size = own[joint][0] * parts[joint][0], own[joint][1] - parts[joint][1]
        there = shift.setdefault(clusters[joint], (sign, size))
        if there[0] != sign or abs(there[1] - size) > _AGREE:
            return None
    for joint, cluster in clusters.items():
        if cluster in shift:
            sign, size = shift[cluster]
            clusters[joint], parts[joint] = fresh, (parts[joint][0] * sign, parts[joint][1] + size)
    for joint in joints:
        if joint not in clusters or joint in own:
            clusters[joint], parts[joint] = (fresh, own[joint]) if joint in own else (-1, (1, 0.0))
    ended = len(set(clusters.values()) - {-1} - {clusters[joint] for joint in after})
    return _normal(clusters, parts, after), ended


def _part(value: float) -> tuple[int, float]:
    return (1 if value > 0.0 else -1), float(np.log(abs(value)))


def _normal(clusters: dict[int, int], parts: dict[int, tuple[int, float]], after: tuple[int, ...]) -> _State:
    """Return a frontier whose clusters are numbered in its order, each with its first crease as unit."""
    numbers: dict[int, int] = {-1: -1}
    first: dict[int, tuple[int, float]] = {}
    new, sizes = [], []
    for joint in after:
        cluster = clusters[joint]
        numbers.setdefault(cluster, len(numbers) - 1)
        unit = first.setdefault(cluster, parts[joint])
        new.append(numbers[cluster])
        rest = cluster < 0
        sizes.append((1, 0.0) if rest else (parts[joint][0] * unit[0], parts[joint][1] - unit[1]))
    return tuple(new), tuple(sizes)


def _no_vertex_rests(linkage: Linkage, modes: Sequence[tuple[Mode, ...]]) -> bool:
    """Tell whether every branch on which a vertex rests is part of one on which more of them move.

    A crease that moves in both modes of a vertex holds it if it rests. So with one vertex all rest that such creases
    lead to; where these alone can move, creases to others at rest, the branch is part of a larger one.
    """
    holds = _held(linkage, dict(enumerate(modes)))
    groups = nx.condensation(holds)
    sinks = [groups.nodes[node]["members"] for node in groups if not groups.out_degree(node)]
    return all(len(sink) == len(modes) or _moves_alone(linkage, modes, sorted(sink)) for sink in sinks)


def _moves_alone(linkage: Linkage, modes: Sequence[tuple[Mode, ...]], loops: Sequence[int]) -> bool:
    """Tell whether some vertices can move with all creases to other vertices at rest."""
    inside = set(loops)
    outside = {joint for number, loop in enumerate(linkage.loops) if number not in inside for joint in loop.joints}
    kept = {}
    for number in loops:
        at_rest = [place for place, joint in enumerate(linkage.loops[number].joints) if joint in outside]
        kept[number] = [mode for mode in modes[number] if not any(mode[place] for place in at_rest)]
    kinds = _transferred(linkage, kept)
    return kinds is not None and kinds.total() > 0
