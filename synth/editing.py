"""Several edits in one call, as `synth edit` makes them; one by one: `graphs.edit` and `graphs.creasing`."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias, cast

from graphs.convert.table import graph_of
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
from graphs.files.accepted import MechanismLike, mechanism_for
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.printing import Block, Printed, TableBlock
from graphs.types import JointId, LinkId
from synth.folding.motion import assign_branch as branch_assigned

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
        return {"edits": [each.to_json() for each in self.edits]}

    def blocks(self) -> list[Block]:
        """Return the table that is printed."""
        columns = ("edit", "by", "dM predicted", "counted", "M")
        rows = [
            (each.what, each.equation, str(each.predicted), str(each.counted), str(each.to_json()["mobility"]))
            for each in self.edits
        ]
        return [TableBlock(columns, rows, columns[2:])]

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
    source = mechanism_for("edit", mechanism)
    of_sheet: list[Callable[[Sheet], SheetEdit]] = (
        [] if assign_branch is None else [partial(_assigned, assign_branch)]
    )
    locks, creases = list(lock), list(add_crease)
    gone = list(remove_crease)
    of_graph: list[Callable[[SCGraph], Edit]] = [
        *(partial(_with_loop, loop, Centre.FINITE) for loop in add_loop),
        *(partial(_with_loop, loop, "none") for loop in add_spatial_loop),
        *(partial(_with_ride_along, pair) for pair in add_ride_along),
        *(partial(_with_centre, make_implicit, loop) for loop in implicit),
        *(partial(_with_centre, make_explicit, loop) for loop in explicit),
    ]
    if isinstance(source, Sheet) and not of_graph:
        of_sheet += [partial(_locked_crease, joint) for joint in locks]
        of_sheet += [partial(_creased_sheet, crease) for crease in creases]
        of_sheet += [partial(_without_crease, ends) for ends in _ends_of(source, gone)]
        return _edited_sheet(source, of_sheet)
    if gone or assign_branch is not None:
        option = "remove_crease" if gone else "assign_branch"
        raise UnsolvableError(f"{option} requires a crease pattern, and no edits that add links")
    of_graph = [*(partial(_creased, crease) for crease in creases), *of_graph]
    return _edited_graph(graph_of(source), [*of_graph, *(partial(_locked, joint) for joint in locks)])


def _edited_graph(graph: SCGraph, steps: Sequence[Callable[[SCGraph], Edit]]) -> EditedMechanism:
    """Make the edits of a graph, each to the last result."""
    edits: list[Edit] = []
    for step in steps:
        edits.append(step(graph))
        graph = edits[-1].graph
    return _checked(graph, edits)


def _edited_sheet(sheet: Sheet, steps: Sequence[Callable[[Sheet], SheetEdit]]) -> EditedMechanism:
    """Make the edits of a pattern, each to the last result."""
    edits: list[SheetEdit] = []
    for step in steps:
        edits.append(step(sheet))
        sheet = edits[-1].sheet
    return _checked(sheet, edits)


def _checked(mechanism: SCGraph | Sheet, edits: Sequence[Edit | SheetEdit]) -> EditedMechanism:
    if not edits:
        raise InvariantError("edit", "no edit", "one or more, such as lock=[joint]")
    return EditedMechanism(mechanism, tuple(edits))


def _creased(crease: NewCrease, graph: SCGraph) -> Edit:
    link, *rest = crease
    if not isinstance(graph, SCDGraph):
        joints = rest[0] if len(rest) == 1 and not isinstance(rest[0], int | str) else rest
        return crease_sc(graph, link, list(joints))
    if len(rest) not in (1, 2) or not all(isinstance(vertex, int) for vertex in rest):
        raise InvariantError("edit", f"the crease {shown(crease)}", "a link, and one or two of its vertices")
    return crease_link(graph, link, *rest)


def _with_loop(loop: NewLoop, centre: Centre | str, graph: SCGraph) -> Edit:
    first, second, links, *through = loop
    bare = graph.sc_graph() if isinstance(graph, SCDGraph) else graph
    return with_loop(bare, first, second, links, centre=centre, through=through[0] if through else None)


def _with_ride_along(pair: tuple[LinkId, LinkId], graph: SCGraph) -> Edit:
    first, second = pair
    if isinstance(graph, SCDGraph) and graph.has_edge(first, second):
        return ride_along(graph, next(iter(graph[first][second])))
    return with_ride_along(graph, first, second)


def _with_centre(change: Callable[[SCDGraph, int], Edit], loop: int, graph: SCGraph) -> Edit:
    if not isinstance(graph, SCDGraph):
        raise UnsolvableError("implicit and explicit require an SCD graph, which has the sides of the links")
    return change(graph, loop)


def _locked(joint: JointId, graph: SCGraph) -> Edit:
    return lock_hinge(graph, joint) if isinstance(graph, SCDGraph) else lock_joint(graph, joint)


def _assigned(branch: int | str, sheet: Sheet) -> SheetEdit:
    return branch_assigned(sheet, branch)


def _locked_crease(joint: JointId, sheet: Sheet) -> SheetEdit:
    return lock_crease(sheet, joint_of_sheet_named(sheet, str(joint)))


def _creased_sheet(crease: NewCrease, sheet: Sheet) -> SheetEdit:
    if len(crease) != 2:
        raise InvariantError("edit", f"the crease {shown(crease)}", "two vertices or points of the pattern")
    start, end = cast("tuple[End, End]", crease)
    return crease_sheet(sheet, start, end)


def _ends_of(sheet: Sheet, edges: Sequence[int]) -> list[set[int]]:
    """Return the ends of edges: removing one moves those after it up, and ends stay."""
    whole = with_all_edges(sheet)
    return [set(whole.edges[joint_of_sheet_named(sheet, str(edge))]) for edge in edges]


def _without_crease(ends: set[int], sheet: Sheet) -> SheetEdit:
    number = [set(edge) for edge in with_all_edges(sheet).edges].index(ends)
    return remove_crease(sheet, joint_of_sheet_named(sheet, str(number)))
