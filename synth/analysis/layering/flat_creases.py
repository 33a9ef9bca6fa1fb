"""Creases that may stay flat: every choice of those that do, and the layer orders of each.

What stays flat joins its panels, so each choice is a crease pattern of its own. Choices are made vertex by vertex: what
is folded round each has to fold flat by itself. Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import pi
from typing import Any

import networkx as nx
import numpy as np

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet, opened
from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.input_limits import check_work
from graphs.mechanism.precision import flat_places, keeping, precision_of_sheet
from graphs.mechanism.sheet import FLAT, HINGES, Sheet, with_all_edges
from graphs.printing import Block, Printed, TableBlock
from synth.analysis.layering.counting.problem import Counter
from synth.analysis.layering.local import FlatVertex, flat_vertices, folds_alone
from synth.analysis.layering.orders import FlatFolding, LayerOrder, flat_folding

_LISTED = 24
"""Choices that are printed; data has all."""


@dataclass(frozen=True, eq=False, repr=False)
class StayingFlat(Printed):
    """The layer orders of a crease pattern some creases of which may stay flat. It prints as ``synth layers`` does.

    Attributes
    ----------
    creases : tuple of int
        The creases that are folded by 180 degrees either way or stay flat.
    cases : tuple of (tuple of int, FlatFolding)
        For each choice of those that stay flat for which there is a layer order: these creases, and the answer on the
        pattern without them. Choices with the most folded creases first.
    tried : int
        Choices that fold flat round each vertex by itself.

    Examples
    --------
    A strip of three squares: both creases stay flat, one of them, or none.

    >>> import synth
    >>> from graphs.mechanism.sheet import Sheet
    >>> corners = tuple((float(x), float(y)) for y in (0, 1) for x in range(4))
    >>> strip = Sheet(8, (), "", ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6)), corners)
    >>> answer = synth.layers(strip, may_stay_flat="unassigned")
    >>> answer.orders, {flat: case.orders for flat, case in answer.cases}
    (11, {(): 6, (0,): 2, (1,): 2, (0, 1): 1})
    """

    creases: tuple[int, ...]
    cases: tuple[tuple[tuple[int, ...], FlatFolding], ...]
    tried: int

    @property
    def orders(self) -> int:
        """The number of layer orders of all choices together."""
        return sum(case.orders for _, case in self.cases)

    @property
    def foldable(self) -> bool:
        """Whether there is any layer order."""
        return self.orders > 0

    def order(self, number: int = 0) -> tuple[FlatFolding, LayerOrder]:
        """Return one layer order by its number, from 0 on, and the answer on the pattern that it is of.

        Choices come one after the other. Raises `InvariantError` for a number beyond the last.
        """
        left = number
        for _, case in self.cases if number >= 0 else ():
            if left < case.orders:
                return case, case.order(left)
            left -= case.orders
        raise InvariantError("order", f"order {number}", f"a number from 0 to {self.orders - 1}")

    def to_json(self) -> dict[str, Any]:
        """Return plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "foldable": self.foldable,
            "orders": self.orders,
            "creases": list(self.creases),
            "tried": self.tried,
            "cases": [{"flat": list(flat), "orders": case.orders} for flat, case in self.cases],
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        may = f"{numbered(len(self.creases), 'crease')} that may stay flat"
        if not self.foldable:
            return [f"Does not fold flat with {may}: no choice has a layer order."]
        number = numbered(len(self.cases), "choice")
        blocks: list[Block] = [
            f"Folds flat, in {numbered(self.orders, 'layer order')} (proved: every order is counted).",
            f"{may}: {number} fold flat, of {self.tried} that do round each vertex",
        ]
        rows = [(str(case.orders), " ".join(map(str, flat)) or "none") for flat, case in self.cases[:_LISTED]]
        blocks.append(TableBlock(("orders", "creases that stay flat"), rows, ("orders",)))
        more = len(self.cases) - _LISTED
        return [*blocks, *([f"and {more} more choices"] if more > 0 else [])]

    def __repr__(self) -> str:
        return f"<StayingFlat: {numbered(self.orders, 'layer order')} of {numbered(len(self.cases), 'choice')}>"


def staying_flat(sheet: Sheet, may: str | Sequence[int], count: Counter) -> StayingFlat:
    """Return the layer orders of a sheet some creases of which may stay flat.

    Parameters
    ----------
    sheet : Sheet
    may : "unassigned", "all", or numbers of edges
        Which creases may be folded by 180 degrees either way, or stay flat; an edge stands for the crease it is a
        piece of.
    count : callable
        Takes problems, and returns how many solutions each has.

    Raises
    ------
    UnsolvableError
        As `synth.layers`.
    InvariantError
        For an edge that is no crease, and for more choices than the limit ``choices`` allows.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.layering.counting.propagation import counted
    >>> from graphs.mechanism.sheet import Sheet
    >>> corners = tuple((float(x), float(y)) for y in (0, 1) for x in range(4))
    >>> strip = Sheet(8, (), "", ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6)), corners)
    >>> len(staying_flat(strip, "unassigned", lambda problems: list(map(counted, problems))).creases)
    2
    """
    if not sheet.faces:
        raise UnsolvableError("layers need panels, and the pattern has no faces")
    precision = precision_of_sheet(sheet)
    whole = with_all_edges(sheet)
    chosen = _edges_of(whole, may)
    free = with_letters(whole, dict.fromkeys(chosen, "U"))
    dual = mechanism_of_sheet(free, geometry=False)
    apart = opened(free, dual)
    mechanism = dual if apart is free else mechanism_of_sheet(apart, geometry=False)
    points = np.array(flat_places(apart, "a crease pattern that is folded flat"))
    vertices = flat_vertices(apart, mechanism, points, precision)
    creases = _joints_of(free, dual, chosen)
    choices = sorted(_choices(vertices, creases), key=lambda flat: (len(flat), flat))
    edges = {frozenset(edge): number for number, edge in enumerate(free.edges)}
    pieces = {joint: [edges[frozenset(piece)] for piece in dual.pieces[joint]] for joint in creases}
    every = sum(map(len, dual.pieces.values()))
    cases = []
    for flat in choices:
        letters = dict.fromkeys((edge for joint in flat for edge in pieces[joint]), "F")
        folding = flat_folding(keeping(with_letters(free, letters), precision), count, explain=False)
        folded = sum(map(len, folding.mechanism.pieces.values()))  # no crease inside a panel counts as folded
        if folding.foldable and folded + len(letters) == every:
            cases.append((flat, folding))
    return StayingFlat(creases, tuple(cases), len(choices))


def with_letters(sheet: Sheet, letters: Mapping[int, str]) -> Sheet:
    """Return a sheet with other letters of some edges."""
    every = "".join(letters.get(edge, letter) for edge, letter in enumerate(sheet.assignments))
    return replace(sheet, assignments=every, fold_angles=None)


def _edges_of(sheet: Sheet, may: str | Sequence[int]) -> list[int]:
    """Return the edges that may stay flat."""
    if may in ("unassigned", "all"):
        wanted = "U" if may == "unassigned" else HINGES
        return [edge for edge, letter in enumerate(sheet.assignments) if letter in wanted]
    if isinstance(may, str):
        raise InvariantError("creases that may stay flat", repr(may), "'unassigned', 'all', or numbers of creases")
    for edge in may:
        if not 0 <= edge < len(sheet.edges):
            raise InvariantError("creases that may stay flat", f"edge {edge}", f"one from 0 to {len(sheet.edges) - 1}")
        if sheet.assignments[edge] not in HINGES + FLAT:
            raise InvariantError("creases that may stay flat", f"edge {edge} is a border or a cut", "a crease")
    return sorted(set(may))


def _joints_of(sheet: Sheet, mechanism: SheetMechanism, chosen: Sequence[int]) -> tuple[int, ...]:
    """Return the joints that edges are pieces of."""
    joint_of = {frozenset(piece): joint for joint, pieces in mechanism.pieces.items() for piece in pieces}
    joints = {joint_of.get(frozenset(sheet.edges[edge])) for edge in chosen}
    return tuple(sorted(joint for joint in joints if joint is not None))


def _choices(vertices: Sequence[FlatVertex], creases: Sequence[int]) -> list[tuple[int, ...]]:
    """Return all choices of creases that stay flat for which each vertex folds flat by itself."""
    left = set(creases)
    tables = []
    for vertex in vertices:
        mine = tuple(dict.fromkeys(joint for joint in vertex.creases if joint in left))
        tables.append((mine, [set(flat) for flat in _allowed(vertex, mine)]))
    alone = [joint for joint in creases if not any(joint in mine for mine, _ in tables)]
    found: list[dict[int, bool]] = [{}]
    for mine, allowed in _near_each_other(tables):
        merged = [
            {**state, **{joint: joint in flat for joint in mine}}
            for state in found
            for flat in allowed
            if all(state.get(joint, joint in flat) == (joint in flat) for joint in mine)
        ]
        found = merged
        check_work("choices", len(found), "choices of creases that stay flat")
    check_work("choices", len(found) << len(alone), "choices of creases that stay flat")
    return [
        tuple(
            sorted(
                [joint for joint, flat in state.items() if flat]
                + [j for j, flat in zip(alone, rest, strict=True) if flat]
            )
        )
        for state in found
        for rest in product((False, True), repeat=len(alone))
    ]


def _near_each_other(
    tables: Sequence[tuple[tuple[int, ...], list[set[int]]]],
) -> Iterator[tuple[tuple[int, ...], list[set[int]]]]:
    """Yield the vertices so that each shares creases with those before, where any does."""
    graph = nx.Graph()
    graph.add_nodes_from(range(len(tables)))
    at: dict[int, int] = {}
    for number, (mine, _) in enumerate(tables):
        for joint in mine:
            if joint in at:
                graph.add_edge(at[joint], number)
            at[joint] = number
    for part in nx.connected_components(graph):
        for number in nx.bfs_tree(graph, min(part)):
            yield tables[number]


def _allowed(vertex: FlatVertex, creases: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Yield the creases at a vertex that stay flat so that it folds flat by itself."""
    check_work("choices", 1 << len(creases), f"choices at vertex {vertex.vertex}")
    allowed = vertex.allowed
    for picked in product((False, True), repeat=len(creases)):
        flat = {joint for joint, stays in zip(creases, picked, strict=True) if stays}
        angles, letters = _sectors_without(vertex, flat)
        if len(angles) % 2 or (angles and abs(sum(angles[::2]) - pi) > allowed):
            continue
        if not angles or folds_alone(angles, letters, allowed):
            yield tuple(sorted(flat))


def _sectors_without(vertex: FlatVertex, flat: set[int]) -> tuple[list[float], str]:
    """Return the sectors and letters of a vertex at which some creases stay flat."""
    kept = [place for place, joint in enumerate(vertex.creases) if joint not in flat]
    ends = [*kept[1:], kept[0] + len(vertex.creases)] if kept else []
    twice = [*vertex.angles, *vertex.angles]
    angles = [sum(twice[start:end]) for start, end in zip(kept, ends, strict=True)]
    return angles, "".join(vertex.letters[place] for place in kept)
