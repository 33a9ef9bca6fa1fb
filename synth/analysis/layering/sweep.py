"""The number of layer orders by another road: cell after cell, and in each cell layer after layer.

What must lie below each panel of a cell is closed first (`Precedence`). Panels of a cell that open pairs join are a
*block*, and lie on each other without a gap. Blocks that share an open pair, or whose creases may interleave, are one
*part*; parts are counted one by one. What two cells of a part have to agree on is the order of the panels that run
across the segments between them; so its cells are taken one after the other, with the number of orders of those done
for each order at their open segments. In a cell panels are put on each other from below: at each segment those creases
are open of which one panel lies there, the last one innermost, and no panel runs across an open crease.

Nothing here is shared with the conditions and the counter of `synth.analysis.layering.counting.problem`. Sources: D.
Eppstein, Computational complexities of folding (2024), arXiv 2410.07666; I. Jensen, A transfer matrix approach to the
enumeration of plane meanders (2000). Theory: docs/theory/layer-orders.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from itertools import combinations
from math import prod

import networkx as nx

from synth.analysis.layering.image import OUTSIDE, FoldedImage, SegmentStrands

Order = tuple[int, ...]
"""Panels from the lowest to the highest."""
Above = Mapping[tuple[int, int, int], bool]
"""For a cell and two panels over it whether the first is above the second."""

_Blocks = dict[int, tuple[int, ...]]
"""The blocks of each cell of a part: panels as bits."""
_State = tuple[tuple[int, Order], ...]
"""The orders at open segments."""
_MOST = 2_000
"""Orders that are kept at once where there are several cells."""


class _TooManyError(Exception):
    """More orders would have to be kept."""


@dataclass(frozen=True, slots=True)
class _Side:
    """A segment seen from a cell: panels that run across, and the other panel of each crease that turns back."""

    segment: int
    beyond: int
    through: int
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
    precedence = Precedence(image)
    flipped = image.panels.flipped
    for cell, around in enumerate(precedence.sides):
        for side in around:
            for panel, partner in side.partner.items():
                joint = side.joint[panel]
                if joint in valleys and valleys[joint] == bool(flipped[panel]):
                    precedence.below[cell][panel] |= 1 << partner  # folded towards its other face: it lies above
    for (cell, one, other), is_above in (above or {}).items():
        low, high = (other, one) if is_above else (one, other)
        precedence.below[cell][high] |= 1 << low
    return _count(precedence, {cell: _bits(below) for cell, below in enumerate(precedence.below)})


def _bits(panels: Iterable[int]) -> int:
    return sum(1 << panel for panel in panels)


def _places(bits: int) -> Iterator[int]:
    while bits:
        yield (bits & -bits).bit_length() - 1
        bits &= bits - 1


def _count(precedence: Precedence, panels: Mapping[int, int]) -> int:
    """Count the orders of some panels of some cells, as bits, whose order does not depend on that of others."""
    if not precedence.close(panels):
        return 0
    return prod(_of_part(precedence, blocks) for blocks in precedence.parts(panels))


def _of_part(precedence: Precedence, blocks: _Blocks) -> int:
    """Count the orders of a part; where too many would be kept, two panels are put either way."""
    try:
        return _swept(precedence, blocks)
    except _TooManyError:
        cell, low, high = precedence.open_pair(blocks)
    panels = {cell: sum(there) for cell, there in blocks.items()}
    return sum(_count(precedence.with_order(panels, cell, *pair), panels) for pair in ((low, high), (high, low)))


def _swept(precedence: Precedence, blocks: _Blocks) -> int:
    """Count cell after cell; raises `_TooManyError` where several cells have too many orders to be kept."""
    most = _MOST if len(blocks) > 1 else None
    borders = precedence.borders(blocks)
    states: dict[_State, int] = {(): 1}
    done: set[int] = set()
    for cell in _cell_order(blocks, [cells for cells, _ in borders.values()]):
        around = {segment: cells for segment, (cells, _) in borders.items() if cell in cells}
        given = {segment for segment, cells in around.items() if set(cells) - {cell} <= done}
        opened = sorted(around.keys() - given)
        stack = _CellStack(precedence, cell, blocks[cell], [borders[segment][1] for segment in opened], most)
        after: dict[_State, int] = defaultdict(int)
        known: dict[_State, dict[tuple[Order, ...], int]] = {}
        for state, count in states.items():
            here = tuple(part for part in state if part[0] in given)
            rest = tuple(part for part in state if part[0] not in given)
            if here not in known:
                known[here] = stack.orders([order for _, order in here])
            for orders, number in known[here].items():
                after[tuple(sorted((*rest, *zip(opened, orders, strict=True))))] += count * number
            if most is not None and len(after) > most:
                raise _TooManyError
        states = dict(after)
        done.add(cell)
    return sum(states.values())


def _cell_order(cells: Iterable[int], neighbours: Iterable[tuple[int, int]]) -> list[int]:
    """Return cells so that few segments are open between those done and those left."""
    left = dict.fromkeys(cells)
    beside: dict[int, list[int]] = {cell: [] for cell in left}
    for one, other in neighbours:
        beside[one].append(other)
        beside[other].append(one)
    order: list[int] = []

    def opens(cell: int) -> tuple[int, int]:
        return sum(1 if other in left else -1 for other in beside[cell]), cell

    while left:
        reached = {other for cell in order for other in beside[cell] if other in left}
        order.append(min(reached or left, key=opens))
        del left[order[-1]]
    return order


class Precedence:
    """The panels that lie below each panel of each cell, as bits: those that are known, and what follows."""

    def __init__(self, image: FoldedImage) -> None:
        self.below = [dict.fromkeys(panels.tolist(), 0) for panels in image.above]
        self.sides: list[list[_Side]] = [[] for _ in image.cells]
        for number, strand in enumerate(image.strands):
            cells = strand.left, strand.right
            for cell, beyond, turning in zip(cells, reversed(cells), strand.turning, strict=True):
                if cell != OUTSIDE and (strand.through or turning):
                    self.sides[cell].append(_side(number, beyond, strand, turning))

    def _open(self, cell: int, panels: int) -> dict[int, int]:
        """Return for each of some panels those whose order with it is open, as bits."""
        below = self.below[cell]
        left = {panel: panels & ~(below[panel] | 1 << panel) for panel in _places(panels)}
        for panel in left:
            for low in _places(below[panel] & panels):
                left[low] &= ~(1 << panel)
        return left

    def parts(self, panels: Mapping[int, int]) -> Iterator[_Blocks]:
        """Yield the parts of some panels of some cells; of each cell they are whole blocks."""
        pairs = {cell: self._open(cell, there) for cell, there in panels.items()}
        block: dict[int, dict[int, int]] = {}  # of each cell and panel
        tied = nx.Graph()
        for cell, left in pairs.items():
            block[cell] = {}
            for panel in left:
                if left[panel] and panel not in block[cell]:
                    bits = _joined(panel, left)
                    block[cell] |= dict.fromkeys(_places(bits), bits)
                    tied.add_node((cell, bits))
        for cell, of in block.items():
            for side in self.sides[cell] if of else ():
                if side.beyond > cell:
                    for panel in _places(side.through & sum(set(of.values()))):
                        if pairs[cell][panel] & side.through and side.beyond in block:
                            tied.add_edge((cell, of[panel]), (side.beyond, block[side.beyond][panel]))
                creases = [(one, other) for one, other in side.partner.items() if one < other]
                for one, other in combinations(creases, 2):
                    here = [of[a] for a in one for b in other if a in of and pairs[cell][a] >> b & 1]
                    tied.add_edges_from(((cell, here[0]), (cell, bits)) for bits in here[1:])
        for part in nx.connected_components(tied):
            blocks: dict[int, list[int]] = defaultdict(list)
            for cell, bits in sorted(part):
                blocks[cell].append(bits)
            yield {cell: tuple(there) for cell, there in blocks.items()}

    def borders(self, blocks: _Blocks) -> dict[int, tuple[tuple[int, int], int]]:
        """Return the segments across which blocks share open pairs: their cells, and the panels that run across."""
        found = {}
        for cell, there in blocks.items():
            for side in self.sides[cell]:
                if side.beyond > cell and side.beyond in blocks:
                    both = side.through & sum(there) & sum(blocks[side.beyond])
                    if any(self._open(cell, both).values()):
                        found[side.segment] = ((cell, side.beyond), both)
        return found

    def open_pair(self, blocks: _Blocks) -> tuple[int, int, int]:
        """Return the cell of a part in which most pairs of panels are open, and the first such pair."""
        pairs = {cell: self._open(cell, sum(there)) for cell, there in blocks.items()}
        cell = max(pairs, key=lambda cell: (sum(bits.bit_count() for bits in pairs[cell].values()), -cell))
        panel = next(panel for panel, bits in pairs[cell].items() if bits)
        return cell, panel, next(_places(pairs[cell][panel]))

    def with_order(self, cells: Iterable[int], cell: int, low: int, high: int) -> Precedence:
        """Return a copy in which one panel lies below another in a cell; only some cells may change."""
        other = copy(self)
        other.below = list(self.below)
        for each in cells:
            other.below[each] = dict(self.below[each])
        other.below[cell][high] |= 1 << low
        return other

    def close(self, cells: Iterable[int]) -> bool:
        """Add what follows in some cells until nothing does; return whether no panel lies below itself."""
        left = dict.fromkeys(cells)
        while left:
            cell, _ = left.popitem()
            below = self.below[cell]
            changed = True
            while changed:
                changed = self._transitive(below)
                for side in self.sides[cell]:
                    changed |= _beside_creases(below, side)
            if any(mask >> panel & 1 for panel, mask in below.items()):
                return False
            for side in self.sides[cell]:
                for panel in _places(side.through):
                    more = below[panel] & side.through & ~self.below[side.beyond][panel]
                    if more:
                        self.below[side.beyond][panel] |= more
                        left[side.beyond] = None
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


def _side(number: int, beyond: int, strand: SegmentStrands, turning: Iterable[tuple[int, int, int]]) -> _Side:
    partner: dict[int, int] = {}
    joint: dict[int, int] = {}
    for one, other, crease in turning:
        partner |= {one: other, other: one}
        joint[one] = joint[other] = crease
    return _Side(number, beyond, _bits(strand.through), partner, joint)


def _joined(panel: int, pairs: Mapping[int, int]) -> int:
    """Return the panels that open pairs join to a panel, as bits."""
    bits, left = 1 << panel, pairs[panel]
    while left:
        bits |= left
        more = 0
        for other in _places(left):
            more |= pairs[other]
        left = more & ~bits
    return bits


def _beside_creases(below: dict[int, int], side: _Side) -> bool:
    """Add what follows at one segment: both panels of a crease lie on one side of what does not pass between them."""
    changed = False

    def add(low: int, high: int) -> None:
        nonlocal changed
        if not below[high] >> low & 1:
            below[high] |= 1 << low
            changed = True

    for panel, partner in side.partner.items():
        for across in _places(side.through):
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
    """The panels of the blocks of one cell, put on each other from below.

    A state is one number: bits of the panels that lie there, the stack of open creases of each side, and the order
    of the panels that are written at each open segment, as digits; digit 0 is none.
    """

    def __init__(
        self, precedence: Precedence, cell: int, blocks: Sequence[int], written: Sequence[int], most: int | None
    ) -> None:
        self._most = most
        self._panels = list(_places(sum(blocks)))
        self._place = {panel: place for place, panel in enumerate(self._panels)}
        self._block = [next(bits for bits in blocks if bits >> panel & 1) for panel in self._panels]
        self._below = [self._local(precedence.below[cell][panel]) for panel in self._panels]
        self._width = len(self._panels).bit_length()
        self._end = len(self._panels)
        self._stacks: list[tuple[int, int, dict[int, int]]] = []
        self._meets: list[list[tuple[int, int, int]]] = [[] for _ in self._panels]
        for side in precedence.sides[cell]:
            self._add_side(side)
        self._written = [self._field(bits.bit_count()) for bits in written]
        self._writes = [
            [field for field, bits in zip(self._written, written, strict=True) if bits >> panel & 1]
            for panel in self._panels
        ]

    def _local(self, bits: int) -> int:
        return _bits(place for panel, place in self._place.items() if bits >> panel & 1)

    def _field(self, digits: int) -> tuple[int, int]:
        """Return where the next field of so many digits begins, and its bits."""
        begin = self._end
        self._end += digits * self._width
        return begin, (1 << digits * self._width) - 1

    def _add_side(self, side: _Side) -> None:
        """Add the stack of a side; a crease whose other panel is in no block of the part counts as running across."""
        place = self._place
        partner = {place[one]: place[other] for one, other in side.partner.items() if one in place and other in place}
        if not partner:
            return
        begin, bits = self._field(len(partner) // 2)
        self._stacks.append((begin, bits, partner))
        for panel, here in place.items():
            if panel in side.partner or side.through >> panel & 1:
                self._meets[here].append((begin, bits, partner.get(here, -1)))

    def orders(self, given: Iterable[Order]) -> dict[tuple[Order, ...], int]:
        """Return how many orders there are for each order of what is written; `given` are orders of some panels."""
        below = list(self._below)
        for order in given:
            before = 0
            for panel in order:
                below[self._place[panel]] |= before
                before |= 1 << self._place[panel]
        level = {0: 1}
        for _ in self._panels:
            after: dict[int, int] = {}
            for state, count in level.items():
                for place, under in enumerate(below):
                    if not state >> place & 1 and not under & ~state:
                        changed = self._put(state, place)
                        if changed:
                            after[changed] = after.get(changed, 0) + count
            level = {state: count for state, count in after.items() if self._closes(state, below)}
            if self._most is not None and len(level) > self._most:
                raise _TooManyError
        found: dict[tuple[Order, ...], int] = defaultdict(int)
        for state, count in level.items():
            found[tuple(self._order(state >> begin & bits) for begin, bits in self._written)] += count
        return found

    def _put(self, state: int, place: int) -> int:
        """Return the state with one more panel on top; 0 if strands would cross."""
        changed = state | 1 << place
        for begin, bits, partner in self._meets[place]:
            stack = state >> begin & bits
            if partner < 0:
                if stack and self._within_open(stack, begin, place):
                    return 0
            elif not state >> partner & 1:
                changed += (stack << self._width) + place + 1 - stack << begin
            elif stack & (1 << self._width) - 1 == partner + 1:
                changed -= stack - (stack >> self._width) << begin
            else:
                return 0
        for begin, bits in self._writes[place]:
            order = state >> begin & bits
            changed += (order << self._width) + place + 1 - order << begin
        return changed

    def _digits(self, field: int) -> Iterator[int]:
        """Yield places, the last written first."""
        while field:
            yield (field & (1 << self._width) - 1) - 1
            field >>= self._width

    def _within_open(self, stack: int, begin: int, place: int) -> bool:
        """Return whether a crease within the block of a panel is open: how panels of two blocks lie is decided."""
        partner = next(partner for start, _, partner in self._stacks if start == begin)
        block = self._block[place]
        return any(self._block[one] == self._block[partner[one]] == block for one in self._digits(stack))

    def _closes(self, state: int, below: Sequence[int]) -> bool:
        """Return whether the panels that close the open creases of all sides can follow each other somehow."""
        under: dict[int, int] = {}
        left = 0
        for begin, bits, partner in self._stacks:
            before = 0
            for one in self._digits(state >> begin & bits):
                other = partner[one]
                under[other] = under.get(other, below[other]) | before
                before |= 1 << other
            left |= before
        while left:
            free = _bits(place for place in _places(left) if not under[place] & left)
            if not free:
                return False
            left ^= free
        return True

    def _order(self, field: int) -> Order:
        return tuple(self._panels[place] for place in self._digits(field))[::-1]
