"""``synth reduce``: take adjunct addenda off a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import FORCE, LOSSY, about, check_output, console, plain, print_json, tell_lost, tell_written

if TYPE_CHECKING:
    from collections.abc import Hashable

    import networkx as nx
    from rich.tree import Tree

    from graphs.mechanism.sc import SCGraph
    from graphs.reduce.assur import AssurReduction
    from graphs.reduce.ride_alongs import Reduction

__all__ = ["reduce_command"]

_MOST_SHOWN = 200


@click.command("reduce", short_help="Take off ride-alongs and adjunct addenda.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", metavar="OUT", help="Write the reduced mechanism here.")
@click.option(
    "--rule", type=click.Choice(["ride-along", "dyad", "assur"]), default="ride-along", show_default=True
)
@click.option("--fully", is_flag=True, help="Reduce a block even where it then has no loop left.")
@click.option("--keep", multiple=True, metavar="LINK", help="A link that stays (an input, say); may be repeated.")
@click.option("--ground", metavar="LINK", help="The fixed link, for the rule assur; the file's, if it names one.")
@click.option(
    "--input", "inputs", multiple=True, metavar="JOINT", help="An input, for the rule assur; may be repeated."
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
    """Take ride-alongs off a mechanism, one by one, until none is left. Mobility stays.

    A ride-along is two binary links u, v on two adjacent links a, b, the four about one centre. Chains of them,
    adjunct addenda, are shown as trees. The rule "dyad" takes off such pairs also where a and b are not joined.

    The rule "assur" parts a mechanism whose loops have one centre into the groups of links that are positioned
    together, given a ground link and an input for each freedom, and takes off those that nothing hangs on.

    \b
    Examples:
      synth reduce data/wiener/fortune-teller.json -o eight-bar.json
      synth reduce data/wiener/stephenson.json --rule assur --ground 0 --input 0
    """
    from graphs.convert.table import to_sc
    from graphs.edit.named import link_named
    from graphs.files.formats import read, write
    from graphs.reduce.ride_alongs import Reduction, reduce

    if (rule != "assur") and (ground is not None or inputs):
        raise click.UsageError("--ground and --input belong to --rule assur")
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
    if isinstance(reduction, Reduction):
        _print(reduction)
    else:
        _print_groups(reduction)
    if output is not None:
        tell_written(output)
        tell_lost(lost)


def _assur(sc: SCGraph, ground: str | None, inputs: tuple[str, ...]) -> AssurReduction:
    from graphs.edit.named import joint_named, link_named
    from graphs.reduce.assur import reduce_assur

    fixed = sc.ground if ground is None else link_named(sc, ground)
    if fixed is None or not inputs:
        raise click.UsageError("--rule assur needs --ground LINK and an --input JOINT for each freedom")
    return reduce_assur(sc, fixed, [joint_named(sc, name) for name in inputs])


def _print_groups(reduction: AssurReduction) -> None:
    _print_counts(reduction.to_json())
    taken = {group.links for group in reduction.removed}
    for number, group in enumerate(reduction.groups, start=1):
        words = f"group {number}: links {_listed(group.links)}, joints {_listed(group.joints)}"
        words += f", input {_listed(group.inputs)}" if group.inputs else ""
        click.echo(words + ("   (taken off)" if group.links in taken else ""))


def _listed(names: tuple[Hashable, ...]) -> str:
    return plain(", ".join(map(str, names)), 200)


def _print(reduction: Reduction) -> None:
    _print_counts(reduction.to_json())
    if not reduction.steps:
        click.echo("nothing to take off")
        return
    chains = reduction.chains()
    click.echo(
        f"{len(reduction.steps)} step(s) in {len(chains)} adjunct addend{'um' if len(chains) == 1 else 'a'}"
    )
    if len(reduction.steps) > _MOST_SHOWN:
        click.echo(f"more than {_MOST_SHOWN} steps: --json lists them")
        return
    out = console()
    for chain in chains:
        out.print(_tree(reduction, chain))


def _print_counts(told: dict[str, Any]) -> None:
    for when in ("before", "after"):
        counts = told[when]
        click.echo(f"{when:6}  links {counts['links']}, joints {counts['joints']}, mobility {counts['mobility']}")


def _tree(reduction: Reduction, chain: nx.DiGraph) -> Tree:
    """Draw an adjunct addendum from the mechanism outwards."""
    from rich.text import Text
    from rich.tree import Tree

    def words(step: int) -> Text:
        one = reduction.steps[step]
        u, v = map(plain, one.removed)
        a, b = map(plain, one.onto)
        return Text(f"step {step + 1}: links {u}, {v} on {a}, {b}")

    (root,) = (step for step in chain if not chain.in_degree(step))
    tree = Tree(words(root))
    branches = {root: tree}
    waiting = [root]
    while waiting:
        step = waiting.pop()
        for above in sorted(chain.successors(step)):
            branches[above] = branches[step].add(words(above))
            waiting.append(above)
    return tree
