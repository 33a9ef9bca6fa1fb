"""Layer orders by the mountains and valleys of unassigned creases."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

from graphs.errors import InvariantError, numbered
from graphs.printing import Block, Printed, TableBlock, plain
from synth.analysis.layering.counting.problem import LayerProblem
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.orders import FlatFolding

_LISTED = 64
"""Assignments that are printed; data has all."""


@dataclass(frozen=True, slots=True)
class OrdersByAssignment(Printed):
    """The numbers of layer orders of a pattern for each assignment of its unassigned creases that folds flat.

    Attributes
    ----------
    creases : tuple of int
        The unassigned creases.
    orders : dict of str to int
        Letters M and V of these creases, in their order, to the number of layer orders.

    Examples
    --------
    >>> print(OrdersByAssignment((0, 1), {"MV": 1, "VM": 1}).blocks()[0])
    2 of 4 assignments of 2 unassigned creases fold flat, in 2 layer orders
    """

    creases: tuple[int, ...]
    orders: dict[str, int]

    def blocks(self) -> list[Block]:
        """Return the line and the table that are printed."""
        number, free = len(self.orders), len(self.creases)
        creases = numbered(free, "unassigned crease")
        orders = numbered(sum(self.orders.values()), "layer order")
        head = f"{number} of {2**free} assignments of {creases} fold flat, in {orders}"
        rows = [(letters, str(count)) for letters, count in list(self.orders.items())[:_LISTED]]
        table = TableBlock(("assignment", "orders"), rows, ("orders",))
        order = f"creases in this order: {plain(' '.join(map(str, self.creases)), 1000)}"
        more = [f"and {number - _LISTED} more"] if number > _LISTED else []
        return [head, order, table, *more]

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"creases": list(self.creases), "orders": dict(self.orders)}


def orders_by_assignment(answer: FlatFolding, most: int = 100_000) -> OrdersByAssignment:
    """Return how many layer orders a pattern has for each assignment of its unassigned creases.

    Parameters
    ----------
    answer : FlatFolding
    most : int, optional
        `InvariantError` for more assignments than this that fold flat.

    Examples
    --------
    A vertex of four right angles has one order for each of its eight assignments:

    >>> import synth
    >>> from graphs.mechanism.sheet import Sheet
    >>> corners = ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1))
    >>> square = Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners)
    >>> orders_by_assignment(synth.layers(square)).orders["MMMV"]
    1
    """
    free = tuple(sorted(joint for joint in answer.mechanism.hinges if joint not in answer.valleys))
    literal_of = answer.valley_literals(free)
    parts = answer.problems
    part_of = {number: place for place, (_, classes) in enumerate(parts) for number in classes.tolist()}
    fixed: dict[int, str] = {}
    wanted: list[list[tuple[int, int]]] = [[] for _ in parts]  # joint and literal in the problem
    for joint, literal in literal_of.items():
        if literal < 2:
            fixed[joint] = "MV"[literal == 0]
            continue
        place = part_of[literal >> 1]
        local = parts[place][1].tolist().index(literal >> 1)
        wanted[place].append((joint, 2 * local + (literal & 1)))
    every: list[dict[tuple[tuple[int, str], ...], int]] = []
    for (problem, _), creases in zip(parts, wanted, strict=True):
        every.append(dict(_cases(problem, creases, most)))
    number = prod(map(len, every)) if answer.foldable else 0
    if number > most:
        raise InvariantError("assignments", f"{number} assignments fold flat", f"at most {most}")
    orders: dict[str, int] = {}
    for choice in _products(every) if answer.foldable else ():
        letters = fixed | {joint: letter for case, _ in choice for joint, letter in case}
        orders["".join(letters[joint] for joint in free)] = prod(count for _, count in choice)
    return OrdersByAssignment(free, dict(sorted(orders.items())))


def _cases(
    problem: LayerProblem, creases: Sequence[tuple[int, int]], most: int
) -> Iterator[tuple[tuple[tuple[int, str], ...], int]]:
    """Yield the letters of creases, with the number of solutions of the problem that have them."""
    stack: list[tuple[tuple[int, ...], int]] = [((), counted(problem))]
    found = 0
    while stack:
        given, count = stack.pop()
        if not count:
            continue
        if len(given) == len(creases):
            found += 1
            if found > most:
                raise InvariantError("assignments", f"more than {most} assignments fold flat", f"at most {most}")
            pairs = zip(creases, given, strict=True)
            yield tuple((joint, "V" if literal == valley else "M") for (joint, valley), literal in pairs), count
            continue
        _, literal = creases[len(given)]
        valley = counted(problem, (*given, literal))
        stack += [((*given, literal), valley), ((*given, literal ^ 1), count - valley)]


def _products(
    every: Sequence[dict[tuple[tuple[int, str], ...], int]],
) -> Iterator[list[tuple[tuple[tuple[int, str], ...], int]]]:
    if not every:
        yield []
        return
    for rest in _products(every[:-1]):
        for case in every[-1].items():
            yield [*rest, case]
