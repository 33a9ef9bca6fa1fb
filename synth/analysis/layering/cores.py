"""Why there is no layer order: panels, and conditions on them, that contradict each other, none of which can go.

First panels are left out, in halves, as long as the rest still contradict each other (QuickXplain); then the conditions
among those that are left, one by one. What is left is a *core*: without any of its conditions there is an order.
Sources: U. Junker, QuickXplain (2004); for the conditions `synth.analysis.layering.constraints`. Theory:
docs/theory/layer-orders.md.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import networkx as nx
import numpy as np

from graphs.plain_data import fields_to_json
from graphs.printing import plain
from synth.analysis.layering.constraints import PairTable, layer_constraints
from synth.analysis.layering.counting.problem import LayerProblem, solutions
from synth.analysis.layering.counting.propagation import contradicting, counted
from synth.analysis.layering.image import FoldedImage
from synth.analysis.layering.reduction import merged, reduced
from synth.analysis.layering.sweep import count_by_cells


@dataclass(frozen=True, slots=True)
class CoreCondition:
    """A condition of a core.

    Attributes
    ----------
    kind : {"crease", "taco-tortilla", "taco-taco", "transitivity", "leaving", "leaving together", "motion"}
    panels : tuple of int
        A crease has two; of a taco-tortilla the last one runs across; of a taco-taco the first two and the last two
        are joined. In space: the first of two lies above the second, since the paper of one leaves their plane, or
        since it comes from there; the first two of four leave for where the last two lie.
    joints : tuple of int
        The creases.

    Examples
    --------
    >>> print(CoreCondition("taco-tortilla", (0, 1, 7), (4,)))
    panel 7 does not pass between panels 0 and 1 through crease 4
    """

    kind: str
    panels: tuple[int, ...]
    joints: tuple[int, ...]

    def __str__(self) -> str:
        """Return the condition in words."""
        names = [str(panel) for panel in self.panels]
        if self.kind == "crease":
            return f"crease {self.joints[0]} decides which of panels {names[0]} and {names[1]} is on top"
        if self.kind == "taco-tortilla":
            between = f"panel {names[2]} does not pass between panels {names[0]} and {names[1]}"
            return f"{between} through crease {self.joints[0]}"
        if self.kind == "taco-taco":
            one = f"crease {self.joints[0]} (panels {names[0]}, {names[1]})"
            return f"{one} and crease {self.joints[1]} (panels {names[2]}, {names[3]}) do not cross"
        if self.kind == "leaving":
            return f"panel {names[0]} is above panel {names[1]}: beyond a crease the paper of one leaves their plane"
        if self.kind == "leaving together":
            return (
                f"panels {names[0]} and {names[1]} leave their plane together, in one order with {names[2]}, {names[3]}"
            )
        if self.kind == "motion":
            return f"panel {names[0]} comes to lie above panel {names[1]}"
        return f"panels {', '.join(names[:2])} and {names[2]} are not above each other in a circle"

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(self)


@dataclass(frozen=True, slots=True)
class LayerCore:
    """Conditions that contradict each other, none of which can go.

    Attributes
    ----------
    panels : tuple of int
    conditions : tuple of CoreCondition
    confirmed : bool
        Whether the second method, cell by cell, finds no order of these panels either.

    Examples
    --------
    >>> core = LayerCore((0, 1), (CoreCondition("crease", (0, 1), (4,)),), True)
    >>> core_lines(core, 1)[1]
    '- crease 4 decides which of panels 0 and 1 is on top'
    """

    panels: tuple[int, ...]
    conditions: tuple[CoreCondition, ...]
    confirmed: bool

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(self)


Heights = Sequence[tuple[int, int, int]]
"""Cells, and two panels over each of which the first is known to be above the second."""


def core_of(image: FoldedImage, valleys: Mapping[int, bool], above: Heights = ()) -> LayerCore:
    """Return a core of an image that has no layer order where some are known to be above others."""

    def contradict(panels: Sequence[int]) -> bool:
        return _has_none(restricted(image, panels), valleys, _among(above, panels))

    every = set(np.concatenate(image.above).tolist())
    in_space = bool(above or image.bundles or any(any(strand.leaving) for strand in image.strands))
    suspects = every if in_space else _suspects(image, valleys)
    panels = tuple(sorted(_least(contradict, [panel for panel in _near_each_other(image) if panel in suspects])))
    part = restricted(image, panels)
    primitives = list(_primitives(part, valleys, _among(above, panels)))

    def hold_nowhere(kept: Sequence[int]) -> bool:
        return next(solutions(*_problem([primitives[place] for place in kept])), None) is None

    kept = _least(hold_nowhere, list(range(len(primitives))))
    conditions = tuple(sorted((primitives[place][1] for place in kept), key=_order_of_kinds))
    known = dict.fromkeys(_among(above, panels), True)
    return LayerCore(panels, conditions, count_by_cells(part, valleys, known) == 0)


def _among(above: Heights, panels: Sequence[int]) -> list[tuple[int, int, int]]:
    """Return what is known of some panels."""
    return [row for row in above if row[1] in panels and row[2] in panels]


_KINDS = ("motion", "crease", "leaving", "leaving together", "taco-tortilla", "taco-taco", "transitivity")


def _order_of_kinds(condition: CoreCondition) -> tuple[int, tuple[int, ...]]:
    return _KINDS.index(condition.kind), condition.panels


def restricted(image: FoldedImage, panels: Sequence[int]) -> FoldedImage:
    """Return an image with some of its panels only, and the creases between them."""
    kept = np.array(sorted(panels), dtype=np.int64)
    inside = set(kept.tolist())
    above = tuple(np.intersect1d(there, kept, assume_unique=True) for there in image.above)
    strands = tuple(
        replace(
            strand,
            through=tuple(panel for panel in strand.through if panel in inside),
            turning=tuple(  # type: ignore[arg-type]
                tuple(turn for turn in side if turn[0] in inside and turn[1] in inside) for side in strand.turning
            ),
            leaving=tuple(  # type: ignore[arg-type]
                tuple(there for there in side if there.panel in inside) for side in strand.leaving
            ),
        )
        for strand in image.strands
    )
    bundles = tuple(row for row in image.bundles if {row[1], row[2], row[4], row[5]} <= inside)
    part = replace(image, above=above, bundles=bundles)
    part.__dict__["strands"] = strands
    return part


def _has_none(image: FoldedImage, valleys: Mapping[int, bool], above: Heights) -> bool:
    """Return whether an image has no layer order."""
    constraints = layer_constraints(image)
    heights = np.array([int(constraints.table.literals(*row)) for row in above], dtype=np.int64)
    left = reduced(constraints, np.concatenate([constraints.creases(valleys)[0], heights]))
    return left is None or not all(counted(problem) for problem, _ in left.parts)


def _suspects(image: FoldedImage, valleys: Mapping[int, bool]) -> set[int]:
    """Return panels that contradict each other: those from which a contradiction followed, or all."""
    every = set(range(len(image.panels.flipped)))
    constraints = layer_constraints(image)
    table = constraints.table
    one, other, *_ = constraints.beside
    known, _ = constraints.creases(valleys)
    literal = merged(constraints.variables + 1, one + 2, other + 2)
    if literal is None:
        return every
    rows = literal[2 * (table.variable + 1)]
    classes = int(literal.max()) // 2 + 1
    met = contradicting(table, rows, literal[known + 2], classes, literal[constraints.nested[0] + 2])
    return every if met is None else set(table.panels[np.isin(rows >> 1, met)].ravel().tolist())


def _near_each_other(image: FoldedImage) -> list[int]:
    """Return the panels so that those that creases join are near each other."""
    graph = image.panels.mechanism.sc
    return [panel for part in nx.connected_components(graph) for panel in nx.dfs_preorder_nodes(graph, min(part))]


def _least(contradict: Callable[[Sequence[int]], bool], members: Sequence[int]) -> list[int]:
    """Return some members that contradict each other, none of which can go: all of them together do (QuickXplain)."""

    def below(background: list[int], changed: bool, left: list[int]) -> list[int]:
        if changed and contradict(background):
            return []
        if len(left) == 1:
            return left
        half = len(left) // 2
        first, second = left[:half], left[half:]
        needed = below([*background, *first], bool(first), second)
        return [*below([*background, *needed], bool(needed), first), *needed]

    return below([], False, list(members))


_Primitive = tuple[tuple[tuple[int, int], ...], CoreCondition]
"""Literals with the kind of a row of a problem (1: true, 2: equal, 3: not all equal, 4: an even number), and what
condition it is."""


def _primitives(image: FoldedImage, valleys: Mapping[int, bool], above: Heights) -> Iterator[_Primitive]:
    """Yield all conditions of an image, each once; a literal is paired with the kind."""
    table = PairTable(image)
    constraints = layer_constraints(image)
    turns = constraints.turns
    seen: set[tuple[tuple[int, int], ...]] = set()

    def once(kind: int, literals: Sequence[int], condition: CoreCondition) -> Iterator[_Primitive]:
        row = tuple((kind, int(literal)) for literal in literals)
        if row not in seen:
            seen.add(row)
            yield row, condition

    literals, places = constraints.creases(valleys)
    for literal, turn in zip(literals.tolist(), places.tolist(), strict=True):
        pair = (int(turns.one[turn]), int(turns.other[turn]))
        yield from once(1, [literal], CoreCondition("crease", pair, (int(turns.joint[turn]),)))
    for cell, upper, lower in above:
        yield from once(1, [int(table.literals(cell, upper, lower))], CoreCondition("motion", (upper, lower), ()))
    for literal, (upper, lower) in zip(*(array.tolist() for array in constraints.decided), strict=True):
        yield from once(1, [literal], CoreCondition("leaving", (upper, lower), ()))
    for (_, a, b, _, c, d), *equal in zip(image.bundles, *(x.tolist() for x in constraints.bundled), strict=True):
        yield from once(2, equal, CoreCondition("leaving together", (a, b, c, d), ()))
    for one, other, turn, panel in zip(*(array.tolist() for array in constraints.beside), strict=True):
        three = (int(turns.one[turn]), int(turns.other[turn]), panel)
        yield from once(2, [one, other], CoreCondition("taco-tortilla", three, (int(turns.joint[turn]),)))
    for row, one, other in zip(*(array.tolist() for array in constraints.nested), strict=True):
        four = tuple(int(ends[turn]) for turn in (one, other) for ends in (turns.one, turns.other))
        joints = (int(turns.joint[one]), int(turns.joint[other]))
        yield from once(4, row, CoreCondition("taco-taco", four, joints))
    for cell, panels in enumerate(image.above):
        for a, b, c in combinations(panels.tolist(), 3):
            row = [int(table.literals(cell, *pair)) for pair in ((a, b), (b, c), (c, a))]
            yield from once(3, row, CoreCondition("transitivity", (a, b, c), ()))


def _problem(primitives: Sequence[_Primitive]) -> tuple[LayerProblem, list[int]]:
    """Return the problem of some conditions, on the variables that they speak of, and the literals that are true."""
    number: dict[int, int] = {}
    rows: dict[int, list[list[int]]] = {2: [], 3: [], 4: []}
    known: list[int] = []
    for row, _ in primitives:
        kind = row[0][0]
        literals = [2 * number.setdefault(literal >> 1, len(number)) + (literal & 1) for _, literal in row]
        if kind == 1:
            known += literals
        elif kind == 2:
            rows[2] += [[literals[0], literals[1] ^ 1], [literals[0] ^ 1, literals[1]]]
        else:
            rows[kind].append(literals)
    arrays = [np.array(rows[kind], dtype=np.int64).reshape(-1, kind) for kind in (3, 2, 4)]
    return LayerProblem(len(number), *arrays), known


def core_lines(core: LayerCore, most: int, *, flat: bool = True) -> list[str]:
    """Return a core in words: its panels, and so many of its conditions; in space there is no second method."""
    panels = plain(" ".join(map(str, core.panels)), 200)
    by = (" (confirmed cell by cell)" if core.confirmed else " (not confirmed cell by cell)") if flat else ""
    lines = [f"panels that cannot be layered, though they can without any one of them: {panels}{by}"]
    lines += [f"- {condition}" for condition in core.conditions[:most]]
    more = len(core.conditions) - most
    return [*lines, *([f"and {more} more conditions"] if more > 0 else [])]
