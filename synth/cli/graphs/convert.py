"""``synth convert``: from one kind of file to another."""

from __future__ import annotations

import click

from synth.cli.output import FORCE, LOSSY, about, check_output, plain, print_json, tell_lost

__all__ = ["convert"]


@click.command(short_help="Convert between kinds of files; change centres.")
@click.argument("source", metavar="IN")
@click.argument("target", metavar="OUT")
@click.option(
    "--to",
    "kind",
    type=click.Choice(["sc", "scd", "polyhedron", "vertex-edge", "sheet"]),
    help="What to make of it first; by default what the file holds.",
)
@click.option(
    "--form",
    type=click.Choice(["planar", "spherical", "general"]),
    help="Change the centres: planar analogue, spherical analogue, or most general form.",
)
@FORCE
@LOSSY
@click.option("--json", "as_json", is_flag=True, help="Print what was done as JSON.")
def convert(
    source: str, target: str, kind: str | None, form: str | None, force: bool, lossy: bool, as_json: bool
) -> None:
    """Convert a mechanism from one kind of file to another; the extensions name the formats.

    \b
    Read and written:
      .json                native: SC and SCD graphs, models, vertex-edge graphs, linkages on cones
      .fold .svg .cp .obj  crease patterns
      .dxf                 crease patterns (R12 written)
      .g6 .s6              graph6 and sparse6 (nauty): bare link-joint graphs
      .graphml             bare link-joint graphs
      .edges .txt          bare link-joint graphs, a joint a line
    Read:
      .opx                 crease patterns (ORIPA)
      .csv                 bare link-joint graphs, a table of edges

    What OUT cannot hold is told by kind and number. If its type would be another (links, joints or centres of what
    is read back do not correspond), nothing is written, unless with --lossy.

    \b
    Examples:
      synth convert crease-pattern.fold mechanism.json
      synth convert crease-pattern.fold model.json --to polyhedron
      synth convert watt.json planar-watt.json --form planar
    """
    from graphs.convert.by_name import convert as converted
    from graphs.files.formats import read, write

    check_output(target, force=force)
    given = read(source)
    with about(source):
        mechanism = converted(given, kind, form=form)
        made_of = given if kind == "sheet" and form is None else None  # a sheet holds less than others
        lost = write(mechanism, target, lossy=lossy, force=force, made_of=made_of)
    if as_json:
        print_json({"input": source, "output": target, "kind": type(mechanism).__name__, "lost": list(lost)})
        return
    click.echo(f"{plain(target, 4096)}: from {type(mechanism).__name__}")
    tell_lost(lost)
