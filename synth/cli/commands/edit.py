"""``synth edit`` and ``synth reduce``: mechanisms changed, with the change of mobility."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import click

from graphs import creasing, edit as editing, mechanism as mechanisms
from graphs.errors import UnsolvableError, numbered
from synth.cli.options import BRANCH, FORCE, LOSSY
from synth.cli.output import (
    about,
    check_output,
    console,
    plain,
    print_answer,
    print_json,
    table,
    tell_lost,
    tell_written,
)
from synth.cli.reading import DRAWN, read

if TYPE_CHECKING:
    from graphs.creasing.edits import SheetEdit
    from graphs.edit.edits import Edit
    from graphs.mechanism.sc import SCGraph
    from graphs.mechanism.sheet import Sheet
    from graphs.reduce.assur import AssurReduction
    from graphs.reduce.ride_alongs import Reduction

__all__ = ["edit", "reduce_command"]


@dataclass(frozen=True, slots=True)
class EditOption:
    """An edit of `synth edit`: its option, what that takes, its help, and what makes the edit.

    `of_graph` edits an SC or SCD graph by a value, `of_sheet` a crease pattern by all values, one after the other;
    None where the edit does not apply. Both say what was done, with the predicted change of mobility.
    """

    name: str
    takes: str
    help: str
    of_graph: Callable[[SCGraph, str], Edit] | None = None
    of_sheet: Callable[[Sheet, Sequence[str]], Iterator[SheetEdit]] | None = None

    @property
    def key(self) -> str:
        """The parameter of the command."""
        return self.name.removeprefix("--").replace("-", "_")


def _crease_graph(sc: SCGraph, text: str) -> Edit:
    name, _, rest = text.partition(":")
    link, words = editing.link_named(sc, name), [word.strip() for word in rest.split(",") if word.strip()]
    if not isinstance(sc, mechanisms.SCDGraph):
        return editing.add_crease(sc, link, [editing.joint_named(sc, word) for word in words])
    if len(words) not in (1, 2):
        wrong = f"{plain(text)!r} is not LINK:VERTEX or LINK:VERTEX,VERTEX"
        raise click.BadParameter(wrong, param_hint="--add-crease")
    return editing.crease_link(sc, link, *(_whole(word, "--add-crease") for word in words))


def _add_loop(sc: SCGraph, text: str, *, option: str, centre: str) -> Edit:
    chain, _, rest = text.partition(":")
    a, b, k = _parts(chain, 3, option)
    through = [editing.joint_named(sc, word.strip()) for word in rest.split(",") if word.strip()]
    bare = sc.sc_graph() if isinstance(sc, mechanisms.SCDGraph) else sc
    ends = editing.link_named(sc, a), editing.link_named(sc, b)
    return editing.add_loop(bare, *ends, _whole(k, option), centre=centre, through=through or None)


def _add_ride_along(sc: SCGraph, text: str) -> Edit:
    a, b = (editing.link_named(sc, word) for word in _parts(text, 2, "--add-ride-along"))
    if isinstance(sc, mechanisms.SCDGraph) and sc.has_edge(a, b):
        return editing.ride_along(sc, next(iter(sc[a][b])))
    return editing.add_ride_along(sc, a, b)


def _change_centre(sc: SCGraph, text: str, *, option: str) -> Edit:
    if not isinstance(sc, mechanisms.SCDGraph):
        raise UnsolvableError(f"{option} requires an SCD graph, which has the sides of the links")
    change = editing.make_implicit if option == "--implicit" else editing.make_explicit
    return change(sc, _whole(text, option))


def _lock_graph(sc: SCGraph, text: str) -> Edit:
    joint = editing.joint_named(sc, text)
    return editing.lock_hinge(sc, joint) if isinstance(sc, mechanisms.SCDGraph) else editing.lock_joint(sc, joint)


def _lock_sheet(sheet: Sheet, names: Sequence[str]) -> Iterator[SheetEdit]:
    for name in names:
        edit = creasing.lock_crease(sheet, creasing.joint_of_sheet_named(sheet, name))
        sheet = edit.sheet
        yield edit


def _crease_sheet(sheet: Sheet, texts: Sequence[str]) -> Iterator[SheetEdit]:
    for text in texts:
        ends = text.split(":")
        if len(ends) != 2:
            wrong = f"{plain(text)!r} is not A:B, two vertices or points X,Y of the pattern"
            raise click.BadParameter(wrong, param_hint="--add-crease")
        edit = creasing.crease_sheet(sheet, _end(ends[0].strip()), _end(ends[1].strip()))
        sheet = edit.sheet
        yield edit


def _remove_creases(sheet: Sheet, names: Sequence[str]) -> Iterator[SheetEdit]:
    """Yield the edits that remove creases. Edges move up after each, so all are found first, and known by ends."""
    from graphs.mechanism.sheet import with_all_edges

    edges = with_all_edges(sheet).edges
    creases = [set(edges[creasing.joint_of_sheet_named(sheet, name)]) for name in names]
    for ends in creases:
        number = next((i for i, edge in enumerate(with_all_edges(sheet).edges) if set(edge) == ends), -1)
        edit = creasing.remove_crease(sheet, creasing.joint_of_sheet_named(sheet, str(number)))
        sheet = edit.sheet
        yield edit


def _end(word: str) -> int | tuple[float, ...]:
    """Read a vertex, or a point ``X,Y``."""
    if word.isascii() and word.isdigit() and len(word) < 10:
        return int(word)
    try:
        point = tuple(float(part) for part in word.split(","))
    except ValueError:
        point = ()
    if len(point) not in (2, 3) or not all(abs(x) < 1e12 for x in point):
        raise click.BadParameter(f"{plain(word)!r} is neither a vertex nor a point X,Y", param_hint="--add-crease")
    return point


def _parts(text: str, number: int, option: str) -> list[str]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != number:
        wrong = f"{plain(text)!r} has {numbered(len(parts), 'part')}; expected {number}"
        raise click.BadParameter(wrong, param_hint=option)
    return parts


def _whole(word: str, option: str) -> int:
    if not word.isascii() or not word.isdigit() or len(word) > 6:
        raise click.BadParameter(f"{plain(word)!r} is not a number", param_hint=option)
    return int(word)


EDITS = (
    EditOption(
        "--add-crease",
        "LINK[:X,Y]",
        "Crease a link. For an SC graph, X,Y are the joints beyond the crease; for an SCD "
        "graph, its vertices. For a pattern, A:B, each a vertex or a point X,Y.",
        of_graph=_crease_graph,
        of_sheet=_crease_sheet,
    ),
    EditOption(
        "--remove-crease",
        "JOINT",
        "For a pattern: remove a crease; its two panels become one.",
        of_sheet=_remove_creases,
    ),
    EditOption(
        "--add-loop",
        "A,B,K[:J,...]",
        "Add K links between links A and B: a loop with a centre, through the joints J,... from A to B.",
        of_graph=partial(_add_loop, option="--add-loop", centre="finite"),
    ),
    EditOption(
        "--add-spatial-loop",
        "A,B,K[:J,...]",
        "Add K links between links A and B: a loop without a centre, through the joints J,... from A to B.",
        of_graph=partial(_add_loop, option="--add-spatial-loop", centre="none"),
    ),
    EditOption(
        "--add-ride-along", "A,B", "Add a ride-along to the adjacent links A and B.", of_graph=_add_ride_along
    ),
    EditOption(
        "--implicit",
        "LOOP",
        "For an SCD graph: make the centre of a loop implicit, so that no link reaches it. LOOP is an index.",
        of_graph=partial(_change_centre, option="--implicit"),
    ),
    EditOption(
        "--explicit",
        "LOOP",
        "For an SCD graph: make the centre of a loop explicit, so that its links reach it. LOOP is an index.",
        of_graph=partial(_change_centre, option="--explicit"),
    ),
    EditOption(
        "--lock",
        "JOINT",
        "Lock a joint; its two links become one. For a pattern, the crease becomes flat.",
        of_graph=_lock_graph,
        of_sheet=_lock_sheet,
    ),
)
"""The edits of `synth edit`, in the order of the options, in which graphs are edited."""


def _with_edit_options(command: Callable[..., None]) -> Callable[..., None]:
    """Give the command an option for each edit, which may be repeated."""
    for option in reversed(EDITS):
        command = click.option(option.name, multiple=True, metavar=option.takes, help=option.help)(command)
    return command


@click.command(short_help="Add creases, ride-alongs and loops; change centres; lock joints.")
@click.argument("file", metavar="FILE")
@DRAWN
@_with_edit_options
@click.option(
    "--assign-branch", type=BRANCH, metavar="K",
    help="For a pattern: assign the mountains and valleys of a folding branch, by its number "
    "or signs, as `synth fold --branches` lists them. Creases that are immobile on it "
    "become flat (F).",
)  # fmt: skip
@click.option("-o", "--output", metavar="OUT", help="Write the result to this file.")
@FORCE
@LOSSY
@click.option("--json", "as_json", is_flag=True, help="Print the edits as JSON.")
def edit(
    file: str,
    assign_branch: int | str | None,
    output: str | None,
    force: bool,
    lossy: bool,
    as_json: bool,
    **words: tuple[str, ...],
) -> None:
    """Edit a mechanism. Each edit predicts its change of mobility (Wiener, Eqs. 5 to 7); the count confirms it.

    Options may be repeated; the edits are made in the order of the list below, but creases of a pattern are locked
    before others are added. An SCD graph keeps the sides of its links, unless a loop is added: then it becomes an
    SC graph. A crease pattern stays a crease pattern if creases are locked, added and removed; if links are added,
    it becomes the SC graph of its mechanism. --assign-branch comes before all others: it gives a pattern that
    folds with its mountain-valley assignment.

    JOINT is an id, a number in the list of joints (for a pattern, of edges), or two links A,B with one joint. For
    a loop between links that are not adjacent, name the joints of a path between them, as in the last example.

    \b
    Examples:
      synth edit data/patterns/bird-base.fold --lock 3 --add-crease 0:2 -o edited.fold
      synth edit data/patterns/bird-base.fold --assign-branch 1 -o marked.fold
      synth edit data/wiener/six-bar.json --add-ride-along 0,1 --lock 3 -o edited.json
      synth edit data/wiener/six-bar.json --add-spatial-loop 0,2,4:1,2 -o ten-bar.json
    """
    from graphs.convert.table import graph_of
    from graphs.files.formats import write
    from graphs.mechanism.sheet import Sheet

    check_output(output, force=force)
    mechanism = read(file)
    with about(file):
        edits: list[Edit] | list[SheetEdit]
        if isinstance(mechanism, Sheet) and not any(words[each.key] for each in EDITS if each.of_sheet is None):
            edits = list(_edits_of_sheet(mechanism, words, assign_branch))
        elif words["remove_crease"] or assign_branch is not None:
            option = "--remove-crease" if words["remove_crease"] else "--assign-branch"
            raise UnsolvableError(f"{option} requires a crease pattern, and no edits that add links")
        else:
            edits = list(_edits_of_graph(graph_of(mechanism), words))
        if not edits:
            raise click.UsageError("no edit; try --add-ride-along A,B or another")
        last = edits[-1]
        result = last.graph if isinstance(last, editing.Edit) else last.sheet
        lost = () if output is None else write(result, output, force=force, lossy=lossy)
    if as_json:
        print_json(
            {"file": file, "output": output, "lost": list(lost), "edits": [each.to_json() for each in edits]}
        )
        return
    rows = table("edit", "by", "dM predicted", "counted", "M", numbers=["dM predicted", "counted", "M"])
    for each in edits:
        mobilities = (each.predicted, each.counted, each.to_json()["mobility"])
        rows.add_row(plain(each.what), each.equation, *map(plain, mobilities))
    console().print(rows)
    if output is not None:
        tell_written(output)
        tell_lost(lost)


def _edits_of_graph(sc: SCGraph, words: dict[str, tuple[str, ...]]) -> Iterator[Edit]:
    """Yield the edits of a graph in the order of the options, each made to the last result."""
    for option in EDITS:
        for text in words[option.key]:
            assert option.of_graph is not None  # the command has refused it
            edit = option.of_graph(sc, text)
            sc = edit.graph
            yield edit


def _edits_of_sheet(
    sheet: Sheet, words: dict[str, tuple[str, ...]], branch: int | str | None
) -> Iterator[SheetEdit]:
    """Yield the edits of a pattern: assigned as a branch, locked, creased, uncreased, each to the last result."""
    if branch is not None:
        from synth.folding.motion import assign_branch

        edit = assign_branch(sheet, branch)
        sheet = edit.sheet
        yield edit
    for option in sorted(EDITS, key=lambda option: option.name != "--lock"):
        for edit in option.of_sheet(sheet, words[option.key]) if option.of_sheet is not None else ():
            sheet = edit.sheet
            yield edit


@click.command("reduce", short_help="Remove ride-alongs and adjunct addenda.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("-o", "--output", metavar="OUT", help="Write the reduced mechanism to this file.")
@click.option(
    "--rule", type=click.Choice(["ride-along", "dyad", "assur"]), default="ride-along", show_default=True,
    help="Rule of reduction.",
)  # fmt: skip
@click.option("--fully", is_flag=True, help="Reduce a block even if no loop of it is left.")
@click.option(
    "--keep", multiple=True, metavar="LINK",
    help="Link that must not be removed, such as an input link; may be repeated.",
)  # fmt: skip
@click.option(
    "--ground", metavar="LINK", help="Fixed link, for --rule assur. By default the one that the file names."
)
@click.option(
    "--input", "inputs", multiple=True, metavar="JOINT", help="Input joint, for --rule assur; may be repeated."
)
@FORCE
@LOSSY
@click.option("--json", "as_json", is_flag=True, help="Print counts and steps as JSON.")
def reduce_command(
    file: str,
    output: str | None,
    rule: str,
    fully: bool,
    keep: tuple[str, ...],
    ground: str | None,
    inputs: tuple[str, ...],
    force: bool,
    lossy: bool,
    as_json: bool,
) -> None:
    """Remove the ride-alongs of a mechanism one by one, until none is left. The mobility does not change.

    A ride-along is two binary links u, v on two adjacent links a, b, all four about one centre. Chains of them,
    adjunct addenda, are shown as trees. The rule "dyad" removes such pairs even if a and b are not adjacent.

    The rule "assur" divides a mechanism whose loops have one centre into its Assur groups, given a ground link and
    one input for each degree of freedom, and removes the groups that no other group is attached to.

    \b
    Examples:
      synth reduce data/wiener/fortune-teller.json -o eight-bar.json
      synth reduce data/wiener/stephenson.json --rule assur --ground 0 --input 0
    """
    from graphs.convert.table import to_sc
    from graphs.files.formats import write
    from graphs.reduce.ride_alongs import reduce

    if (rule != "assur") and (ground is not None or inputs):
        raise click.UsageError("--ground and --input require --rule assur")
    check_output(output, force=force)
    with about(file):
        sc = to_sc(read(file))
        if rule == "assur":
            reduction: Reduction | AssurReduction = _assur(sc, ground, inputs)
        else:
            reduction = reduce(sc, rule=rule, fully=fully, keep=[editing.link_named(sc, name) for name in keep])
        lost = () if output is None else write(reduction.graph, output, force=force, lossy=lossy)
    if as_json:
        print_json({"file": file, "output": output, "lost": list(lost), **reduction.to_json()})
        return
    print_answer(reduction)
    if output is not None:
        tell_written(output)
        tell_lost(lost)


def _assur(sc: SCGraph, ground: str | None, inputs: tuple[str, ...]) -> AssurReduction:
    from graphs.reduce.assur import reduce_assur

    fixed = sc.ground if ground is None else editing.link_named(sc, ground)
    if fixed is None or not inputs:
        raise click.UsageError("--rule assur requires --ground LINK, and an --input JOINT per degree of freedom")
    return reduce_assur(sc, fixed, [editing.joint_named(sc, name) for name in inputs])
