"""Random mechanisms with ride-alongs on them and on each other, and the same mechanism under other names."""

from __future__ import annotations

import random

from graphs.errors import InvariantError
from graphs.loops.loop import Loop, cyclic_order
from graphs.mechanism.sc import SCGraph
from graphs.types import LinkId

_NAMES = {"finite": (None, None, "F", "G", "H"), "infinite": (None, None, "P", "Q", "R")}


def random_addenda(rng: random.Random, *, size: int = 12) -> SCGraph:
    """A core with ride-alongs on it and on each other, loops of other lengths, flaps, cut links, mixed bases."""
    links, joints, loops = [0], {}, []

    def chain(a, b, number, closing, centre):
        """Append a chain of links between a and b; it closes a loop with the given joints."""
        path, before = [], a
        for _ in range(number):
            link = len(links)
            links.append(link)
            path.append(len(joints))
            joints[path[-1]] = (before, link)
            before = link
        path.append(len(joints))
        joints[path[-1]] = (before, b)
        loops.append(([*closing, *path], centre))

    for _ in range(rng.randint(1, 2)):  # cores that share one link: a cut link
        start, n = rng.choice(links), rng.randint(3, 5)
        first = len(links)
        links.extend(range(first, first + n - 1))
        around = [start, *range(first, first + n - 1)]
        ids = []
        for a, b in zip(around, [*around[1:], start], strict=True):
            ids.append(len(joints))
            joints[ids[-1]] = (a, b)
        loops.append((ids, rng.choice(["finite", "finite", "none"])))
    for _ in range(rng.randint(0, size)):
        what = rng.random()
        joint = rng.choice(list(joints))
        a, b = joints[joint]
        if what < 0.7:
            chain(a, b, 2, [joint], "finite")
        elif what < 0.85:
            chain(a, b, rng.randint(1, 4), [joint], rng.choice(["finite", "none"]))
        else:  # a flap
            link = len(links)
            links.append(link)
            joints[len(joints)] = (rng.choice(links[:-1]), link)
    ground = rng.choice([None, None, rng.choice(links)])
    sc = SCGraph(links, joints, [Loop(tuple(j), c) for j, c in loops], ground=ground)
    return shuffled_basis(sc, rng)


def shuffled_basis(sc: SCGraph, rng: random.Random) -> SCGraph:
    """Replace loops by sums with loops of their class, where these are cycles."""
    current = list(sc.loops)
    for _ in range(rng.randint(0, 4)):
        classes = sc.centre_classes()
        many = [one for one in classes if len(one.loops) > 1]
        if not many:
            break
        one = rng.choice(many)
        i, k = rng.sample(one.loops, 2)
        total = set(current[i].joints) ^ set(current[k].joints)
        try:
            cyclic_order(Loop(tuple(total)), sc.joints)
        except InvariantError:
            continue
        trial = [*current]
        trial[i] = Loop(tuple(total), current[i].centre, current[i].name, current[i].at)
        changed = sc.with_loops(trial)
        if {c.joints for c in changed.centre_classes()} == {c.joints for c in classes}:
            current = trial
    return sc.with_loops(current)


def relabelled(sc: SCGraph, rng: random.Random) -> SCGraph:
    """The same mechanism with links, joints and loops renamed and in another order."""
    return renamed(sc, rng)[0]


def renamed(sc: SCGraph, rng: random.Random) -> tuple[SCGraph, dict[LinkId, int]]:
    """The same mechanism with all renamed and in another order, and the new name of each link."""
    links = dict(zip(sc.nodes, rng.sample(range(len(sc)), len(sc)), strict=True))
    joints = dict(zip(sc.joints, rng.sample(range(len(sc.joints)), len(sc.joints)), strict=True))
    other = sc.relabel(links, joints)
    order = list(other.loops)
    rng.shuffle(order)
    ids = list(other.joints)
    rng.shuffle(ids)
    there = SCGraph(
        sorted(other.nodes), {j: other.joints[j] for j in ids}, order, closing=other.closing, ground=other.ground
    )
    return there, links


def mixed_addenda(rng: random.Random) -> SCGraph:
    """Blocks of four-bars on four-bars, centres finite, at infinity, of one name, or none; no block has one kind."""
    while True:
        builder = _Mixed(rng)
        for _ in range(rng.randint(1, 4)):
            builder.block()
        links, rows = len(builder.links), builder.joints
        loops = [Loop(tuple(joints), centre, None, at) for joints, centre, at in builder.loops]
        try:
            sc = SCGraph(links, rows, loops, ground=rng.choice([None, None, rng.randrange(links)]))
            return shuffled_basis(sc, rng)
        except InvariantError as error:
            if error.rule != "centre classes":  # else two kinds of centre would have to be one: try again
                raise


class _Mixed:
    """A mechanism that grows block by block."""

    def __init__(self, rng: random.Random) -> None:
        self.rng = rng
        self.links = [0]
        self.joints: list[tuple[int, int]] = []
        self.loops: list[tuple[list[int], str, str | None]] = []

    def block(self) -> None:
        """Add a ring at some link, chains of links on its joints and on theirs, and perhaps a flap."""
        rng = self.rng
        start = rng.choice(self.links)
        first = len(self.joints)
        self._chain(start, start, rng.choice([3, 3, 3, 4, 2]), [])
        for _ in range(rng.randint(0, 4)):
            joint = rng.randrange(first, len(self.joints))
            a, b = self.joints[joint]
            self._chain(a, b, rng.choice([2] * 7 + [1, 3, 0]), [joint])
        if rng.random() < 0.2:
            self.joints.append((rng.choice(self.links), len(self.links)))
            self.links.append(len(self.links))

    def _chain(self, a: int, b: int, number: int, closing: list[int]) -> None:
        """Append a chain of links between a and b; with the joints given it closes a loop."""
        new = range(len(self.links), len(self.links) + number)
        self.links.extend(new)
        path = [a, *new, b]
        ids = list(range(len(self.joints), len(self.joints) + number + 1))
        self.joints += zip(path[:-1], path[1:], strict=True)
        centre = self.rng.choice(["finite"] * 4 + ["infinite"] * 4 + ["none"])
        at = self.rng.choice(_NAMES.get(centre, (None,)))
        self.loops.append(([*closing, *ids], centre, at))
