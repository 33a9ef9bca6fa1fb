"""``synth edit`` and ``synth reduce``: mechanisms changed, with the change of mobility."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import click

import graphs.convert
import graphs.edit
import graphs.reduce
import synth.folding
from graphs import creasing
from graphs.errors import UnsolvableError, numbered
from synth.cli import options, output as out
from synth.cli.reading import DRAWN, read


@dataclass(frozen=True, slots=True)
class EditOption:
    """An edit of `synth edit`: its option, what that takes, its help, and what makes the edit.

    `of_graph` edits an SC or SCD graph by a value, `of_sheet` a crease pattern by all values, one after the other;
    None where the edit does not apply. Both say what was done, with the predicted change of mobility.
    """

    name: str
    takes: str
    help: str
    of_graph: Callable[[synth.SCGraph, str], graphs.edit.Edit] | None = None
    of_sheet: Callable[[synth.Sheet, Sequence[str]], Iterator[creasing.SheetEdit]] | None = None

    @property
    def key(self) -> str:
        """The parameter of the command."""
        return self.name.removeprefix("--").replace("-", "_")


def _crease_graph(sc: synth.SCGraph, text: str) -> graphs.edit.Edit:
    name, _, rest = text.partition(":")
    link, words = options.link_of(sc, name), [word.strip() for word in rest.split(",") if word.strip()]
    if not isinstance(sc, synth.SCDGraph):
        return graphs.edit.add_crease(sc, link, [options.joint_of(sc, word) for word in words])
    if len(words) not in (1, 2):
        wrong = f"{out.plain(text)!r} is not LINK:VERTEX or LINK:VERTEX,VERTEX"
        raise click.BadParameter(wrong, param_hint="--add-crease")
    return graphs.edit.crease_link(sc, link, *(_whole(word, "--add-crease") for word in words))


def _add_loop(sc: synth.SCGraph, text: str, *, option: str, centre: str) -> graphs.edit.Edit:
    chain, _, rest = text.partition(":")
    a, b, k = _parts(chain, 3, option)
    through = [options.joint_of(sc, word.strip()) for word in rest.split(",") if word.strip()]
    bare = sc.sc_graph() if isinstance(sc, synth.SCDGraph) else sc
    ends = options.link_of(sc, a), options.link_of(sc, b)
    return graphs.edit.add_loop(bare, *ends, _whole(k, option), centre=centre, through=through or None)


def _add_ride_along(sc: synth.SCGraph, text: str) -> graphs.edit.Edit:
    a, b = (options.link_of(sc, word) for word in _parts(text, 2, "--add-ride-along"))
    if isinstance(sc, synth.SCDGraph) and sc.has_edge(a, b):
        return graphs.edit.ride_along(sc, next(iter(sc[a][b])))
    return graphs.edit.add_ride_along(sc, a, b)


def _change_centre(sc: synth.SCGraph, text: str, *, option: str) -> graphs.edit.Edit:
    if not isinstance(sc, synth.SCDGraph):
        raise UnsolvableError(f"{option} requires an SCD graph, which has the sides of the links")
    change = graphs.edit.make_implicit if option == "--implicit" else graphs.edit.make_explicit
    return change(sc, _whole(text, option))


def _lock_graph(sc: synth.SCGraph, text: str) -> graphs.edit.Edit:
    joint = options.joint_of(sc, text)
    return (
        graphs.edit.lock_hinge(sc, joint) if isinstance(sc, synth.SCDGraph) else graphs.edit.lock_joint(sc, joint)
    )


def _lock_sheet(sheet: synth.Sheet, names: Sequence[str]) -> Iterator[creasing.SheetEdit]:
    for name in names:
        edit = creasing.lock_crease(sheet, creasing.joint_of_sheet_named(sheet, name))
        sheet = edit.sheet
        yield edit


def _crease_sheet(sheet: synth.Sheet, texts: Sequence[str]) -> Iterator[creasing.SheetEdit]:
    for text in texts:
        ends = text.split(":")
        if len(ends) != 2:
            wrong = f"{out.plain(text)!r} is not A:B, two vertices or points X,Y of the pattern"
            raise click.BadParameter(wrong, param_hint="--add-crease")
        edit = creasing.crease_sheet(sheet, _end(ends[0].strip()), _end(ends[1].strip()))
        sheet = edit.sheet
        yield edit


def _remove_creases(sheet: synth.Sheet, names: Sequence[str]) -> Iterator[creasing.SheetEdit]:
    """Yield the edits that remove creases, all found before by their ends: edges are renumbered after each."""
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
        raise click.BadParameter(
            f"{out.plain(word)!r} is neither a vertex nor a point X,Y", param_hint="--add-crease"
        )
    return point


def _parts(text: str, number: int, option: str) -> list[str]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != number:
        wrong = f"{out.plain(text)!r} has {numbered(len(parts), 'part')}; expected {number}"
        raise click.BadParameter(wrong, param_hint=option)
    return parts


def _whole(word: str, option: str) -> int:
    if not word.isascii() or not word.isdigit() or len(word) > 6:
        raise click.BadParameter(f"{out.plain(word)!r} is not a number", param_hint=option)
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
        "For an SCD graph: make the centre of a loop implicit, so that no link reaches it. "
        "LOOP is the number of the loop, from 0.",
        of_graph=partial(_change_centre, option="--implicit"),
    ),
    EditOption(
        "--explicit",
        "LOOP",
        "For an SCD graph: make the centre of a loop explicit, so that its links reach it. "
        "LOOP is the number of the loop, from 0.",
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
        command = options.repeated(option.name, option.takes, option.help)(command)
    return command


@click.command()
@options.FILE
@DRAWN
@_with_edit_options
@options.value(
    "--assign-branch", "K",
    "For a pattern: assign the mountains and valleys of a folding branch, by its number or signs, as `synth "
    "fold --branches` lists them. Creases that are immobile on it become flat (F).", type=options.BRANCH,
)  # fmt: skip
@options.output("Write the result to this file.")
@options.FORCE
@options.LOSSY
@options.flag("--json as_json", "Print the edits as JSON.")
def edit(
    file: str, assign_branch: int | str | None, output: str | None, force: bool, lossy: bool, as_json: bool,
    **words: tuple[str, ...],
) -> None:  # fmt: skip
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
      synth edit data/patterns/bird-base.fold --lock 3 --add-crease 5:2 -o edited.fold
      synth edit data/patterns/bird-base.fold --assign-branch 1 -o marked.fold
      synth edit data/wiener/six-bar.json --add-ride-along 0,1 --lock 3 -o edited.json
      synth edit data/wiener/six-bar.json --add-spatial-loop 0,2,4:1,2 -o ten-bar.json
    """
    from graphs.convert.table import graph_of

    out.check_output(output, force=force)
    mechanism = read(file)
    with out.about(file):
        edits: list[graphs.edit.Edit] | list[creasing.SheetEdit]
        if isinstance(mechanism, synth.Sheet) and not any(
            words[each.key] for each in EDITS if each.of_sheet is None
        ):
            edits = list(_edits_of_sheet(mechanism, words, assign_branch))
        elif words["remove_crease"] or assign_branch is not None:
            option = "--remove-crease" if words["remove_crease"] else "--assign-branch"
            raise UnsolvableError(f"{option} requires a crease pattern, and no edits that add links")
        else:
            edits = list(_edits_of_graph(graph_of(mechanism), words))
        if not edits:
            raise click.UsageError("no edit; try --add-ride-along A,B or another option that edits")
        last = edits[-1]
        result = last.graph if isinstance(last, graphs.edit.Edit) else last.sheet
        lost = () if output is None else synth.write(result, output, force=force, lossy=lossy)
    if as_json:
        out.print_json(
            {"file": file, "output": output, "lost": list(lost), "edits": [each.to_json() for each in edits]}
        )
        return
    rows = out.table("edit", "by", "dM predicted", "counted", "M", numbers=["dM predicted", "counted", "M"])
    for each in edits:
        mobilities = (each.predicted, each.counted, each.to_json()["mobility"])
        rows.add_row(out.plain(each.what), each.equation, *map(out.plain, mobilities))
    out.console().print(rows)
    out.tell_written(output)
    out.tell_lost(lost)


def _edits_of_graph(sc: synth.SCGraph, words: dict[str, tuple[str, ...]]) -> Iterator[graphs.edit.Edit]:
    """Yield the edits of a graph in the order of the options, each made to the last result."""
    for option in EDITS:
        for text in words[option.key]:
            assert option.of_graph is not None  # the command has refused it
            edit = option.of_graph(sc, text)
            sc = edit.graph
            yield edit


def _edits_of_sheet(
    sheet: synth.Sheet, words: dict[str, tuple[str, ...]], branch: int | str | None
) -> Iterator[creasing.SheetEdit]:
    """Yield the edits of a pattern: assigned as a branch, locked, creased, uncreased, each to the last result."""
    if branch is not None:
        edit = synth.folding.assign_branch(sheet, branch)
        sheet = edit.sheet
        yield edit
    for option in sorted(EDITS, key=lambda option: option.name != "--lock"):
        for edit in option.of_sheet(sheet, words[option.key]) if option.of_sheet is not None else ():
            sheet = edit.sheet
            yield edit


@click.command("reduce")
@options.FILE
@DRAWN
@options.output("Write the reduced mechanism to this file.")
@options.choice("--rule", ("ride-along", "dyad", "assur"), "Rule of reduction.", default="ride-along")
@options.flag("--fully", "Reduce a block even if no loop of it is left.")
@options.repeated("--keep", "LINK", "Link that must not be removed, such as an input link; may be repeated.")
@options.value("--ground", "LINK", "Fixed link, for --rule assur. By default the one that the file names.")
@options.repeated("--input inputs", "JOINT", "Input joint, for --rule assur; may be repeated.")
@options.FORCE
@options.LOSSY
@options.flag("--json as_json", "Print counts and steps as JSON.")
def reduce_command(
    file: str, output: str | None, rule: str, fully: bool, keep: tuple[str, ...], ground: str | None,
    inputs: tuple[str, ...], force: bool, lossy: bool, as_json: bool,
) -> None:  # fmt: skip
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
    if (rule != "assur") and (ground is not None or inputs):
        raise click.UsageError("--ground and --input require --rule assur")
    out.check_output(output, force=force)
    with out.about(file):
        sc = graphs.convert.to_sc(read(file))
        if rule == "assur":
            reduction: graphs.reduce.Reduction | graphs.reduce.AssurReduction = _assur(sc, ground, inputs)
        else:
            reduction = synth.reduce(sc, rule=rule, fully=fully, keep=[options.link_of(sc, name) for name in keep])
        lost = () if output is None else synth.write(reduction.graph, output, force=force, lossy=lossy)
    keys = {"file": file, "output": output, "lost": list(lost)}
    out.print_result(reduction, keys, as_json=as_json, written=[output], lost=lost)


def _assur(sc: synth.SCGraph, ground: str | None, inputs: tuple[str, ...]) -> graphs.reduce.AssurReduction:
    fixed = sc.ground if ground is None else options.link_of(sc, ground)
    if fixed is None or not inputs:
        raise click.UsageError("--rule assur requires --ground LINK, and an --input JOINT per degree of freedom")
    return graphs.reduce.reduce_assur(sc, fixed, [options.joint_of(sc, name) for name in inputs])
