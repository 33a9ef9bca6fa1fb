"""``synth edit`` and ``synth reduce``: mechanisms changed, with the change of mobility."""

from collections.abc import Callable
from typing import Any, NamedTuple

import click

import graphs.convert
import graphs.reduce
import synth
from graphs.errors import UnsolvableError, numbered
from synth.cli import options, output as out
from synth.cli.reading import AT, MECHANISM, read


class _EditWords(NamedTuple):
    """What the option of an edit takes, its help, and the function that reads a word of it as a value."""

    takes: str
    help: str
    value_of: Callable[[Any, str, str], Any] = lambda _mechanism, word, _option: word


def _crease(mechanism: synth.Sheet | synth.SCGraph, text: str, option: str) -> tuple[Any, ...]:
    if isinstance(mechanism, synth.Sheet):
        ends = text.split(":")
        if len(ends) != 2:
            wrong = f"{out.plain(text)!r} is not A:B, two vertices or points X,Y of the pattern"
            raise click.BadParameter(wrong, param_hint=option)
        return tuple(_end(word.strip(), option) for word in ends)
    name, _, rest = text.partition(":")
    link, words = options.link_of(mechanism, name), [word.strip() for word in rest.split(",") if word.strip()]
    if not isinstance(mechanism, synth.SCDGraph):
        return link, [options.joint_of(mechanism, word) for word in words]
    if len(words) not in (1, 2):
        wrong = f"{out.plain(text)!r} is not LINK:VERTEX or LINK:VERTEX,VERTEX"
        raise click.BadParameter(wrong, param_hint=option)
    return link, *(_whole(word, option) for word in words)


def _end(word: str, option: str) -> int | tuple[float, ...]:
    """Read a vertex, or a point ``X,Y``."""
    if word.isascii() and word.isdigit() and len(word) < 10:
        return int(word)
    try:
        point = tuple(float(part) for part in word.split(","))
    except ValueError:
        point = ()
    if len(point) not in (2, 3) or not all(abs(x) < 1e12 for x in point):
        raise click.BadParameter(f"{out.plain(word)!r} is neither a vertex nor a point X,Y", param_hint=option)
    return point


def _loop(sc: synth.SCGraph, text: str, option: str) -> tuple[Any, ...]:
    chain, _, rest = text.partition(":")
    a, b, k = _parts(chain, 3, option)
    through = [options.joint_of(sc, word.strip()) for word in rest.split(",") if word.strip()]
    return options.link_of(sc, a), options.link_of(sc, b), _whole(k, option), through or None


def _centre(sc: synth.SCGraph, text: str, option: str) -> int:
    if not isinstance(sc, synth.SCDGraph):
        raise UnsolvableError(f"{option} requires an SCD graph, which has the sides of the links")
    return _whole(text, option)


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


_WORDS = {
    "add_crease": _EditWords(
        "LINK[:X,Y]",
        "Crease a link. For an SC graph, X,Y are the joints beyond the crease; for an SCD "
        "graph, its vertices. For a pattern, A:B, each a vertex or a point X,Y.",
        _crease,
    ),
    "remove_crease": _EditWords("JOINT", "For a pattern: remove a crease; its two panels become one."),
    "add_loop": _EditWords(
        "A,B,K[:J,...]",
        "Add K links between links A and B: a loop with a centre, through the joints J,... from A to B.",
        _loop,
    ),
    "add_spatial_loop": _EditWords(
        "A,B,K[:J,...]",
        "Add K links between links A and B: a loop without a centre, through the joints J,... from A to B.",
        _loop,
    ),
    "add_ride_along": _EditWords(
        "A,B",
        "Add a ride-along to the adjacent links A and B.",
        lambda sc, text, option: [options.link_of(sc, word) for word in _parts(text, 2, option)],
    ),
    "implicit": _EditWords(
        "LOOP",
        "For an SCD graph: make the centre of a loop implicit, so that no link reaches it. "
        "LOOP is the number of the loop, from 0.",
        _centre,
    ),
    "explicit": _EditWords(
        "LOOP",
        "For an SCD graph: make the centre of a loop explicit, so that its links reach it. "
        "LOOP is the number of the loop, from 0.",
        _centre,
    ),
    "lock": _EditWords(
        "JOINT",
        "Lock a joint; its two links become one. For a pattern, the crease becomes flat.",
        lambda before, text, _option: text if isinstance(before, synth.Sheet) else options.joint_of(before, text),
    ),
}
"""The options by the keys of `synth.editing.EDITS`, in the same order."""


def _spelled(key: str) -> str:
    """Return the option of an edit."""
    return "--" + key.replace("_", "-")


def _with_edit_options(command: Callable[..., None]) -> Callable[..., None]:
    """Give the command an option for each edit, which may be repeated."""
    for key, words in reversed(_WORDS.items()):
        command = options.repeated(_spelled(key), words.takes, words.help)(command)
    return command


@click.command()
@MECHANISM
@_with_edit_options
@options.value(
    "--assign-branch", "K",
    "For a pattern: assign the mountains and valleys of a folding branch, by its number or signs, as `synth "
    "fold --branches` lists them. Creases that are immobile on it become flat (F).", type=options.BRANCH,
)  # fmt: skip
@AT
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
    from synth.editing import with_edits

    def value_of(key: str, before: Any, word: Any) -> Any:
        return _WORDS[key].value_of(before, word, _spelled(key)) if key in _WORDS else word

    out.check_output(output, force=force)
    mechanism = read(file)
    with out.about(file):
        branches = () if assign_branch is None else (assign_branch,)
        edited = with_edits(mechanism, {"assign_branch": branches, **words}, value_of=value_of, spelled=_spelled)
        if not edited.edits:
            raise click.UsageError("no edit; try --add-ride-along A,B or another option that edits")
        lost = () if output is None else synth.write(edited.mechanism, output, force=force, lossy=lossy)
    keys = {"file": file, "output": output, "lost": list(lost)}
    out.print_result(edited, keys, as_json=as_json, written=[output], lost=lost)


@click.command("reduce")
@MECHANISM
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
    adjunct addenda, are listed in the order of the steps. The rule "dyad" removes such pairs even if a and b are not
    adjacent.

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
        mechanism = read(file)
        sc = mechanism if isinstance(mechanism, synth.SCDGraph) else graphs.convert.to_sc(mechanism)
        if rule == "assur":
            reduction: graphs.reduce.Reduction | graphs.reduce.AssurReduction = _assur(sc, ground, inputs)
        else:
            reduction = synth.reduce(sc, rule=rule, fully=fully, keep=[options.link_of(sc, name) for name in keep])
        lost = () if output is None else synth.write(reduction.graph, output, force=force, lossy=lossy)
    keys = {"file": file, "output": output, "lost": list(lost)}
    out.print_result(reduction, keys, as_json=as_json, written=[output], lost=lost)
    if output is not None and not as_json:
        click.echo(f"to draw it: synth draw {out.plain(output, 4096)} -o left.svg")


def _assur(sc: synth.SCGraph, ground: str | None, inputs: tuple[str, ...]) -> graphs.reduce.AssurReduction:
    fixed = sc.ground if ground is None else options.link_of(sc, ground)
    if fixed is None or not inputs:
        raise click.UsageError("--rule assur requires --ground LINK, and an --input JOINT per degree of freedom")
    return graphs.reduce.reduce_assur(sc, fixed, [options.joint_of(sc, name) for name in inputs])
