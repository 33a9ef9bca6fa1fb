"""What the order of two panels over a cell has to do with the order of others.

A *variable* is a pair of panels over a connected region of cells: true if the panel of the lower number is on top.
Between two cells strands may not cross: a panel that runs across a segment lies on one side of both panels of a
crease there (taco-tortilla), two creases on one side of a segment do not interleave (taco-taco), and of three panels
over a cell no two may lie between each other in a circle (transitivity). Two panels that both run across a segment
are ordered alike on both sides (tortilla-tortilla): that makes regions of cells.

Equal and opposite variables are one *class*. Literals are integers: twice the class, and one more for its opposite;
class 0 is what is true. Sources: M. Bern and B. Hayes (1996); H. A. Akitaya et al. (2015); J. Ku, Flat-Folder.
Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from math import pi

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from graphs.types import Ints
from synth.analysis.layering.image import OUTSIDE, FoldedImage, SegmentStrands

TRUE, FALSE = 0, 1
"""The literals of the class 0."""


@cache
def pairs_of(count: int) -> tuple[Ints, Ints]:
    """Return the pairs of places among some panels, the lower first, in order."""
    one, other = np.triu_indices(count, 1)
    return one, other


class PairTable:
    """Places of pairs of panels over cells: one row for each cell and pair, those of a cell one after the other."""

    def __init__(self, image: FoldedImage) -> None:
        self.image = image
        sizes = np.array([len(panels) for panels in image.above], dtype=np.int64)
        self.sizes = sizes
        self.first = np.concatenate([[0], np.cumsum(sizes * (sizes - 1) // 2)])

    def __len__(self) -> int:
        return int(self.first[-1])

    def rows(self, cell: int, one: Ints, other: Ints) -> Ints:
        """Return the rows of pairs of places among the panels over a cell, the lower first."""
        size = self.sizes[cell]
        found: Ints = self.first[cell] + one * (2 * size - one - 1) // 2 + other - one - 1
        return found

    def literals(self, cell: int, one: Ints | int, other: Ints | int) -> Ints:
        """Return the literals of variables that say that a panel is over another in a cell."""
        low, high = np.minimum(one, other), np.maximum(one, other)
        places = self.image.above[cell]
        rows = self.rows(cell, np.searchsorted(places, low), np.searchsorted(places, high))
        found: Ints = 2 * self.variable[rows] + (np.asarray(one) > other)
        return found

    @cached_property
    def panels(self) -> Ints:
        """The two panels of each row, int[rows, 2], the lower number first."""
        parts = [np.empty((0, 2), dtype=np.int64)]
        for panels in self.image.above:
            one, other = pairs_of(len(panels))
            parts.append(np.column_stack([panels[one], panels[other]]))
        return np.concatenate(parts)

    @cached_property
    def variable(self) -> Ints:
        """The variable of each row: numbered by their first rows."""
        ones, others = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
        for strand in self.image.strands:
            if OUTSIDE in (strand.left, strand.right) or len(strand.through) < 2:
                continue
            through = np.array(strand.through)
            one, other = pairs_of(len(through))
            for parts, cell in ((ones, strand.left), (others, strand.right)):
                places = np.searchsorted(self.image.above[cell], through)
                parts.append(self.rows(cell, places[one], places[other]))
        one, other = np.concatenate(ones), np.concatenate(others)
        return joined(len(self), one, other)


def joined(count: int, one: Ints, other: Ints) -> Ints:
    """Return the part of each of some members, joined in pairs; parts are numbered by their first members."""
    joined = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(count, count))
    _, part = connected_components(joined, directed=False)
    _, first, place = np.unique(part, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[place.ravel()] if count else np.empty(0, dtype=np.int64)


class Turns:
    """Where creases turn back: arrays of the segment, the cell, the two panels and the joint of each."""

    def __init__(self, image: FoldedImage) -> None:
        rows = [
            (number, cell, *turn)
            for number, strand in enumerate(image.strands)
            for cell, turning in zip((strand.left, strand.right), strand.turning, strict=True)
            for turn in turning
        ]
        table = np.array(rows, dtype=np.int64).reshape(-1, 5)
        self.segment, self.cell, self.one, self.other, self.joint = table.T

    def __len__(self) -> int:
        return len(self.segment)


@dataclass(frozen=True, eq=False)
class LayerConstraints:
    """All constraints on the layers of an image, on literals of variables: variable v has 2 v and 2 v + 1.

    Attributes
    ----------
    table : PairTable
    turns : Turns
    beside : (int[n], int[n], int[n], int[n])
        Taco-tortilla: two literals that are equal, the turn, and the panel that runs across.
    nested : (int[m, 4], int[m], int[m])
        Taco-taco: literals of which an even number is true, and the two turns.
    decided : (int[k], int[k, 2])
        In space: literals that are true, since the paper of one of two panels leaves their plane, and the panels.
    bundled : (int[b], int[b])
        In space: literals that are equal, since two panels leave a plane for another together.
    """

    table: PairTable
    turns: Turns
    beside: tuple[Ints, Ints, Ints, Ints]
    nested: tuple[Ints, Ints, Ints]
    decided: tuple[Ints, Ints]
    bundled: tuple[Ints, Ints]

    @property
    def variables(self) -> int:
        """The number of variables."""
        return int(self.table.variable.max(initial=-1)) + 1

    def creases(self, valleys: Mapping[int, bool]) -> tuple[Ints, Ints]:
        """Return literals that are true, and the turns: by whether each joint that is assigned is a valley."""
        turns = self.turns
        known = np.flatnonzero(np.isin(turns.joint, list(valleys)))
        flipped = self.table.image.panels.flipped
        literals = [
            int(self.table.literals(cell, one, other)) ^ int(valleys[joint] != bool(flipped[one]))
            for cell, one, other, joint in zip(
                *(array[known].tolist() for array in (turns.cell, turns.one, turns.other, turns.joint)), strict=True
            )
        ]
        return np.array(literals, dtype=np.int64), known


def layer_constraints(image: FoldedImage) -> LayerConstraints:
    """Return the constraints of an image, those of transitivity left to the table."""
    table, turns = PairTable(image), Turns(image)
    none = np.empty(0, dtype=np.int64)
    lines: list[tuple[Ints, ...]] = [(none, none, none, none)]
    nested: list[tuple[Ints, Ints, Ints]] = [(np.empty((0, 4), dtype=np.int64), none, none)]
    begin = np.searchsorted(turns.segment, np.arange(len(image.segments) + 1))
    through = [np.array(strand.through, dtype=np.int64) for strand in image.strands]
    for segment in range(len(image.segments)):
        for turn in range(begin[segment], begin[segment + 1]):
            cell, one, other = turns.cell[turn], turns.one[turn], turns.other[turn]
            leaving = image.strands[segment].leaving[int(cell != image.strands[segment].left)]
            across = np.array([*through[segment], *(there.panel for there in leaving)], dtype=np.int64)
            if len(across):
                literals = table.literals(cell, one, across), table.literals(cell, other, across)
                lines.append((*literals, np.full(len(across), turn), across))
            before = np.arange(begin[segment], turn)
            before = before[turns.cell[before] == cell]
            if len(before):
                c, d = turns.one[before], turns.other[before]
                four = [table.literals(cell, *pair) for pair in ((one, c), (one, d), (other, c), (other, d))]
                nested.append((np.column_stack(four), np.full(len(before), turn), before))
    beside = tuple(np.concatenate(part) for part in zip(*lines, strict=True))
    pairs = tuple(np.concatenate(part) for part in zip(*nested, strict=True))
    decided, bundled = _by_turns(table), _by_bundles(table)
    return LayerConstraints(table, turns, beside, pairs, decided, bundled)  # type: ignore[arg-type]


def _by_turns(table: PairTable) -> tuple[Ints, Ints]:
    """Return literals that are true where panels leave their plane, and their panels.

    Round a segment the strands are chords of a circle. Of two that begin at one ray, the one that ends farther on is
    the outer one: it begins first, which is below on the left of the segment and above on its right.
    """
    literals, panels = list[int](), list[tuple[int, int]]()
    for strand in table.image.strands:
        for side, cell in enumerate((strand.left, strand.right)):
            for upper, lower in decided_at(strand, side):
                literals.append(int(table.literals(cell, upper, lower)))
                panels.append((upper, lower))
    return np.array(literals, dtype=np.int64), np.array(panels, dtype=np.int64).reshape(-1, 2)


def decided_at(strand: SegmentStrands, side: int) -> list[tuple[int, int]]:
    """Return pairs of panels on a side of a segment whose order their turns decide, the upper one first."""
    leaving = strand.leaving[side]
    found = []
    for place, one in enumerate(leaving):
        others = [(other.turn, other.plane, other.panel) for other in leaving[:place]]
        others += [(pi, -1, panel) for panel in strand.through]
        for turn, plane, panel in others:
            together = plane == one.plane and abs(turn - one.turn) < 1.0  # not on both sides of one plane
            if not together and turn != one.turn:
                outer, inner = (one.panel, panel) if one.turn > turn else (panel, one.panel)
                found.append((inner, outer) if side == 0 else (outer, inner))
    return found


def _by_bundles(table: PairTable) -> tuple[Ints, Ints]:
    """Return literals that are equal since two panels leave a plane for another together."""
    rows = [
        (int(table.literals(cell, one, other)), int(table.literals(there, first, second)))
        for cell, one, other, there, first, second in table.image.bundles
    ]
    one, other = np.array(rows, dtype=np.int64).reshape(-1, 2).T
    return one, other
