"""``synth edit``: change a mechanism, and say what that does to its mobility."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import click

from synth.cli.lengths import BRANCH
from synth.cli.output import (
    FORCE,
    LOSSY,
    about,
    check_output,
    console,
    plain,
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

__all__ = ["edit"]

_OF_PATTERNS = ("lock", "add_crease", "remove_crease")
"""The edits that leave a crease pattern one."""


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
    "--assign-branch",
    type=BRANCH,
    metavar="K",
    help="For a pattern: assign the mountains and valleys of a folding branch, by its number "
    "or signs, as `synth fold --branches` lists them. Creases that are immobile on it "
    "become flat (F).",
)
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
    **wanted: tuple[str, ...],
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
    from synth.cli.graphs.patterns import pattern_edits

    check_output(output, force=force)
    thing = read(file)
    with about(file):
        edits: list[Edit] | list[SheetEdit]
        if isinstance(thing, Sheet) and not any(wanted[name] for name in wanted if name not in _OF_PATTERNS):
            edits = list(pattern_edits(thing, wanted, assign_branch))
        elif wanted["remove_crease"] or assign_branch is not None:
            option = "--remove-crease" if wanted["remove_crease"] else "--assign-branch"
            raise UnsolvableError(f"{option} is for crease patterns, without edits that add links")
        else:
            edits = _edited(graph_of(thing), wanted)
        if not edits:
            raise click.UsageError("name an edit, such as --add-ride-along A,B")
        last = edits[-1]
        result = last.graph if isinstance(last, EditOfGraph) else last.sheet
        lost = () if output is None else write(result, output, force=force, lossy=lossy)
    if as_json:
        print_json({"file": file, "output": output, "lost": list(lost), "edits": [one.to_json() for one in edits]})
        return
    rows = table("edit", "by", "dM predicted", "counted", "M", numbers=["dM predicted", "counted", "M"])
    for one in edits:
        told = one.to_json()
        rows.add_row(plain(one.what), one.equation, *map(plain, (one.predicted, one.counted, told["mobility"])))
    console().print(rows)
    if output is not None:
        tell_written(output)
        tell_lost(lost)


def _edited(sc: SCGraph, wanted: dict[str, tuple[str, ...]]) -> list[Edit]:
    """Make the edits that were asked for, each to the result of the last."""
    edits: list[Edit] = []
    for make in _edits(wanted):
        edits.append(make(edits[-1].graph if edits else sc))
    return edits


def _edits(wanted: dict[str, tuple[str, ...]]) -> Iterator[Callable[[SCGraph], Edit]]:
    """Yield the edits that were asked for, in the order of the options."""
    kinds: dict[str, Callable[[SCGraph, str], Edit]] = {
        "add_crease": _crease,
        "add_loop": lambda sc, text: _loop(sc, text, "finite", "--add-loop"),
        "add_spatial_loop": lambda sc, text: _loop(sc, text, "none", "--add-spatial-loop"),
        "add_ride_along": _ride_along,
        "implicit": lambda sc, text: _centre(sc, text, "--implicit"),
        "explicit": lambda sc, text: _centre(sc, text, "--explicit"),
        "lock": _lock,
    }
    for name, make in kinds.items():
        for text in wanted[name]:
            yield lambda sc, make=make, text=text: make(sc, text)  # type: ignore[misc]


def _words(text: str, number: int, option: str) -> list[str]:
    words = [word.strip() for word in text.split(",")]
    if len(words) != number:
        raise click.BadParameter(f"{plain(text)!r} has {len(words)} part(s), not {number}", param_hint=option)
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
        raise click.BadParameter("an SCD graph needs LINK:VERTEX or LINK:VERTEX,VERTEX", param_hint="--add-crease")
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
        raise UnsolvableError(f"{option} needs the sides of the links: an SCD graph")
    return (make_implicit if option == "--implicit" else make_explicit)(sc, _whole(text, option))


def _lock(sc: SCGraph, text: str) -> Edit:
    from graphs.edit.edits import lock_hinge, lock_joint
    from graphs.edit.named import joint_named
    from graphs.mechanism.scd import SCDGraph

    joint = joint_named(sc, text)
    return lock_hinge(sc, joint) if isinstance(sc, SCDGraph) else lock_joint(sc, joint)
