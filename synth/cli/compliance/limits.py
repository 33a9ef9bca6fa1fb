"""``synth limits``: where ride-alongs go straight, and what remains then."""

from __future__ import annotations

import click

from synth.cli.output import about, print_json

__all__ = ["limits"]


@click.command(short_help="Tell where ride-alongs go straight: the angles they leave, the truss that remains.")
@click.argument("file", metavar="FILE")
@click.option("--keep", multiple=True, metavar="LINK", help="A link of the mechanism proper; may be repeated.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def limits(file: str, keep: tuple[str, ...], as_json: bool) -> None:
    """Tell what range of angles each ride-along leaves to the joint it sits on, and what moves with it rigid.

    At the pose of the file. A ride-along stops the joint where its two links are in line: stretched, one beyond
    the other, or folded, one on the other. Angles are those of synth fold.

    \b
    Examples:
      synth generate deployable-cylinder --pleats 3 -o cylinder.fold
      synth limits cylinder.fold
    """
    from graphs.edit.named import link_named
    from graphs.files.formats import read
    from synth.compliance.limited import limits as found_limits
    from synth.moving.made import configuration_of

    thing = read(file)
    with about(file):
        graph = configuration_of(thing).linkage.graph
        found = found_limits(thing, [link_named(graph, name) for name in keep])
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
