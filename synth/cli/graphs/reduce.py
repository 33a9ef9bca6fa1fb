"""``synth reduce``: take adjunct addenda off a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from synth.cli.output import (
    FORCE,
    LOSSY,
    about,
    check_output,
    print_answer,
    print_json,
    tell_lost,
    tell_written,
)
from synth.cli.reading import DRAWN, read

if TYPE_CHECKING:
    from graphs.mechanism.sc import SCGraph
    from graphs.reduce.assur import AssurReduction
    from graphs.reduce.ride_alongs import Reduction

__all__ = ["reduce_command"]


@click.command("reduce", short_help="Remove ride-alongs and adjunct addenda.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("-o", "--output", metavar="OUT", help="Write the reduced mechanism to this file.")
@click.option(
    "--rule",
    type=click.Choice(["ride-along", "dyad", "assur"]),
    default="ride-along",
    show_default=True,
    help="Rule of reduction.",
)
@click.option("--fully", is_flag=True, help="Reduce a block even if no loop of it is left.")
@click.option(
    "--keep",
    multiple=True,
    metavar="LINK",
    help="Link that must not be removed, such as an input link; may be repeated.",
)
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
    print_answer(reduction)
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
