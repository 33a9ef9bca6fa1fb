"""``synth generate`` and ``synth realise``: patterns from parameters, types with coordinates."""

from __future__ import annotations

import sys
from difflib import get_close_matches
from functools import partial
from math import ceil, degrees, log10, radians
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import synth.catalogue.patterns
from graphs.errors import FileError, numbered
from graphs.printing import plain
from synth.cli import options, output as out
from synth.cli.main import NamedGroup
from synth.cli.reading import MODE, read_named
from synth.cli.runner import RunOptions, run_resumable

if TYPE_CHECKING:
    from collections.abc import Callable

    from enumerate.runner import Sink
    from synth.catalogue.realisation import ConeRealisation


class _Generators(NamedGroup):
    """A command for each generator; the generators are imported when one is looked up."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(synth.catalogue.patterns.GENERATORS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        generator = synth.catalogue.patterns.GENERATORS.get(cmd_name)
        return None if generator is None else _command(generator)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the generator of the first word; name them all if there is none of that name, nor one near it."""
        names = self.list_commands(ctx)
        unknown = not args[0].startswith("-") and args[0] not in names
        if unknown and not ctx.resilient_parsing and not get_close_matches(args[0], names, 1):
            ctx.fail(f"There is no generator {plain(args[0])!r}; expected one of {', '.join(names)}")
        return super().resolve_command(ctx, args)


@click.group(cls=_Generators, invoke_without_command=True)
@options.flag("--list listed", "List all generators with their parameters and sources.")
@options.flag("--json as_json", "Print the list as JSON.")
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
    generators = synth.catalogue.patterns.GENERATORS.values()
    if as_json:
        out.print_json([_described(generator) for generator in generators])
        return
    rows = out.table("name", "what", "parameters", "source")
    for generator in generators:
        names = " ".join(parameter.name for parameter in generator.parameters)
        parameters = f"{names}; {generator.relations}" if generator.relations else names
        rows.add_row(generator.name, generator.title, parameters, generator.source)
    out.console().print(rows)


def _described(generator: synth.catalogue.patterns.Generator) -> dict[str, Any]:
    return {
        "name": generator.name,
        "title": generator.title,
        "parameters": [
            {
                "name": parameter.name,
                "unit": "degrees" if parameter.unit == "angle" else parameter.unit,
                **{
                    key: round(degrees(bound), 9) if parameter.unit == "angle" else bound
                    for key in ("default", "least", "most")
                    for bound in [getattr(parameter, key)]
                },
                "meaning": parameter.meaning,
            }
            for parameter in generator.parameters
        ],
        "relations": generator.relations,
        "foldable": generator.foldable,
        "conditions": generator.conditions,
        "source": generator.source,
    }


def _command(generator: synth.catalogue.patterns.Generator) -> click.Command:
    """Return the command of one generator, an option for each of its parameters."""

    def run(
        fold: float | None = None, *, output: str | None, force: bool, as_json: bool, **parameters: float | None
    ) -> None:
        out.check_output(output, force=force)
        values = {
            name: radians(value) if units[name] == "angle" else value
            for name, value in parameters.items()
            if value is not None
        }
        with out.about(generator.name):
            generated = synth.generate(generator.name, fold=None if fold is None else radians(fold), **values)
        lost = () if output is None else synth.write(generated.mechanism, output, force=force)
        if as_json:
            out.print_json({**generated.to_json(), "output": output})
            return
        click.echo(str(generated))
        out.tell_lost(lost)
        out.tell_written(output)

    units = {parameter.name: parameter.unit for parameter in generator.parameters}
    relations = f" Limits on parameters: {generator.relations}." if generator.relations else ""
    text = (
        f"{generator.title}.\n\n"
        f"Condition for its degrees of freedom: {generator.conditions}.{relations} Source: {generator.source}."
    )
    command = click.Command(generator.name, callback=run, help=text, short_help=f"{generator.title}.")
    for parameter in generator.parameters:
        metavar = {"count": "N", "length": "LENGTH", "angle": "DEGREES"}[parameter.unit]
        meaning = (
            f"{parameter.meaning[0].upper()}{parameter.meaning[1:]}, {parameter.limits}.  "
            f"[default: {parameter.in_words(parameter.default)}]"
        )
        kind = int if parameter.unit == "count" else float
        options.value(f"--{parameter.name}", metavar, meaning, type=kind)(command)
    written = ".json, or .fold if the mechanism has panels"
    if generator.foldable:
        written = ".fold, .obj or another format"
        meaning = "Fold the crease that moves most to this angle; equivalent creases fold alike if they can."
        options.value("--fold", "DEGREES", meaning, type=float)(command)
    for option in (options.output(f"File to write: {written}."), options.JSON, options.FORCE):
        option(command)
    return command


_FIGURES = 12
"""Decimals of coordinates, in units of the size: later ones differ among processors."""


@click.command()
@options.FILE
@options.choice("--as kind", ("sheet", "space", "cone"), "Kind of realisation.", default="sheet")
@options.number("--row", "K", "With --as cone: number of the row, from 1, of a list of conical candidates or types.")
@options.value(
    "--size", None, "Longer side of the bounding box of the panels, in any unit.  [default: 1]",
    type=options.LENGTH,
)  # fmt: skip
@options.cone_angle("For --as cone: cone angle, from the plane across its axis.  [default: 30]")
@options.seed("Random seed; another seed gives other coordinates.")
@options.number("--tries", "N", "Largest number of drawings to try.", most=10_000, default=12)
@options.flag(
    "--flat-foldable",
    "For a sheet: make it flat-foldable; alternate sector angles round each vertex sum to 180 degrees.",
)  # fmt: skip
@options.flag("--symmetric", "For a sheet: draw it with symmetries of the type.")
@MODE
@options.number(
    "--freedoms", "K",
    "Find a realisation of special geometry with K degrees of freedom, where a generic one has fewer.",
)  # fmt: skip
@options.value("--geometry", "TEXT", "With --freedoms: try only families with TEXT in their name.")
@options.flag("--every", "With --freedoms: try every family, not only until one moves.")
@options.flag("--some-joints", "With --freedoms: allow joints to stay immobile.")
@options.output("With --freedoms: write the type, marked with the geometry that was found.", "OUT.json", "--mark")
@options.output("Write the realisation: .fold, .obj or .svg; .json on a cone; a folder or .sqlite for many types.")
@options.number("--workers", "N", "For many types: number of processes. By default one per core.")
@options.flag("--resume", "For many types: continue a run that was stopped.")
@options.flag("--quiet", "For many types: show no progress.")
@options.FORCE
@options.JSON
def realise(
    file: str, kind: str, row: int | None, size: float | None, cone_angle: float | None, seed: int, tries: int,
    flat_foldable: bool, symmetric: bool, mode: str | None, freedoms: int | None, geometry: str | None, every: bool,
    some_joints: bool, mark: str | None, output: str | None, workers: int | None, resume: bool, quiet: bool,
    force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Give a type coordinates. FILE is a file, an id m1:... or k1:..., or an R/- string.

    For a store or an atlas (.sqlite), rows (.jsonl), a graph6 file or a folder, every type is realised: OUT is a
    folder of .fold files, with a store of the result for each type beside it, or a store alone.

    Panels are convex where they can be, creases round a hole point to their centre, and the output reads back as
    the same type. For a graph without a drawing the simplest drawing is taken, and a note says so; a string
    becomes a strip of panels, rectangles between parallel creases. A flat sheet is drawn again until it has a
    folding branch on which every crease turns; its mountains and valleys are those of that branch. It can be made
    flat-foldable and symmetric.

    With --freedoms, search for realisations of the type that move although counts say it is rigid: flat sheets
    with flat-foldable vertices whose ratios agree, straight lines, parallel creases or symmetries; axes in space
    that are symmetric, parallel or meet in groups, equal links, poses along a motion that close (--as space: axes
    alone). A finite motion in which all joints move confirms each of them. The answer lists all families that were
    tried; the first realisation that moves is written, a sheet as .fold, axes as .json. Exit status 1: none moves.

    A type with one centre can lie on a cone, with all its axes on ruling lines; the output is a file for `synth
    cone`. A row of conical candidates (`synth enumerate conical -o FILE.jsonl`) is laid in its own order of joints.

    \b
    Examples:
      synth realise m1:a-b.ac-.b-d.cd- -o four-bar.fold
      synth realise RR-R-RRR --mode D -o ups.fold
      synth realise data/wiener/six-bar.json --as space -o six-bar.obj
      synth realise data/wiener/stephenson.json --as cone --lambda 25 -o stephenson.json
      synth realise watt.jsonl --row 3 --as cone -o watt.json
      synth realise types.sqlite --as space -o realised
      synth realise data/wiener/six-bar-loop-spatial.json --freedoms 1 --as space
      synth realise data/linkages/bennett.json --freedoms 1 -o bennett.json --mark type.json
    """
    from synth.making.drawing.list_pages import is_catalogue

    if freedoms is not None:
        others = kind == "cone" or size is not None or flat_foldable or symmetric or mode or workers or resume
        _refuse((others, "--freedoms goes with --as sheet|space, --seed and --tries only, for one type"))
        search = {"kind": kind, "seed": seed, "tries": tries, "freedoms": freedoms, "geometry": geometry or ""}
        search |= {"every": every, "all_joints": not some_joints}
        _search_special_geometry(file, search, output, mark, force=force, as_json=as_json)
        return
    many, on_cone = is_catalogue(file), kind == "cone"
    _refuse(
        (geometry is not None or every or some_joints or mark is not None,
         "--geometry, --every, --some-joints and --mark require --freedoms"),
        (on_cone and size is not None, "--size is for panels: a linkage on a cone has angles only"),
        (not on_cone and cone_angle is not None, "--lambda requires --as cone"),
        (kind != "sheet" and (flat_foldable or symmetric), "--flat-foldable and --symmetric require --as sheet"),
        (mode and (on_cone or many),
         "--mode requires one R/- string as panels; rows of a list have modes of their own"),
        (many and on_cone and row is None,
         "--as cone requires one type: --row K, the number of a row, of a store, a list or a folder"),
        (row is not None and not (many and on_cone), "--row requires --as cone and a store, a list or a folder"),
        (not many and (workers or resume),
         "--workers and --resume require many types: a store, a list or a folder"),
    )  # fmt: skip
    settings: dict[str, Any] = {"kind": kind, "size": 1.0 if size is None else size, "seed": seed, "tries": tries}
    settings |= {"flat_foldable": True} if flat_foldable else {}
    settings |= {"symmetric": True} if symmetric else {}
    if many and not on_cone:
        running = RunOptions(output, workers, resume=resume, quiet=quiet, force=force)
        _realise_many(file, running, settings, as_json=as_json)
        return
    out.check_output(output, force=force)
    if on_cone and output is not None and not output.lower().endswith(".json"):
        raise FileError(output, "", "a linkage on a cone cannot be written to it", "a name that ends in .json")
    with out.about(file):
        source: Any = read_named(file, row).mechanism
        if on_cone:
            realisation: Any = _on_cone(file, source, cone_angle, seed, tries)
            mechanism = realisation.linkage
        else:
            from synth.catalogue.patterns.panels import rounded

            realisation = synth.realise(source, mode=mode, **settings)
            mechanism = rounded(realisation.sheet, _FIGURES - ceil(log10(settings["size"])))
    if output is not None:
        synth.write(mechanism, output, force=force)
    out.print_result(realisation, {"file": file, "output": output}, as_json=as_json, written=[output])
    if on_cone and output is not None and not as_json:
        click.echo(f"next: synth cone move {out.plain(output, 4096)}; synth view {out.plain(output, 4096)}")


def _refuse(*rules: tuple[object, str]) -> None:
    """Raise click.UsageError with the message of the first rule whose condition holds."""
    for broken, message in rules:
        if broken:
            raise click.UsageError(message)


def _on_cone(file: str, source: Any, cone_angle: float | None, seed: int, tries: int) -> ConeRealisation:
    from enumerate.strings import ChainString
    from synth.catalogue.realisation.on_cone import realise_candidate
    from synth.linkages.conformed.orders import OrderOnCircle

    angle = {} if cone_angle is None else {"cone_angle": radians(cone_angle)}
    if isinstance(source, OrderOnCircle):
        return realise_candidate(source.chain, source.azimuths, **angle, seed=seed, tries=tries)
    if isinstance(source, ChainString):
        raise FileError(file, "", "an R/- string has no loop", "a linkage whose axes meet in one centre")
    return synth.realise_on_cone(source, **angle, seed=seed, tries=tries)


def _realise_many(source: str, running: RunOptions, settings: dict[str, Any], *, as_json: bool) -> None:
    """Realise the types of a store, a list or a folder, and print the results.

    The output of `running` is a folder, or a store (.sqlite), which holds the files in its rows; the settings are
    the parameters of `synth.catalogue.realisation.realise`.
    """
    from enumerate.runner import read_rows
    from enumerate.runner.job import row_as_dict
    from synth.synthesis.atlas.realisation_job import COLUMNS, RealisationJob, summary_of

    job = RealisationJob(source, tuple(sorted(settings.items())))
    sink, store = _sink_of(running)
    run_resumable(job, sink, running)
    summary = summary_of(row_as_dict(COLUMNS, row) for row in read_rows(store))
    if as_json:
        out.print_json({"file": source, "output": running.output, "left_out": job.failures, **summary})
        return
    for row in summary["types"]:
        if row["outcome"] != "realised":
            click.echo(f"{row['number']}  {out.plain(row['name'])}: {out.plain(row['reason'], 4096)}")
    for failure in job.failures:
        click.echo(f"left out: {out.plain(failure, 4096)}", err=True)
    counts = "{realised} realised, {not_found} not found, {refused} refused".format(**summary)
    click.echo(f"{numbered(len(summary['types']), 'type')}: {counts}")
    out.tell_written(*dict.fromkeys((str(running.output), str(store))))


def _sink_of(running: RunOptions) -> tuple[Callable[..., Sink], Path]:
    """Return a function that makes the sink, and the path of the store."""
    from enumerate.runner import SqliteSink
    from synth.synthesis.atlas.realisation_job import RealisationFolder, store_beside

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
    from synth.making.drawing.list_pages import is_catalogue

    if is_catalogue(file):
        raise click.UsageError("--freedoms requires one type, not a store, a list or a folder")
    for path in (output, mark):
        out.check_output(path, force=force)
    with out.about(file):
        mechanism: Any = read_named(file).mechanism
        answer = synth.realise(mechanism, **search)
    if not answer.members:
        output = mark = None
    if output is not None:
        synth.write(answer.members[0].mechanism, output, force=force)
    if mark is not None:
        synth.write(answer.type_with_mark, mark, force=force)
    out.print_result(answer, {"file": file, "output": output}, as_json=as_json, written=[output, mark])
    if not answer.members:
        sys.exit(1)
