"""``synth limits``: where ride-alongs go straight, and what remains then."""

from __future__ import annotations

import click

from synth.cli.output import about, print_json
from synth.cli.precision import PRECISION, precise
from synth.cli.reading import DRAWN, read

__all__ = ["limits"]


@click.command(short_help="Find the joint limits that ride-alongs impose, and the truss they form when held.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--keep",
    multiple=True,
    metavar="LINK",
    help="Link that belongs to the mechanism proper, not to a ride-along; may be repeated.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def limits(file: str, keep: tuple[str, ...], as_json: bool) -> None:
    """Find the joint limits that ride-alongs impose, and the mobility while one is held straight.

    The analysis starts at the configuration of the file. A ride-along stops its joint where its own two links are
    in line: stretched, one beyond the other, or folded, one on the other. Angles are those of `synth fold`, in
    degrees.

    \b
    Examples:
      synth generate deployable-cylinder --pleats 3 -o cylinder.fold
      synth limits cylinder.fold
    """
    from graphs.edit.named import link_named
    from synth.compliance.joint_limits import limits as found_limits
    from synth.moving.made import configuration_of

    thing = read(file)
    with about(file):
        thing = precise(thing)
        graph = configuration_of(thing).linkage.graph
        found = found_limits(thing, [link_named(graph, name) for name in keep])
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
