"""Addenda taken off one after the other: which joint is asked next, and whether its two links may go.

Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from graphs.loops.loop import cut_into_cycles, dependent_loop, in_span_of
from graphs.reduce.working import Path, Removal, WorkingGraph
from graphs.types import JointId, LinkId

__all__ = ["RULES", "Taken", "Terms", "take_all"]

RULES = ("ride-along", "dyad")


@dataclass(frozen=True, slots=True)
class Terms:
    """Which addenda may be taken off: ride-alongs or dyads, without protected links.

    `fully`: a block may lose its last loop.
    """

    rule: str
    fully: bool
    protected: frozenset[LinkId]


class Taken(NamedTuple):
    """An addendum that was taken off the links a and b (`onto`).

    `joint` is the joint a-b that takes the place of the addendum; None for a dyad.
    """

    removal: Removal
    joint: JointId | None
    onto: tuple[LinkId, LinkId]


_Cycle = tuple[JointId, frozenset[JointId]]
"""A joint, and the cycle that it closes."""


def take_all(work: WorkingGraph, terms: Terms) -> list[Taken]:
    """Take addenda off a working graph until none is left; return them in their order.

    Joints that only an elimination can decide wait until nothing else is left to do, since a loop less may
    settle them at once.
    """
    ride_alongs = terms.rule == "ride-along"
    taken: list[Taken] = []
    waiting = dict.fromkeys(reversed(list(work.joints)))
    hard: dict[JointId, None] = {}
    while waiting or hard:
        easy_first = bool(waiting)
        middle, _ = waiting.popitem() if waiting else hard.popitem()
        path = _path_that_may_go(work, middle, terms)
        if path is None:
            continue
        if ride_alongs:
            cycles = _cycles(work, path)
            if easy_first and _needs_elimination(work, middle, cycles):
                hard[middle] = None
                continue
            step = _take_ride_along(work, path, cycles)
        else:
            step = _take_dyad(work, path)
        if step is None:
            continue
        taken.append(step)
        eased = hard.keys() & work.loops[step.removal.dropped]
        for joint in eased:
            del hard[joint]
        waiting |= dict.fromkeys(sorted(eased, key=str))
        for link in step.onto:
            if work.degree[link] == 2:
                waiting |= dict.fromkeys(work.joints_at(link))
    return taken


def _path_that_may_go(work: WorkingGraph, middle: JointId, terms: Terms) -> Path | None:
    """Return the path of a joint that joins two binary links between two others, if nothing protects them."""
    path = work.path(middle) if middle in work.joints else None
    if path is None:
        return None
    if path.a == path.b or path.u in terms.protected or path.v in terms.protected:
        return None
    return path if terms.fully or work.loops_in_block[work.block_of[middle]] > 1 else None


def _cycles(work: WorkingGraph, path: Path) -> list[_Cycle]:
    """Return the joints between the ends of a path, each with the cycle that it closes with it."""
    a, before, _, middle, _, after, b = path
    between = work.original[a][b] if work.original.has_edge(a, b) else ()
    return [(joint, frozenset((before, middle, after, joint))) for joint in sorted(between, key=str)]


def _needs_elimination(work: WorkingGraph, middle: JointId, cycles: list[_Cycle]) -> bool:
    """Tell whether it takes an elimination to know if the two links that a joint joins are a ride-along."""
    for _, cycle in cycles:
        known, member = work.member_at_once(cycle, middle)
        if not known:
            return True
        if member is not None:
            return False
    return False


def _take_ride_along(work: WorkingGraph, path: Path, cycles: list[_Cycle]) -> Taken | None:
    """Take off the two links within a path, if they are a ride-along."""
    middle = path.middle
    for joint, cycle in cycles:
        dropped = work.member_through(cycle, middle)
        if dropped is None:
            continue
        reopened = None
        if dropped in work.closing:
            reopened = _independent_member(work, cycle, middle)
            if reopened is None:
                continue
        others = sorted(work.through[middle] - {dropped})
        removal = work.remove(path, dropped, [(index, cycle) for index in others], reopened)
        return Taken(removal, joint, (path.a, path.b))
    return None


def _independent_member(work: WorkingGraph, cycle: frozenset[JointId], middle: JointId) -> int | None:
    """Return an independent loop with a centre, through a joint, that is part of the sum giving a closing loop."""
    independent = [i for i in range(len(work.loops)) if work.alive[i] and i not in work.closing]
    passing = [i for i in work.centred_through(middle) if i not in work.closing]
    if len(passing) == 1 and len(work.through[middle] - work.closing) == 1:
        return passing[0]
    summands = in_span_of(cycle, [work.loops[i] for i in independent])
    return (
        None if summands is None else next((independent[i] for i in summands if independent[i] in passing), None)
    )


def _take_dyad(work: WorkingGraph, path: Path) -> Taken | None:
    """Take off the two links within a path, a dyad, if a loop through it has a centre."""
    middle = path.middle
    passing = [i for i in work.centred_through(middle) if i not in work.closing]
    if not passing:
        return None
    dropped = min(passing, key=lambda i: (len(work.loops[i]), i))
    deltas: list[tuple[int, frozenset[JointId]]] = []
    for index in sorted(work.through[middle] - {dropped}):
        merged = _one_cycle(work, index, dropped, [d for d, _ in deltas])
        if merged is None:
            return None
        deltas.append((index, frozenset(work.loops[index] ^ merged)))
    block = work.block_of[middle]
    removal = work.remove(path, dropped, deltas)
    work.renumber_block(block)
    return Taken(removal, None, (path.a, path.b))


def _one_cycle(work: WorkingGraph, index: int, dropped: int, done: list[int]) -> set[JointId] | None:
    """Return the sum of two loops as one cycle; if it falls apart, a part that is independent of the rest."""
    merged = work.loops[index] ^ work.loops[dropped]
    parts = [set(part) for part in cut_into_cycles(sorted(merged, key=str), work.joints)]
    if len(parts) == 1:
        return parts[0]
    if index in work.closing:
        return None
    skip = {index, dropped, *done}
    rest = [
        tuple(x) for i, x in enumerate(work.loops) if work.alive[i] and i not in work.closing and i not in skip
    ]
    for part in sorted(parts, key=len, reverse=True):
        if dependent_loop([*rest, tuple(part)]) is None:
            return part
    return None
