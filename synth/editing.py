"""Several edits in one call, as `synth edit` makes them; one by one: `graphs.edit` and `graphs.creasing`."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple, TypeAlias, cast

from graphs.convert.conversions import Mechanism, graph_of
from graphs.creasing.edits import SheetEdit, crease_sheet, joint_of_sheet_named, lock_crease, remove_crease
from graphs.edit.edits import (
    Edit,
    add_crease as crease_sc,
    add_loop as with_loop,
    add_ride_along as with_ride_along,
    crease_link,
    lock_hinge,
    lock_joint,
    make_explicit,
    make_implicit,
    ride_along,
)
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.types import JointId, LinkId
from synth.analysis.folding.motion import assign_branch as branch_assigned

__all__ = ["EditedMechanism", "edit"]

End: TypeAlias = int | tuple[float, ...]
"""A vertex of a pattern, or a point of it."""
NewCrease: TypeAlias = tuple[End, End] | tuple[LinkId, Sequence[JointId]] | tuple[LinkId, int, int]
"""A crease of a pattern, of an SC graph, of an SCD graph."""
NewLoop: TypeAlias = tuple[LinkId, LinkId, int] | tuple[LinkId, LinkId, int, Sequence[JointId]]


@dataclass(frozen=True, repr=False)
class EditedMechanism(Printed):
    """A mechanism after edits.

    Attributes
    ----------
    mechanism : SCGraph or Sheet
        The last result.
    edits : tuple of Edit or SheetEdit
        Each with the mechanism before and after it, and the change of mobility predicted and counted.

    Examples
    --------
    >>> edit("k1:Cr", add_ride_along=[(0, 1)], lock=[0]).mechanism
    <SCGraph: 5 links, 6 joints, 2 centres>
    """

    mechanism: SCGraph | Sheet
    edits: tuple[Edit | SheetEdit, ...]

    def to_json(self) -> dict[str, object]:
        """Return the edits as plain data."""
        return {"edits": [each.to_json() for each in self.edits], "notes": list(self.notes)}

    @property
    def notes(self) -> tuple[str, ...]:
        """What was assumed of the mechanism before the edits."""
        first = self.edits[0].before
        return first.notes if isinstance(first, SCGraph) else ()

    def blocks(self) -> list[Block]:
        """Return the table that is printed."""
        columns = ("edit", "by", "dM predicted", "counted", "M")
        keys = ("what", "equation", "predicted", "counted", "mobility")
        rows = [[plain(edit[key]) for key in keys] for edit in (each.to_json() for each in self.edits)]
        return [TableBlock(columns, rows, columns[2:]), *(f"note: {note}" for note in self.notes)]

    def __repr__(self) -> str:
        return f"<EditedMechanism: {numbered(len(self.edits), 'edit')}, {self.mechanism!r}>"


def edit(
    mechanism: MechanismLike,
    *,
    assign_branch: int | str | None = None,
    add_crease: Iterable[NewCrease] = (),
    remove_crease: Iterable[int] = (),
    add_loop: Iterable[NewLoop] = (),
    add_spatial_loop: Iterable[NewLoop] = (),
    add_ride_along: Iterable[tuple[LinkId, LinkId]] = (),
    implicit: Iterable[int] = (),
    explicit: Iterable[int] = (),
    lock: Iterable[JointId] = (),
) -> EditedMechanism:
    """Edit a mechanism; each edit predicts its change of mobility, and the count confirms it.

    Edits are made in the order of the parameters, but creases of a pattern are locked before others are added. An
    SCD graph keeps the sides of its links unless a loop is added. A crease pattern stays one if creases are
    locked, added and removed; otherwise it becomes the SC graph of its mechanism.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
    assign_branch : int or str, optional
        For a pattern: assign the mountains and valleys of a folding branch, by its number or its signs.
    add_crease : iterable of tuple, optional
        For a pattern, both ends of a crease, each a vertex or a point (x, y); for an SCD graph, a link and one or
        two of its vertices; for an SC graph, a link and the joints beyond the crease.
    remove_crease : iterable of int, optional
        For a pattern: edges, by their numbers before any is removed.
    add_loop, add_spatial_loop : iterable of (link, link, int) or (link, link, int, joints), optional
        So many new links between two links, which close a loop with a centre, or without one, through the joints
        of a path from the first link to the second; by default the joint between them.
    add_ride_along : iterable of (link, link), optional
        Adjacent links.
    implicit, explicit : iterable of int, optional
        For an SCD graph: loops, by their places in the list, whose centre no link reaches any more, or all reach.
    lock : iterable of joint ids, optional
        Joints whose two links become one; creases of a pattern become flat.

    Returns
    -------
    EditedMechanism

    Raises
    ------
    UnsolvableError
        If an edit requires a crease pattern, or an SCD graph.
    InvariantError
        If there is no such link, joint, loop, vertex or branch, or no edit.

    Examples
    --------
    >>> edited = edit("m1:a-b.ac-.b-d.cd-", lock=[0])
    >>> edited
    <EditedMechanism: 1 edit, <SCDGraph: 3 links, 3 joints, 1 centre, 5 vertices>>
    >>> edited.edits[0].predicted, edited.edits[0].counted
    (-1, -1)
    """
    values = {
        "assign_branch": () if assign_branch is None else (assign_branch,),
        "add_crease": add_crease,
        "remove_crease": remove_crease,
        "add_loop": add_loop,
        "add_spatial_loop": add_spatial_loop,
        "add_ride_along": add_ride_along,
        "implicit": implicit,
        "explicit": explicit,
        "lock": lock,
    }
    answer = with_edits(mechanism_for("edit", mechanism), {key: list(some) for key, some in values.items()})
    if not answer.edits:
        raise InvariantError("edit", "no edit", "one or more, such as lock=[joint]")
    return answer


def with_edits(
    mechanism: Mechanism,
    values: Mapping[str, Sequence[Any]],
    *,
    value_of: Callable[[str, Any, Any], Any] = lambda _key, _mechanism, value: value,
    spelled: Callable[[str], str] = str,
) -> EditedMechanism:
    """Return a mechanism after edits: for each key of `EDITS` some values, for each value an edit.

    `value_of` reads what stands for a value, with its key and the mechanism just before the edit, since names may
    be of parts that an earlier edit added; `spelled` spells a key in messages.
    """
    keys = [key for key in EDITS if values[key]]
    if isinstance(mechanism, Sheet) and all(EDITS[key].of_sheet for key in keys):
        of_sheet = list(_edits_of_sheet(mechanism, values, value_of))
        return EditedMechanism(of_sheet[-1].sheet if of_sheet else mechanism, tuple(of_sheet))
    for key in ("remove_crease", "assign_branch"):
        if key in keys:
            raise UnsolvableError(f"{spelled(key)} requires a crease pattern, and no edits that add links")
    graph = graph_of(mechanism)
    edits: list[Edit] = []
    for key in keys:
        change = EDITS[key].of_graph
        assert change is not None
        for value in values[key]:
            edits.append(change(graph, value_of(key, graph, value)))
            graph = edits[-1].graph
    return EditedMechanism(graph, tuple(edits))


def _edits_of_sheet(
    sheet: Sheet, values: Mapping[str, Sequence[Any]], value_of: Callable[[str, Any, Any], Any]
) -> Iterator[SheetEdit]:
    """Yield the edits of a pattern, each made to the last result."""
    for key in ("assign_branch", "lock", "add_crease", "remove_crease"):
        change, some = EDITS[key].of_sheet, values[key]
        assert change is not None
        if key == "remove_crease":
            some = _ends_of(sheet, some)
        for value in some:
            edit = change(sheet, value_of(key, sheet, value))
            sheet = edit.sheet
            yield edit


def _creased(graph: SCGraph, crease: NewCrease) -> Edit:
    link, *rest = crease
    if not isinstance(graph, SCDGraph):
        joints = rest[0] if len(rest) == 1 and not isinstance(rest[0], int | str) else rest
        return crease_sc(graph, link, list(joints))
    if len(rest) not in (1, 2) or not all(isinstance(vertex, int) for vertex in rest):
        raise InvariantError("edit", f"the crease {shown(crease)}", "a link, and one or two of its vertices")
    return crease_link(graph, link, *rest)


def _with_loop(graph: SCGraph, loop: NewLoop, *, centre: Centre | str = Centre.FINITE) -> Edit:
    first, second, links, *through = loop
    bare = graph.sc_graph() if isinstance(graph, SCDGraph) else graph
    return with_loop(bare, first, second, links, centre=centre, through=through[0] if through else None)


def _with_ride_along(graph: SCGraph, pair: tuple[LinkId, LinkId]) -> Edit:
    first, second = pair
    if isinstance(graph, SCDGraph) and graph.has_edge(first, second):
        return ride_along(graph, next(iter(graph[first][second])))
    return with_ride_along(graph, first, second)


def _with_centre(change: Callable[[SCDGraph, int], Edit], graph: SCGraph, loop: int) -> Edit:
    if not isinstance(graph, SCDGraph):
        raise UnsolvableError("implicit and explicit require an SCD graph, which has the sides of the links")
    return change(graph, loop)


def _creased_sheet(sheet: Sheet, crease: NewCrease) -> SheetEdit:
    if len(crease) != 2:
        raise InvariantError("edit", f"the crease {shown(crease)}", "two vertices or points of the pattern")
    start, end = cast("tuple[End, End]", crease)
    return crease_sheet(sheet, start, end)


def _ends_of(sheet: Sheet, edges: Sequence[int | str]) -> list[set[int]]:
    """Return the ends of edges: removing one moves those after it up, and ends stay."""
    whole = with_all_edges(sheet)
    return [set(whole.edges[joint_of_sheet_named(sheet, str(edge))]) for edge in edges]


def _without_crease(sheet: Sheet, ends: set[int]) -> SheetEdit:
    number = next((i for i, edge in enumerate(with_all_edges(sheet).edges) if set(edge) == ends), -1)
    return remove_crease(sheet, joint_of_sheet_named(sheet, str(number)))


class MechanismEdits(NamedTuple):
    """How one value edits a graph, and a crease pattern; None where the edit does not apply."""

    of_graph: Callable[[SCGraph, Any], Edit] | None = None
    of_sheet: Callable[[Sheet, Any], SheetEdit] | None = None


EDITS = {
    "assign_branch": MechanismEdits(of_sheet=branch_assigned),
    "add_crease": MechanismEdits(_creased, _creased_sheet),
    "remove_crease": MechanismEdits(of_sheet=_without_crease),
    "add_loop": MechanismEdits(_with_loop),
    "add_spatial_loop": MechanismEdits(partial(_with_loop, centre="none")),
    "add_ride_along": MechanismEdits(_with_ride_along),
    "implicit": MechanismEdits(partial(_with_centre, make_implicit)),
    "explicit": MechanismEdits(partial(_with_centre, make_explicit)),
    "lock": MechanismEdits(
        lambda graph, joint: (lock_hinge if isinstance(graph, SCDGraph) else lock_joint)(graph, joint),
        lambda sheet, joint: lock_crease(sheet, joint_of_sheet_named(sheet, str(joint))),
    ),
}
"""The edits by their keys, in the order in which graphs are edited."""
