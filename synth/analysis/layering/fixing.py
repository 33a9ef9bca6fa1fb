"""Creases that would have to change for the local conditions to hold: a set of which none can be left out.

Each vertex allows some assignments of its creases, those that can be crimped. Changes are looked for near the vertices
at fault, farther and farther away until there is an assignment that all vertices allow; then creases are put back, one
by one, as long as there still is one.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from graphs.errors import UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed, plain
from synth.analysis.layering.local import FlatVertex, folds_alone
from synth.analysis.layering.orders import FlatFolding

_MOST_CREASES = 14
"""Creases of a vertex of which all assignments are tried."""


@dataclass(frozen=True, slots=True)
class ChangedAssignment(Printed):
    """A pattern with some creases changed so that each vertex folds flat by itself.

    Attributes
    ----------
    sheet : Sheet
    changed : tuple of int
        The creases whose letters were exchanged; none of them can be left out.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> square = Sheet(3, (), "", ((0, 1, 2),), ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
    >>> print(ChangedAssignment(square, (3, 7)))
    the local conditions hold if 2 creases change between mountain and valley: 3, 7
    """

    sheet: Sheet
    changed: tuple[int, ...]

    def blocks(self) -> list[Block]:
        """Return the line that is printed."""
        if not self.changed:
            return ["the local conditions hold: no crease has to change"]
        names = plain(", ".join(map(str, self.changed)), 1000)
        number = numbered(len(self.changed), "crease")
        verb = "changes" if len(self.changed) == 1 else "change"
        return [f"the local conditions hold if {number} {verb} between mountain and valley: {names}"]

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"changed": list(self.changed)}


def locally_fixed(answer: FlatFolding) -> ChangedAssignment:
    """Return a pattern with a set of creases changed so that all local conditions hold.

    Parameters
    ----------
    answer : FlatFolding
        `UnsolvableError` if a vertex breaks Kawasaki's condition, or no assignment meets all conditions.

    Returns
    -------
    ChangedAssignment
        Its creases are minimal by inclusion; there may be smaller sets. Unassigned creases stay so.

    Examples
    --------
    >>> import synth
    >>> locally_fixed(synth.layers("data/patterns/bird-base.fold")).changed
    ()
    """
    for vertex in answer.vertices:
        if not vertex.kawasaki:
            raise UnsolvableError(f"no assignment folds vertex {vertex.vertex} flat: {vertex.fault}")
    written = {
        joint: letter
        for vertex in answer.vertices
        for joint, letter in zip(vertex.creases, vertex.letters, strict=True)
        if letter in "MV"
    }
    allowed = [(vertex.creases, _allowed(vertex)) for vertex in answer.vertices]
    free = {joint for vertex in answer.vertices if vertex.fault for joint in vertex.creases}
    found = _assigned(allowed, written, free)
    while found is None:
        wider = free.union(*(creases for creases, _ in allowed if free & set(creases)))
        if wider == free:
            raise UnsolvableError("no assignment of mountains and valleys meets the local conditions of all vertices")
        free = wider
        found = _assigned(allowed, written, free)
    for joint in sorted(free & set(written)):
        if found[joint] == written[joint]:
            free = free - {joint}
        elif (other := _assigned(allowed, written, free - {joint})) is not None:
            free, found = free - {joint}, other
    changed = tuple(sorted(joint for joint in written if found[joint] != written[joint]))
    pieces = {frozenset(edge) for joint in changed for edge in answer.mechanism.pieces[joint]}
    turned = {"M": "V", "V": "M"}
    letters = "".join(
        turned.get(letter, letter) if frozenset(edge) in pieces else letter
        for edge, letter in zip(answer.sheet.edges, answer.sheet.assignments, strict=True)
    )
    return ChangedAssignment(replace(answer.sheet, assignments=letters), changed)


def _allowed(vertex: FlatVertex) -> list[str]:
    """Return the assignments of its creases by which a vertex folds flat."""
    if len(vertex.creases) > _MOST_CREASES:
        raise UnsolvableError(
            f"vertex {vertex.vertex} has {len(vertex.creases)} creases; at most {_MOST_CREASES} are tried"
        )
    every = map("".join, product("MV", repeat=len(vertex.creases)))
    return [letters for letters in every if folds_alone(vertex.angles, letters, vertex.allowed)]


def _assigned(
    allowed: Sequence[tuple[tuple[int, ...], list[str]]], written: Mapping[int, str], free: Collection[int]
) -> dict[int, str] | None:
    """Return letters of all creases that all vertices allow, those that are not free as written; None if none do.

    Each crease keeps its letter where the search has the choice.
    """
    tables = [(creases, _fitting(creases, rows, written, free)) for creases, rows in allowed]

    def search(tables: list[tuple[tuple[int, ...], list[str]]], known: dict[int, str]) -> dict[int, str] | None:
        changed = True
        while changed:
            changed = False
            for place, (creases, rows) in enumerate(tables):
                left = [row for row in rows if all(known.get(c, x) == x for c, x in zip(creases, row, strict=True))]
                if not left:
                    return None
                tables[place] = (creases, left)
                for number, crease in enumerate(creases):
                    letters = {row[number] for row in left}
                    if crease not in known and len(letters) == 1:
                        known[crease] = letters.pop()
                        changed = True
        undecided = [table for table in tables if len(table[1]) > 1]
        if not undecided:
            return known
        creases, rows = min(undecided, key=lambda table: len(table[1]))

        def changes(row: str) -> int:
            return sum(written.get(crease, letter) != letter for crease, letter in zip(creases, row, strict=True))

        for row in sorted(rows, key=lambda row: (changes(row), row)):
            found = search(list(tables), {**known, **dict(zip(creases, row, strict=True))})
            if found is not None:
                return found
        return None

    if not all(rows for _, rows in tables):
        return None
    return search(tables, {joint: letter for joint, letter in written.items() if joint not in free})


def _fitting(
    creases: Sequence[int], rows: Sequence[str], written: Mapping[int, str], free: Collection[int]
) -> list[str]:
    fixed = [
        (place, written[crease]) for place, crease in enumerate(creases) if crease in written and crease not in free
    ]
    return [row for row in rows if all(row[place] == letter for place, letter in fixed)]
