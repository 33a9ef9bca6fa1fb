"""``synth realise``: types given coordinates, as flat sheets or as poses in space."""

from __future__ import annotations

import click

from synth.cli.output import FORCE, about, check_output, plain, print_json
from synth.cli.runner import RunOptions
from synth.cli.things.realise_many import realise_many

__all__ = ["realise"]


@click.command(short_help="Give a type coordinates: a flat sheet of panels, or a pose in space.")
@click.argument("file", metavar="FILE")
@click.option("--as", "kind", type=click.Choice(["sheet", "space"]), default="sheet", show_default=True)
@click.option("--size", type=float, default=1.0, show_default=True, help="Longer side of the box round it.")
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Another drawing for each.")
@click.option("--tries", type=click.IntRange(1, 10_000), default=12, show_default=True, help="Drawings at most.")
@click.option("-o", "--output", metavar="OUT", help="Write the placed panels: .fold, .obj, .svg ...; or a folder.")
@click.option("--workers", type=click.IntRange(min=1), metavar="N", help="Of many types: processes; one a core.")
@click.option("--resume", is_flag=True, help="Of many types: go on with what a stopped run left.")
@click.option("--quiet", is_flag=True, help="Of many types: show no progress.")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def realise(
    file: str,
    kind: str,
    size: float,
    seed: int,
    tries: int,
    output: str | None,
    workers: int | None,
    resume: bool,
    quiet: bool,
    force: bool,
    as_json: bool,
) -> None:
    """Give a type coordinates. FILE is a file, or an id m1:... or k1:...

    Of a store (.sqlite), of rows (.jsonl), of a graph6 file or of a folder every type is realised: OUT is a folder
    of .fold files, with a store of what became of each beside it, or a store alone.

    Panels are convex where they can be, creases round a hole point to their centre, and what is written reads back
    to the same type. Of a graph without a drawing the simplest is taken, which is told. A flat sheet is drawn
    until there is a way to fold it in which every crease turns; its mountains and valleys are those of that way.

    \b
    Examples:
      synth realise m1:a-b.ac-.b-d.cd- -o four-bar.fold
      synth realise data/wiener/six-bar.json --as space -o six-bar.obj
      synth realise types.sqlite --as space -o things
    """
    from synth.drawing.catalogue.entries import is_catalogue

    options = {"kind": kind, "size": size, "seed": seed, "tries": tries}
    if is_catalogue(file):
        running = RunOptions(output, workers, None, resume, quiet, as_json=False, force=force)
        realise_many(file, running, options, as_json=as_json)
        return
    if workers or resume:
        raise click.UsageError("--workers and --resume are for many types: a store, a list or a folder")
    from graphs.files.formats import read, write
    from synth.realisation.realised import realise as realised

    check_output(output, force=force)
    thing = read(file)
    with about(file):
        found = realised(thing, **options)  # type: ignore[arg-type]  # a Choice
    if output is not None:
        write(found.sheet, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **found.to_json()})
        return
    click.echo(str(found))
    if output is not None:
        click.echo(f"written: {plain(output, 4096)}")
