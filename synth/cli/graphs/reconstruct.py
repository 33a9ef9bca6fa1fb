"""``synth reconstruct``: the polyhedron model of an SCD graph, vertex by vertex."""

from __future__ import annotations

import click

from synth.cli.output import about, console, plain, print_json, table

__all__ = ["reconstruct"]


@click.command(short_help="Reconstruct the polyhedron model, vertex by vertex.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", metavar="OUT", help="Write the model here (.json or .fold).")
@click.option("--json", "as_json", is_flag=True, help="Print the vertices and the counts as JSON.")
def reconstruct(file: str, output: str | None, as_json: bool) -> None:
    """Reconstruct the polyhedron model of a mechanism, vertex by vertex.

    FILE holds an SCD graph, or a crease pattern of plain panels (.fold). The table says which links meet in
    each vertex and in what kind of face of the graph it lies.

    \b
    Example:
      synth reconstruct data/wiener/six-bar.json -o model.json
    """
    from graphs.convert.reconstruction import vertex_steps
    from graphs.convert.table import to_polyhedron, to_scd
    from graphs.count.equations import mobility_of_model
    from graphs.files.formats import read, write

    thing = read(file)
    with about(file):
        scd = to_scd(thing)
        model = to_polyhedron(thing)
    if output is not None:
        write(model, output)
    steps = list(vertex_steps(scd))
    counts = scd.counts
    if as_json:
        print_json(
            {
                "file": file,
                "output": output,
                "vertices": [
                    {"vertex": s.vertex, "in": s.kind.value, "links": [str(link) for link in s.links]}
                    for s in steps
                ],
                "counts": {
                    "vertices": counts.vertices,
                    "implicit_centres": counts.implicit_centres,
                    "external_edges": counts.external_edges,
                    "internal_edges": counts.internal_edges,
                },
                "mobility": mobility_of_model(model),
            }
        )
        return
    rows = table("vertex", "lies in", "links that meet there", numbers=["vertex"])
    for step in steps:
        place = "explicit centre" if step.kind.value == "explicit" else f"{step.kind.value} face"
        rows.add_row(str(step.vertex), place, ", ".join(plain(link) for link in step.links))
    out = console()
    out.print(rows)
    out.print(
        f"V = {counts.vertices}, C = {counts.implicit_centres}, E = {counts.external_edges} external "
        f"+ {counts.internal_edges} internal, M = {mobility_of_model(model)}"
    )
    if output is not None:
        out.print(f"written: {plain(output, 4096)}")
