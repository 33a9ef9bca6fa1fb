"""Which loop of a block stays when all but one are taken off.

A block that is nothing but ride-alongs on ride-alongs comes down to a single four-bar, and several of its
four-bars may be the last. Their centres differ, so the choice shows: it is made by what the centres are and not by
the order in which things are given. Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from graphs.identity.chains import ColouredGraph, labels_of
from graphs.loops.loop import Centre
from graphs.reduce.taking import Taken
from graphs.reduce.working import WorkingGraph
from graphs.types import LinkId

__all__ = ["links_of_loops_that_stay"]


class _FourBar(NamedTuple):
    """A four-bar of a block, and the class of the loops that it is a sum of."""

    links: frozenset[LinkId]
    centre_class: int


@dataclass(frozen=True, slots=True)
class _Choice:
    """A block that came down to one four-bar: its last loop, here as a four-bar.

    `there` are the four-bars that could stay, the last one among them.
    """

    last: int
    here: _FourBar
    there: tuple[_FourBar, ...]

    @property
    def classes(self) -> frozenset[int]:
        return frozenset(one.centre_class for one in self.there)


def links_of_loops_that_stay(
    work: WorkingGraph, taken: Sequence[Taken], protected: Collection[LinkId]
) -> frozenset[LinkId]:
    """Return the links of four-bars that should have stayed, if others did.

    Ride-alongs were taken off until none was left, each block keeping a loop. The links are to be protected too,
    as some are anyway, when the reduction is done again; none if it was right. A finite centre stays before one at
    infinity, a centre of its own before one that other blocks have too. If several shared centres are still equal,
    canonical labels of what is left decide: then the choice has no meaning, but it is always the same.
    """
    choices = [_most_general(work, one) for one in _choices(work, taken, protected)]
    labels = _labels(work, choices, protected) if any(len(one.classes) > 1 for one in choices) else {}
    stay: set[LinkId] = set()
    for one in choices:
        chosen = min(one.there, key=lambda four_bar: labels.get(four_bar.centre_class, 0))
        if chosen.centre_class != one.here.centre_class:
            stay |= chosen.links
    return frozenset(stay)


def _choices(work: WorkingGraph, taken: Sequence[Taken], protected: Collection[LinkId]) -> list[_Choice]:
    """Return the blocks that came down to one four-bar.

    A link that is protected or lies in another block cannot go; a four-bar can be the last if it has all of these.
    """
    taken_off: dict[int, list[_FourBar]] = defaultdict(list)
    for removal, _, onto in taken:
        four_bar = _FourBar(frozenset((*removal.links, *onto)), work.class_of[removal.dropped])
        taken_off[work.block_of[removal.joints[1]]].append(four_bar)
    choices = []
    for loop in work.kept_loops()[0]:
        joints = work.loops[loop]
        block = work.block_of[next(iter(joints))]
        if loop not in work.class_of or len(joints) != 4 or work.loops_in_block[block] != 1:
            continue
        links = frozenset(link for joint in joints for link in work.joints[joint])
        fixed = {link for link in links if link in protected or work.degree[link] > 2}
        here = _FourBar(links, work.class_of[loop])
        choices.append(_Choice(loop, here, (here, *(one for one in taken_off[block] if fixed <= one.links))))
    return choices


def _most_general(work: WorkingGraph, choice: _Choice) -> _Choice:
    """Keep the four-bars of the most general kind: of one class, unless several shared classes are equal."""
    kinds = {which: (_is_planar(work, which), _is_shared(work, which)) for which in choice.classes}
    best = min(kinds.values())
    there = [one for one in choice.there if kinds[one.centre_class] == best]
    _, shared = best
    return _Choice(choice.last, choice.here, tuple(there if shared else there[:1]))


def _is_planar(work: WorkingGraph, which: int) -> bool:
    return work.original.centre_classes()[which].centre is Centre.INFINITE


def _is_shared(work: WorkingGraph, which: int) -> bool:
    """Tell whether a class has loops in several blocks, which a file says by naming their centre."""
    return len({work.block_of[joint] for joint in work.original.centre_classes()[which].joints}) > 1


def _labels(work: WorkingGraph, choices: Sequence[_Choice], protected: Collection[LinkId]) -> Mapping[int, int]:
    """Return canonical labels of the classes: of links, joints and classes as they are left.

    A four-bar of which it is open what class it has stands for itself, beside the classes that it may have.
    """
    colours: list[tuple[object, ...]] = []
    edges: list[tuple[int, int]] = []

    def node(*colour: object) -> int:
        colours.append(colour)
        return len(colours) - 1

    link_at = {link: node("link", link == work.original.ground, link in protected) for link in work.degree}
    joint_at = {joint: node("joint") for joint in work.joints}
    edges += [(joint_at[joint], link_at[end]) for joint, ends in work.joints.items() for end in ends]
    open_ones = [one for one in choices if len(one.classes) > 1]
    class_at: dict[int, int] = {}
    for which, loops in _loops_of_classes(work, choices).items():
        number_closing = sum(loop in work.closing for loop in loops)
        class_at[which] = node("class", _is_planar(work, which), len(loops), number_closing)
        joints = set().union(*(work.loops[loop] for loop in loops))
        edges += [(class_at[which], joint_at[joint]) for joint in joints]
    for one in open_ones:
        four_bar = node("open")
        edges += [(four_bar, joint_at[joint]) for joint in work.loops[one.last]]
        edges += [(four_bar, class_at[which]) for which in one.classes]
    palette = {colour: i for i, colour in enumerate(sorted(set(colours), key=repr))}
    labels = labels_of(ColouredGraph(len(colours), edges, [palette[colour] for colour in colours]))
    return {which: labels[place] for which, place in class_at.items()}


def _loops_of_classes(work: WorkingGraph, choices: Sequence[_Choice]) -> dict[int, list[int]]:
    """Return the loops of each class as they will be; none for what is open."""
    independent, closing = work.kept_loops()
    class_of = {loop: work.class_of[loop] for loop in (*independent, *closing) if loop in work.class_of}
    for one in choices:
        del class_of[one.last]
        if len(one.classes) == 1:
            class_of[one.last] = one.there[0].centre_class
    loops: dict[int, list[int]] = {which: [] for one in choices for which in one.classes}
    for loop, which in class_of.items():
        loops.setdefault(which, []).append(loop)
    return loops
