"""``synth convert``: from one kind of file to another."""

from __future__ import annotations

import click

from synth.cli.output import about, plain, print_json

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
@click.option("--json", "as_json", is_flag=True, help="Print what was done as JSON.")
def convert(source: str, target: str, kind: str | None, form: str | None, as_json: bool) -> None:
    """Convert a mechanism from one kind of file to another; the extensions name the formats.

    \b
    Read and written: .json (native), .fold, .g6 and .s6 (nauty), .graphml, .edges

    \b
    Examples:
      synth convert crease-pattern.fold mechanism.json
      synth convert crease-pattern.fold model.json --to polyhedron
      synth convert watt.json planar-watt.json --form planar
    """
    from graphs.convert.by_name import convert as converted
    from graphs.files.formats import read, write

    mechanism = read(source)
    with about(source):
        mechanism = converted(mechanism, kind, form=form)
        lost = write(mechanism, target)
    if as_json:
        print_json({"input": source, "output": target, "kind": type(mechanism).__name__, "lost": list(lost)})
        return
    click.echo(f"{plain(target, 4096)}: from {type(mechanism).__name__}")
    if lost:
        click.echo("not stored: " + ", ".join(lost))
