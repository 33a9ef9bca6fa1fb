"""The number of layer orders by another road: cell after cell, and in each cell layer after layer.

What two cells have to agree on is the order of the panels that run across the segments between them; so cells are
taken one after the other, with the number of orders of those done for each order at their open segments. In a cell
panels are put on each other from below: at each segment those creases are open of which one panel lies there, the
last one innermost, and no panel runs across an open crease. What must lie below each panel of a cell is found first
(`Precedence`), so that few orders are tried. Nothing here is shared with the conditions and the counter of
`synth.layering.counting.problem`. Sources: D. Eppstein, Computational complexities of folding (2024), arXiv 2410.07666;
I. Jensen, A transfer matrix approach to the enumeration of plane meanders (2000). Theory: docs/theory/layer-orders.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import dataclass
from itertools import combinations

from synth.layering.image import OUTSIDE, FoldedImage, SegmentStrands

Order = tuple[int, ...]
"""Panels from the lowest to the highest."""
Above = Mapping[tuple[int, int, int], bool]
"""For a cell and two panels over it whether the first is above the second."""

_Level = dict[tuple[int, tuple[Order, ...], tuple[Order, ...]], int]
"""Panels that lie there, as bits, open creases at each segment, orders that are written, to the number of ways."""
_MOST = 20_000
"""Orders that are kept at once where there are several cells."""


class _TooManyError(Exception):
    """More orders would have to be kept."""


@dataclass(frozen=True, slots=True)
class _Side:
    """A segment seen from a cell: panels that run across, and the other panel of each crease that turns back."""

    segment: int
    through: frozenset[int]
    partner: Mapping[int, int]
    joint: Mapping[int, int]


def count_by_cells(image: FoldedImage, valleys: Mapping[int, bool], above: Above | None = None) -> int:
    """Return the number of layer orders of an image.

    Parameters
    ----------
    image : FoldedImage
    valleys : mapping of joint id to bool
        Whether each assigned crease is a valley; others may be either.
    above : mapping of (cell, panel, panel) to bool, optional
        Orders that are known.
    """
    sides = _sides(image)
    neighbours = {
        number: (strand.left, strand.right)
        for number, strand in enumerate(image.strands)
        if OUTSIDE not in (strand.left, strand.right) and strand.through
    }
    precedence = Precedence(image, sides)
    flipped = image.panels.flipped
    for cell, around in enumerate(sides):
        for side in around:
            for panel, partner in side.partner.items():
                joint = side.joint[panel]
                if joint in valleys and valleys[joint] == bool(flipped[panel]):
                    precedence.below[cell][panel] |= 1 << partner  # folded towards its other face: it lies above
    for (cell, one, other), is_above in (above or {}).items():
        low, high = (other, one) if is_above else (one, other)
        precedence.below[cell][high] |= 1 << low
    return _count(image, sides, neighbours, precedence)


def _count(
    image: FoldedImage, sides: list[list[_Side]], neighbours: Mapping[int, tuple[int, int]], precedence: Precedence
) -> int:
    """Count the orders that keep a precedence; where too many would be kept, two panels are put either way."""
    if not precedence.close():
        return 0
    try:
        return _swept(image, sides, neighbours, precedence)
    except _TooManyError:
        cell, low, high = precedence.open_pair()
    return sum(
        _count(image, sides, neighbours, precedence.with_order(cell, *pair)) for pair in ((low, high), (high, low))
    )


def _swept(
    image: FoldedImage, sides: list[list[_Side]], neighbours: Mapping[int, tuple[int, int]], precedence: Precedence
) -> int:
    """Count cell after cell; raises `_TooManyError` where several cells have too many orders to be kept."""
    most = _MOST if len(image.cells) > 1 else None
    states: dict[tuple[tuple[int, Order], ...], int] = {(): 1}
    done: set[int] = set()
    for cell in _cell_order(len(image.cells), neighbours):
        shared = {side.segment for side in sides[cell] if side.segment in neighbours}
        given = {s for s in shared if set(neighbours[s]) - {cell} <= done}
        stack = _CellStack(sides[cell], precedence.below[cell], most)
        after: dict[tuple[tuple[int, Order], ...], int] = defaultdict(int)
        found: dict[tuple[tuple[int, Order], ...], dict[tuple[Order, ...], int]] = {}
        opened = sorted(shared - given)
        for state, count in states.items():
            here = tuple(part for part in state if part[0] in given)
            rest = tuple(part for part in state if part[0] not in given)
            if here not in found:
                found[here] = stack.orders([order for _, order in here], opened)
            for orders, number in found[here].items():
                after[tuple(sorted((*rest, *zip(opened, orders, strict=True))))] += count * number
            if most is not None and len(after) > most:
                raise _TooManyError
        states = dict(after)
        done.add(cell)
    return sum(states.values())


def _sides(image: FoldedImage) -> list[list[_Side]]:
    sides: list[list[_Side]] = [[] for _ in image.cells]
    for number, strand in enumerate(image.strands):
        for cell, turning in zip((strand.left, strand.right), strand.turning, strict=True):
            if cell != OUTSIDE and (strand.through or turning):
                sides[cell].append(_side(number, strand, turning))
    return sides


def _side(number: int, strand: SegmentStrands, turning: Iterable[tuple[int, int, int]]) -> _Side:
    partner: dict[int, int] = {}
    joint: dict[int, int] = {}
    for one, other, crease in turning:
        partner |= {one: other, other: one}
        joint[one] = joint[other] = crease
    return _Side(number, frozenset(strand.through), partner, joint)


def _cell_order(count: int, neighbours: Mapping[int, tuple[int, int]]) -> list[int]:
    """Return the cells so that few segments are open between those done and those left."""
    beside: list[list[int]] = [[] for _ in range(count)]
    for one, other in neighbours.values():
        beside[one].append(other)
        beside[other].append(one)
    order: list[int] = []
    done: set[int] = set()
    while len(order) < count:

        def opens(cell: int) -> tuple[int, int]:
            return sum(1 if other not in done else -1 for other in beside[cell]), cell

        reached = {other for cell in done for other in beside[cell]} - done
        order.append(min(reached or set(range(count)) - done, key=opens))
        done.add(order[-1])
    return order


class Precedence:
    """The panels that lie below each panel of each cell, as bits: those that are known, and what follows."""

    def __init__(self, image: FoldedImage, sides: list[list[_Side]]) -> None:
        self.below = [dict.fromkeys(panels.tolist(), 0) for panels in image.above]
        self._sides = sides
        self._neighbour: dict[tuple[int, int], int] = {}
        for number, strand in enumerate(image.strands):
            self._neighbour[number, strand.left] = strand.right
            self._neighbour[number, strand.right] = strand.left

    def open_pair(self) -> tuple[int, int, int]:
        """Return the cell in which most pairs of panels are open, and the first such pair."""

        def pairs(cell: int) -> list[tuple[int, int]]:
            below = self.below[cell]
            return [
                (one, other)
                for one, other in combinations(below, 2)
                if not (below[one] >> other & 1 or below[other] >> one & 1)
            ]

        numbers = [len(pairs(cell)) for cell in range(len(self.below))]
        cell = numbers.index(max(numbers))
        return cell, *pairs(cell)[0]

    def with_order(self, cell: int, low: int, high: int) -> Precedence:
        """Return a copy in which one panel lies below another in a cell."""
        other = copy(self)
        other.below = [dict(below) for below in self.below]
        other.below[cell][high] |= 1 << low
        return other

    def close(self) -> bool:
        """Add what follows until nothing does; return whether no panel lies below itself."""
        left = set(range(len(self.below)))
        while left:
            cell = left.pop()
            below = self.below[cell]
            changed = True
            while changed:
                changed = self._transitive(below)
                for side in self._sides[cell]:
                    changed |= _beside_creases(below, side)
            if any(mask >> panel & 1 for panel, mask in below.items()):
                return False
            for side in self._sides[cell]:
                other = self._neighbour[side.segment, cell]
                through = sum(1 << panel for panel in side.through)
                for panel in side.through:
                    more = below[panel] & through & ~self.below[other][panel]
                    if more:
                        self.below[other][panel] |= more
                        left.add(other)
        return True

    @staticmethod
    def _transitive(below: dict[int, int]) -> bool:
        changed = False
        for middle, under in below.items():
            for panel, mask in below.items():
                if mask >> middle & 1 and under & ~mask:
                    below[panel] = mask | under
                    changed = True
        return changed


def _beside_creases(below: dict[int, int], side: _Side) -> bool:
    """Add what follows at one segment: both panels of a crease lie on one side of what does not pass between them."""
    changed = False

    def add(low: int, high: int) -> None:
        nonlocal changed
        if not below[high] >> low & 1:
            below[high] |= 1 << low
            changed = True

    for panel, partner in side.partner.items():
        for across in side.through:
            if below[panel] >> across & 1:
                add(across, partner)
            if below[across] >> panel & 1:
                add(partner, across)
        for other, last in side.partner.items():
            if other in (panel, partner):
                continue
            # one panel of the other crease lies between the two: so does its other panel
            if below[panel] >> other & 1 and below[other] >> partner & 1:
                add(last, panel)
                add(partner, last)
            # both lie above a panel of the other crease: so they do above and below its other panel
            if below[panel] >> other & 1 and below[partner] >> other & 1:
                if below[panel] >> last & 1:
                    add(last, partner)
                if below[last] >> panel & 1:
                    add(partner, last)
    return changed


class _CellStack:
    """The panels over one cell, put on each other from below; `below` are those that come before each, as bits."""

    def __init__(self, sides: list[_Side], below: Mapping[int, int], most: int | None) -> None:
        self.panels = list(below)
        self._most = most
        self.sides = sides
        self._bit = {panel: 1 << panel for panel in self.panels}
        self._below = below

    def orders(self, given: Iterable[Order], opened: Iterable[int]) -> dict[tuple[Order, ...], int]:
        """Return how many orders there are for each order of what runs across some segments.

        `given` are the orders of some panels.
        """
        below = dict(self._below)
        for order in given:
            before = 0
            for panel in order:
                below[panel] |= before
                before |= self._bit[panel]
        places = {segment: place for place, segment in enumerate(opened)}
        turning = [side for side in self.sides if side.partner]
        writes: dict[int, list[int]] = {panel: [] for panel in self.panels}
        for side in self.sides:
            for panel in side.through if side.segment in places else ():
                writes[panel].append(places[side.segment])
        meets = {
            panel: [
                (place, side.partner.get(panel, -1))
                for place, side in enumerate(turning)
                if panel in side.partner or panel in side.through
            ]
            for panel in self.panels
        }
        level: _Level = {(0, ((),) * len(turning), ((),) * len(places)): 1}
        for _ in self.panels:
            after: _Level = defaultdict(int)
            for (mask, stacks, written), count in level.items():
                for panel in self.panels:
                    if mask & self._bit[panel] or below[panel] & ~mask:
                        continue
                    changed = self._put(panel, mask, stacks, meets[panel])
                    if changed is None:
                        continue
                    orders = written
                    if writes[panel]:
                        lines = list(written)
                        for place in writes[panel]:
                            lines[place] = (*lines[place], panel)
                        orders = tuple(lines)
                    after[mask | self._bit[panel], changed, orders] += count
            level = self._bounded(after)
        found: dict[tuple[Order, ...], int] = defaultdict(int)
        for (_, _, written), count in level.items():
            found[written] += count
        return found

    def _bounded(self, level: _Level) -> _Level:
        """Return what is kept; raise `_TooManyError` if that is too much."""
        if self._most is not None and len(level) > self._most:
            raise _TooManyError
        return level

    def _put(
        self, panel: int, mask: int, stacks: tuple[Order, ...], meets: Iterable[tuple[int, int]]
    ) -> tuple[Order, ...] | None:
        """Return the open creases at each segment with one more panel on top; None if strands would cross."""
        changed = list(stacks)
        for place, partner in meets:
            stack = changed[place]
            if partner < 0:
                if stack:
                    return None
            elif not mask & self._bit[partner]:
                changed[place] = (*stack, panel)
            elif stack[-1] == partner:
                changed[place] = stack[:-1]
            else:
                return None
        return tuple(changed)
