"""``synth edit`` and ``synth reduce``: mechanisms changed, with the change of mobility."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import click

from graphs.errors import numbered
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


_OF_PATTERNS = ("lock", "add_crease", "remove_crease")
"""The edits whose result is a crease pattern again."""


def _repeated(name: str, metavar: str, text: str) -> Callable[..., Callable[..., object]]:
    return click.option(name, multiple=True, metavar=metavar, help=text)


@click.command(short_help="Add creases, ride-alongs and loops; change centres; lock joints.")
@click.argument("file", metavar="FILE")
@DRAWN
@_repeated(
    "--add-crease",
    "LINK[:X,Y]",
    "Crease a link. For an SC graph, X,Y are the joints beyond the crease; for an SCD "
    "graph, its vertices. For a pattern, A:B, each a vertex or a point X,Y.",
)
@_repeated("--remove-crease", "JOINT", "For a pattern: remove a crease; its two panels become one.")
@_repeated(
    "--add-loop",
    "A,B,K[:J,...]",
    "Add K links between links A and B: a loop with a centre, through the joints J,... from A to B.",
)
@_repeated(
    "--add-spatial-loop",
    "A,B,K[:J,...]",
    "Add K links between links A and B: a loop without a centre, through the joints J,... from A to B.",
)
@_repeated("--add-ride-along", "A,B", "Add a ride-along to the adjacent links A and B.")
@_repeated(
    "--implicit",
    "LOOP",
    "For an SCD graph: make the centre of a loop implicit, so that no link reaches it. LOOP is an index.",
)
@_repeated(
    "--explicit",
    "LOOP",
    "For an SCD graph: make the centre of a loop explicit, so that its links reach it. LOOP is an index.",
)
@_repeated("--lock", "JOINT", "Lock a joint; its two links become one. For a pattern, the crease becomes flat.")
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

    Options may be repeated; the edits are made in the order of the list below. An SCD graph keeps the sides of its
    links, unless a loop is added: then it becomes an SC graph. A crease pattern stays a crease pattern if creases
    are locked, added and removed; if links are added, it becomes the SC graph of its mechanism. --assign-branch
    comes before all others: it gives a pattern that folds with its mountain-valley assignment.

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
    from graphs.edit.edits import Edit as EditOfGraph
    from graphs.errors import UnsolvableError
    from graphs.files.formats import write
    from graphs.mechanism.sheet import Sheet

    check_output(output, force=force)
    mechanism = read(file)
    with about(file):
        edits: list[Edit] | list[SheetEdit]
        if isinstance(mechanism, Sheet) and not any(words[name] for name in words if name not in _OF_PATTERNS):
            edits = list(_pattern_edits(mechanism, words, assign_branch))
        elif words["remove_crease"] or assign_branch is not None:
            option = "--remove-crease" if words["remove_crease"] else "--assign-branch"
            raise UnsolvableError(f"{option} requires a crease pattern, and no edits that add links")
        else:
            edits = _edited(graph_of(mechanism), words)
        if not edits:
            raise click.UsageError("no edit; try --add-ride-along A,B or another")
        last = edits[-1]
        result = last.graph if isinstance(last, EditOfGraph) else last.sheet
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


def _edited(sc: SCGraph, words: dict[str, tuple[str, ...]]) -> list[Edit]:
    """Make the edits of an SC graph in the order of the options, each to the result of the last."""
    kinds: dict[str, Callable[[SCGraph, str], Edit]] = {
        "add_crease": _crease,
        "add_loop": lambda sc, text: _loop(sc, text, "finite", "--add-loop"),
        "add_spatial_loop": lambda sc, text: _loop(sc, text, "none", "--add-spatial-loop"),
        "add_ride_along": _ride_along,
        "implicit": lambda sc, text: _centre(sc, text, "--implicit"),
        "explicit": lambda sc, text: _centre(sc, text, "--explicit"),
        "lock": _lock,
    }
    edits: list[Edit] = []
    for name, make in kinds.items():
        for text in words[name]:
            edits.append(make(edits[-1].graph if edits else sc, text))
    return edits


def _words(text: str, number: int, option: str) -> list[str]:
    words = [word.strip() for word in text.split(",")]
    if len(words) != number:
        parts = numbered(len(words), "part")
        raise click.BadParameter(f"{plain(text)!r} has {parts}; expected {number}", param_hint=option)
    return words


def _whole(word: str, option: str) -> int:
    if not word.isascii() or not word.isdigit() or len(word) > 6:
        raise click.BadParameter(f"{plain(word)!r} is not a number", param_hint=option)
    return int(word)


def _crease(sc: SCGraph, text: str) -> Edit:
    from graphs.edit.edits import add_crease, crease_link
    from graphs.edit.named import joint_named, link_named
    from graphs.mechanism.scd import SCDGraph

    name, _, rest = text.partition(":")
    link, words = link_named(sc, name), [word.strip() for word in rest.split(",") if word.strip()]
    if not isinstance(sc, SCDGraph):
        return add_crease(sc, link, [joint_named(sc, word) for word in words])
    if len(words) not in (1, 2):
        raise click.BadParameter(
            f"{plain(text)!r} is not LINK:VERTEX or LINK:VERTEX,VERTEX", param_hint="--add-crease"
        )
    return crease_link(sc, link, *(_whole(word, "--add-crease") for word in words))


def _loop(sc: SCGraph, text: str, centre: str, option: str) -> Edit:
    from graphs.edit.edits import add_loop
    from graphs.edit.named import joint_named, link_named
    from graphs.mechanism.scd import SCDGraph

    chain, _, rest = text.partition(":")
    a, b, k = _words(chain, 3, option)
    through = [joint_named(sc, word.strip()) for word in rest.split(",") if word.strip()]
    bare = sc.sc_graph() if isinstance(sc, SCDGraph) else sc
    ends = link_named(sc, a), link_named(sc, b)
    return add_loop(bare, *ends, _whole(k, option), centre=centre, through=through or None)


def _ride_along(sc: SCGraph, text: str) -> Edit:
    from graphs.edit.edits import add_ride_along, ride_along
    from graphs.edit.named import link_named
    from graphs.mechanism.scd import SCDGraph

    a, b = (link_named(sc, word) for word in _words(text, 2, "--add-ride-along"))
    if isinstance(sc, SCDGraph) and sc.has_edge(a, b):
        return ride_along(sc, next(iter(sc[a][b])))
    return add_ride_along(sc, a, b)


def _centre(sc: SCGraph, text: str, option: str) -> Edit:
    from graphs.edit.edits import make_explicit, make_implicit
    from graphs.errors import UnsolvableError
    from graphs.mechanism.scd import SCDGraph

    if not isinstance(sc, SCDGraph):
        raise UnsolvableError(f"{option} requires an SCD graph, which has the sides of the links")
    return (make_implicit if option == "--implicit" else make_explicit)(sc, _whole(text, option))


def _lock(sc: SCGraph, text: str) -> Edit:
    from graphs.edit.edits import lock_hinge, lock_joint
    from graphs.edit.named import joint_named
    from graphs.mechanism.scd import SCDGraph

    joint = joint_named(sc, text)
    return lock_hinge(sc, joint) if isinstance(sc, SCDGraph) else lock_joint(sc, joint)


def _pattern_edits(
    sheet: Sheet, words: dict[str, tuple[str, ...]], branch: int | str | None = None
) -> Iterator[SheetEdit]:
    """Yield the edits of a pattern: assigned as a branch, creases locked, added, removed, each to the last result.

    Edges keep their numbers until creases are removed; those are named before.
    """
    from graphs.creasing.edits import crease_sheet, joint_of_sheet_named, lock_crease, remove_crease
    from graphs.mechanism.sheet import with_all_edges

    if branch is not None:
        from synth.folding.motion import assign_branch

        edit = assign_branch(sheet, branch)
        sheet = edit.sheet
        yield edit
    for text in words["lock"]:
        edit = lock_crease(sheet, joint_of_sheet_named(sheet, text))
        sheet = edit.sheet
        yield edit
    for text in words["add_crease"]:
        edit = crease_sheet(sheet, *_ends(text))
        sheet = edit.sheet
        yield edit
    whole = with_all_edges(sheet)
    leaving = [whole.edges[joint_of_sheet_named(sheet, text)] for text in words["remove_crease"]]
    for ends in leaving:
        number = next((i for i, edge in enumerate(with_all_edges(sheet).edges) if set(edge) == set(ends)), -1)
        edit = remove_crease(sheet, joint_of_sheet_named(sheet, str(number)))
        sheet = edit.sheet
        yield edit


def _ends(text: str) -> tuple[int | tuple[float, ...], int | tuple[float, ...]]:
    """Read ``A:B``, each a vertex, or a point ``X,Y``."""
    ends = text.split(":")
    if len(ends) != 2:
        raise click.BadParameter(
            f"{plain(text)!r} is not A:B, two vertices or points X,Y of the pattern", param_hint="--add-crease"
        )
    return _end(ends[0].strip()), _end(ends[1].strip())


def _end(word: str) -> int | tuple[float, ...]:
    if word.isascii() and word.isdigit() and len(word) < 10:
        return int(word)
    try:
        point = tuple(float(part) for part in word.split(","))
    except ValueError:
        point = ()
    if len(point) not in (2, 3) or not all(abs(x) < 1e12 for x in point):
        raise click.BadParameter(f"{plain(word)!r} is neither a vertex nor a point X,Y", param_hint="--add-crease")
    return point


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
    from graphs.edit.named import link_named
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
            reduction = reduce(sc, rule=rule, fully=fully, keep=[link_named(sc, name) for name in keep])
        lost = () if output is None else write(reduction.graph, output, force=force, lossy=lossy)
    if as_json:
        print_json({"file": file, "output": output, "lost": list(lost), **reduction.to_json()})
        return
    print_answer(reduction)
    if output is not None:
        tell_written(output)
        tell_lost(lost)


def _assur(sc: SCGraph, ground: str | None, inputs: tuple[str, ...]) -> AssurReduction:
    from graphs.edit.named import joint_named, link_named
    from graphs.reduce.assur import reduce_assur

    fixed = sc.ground if ground is None else link_named(sc, ground)
    if fixed is None or not inputs:
        raise click.UsageError("--rule assur requires --ground LINK, and an --input JOINT per degree of freedom")
    return reduce_assur(sc, fixed, [joint_named(sc, name) for name in inputs])
