"""``synth generate`` and ``synth realise``: patterns from parameters, types with coordinates."""

from __future__ import annotations

import sys
from functools import partial
from math import ceil, degrees, log10, radians
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from synth.cli.main import NamedGroup
from synth.cli.options import FORCE, LENGTH
from synth.cli.output import (
    about,
    check_output,
    console,
    plain,
    print_answer,
    print_json,
    table,
    tell_lost,
    tell_written,
)
from synth.cli.reading import MODE, read_named
from synth.cli.runner import RunOptions, run_resumable

if TYPE_CHECKING:
    from collections.abc import Callable

    from enumerate.runner.job import Sink
    from graphs.convert.table import Mechanism
    from synth.patterns.generator import Generator, Parameter
    from synth.realisation.on_cone import ConeRealisation
    from synth.realisation.realised import Realisation

__all__ = ["generate", "realise"]


class _Generators(NamedGroup):
    """A command for each generator; the generators are imported when one is looked up."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        from synth.patterns.catalogue import GENERATORS

        return list(GENERATORS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        from synth.patterns.catalogue import GENERATORS

        return _command(GENERATORS[cmd_name]) if cmd_name in GENERATORS else None


@click.group(
    cls=_Generators,
    invoke_without_command=True,
    short_help="Make known patterns and linkages from their parameters.",
)
@click.option("--list", "listed", is_flag=True, help="List all generators with their parameters and sources.")
@click.option("--json", "as_json", is_flag=True, help="Print the list as JSON.")
@click.pass_context
def generate(ctx: click.Context, listed: bool, as_json: bool) -> None:
    """Make a known pattern or linkage: miura, waterbomb, bennett, kaleidocycle, box-pop-up and others.

    Every other command reads the file that a generator writes. Angles are in degrees, lengths in any unit.

    \b
    Examples:
      synth generate --list
      synth generate miura --help
      synth generate miura --rows 4 --columns 5 --fold 60 -o miura.fold
      synth generate kaleidocycle --solids 8 -o ring.json
    """
    if ctx.invoked_subcommand is not None:
        return
    if not listed and not as_json:
        click.echo(ctx.get_help())
        return
    from synth.patterns.catalogue import GENERATORS

    if as_json:
        print_json([_described(generator) for generator in GENERATORS.values()])
        return
    rows = table("name", "what", "parameters", "source")
    for generator in GENERATORS.values():
        names = " ".join(parameter.name for parameter in generator.parameters)
        parameters = f"{names}; {generator.relations}" if generator.relations else names
        rows.add_row(generator.name, generator.title, parameters, generator.source)
    console().print(rows)


def _described(generator: Generator) -> dict[str, Any]:
    return {
        "name": generator.name,
        "title": generator.title,
        "parameters": [
            {
                "name": parameter.name,
                "unit": "degrees" if parameter.unit == "angle" else parameter.unit,
                **{key: _in_degrees(parameter, getattr(parameter, key)) for key in ("default", "least", "most")},
                "meaning": parameter.meaning,
            }
            for parameter in generator.parameters
        ],
        "relations": generator.relations,
        "foldable": generator.foldable,
        "conditions": generator.conditions,
        "source": generator.source,
    }


def _command(generator: Generator) -> click.Command:
    """Return the command of one generator, an option for each of its parameters."""
    options: list[click.Parameter] = [
        click.Option(
            [f"--{parameter.name}"],
            type=int if parameter.unit == "count" else float,
            metavar={"count": "N", "length": "LENGTH", "angle": "DEGREES"}[parameter.unit],
            help=f"{parameter.meaning[0].upper()}{parameter.meaning[1:]}, "
            f"from {parameter.in_words(parameter.least)} to {parameter.in_words(parameter.most)}."
            f"  [default: {parameter.in_words(parameter.default)}]",
        )
        for parameter in generator.parameters
    ]
    if generator.foldable:
        options.append(
            click.Option(
                ["--fold"],
                type=float,
                metavar="DEGREES",
                help="Fold the crease that moves most to this angle; equivalent creases fold alike if they can.",
            )
        )
    written = ".fold, .obj or another format" if generator.foldable else ".json, or .fold if it has panels"
    options.append(click.Option(["-o", "--output"], metavar="OUT", help=f"File to write: {written}."))
    options.append(click.Option(["--json", "as_json"], is_flag=True, help="Print the answer as JSON."))

    def run(fold: float | None = None, output: str | None = None, **options: Any) -> None:
        _run(generator, fold, output, **options)

    relations = f" Limits on parameters: {generator.relations}." if generator.relations else ""
    text = (
        f"{generator.title}.\n\n"
        f"Condition for its degrees of freedom: {generator.conditions}.{relations} Source: {generator.source}."
    )
    return FORCE(
        click.Command(generator.name, params=options, callback=run, help=text, short_help=f"{generator.title}.")
    )


def _run(
    generator: Generator,
    fold: float | None,
    output: str | None,
    *,
    force: bool,
    as_json: bool,
    **parameters: float | None,
) -> None:
    from graphs.files.formats import write
    from synth.patterns.generated import generate as generate_by_name

    check_output(output, force=force)
    angles = {parameter.name for parameter in generator.parameters if parameter.unit == "angle"}
    values = {
        name: radians(value) if name in angles else value
        for name, value in parameters.items()
        if value is not None
    }
    with about(generator.name):
        generated = generate_by_name(generator.name, fold=None if fold is None else radians(fold), **values)
    lost = () if output is None else write(generated.mechanism, output, force=force)
    if as_json:
        print_json({**generated.to_json(), "output": output})
        return
    click.echo(str(generated))
    tell_lost(lost)
    tell_written(output)


def _in_degrees(parameter: Parameter, value: float) -> float:
    """Return a value of a parameter, an angle in degrees."""
    return round(degrees(value), 9) if parameter.unit == "angle" else value


_FIGURES = 12
"""Decimals of coordinates, in units of the size: later ones differ among processors."""


@click.command(short_help="Give a type coordinates: as a flat sheet, as panels in space, or on a cone.")
@click.argument("file", metavar="FILE")
@click.option(
    "--as", "kind", type=click.Choice(["sheet", "space", "cone"]), default="sheet", show_default=True,
    help="Kind of realisation.",
)  # fmt: skip
@click.option(
    "--size", type=LENGTH, help="Longer side of the bounding box of the panels, in any unit.  [default: 1]"
)
@click.option(
    "--lambda", "cone_angle", type=float, metavar="DEGREES",
    help="For --as cone: cone angle, from the plane across its axis.  [default: 30]",
)  # fmt: skip
@click.option(
    "--seed", type=click.IntRange(min=0), metavar="N", default=0, show_default=True,
    help="Random seed; another seed gives other coordinates.",
)  # fmt: skip
@click.option(
    "--tries", type=click.IntRange(1, 10_000), metavar="N", default=12, show_default=True,
    help="Largest number of drawings to try.",
)  # fmt: skip
@click.option(
    "--flat-foldable", is_flag=True,
    help="For a sheet: make it flat-foldable; alternate sector angles round each vertex sum to 180 degrees.",
)  # fmt: skip
@click.option("--symmetric", is_flag=True, help="For a sheet: draw it with symmetries of the type.")
@MODE
@click.option(
    "--freedoms", type=click.IntRange(min=1), metavar="K",
    help="Find a realisation of special geometry with K degrees of freedom, where a generic one has fewer.",
)  # fmt: skip
@click.option("--geometry", metavar="TEXT", help="With --freedoms: try only families with TEXT in their name.")
@click.option("--every", is_flag=True, help="With --freedoms: try every family, not only until one moves.")
@click.option("--some-joints", is_flag=True, help="With --freedoms: joints may stay immobile.")
@click.option("--mark", metavar="OUT.json", help="With --freedoms: write the type with a mark of what was found.")
@click.option(
    "-o", "--output", metavar="OUT",
    help="Write the realisation: .fold, .obj or .svg; .json on a cone; a folder or .sqlite for many types.",
)  # fmt: skip
@click.option(
    "--workers", type=click.IntRange(min=1), metavar="N",
    help="For many types: number of processes. By default one per core.",
)  # fmt: skip
@click.option("--resume", is_flag=True, help="For many types: continue a run that was stopped.")
@click.option("--quiet", is_flag=True, help="For many types: show no progress.")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def realise(
    file: str,
    kind: str,
    size: float | None,
    cone_angle: float | None,
    seed: int,
    tries: int,
    flat_foldable: bool,
    symmetric: bool,
    mode: str | None,
    freedoms: int | None,
    geometry: str | None,
    every: bool,
    some_joints: bool,
    mark: str | None,
    output: str | None,
    workers: int | None,
    resume: bool,
    quiet: bool,
    force: bool,
    as_json: bool,
) -> None:
    """Give a type coordinates. FILE is a file, an id m1:... or k1:..., or an R/- string.

    For a store or an atlas (.sqlite), rows (.jsonl), a graph6 file or a folder, every type is realised: OUT is a
    folder of .fold files, with a store of the result for each type beside it, or a store alone.

    Panels are convex where they can be, creases round a hole point to their centre, and the output reads back as
    the same type. For a graph without a drawing the simplest drawing is taken, and a note says so; a string
    becomes a strip of panels, rectangles between parallel creases. A flat sheet is drawn again until it has a
    folding branch on which every crease turns; its mountains and valleys are those of that branch. It can be made
    flat-foldable and symmetric.

    With --freedoms the type is searched for members that move although counts say they are rigid: flat sheets with
    flat-foldable vertices whose ratios agree, straight lines, parallel creases or symmetries; axes in space that
    are symmetric, parallel or meet in groups, equal links, poses along a motion that close (--as space: axes
    alone). Each is followed by a finite motion in which all joints move. The answer lists what was tried, found or
    not; the first member is written, a sheet as .fold, axes as .json. Exit status 1: none was found.

    A type with one centre can lie on a cone, with all its axes on ruling lines; the output is a file for `synth
    cone`.

    \b
    Examples:
      synth realise m1:a-b.ac-.b-d.cd- -o four-bar.fold
      synth realise RR-R-RRR --mode D -o ups.fold
      synth realise data/wiener/six-bar.json --as space -o six-bar.obj
      synth realise data/wiener/stephenson.json --as cone --lambda 25 -o stephenson.json
      synth realise types.sqlite --as space -o things
      synth realise k1:Cr --freedoms 1 --as space
      synth realise data/linkages/bennett.json --freedoms 1 -o bennett.json --mark type.json
    """
    from graphs.errors import FileError
    from graphs.files.formats import write
    from synth.drawing.catalogue import is_catalogue

    if freedoms is not None:
        others = kind == "cone" or size is not None or flat_foldable or symmetric or mode or workers or resume
        _refuse((others, "--freedoms goes with --as sheet|space, --seed and --tries only, for one type"))
        search = {"kind": kind, "seed": seed, "tries": tries, "freedoms": freedoms, "geometry": geometry or ""}
        search |= {"every": every, "all_joints": not some_joints}
        _search_special_geometry(file, search, output, mark, force=force, as_json=as_json)
        return
    many, on_cone = is_catalogue(file), kind == "cone"
    _refuse(
        (
            geometry is not None or every or some_joints or mark is not None,
            "--geometry, --every, --some-joints and --mark require --freedoms",
        ),
        (on_cone and size is not None, "--size is for panels: a linkage on a cone has angles only"),
        (not on_cone and cone_angle is not None, "--lambda requires --as cone"),
        (kind != "sheet" and (flat_foldable or symmetric), "--flat-foldable and --symmetric require --as sheet"),
        (
            mode and (on_cone or many),
            "--mode requires one R/- string as panels; rows of a list have modes of their own",
        ),
        (many and on_cone, "--as cone requires one type, not a store, a list or a folder"),
        (
            not many and (workers or resume),
            "--workers and --resume require many types: a store, a list or a folder",
        ),
    )
    options = {"kind": kind, "size": 1.0 if size is None else size, "seed": seed, "tries": tries}
    options |= {"flat_foldable": True} if flat_foldable else {}
    options |= {"symmetric": True} if symmetric else {}
    if many:
        running = RunOptions(output, workers, None, resume, quiet, as_json=False, force=force)
        _realise_many(file, running, options, as_json=as_json)
        return
    check_output(output, force=force)
    if on_cone and output is not None and not output.lower().endswith(".json"):
        raise FileError(output, "", "a linkage on a cone cannot be written to it", "a name that ends in .json")
    with about(file):
        if on_cone:
            realisation, mechanism = _on_cone(file, cone_angle, seed, tries)
        else:
            realisation, mechanism = _as_panels(file, mode, options)
    if output is not None:
        write(mechanism, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **realisation.to_json()})
        return
    print_answer(realisation)
    tell_written(output)


def _refuse(*rules: tuple[object, str]) -> None:
    """Raise click.UsageError with the message of the first rule whose condition holds."""
    for broken, message in rules:
        if broken:
            raise click.UsageError(message)


def _on_cone(
    file: str, cone_angle: float | None, seed: int, tries: int
) -> tuple[ConeRealisation | Realisation, Mechanism]:
    from enumerate.strings.panel_strings import ChainString
    from graphs.errors import FileError
    from synth.realisation.on_cone import CONE_ANGLE, realise_on_cone

    mechanism: Any = read_named(file).mechanism
    if isinstance(mechanism, ChainString):
        raise FileError(file, "", "an R/- string has no loop", "a linkage whose axes meet in one centre")
    angle = CONE_ANGLE if cone_angle is None else radians(cone_angle)
    realisation = realise_on_cone(mechanism, cone_angle=angle, seed=seed, tries=tries)
    return realisation, realisation.linkage


def _as_panels(
    file: str, mode: str | None, options: dict[str, Any]
) -> tuple[ConeRealisation | Realisation, Mechanism]:
    from synth.patterns.panels import rounded
    from synth.realisation.realised import realise as realised

    mechanism: Any = read_named(file).mechanism
    panels = realised(mechanism, mode=mode, **options)
    return panels, rounded(panels.sheet, _FIGURES - ceil(log10(options["size"])))


def _realise_many(source: str, running: RunOptions, options: dict[str, Any], *, as_json: bool) -> None:
    """Realise the types of a store, a list or a folder, and print the results.

    The output of `running` is a folder, or a store (.sqlite), which holds the files in its rows; the options are
    those of `synth.realisation.realise`.
    """
    from enumerate.runner.job import row_as_dict
    from enumerate.runner.store import read_rows
    from graphs.errors import numbered
    from synth.realisation.many import COLUMNS, RealisationJob, summary_of

    job = RealisationJob(source, tuple(sorted(options.items())))
    sink, store = _sink_of(running)
    run_resumable(job, sink, running)
    summary = summary_of(row_as_dict(COLUMNS, row) for row in read_rows(store))
    if as_json:
        print_json({"file": source, "output": running.output, "left_out": job.failures, **summary})
        return
    for row in summary["types"]:
        if row["outcome"] != "realised":
            click.echo(f"{row['number']}  {plain(row['name'])}: {plain(row['reason'], 4096)}")
    for failure in job.failures:
        click.echo(f"left out: {plain(failure, 4096)}", err=True)
    counts = "{realised} realised, {not_found} not found, {refused} refused".format(**summary)
    click.echo(f"{numbered(len(summary['types']), 'type')}: {counts}")
    tell_written(*dict.fromkeys((str(running.output), str(store))))


def _sink_of(running: RunOptions) -> tuple[Callable[..., Sink], Path]:
    """Return a function that makes the sink, and the path of the store."""
    from enumerate.runner.store import SqliteSink
    from synth.realisation.many import RealisationFolder, store_beside

    if running.output is None:
        raise click.UsageError("many types require -o FOLDER or -o FILE.sqlite")
    place = Path(running.output)
    if place.suffix.lower() == ".sqlite":
        return partial(SqliteSink, place, resume=running.resume, force=running.force), place
    if place.suffix:
        raise click.UsageError("many types are written to a folder or a store; try -o FOLDER or -o FILE.sqlite")
    if running.force:
        raise click.UsageError("--force replaces no folder; remove it, or try --resume or another name")
    return partial(RealisationFolder, place, resume=running.resume), store_beside(place)


def _search_special_geometry(
    file: str, search: dict[str, Any], output: str | None, mark: str | None, *, force: bool, as_json: bool
) -> None:
    """Search for members of a type that move, print and write them; exit status 1 if none was found.

    The search has the options of `synth.realise`.
    """
    from graphs.files.formats import write
    from synth.drawing.catalogue import is_catalogue
    from synth.realisation.realised import realise as realised

    if is_catalogue(file):
        raise click.UsageError("--freedoms requires one type, not a store, a list or a folder")
    for path in (output, mark):
        check_output(path, force=force)
    with about(file):
        mechanism: Any = read_named(file).mechanism
        answer = realised(mechanism, **search)
    if not answer.members:
        output = mark = None
    if output is not None:
        write(answer.members[0].mechanism, output, force=force)
    if mark is not None:
        write(answer.type_with_mark, mark, force=force)
    if as_json:
        print_json({"file": file, "output": output, **answer.to_json()})
    else:
        print_answer(answer)
        tell_written(output, mark)
    if not answer.members:
        sys.exit(1)
