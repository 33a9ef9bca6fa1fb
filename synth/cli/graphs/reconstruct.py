"""``synth reconstruct``: the polyhedron model of an SCD graph, vertex by vertex."""

from __future__ import annotations

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

__all__ = ["reconstruct"]


@click.command(short_help="Reconstruct the polyhedron model, vertex by vertex.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("-o", "--output", metavar="OUT", help="Write the model to this file (.json or .fold).")
@FORCE
@LOSSY
@click.option("--json", "as_json", is_flag=True, help="Print the vertices and the counts as JSON.")
def reconstruct(file: str, output: str | None, force: bool, lossy: bool, as_json: bool) -> None:
    """Reconstruct the polyhedron model of a mechanism, vertex by vertex.

    FILE holds an SCD graph, or a crease pattern without flat edges, cuts and split hinges (.fold). The table lists
    the links that meet in each vertex, and the kind of face of the graph in which it lies.

    \b
    Example:
      synth reconstruct data/wiener/six-bar.json -o model.json
    """
    from graphs.answer.reconstruction import reconstruct as reconstructed
    from graphs.files.formats import write

    check_output(output, force=force)
    thing = read(file)
    with about(file):
        reconstruction = reconstructed(thing)
        lost = () if output is None else write(reconstruction.model, output, force=force, lossy=lossy)
    if as_json:
        print_json({"file": file, "output": output, "lost": list(lost), **reconstruction.to_json()})
        return
    print_answer(reconstruction)
    if output is not None:
        tell_written(output)
        tell_lost(lost)
