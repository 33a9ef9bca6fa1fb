"""Joints round a circle: placements on equal slots up to turns, mirror images and symmetries; layers.

A placement gives each joint a slot, 0 to K - 1; no two joints may have slots that are equal modulo a number of
*classes*, which divides K: J for cyclic orders (K = J) and for those of the joints and of the points opposite to
them (K = 2 J), K for different slots. Of the placements that turns, mirror images and symmetries of the chain
exchange the one whose row is lexicographically least is listed. *Layers* say how many links must lie over each
other: a link is an arc, or one of several, the set of gaps between joints that it covers, bit i for gap i, and
arcs that share a gap lie in different layers. Theory: docs/theory/conical-candidates.md.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from math import perm

import numpy as np

from enumerate.kernel._compiled import compiled, cycles, doubled
from enumerate.machine_code.weights import expect, layering
from graphs.errors import InvariantError
from graphs.types import Ints


@dataclass(frozen=True, slots=True)
class Rounds:
    """Where joints may lie: on slots, of which those equal modulo `classes` exclude each other.

    For J joints, cyclic orders have J slots and classes, those of joints and of the points opposite to them 2 J
    slots, and different slots as many classes.
    """

    joints: int
    slots: int
    classes: int

    def __post_init__(self) -> None:
        if self.joints < 3:
            raise InvariantError("joints", f"{self.joints} joints", "three or more round a circle")
        if self.classes < self.joints:
            raise InvariantError("slots", f"{self.slots} slots for {self.joints} joints", "one for each, or more")

    def completions(self, placed: int) -> int:
        """Return how many placements begin with some joints placed."""
        fold = self.slots // self.classes
        left = self.joints - placed
        return int(perm(self.classes - placed, left) * fold**left)


@compiled
def _stabiliser(p: Ints, symmetries: Ints, slots: int) -> int:
    """Return how many images equal a placement, 0 if one is less; joint 0 lies on slot 0.

    Of the turns only that counts which takes the image of joint 0 to slot 0: any other image is greater.
    """
    equal = 0
    for row in range(len(symmetries)):
        first = p[symmetries[row, 0]]
        for mirror in (1, -1):
            verdict = 0
            for i in range(1, len(p)):
                image = (mirror * (p[symmetries[row, i]] - first)) % slots
                if image != p[i]:
                    verdict = 1 if image > p[i] else -1
                    break
            if verdict < 0:
                return 0
            if verdict == 0:
                equal += 1
    return equal


@compiled
def _listed(symmetries: Ints, slots: int, classes: int, prefix: Ints, keep: bool) -> tuple[Ints, Ints, int]:
    """Return the least placements that begin in one way, their stabilisers, and their number.

    They are kept only if that is asked for.
    """
    joints = symmetries.shape[1]
    found = np.empty((64, joints), np.int64)
    order = np.empty((64, 1), np.int64)
    count = 0
    p = np.zeros(joints, np.int64)
    taken = np.zeros(classes, np.bool_)
    for i in range(len(prefix)):
        p[i] = prefix[i]
        taken[prefix[i] % classes] = True
    level = len(prefix)  # the joint that is placed next; -1 is the slot before the first that it tries
    if level < joints:
        p[level] = -1
    while level >= len(prefix):
        if level == joints:
            stabiliser = _stabiliser(p, symmetries, slots)
            if stabiliser:
                if keep:
                    if count == len(found):
                        found, order = doubled(found), doubled(order)
                    for i in range(joints):
                        found[count, i] = p[i]
                    order[count, 0] = stabiliser
                count += 1
            level -= 1
            continue
        if p[level] >= 0:
            taken[p[level] % classes] = False
        p[level] += 1
        while p[level] < slots and taken[p[level] % classes]:
            p[level] += 1
        if p[level] == slots:
            level -= 1
            continue
        taken[p[level] % classes] = True
        level += 1
        if level < joints:
            p[level] = -1
    return found[:count], order[:count], count


def placements(rounds: Rounds, symmetries: Ints, prefix: tuple[int, ...] = (0,)) -> tuple[Ints, Ints]:
    """Return placements, one of each orbit, in lexicographic order: the slot of each joint, int64[r, J].

    With them comes how many symmetries of the chain, each with a turn or mirror image, leave each as it is. All
    symmetries are given, as `enumerate.conical.query.joint_symmetries` returns them, and slots of the first
    joints; joint 0 lies on slot 0.
    """
    rows, order, _ = _listed(symmetries, rounds.slots, rounds.classes, np.array(prefix, np.int64), True)
    return rows, order[:, 0]


def count_rounds_by_orbits(rounds: Rounds, symmetries: Ints, prefix: tuple[int, ...] = (0,)) -> int:
    """Return how many `placements` there are, one of each orbit, by comparing each with its images."""
    return int(_listed(symmetries, rounds.slots, rounds.classes, np.array(prefix, np.int64), False)[2])


def prefixes(rounds: Rounds, most: int) -> Iterator[tuple[int, ...]]:
    """Yield slots of the first joints such that at most so many placements begin with each, symmetric ones apart.

    Joint 1 is kept to one half of the circle: what lies in the other is a mirror image.

    >>> list(prefixes(Rounds(4, 4, 4), 1))
    [(0, 1, 2), (0, 1, 3), (0, 2, 1), (0, 2, 3)]
    """

    def longer(prefix: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        if len(prefix) == rounds.joints or (len(prefix) > 1 and rounds.completions(len(prefix)) <= most):
            yield prefix
            return
        taken = {slot % rounds.classes for slot in prefix}
        end = rounds.slots // 2 + 1 if len(prefix) == 1 else rounds.slots
        for slot in range(end):
            if slot % rounds.classes not in taken:
                yield from longer((*prefix, slot))

    return longer((0,))


def count_rounds_by_burnside(rounds: Rounds, symmetries: Ints) -> int:
    """Return how many placements there are, one of each orbit, by Burnside's lemma; none is made.

    A turn or mirror image g of the circle and a symmetry s of the chain fix the placements that take each cycle
    of s to a cycle of g of the same length. On the classes, g has n_l cycles of length l that do not lead from a
    slot to one of its own class, s has m_l: they go together in n_l! / (n_l - m_l)! (f l)^m_l ways, f being the
    slots of a class.
    """
    types = Counter(tuple(sorted(Counter(map(len, cycles(row))).items())) for row in symmetries.tolist())
    fold, total = rounds.slots // rounds.classes, 0
    for mirror in (1, -1):
        for turn in range(rounds.slots):
            image = [(mirror * slot + turn) % rounds.slots for slot in range(rounds.slots)]
            lengths: Counter[int] = Counter()
            for cycle in cycles(image):
                if len({slot % rounds.classes for slot in cycle}) == len(cycle):
                    lengths[len(cycle)] += 1
            for kind, times in types.items():
                fixed = times
                for length, number in kind:
                    fixed *= perm(lengths[length] // fold, number) * (fold * length) ** number
                total += fixed
    count, rest = divmod(total, 2 * rounds.slots * len(symmetries))
    if rest:
        raise ArithmeticError("Burnside's lemma gives no whole number of orbits: the symmetries are no group")
    return count


_WITHOUT_END = 1 << 62  # more steps than any search makes
_STEPS = 20_000_000
"""Steps of the search for one linkage: a fraction of a second. Twenty links, at random, need a tenth of them."""


@compiled
def _fewest(arcs: Ints, chosen: Ints, layer_of: Ints, steps: int) -> int:
    """Return the fewest layers of links with masks arcs[n, o]; 0 is no choice. Sets choice and layer of each link.

    Links are put into layers one after the other, each into a layer that has room or the next new one; a branch
    ends where it has as many layers as the best solution, the search where no fewer are possible or after so many
    steps.
    """
    links, choices = arcs.shape
    best: int = links  # links before `link` lie in layers; `tried` says where each goes next
    for i in range(links):  # a layer for each always does
        layer_of[i] = i
        chosen[i] = 0
        while chosen[i] < choices - 1 and arcs[i, chosen[i]] == 0:
            chosen[i] += 1
    least = _deepest(arcs)
    filled = np.zeros((links + 1, links), np.int64)  # what each layer holds before each link
    used = np.zeros(links + 1, np.int64)
    tried = np.zeros(links, np.int64)  # next (choice, layer) of each link
    link = 0
    while link >= 0 and best > least and steps > 0:
        steps -= 1
        if tried[link] == choices * links:
            tried[link] = 0
            link -= 1
            continue
        choice, layer = tried[link] // links, tried[link] % links
        tried[link] += 1
        mask = arcs[link, choice]
        if mask == 0 or layer > used[link] or filled[link, layer] & mask:
            continue
        now = max(used[link], layer + 1)
        if now >= best:
            continue
        if link == links - 1:
            best = now
            for i in range(links):
                chosen[i], layer_of[i] = (tried[i] - 1) // links, (tried[i] - 1) % links
            continue
        for i in range(links):
            filled[link + 1, i] = filled[link, i]
        filled[link + 1, layer] |= mask
        used[link + 1] = now
        link += 1
    return best


@compiled
def _deepest(arcs: Ints) -> int:
    """Return how many links cover one gap whatever they choose, at most: no fewer layers are possible."""
    links, choices = arcs.shape
    covered = 0
    for i in range(links):
        for choice in range(choices):
            covered |= arcs[i, choice]
    deepest = 1
    gap = 0
    while covered >> gap:
        over = 0
        for i in range(links):
            always = True
            for choice in range(choices):
                mask = arcs[i, choice]
                if mask and not mask >> gap & 1:
                    always = False
            over += always
        deepest = max(deepest, over)
        gap += 1
    return deepest


def fewest_layers(arcs: Ints) -> Ints:
    """Return the fewest layers in which links lie without overlapping: int64[r].

    Parameters
    ----------
    arcs : int64[r, N, o]
        Masks of the arcs that each link can take, at least one each; 0 where there are fewer choices. All links
        cover something.

    Examples
    --------
    Three arcs round a circle of three gaps, each over two: no two go together.

    >>> fewest_layers(np.array([[[0b011], [0b110], [0b101]], [[0b001], [0b010], [0b100]]])).tolist()
    [3, 1]
    """
    chosen, layer_of = np.zeros((2, arcs.shape[1]), np.int64)
    masks = np.ascontiguousarray(arcs, dtype=np.int64)
    expect(len(masks) * layering(masks.shape[1]))
    return np.array([_fewest(row, chosen, layer_of, _WITHOUT_END) for row in masks], np.int64)


def layers_of_links(arcs: Ints) -> tuple[Ints, Ints]:
    """Return the arc and the layer of each link, in the fewest layers (`fewest_layers`).

    Of many more than twenty links they may be more than the fewest: the search ends after a fraction of a second.
    Arcs, int64[N, o], are masks of those that each link can take; layers count from 0. In the example, the first
    link has two arcs to choose from, and the second leaves room in its layer.

    >>> [found.tolist() for found in layers_of_links(np.array([[0b011, 0b100], [0b011, 0]]))]
    [[1, 0], [0, 0]]
    """
    masks = np.ascontiguousarray(arcs, dtype=np.int64)
    chosen, layer_of = np.zeros(len(masks), np.int64), np.zeros(len(masks), np.int64)
    expect(layering(len(masks)))
    _fewest(masks, chosen, layer_of, _STEPS)
    return chosen, layer_of
