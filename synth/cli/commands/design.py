"""``synth design``: dimensions of a mechanism from wishes about its motion."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import synth.synthesis.designing
from graphs.errors import FileError
from synth.cli import options
from synth.cli.output import about, check_output, print_json, print_result, progress_line, tell_written
from synth.cli.runner import RunOptions, run_resumable

if TYPE_CHECKING:
    from synth.synthesis.designing import Design, Designs
    from synth.synthesis.designing.job import DesignJob


@click.command()
@click.argument("mechanism", type=options.FILE_NAME)
@click.argument("wishes", type=options.FILE_NAME)
@options.number("--starts", "N", "Number of searches, each from other dimensions.", 1, most=100_000, default=8)
@options.value(
    "--spread", "PART", "How far the starts differ from the mechanism: radians of an axis, parts of a length.",
    type=click.FloatRange(0.0, 10.0), default=0.1, show_default=True,
)  # fmt: skip
@options.seed("Random seed; another seed gives other starts.")
@options.output("Keep all designs in this .sqlite store, from which a stopped run is continued.", "STORE", "--store")
@options.flag("--resume", "Continue a stopped run from the store of --store.")
@options.repeated("--freeze", "K", "Number of a wish, from 1, that must hold; may be repeated.", type=click.IntRange(1))
@options.repeated(
    "--weigh", "K=WEIGHT", "Number of a wish, from 1, and its weight in place of that of WISHES; may be repeated."
)
@options.value(
    "--begin",
    "STORE",
    "Begin with the designs in this store, best first, then with other dimensions.",
    type=options.FILE_NAME,
)
@options.number("--workers", "N", "With --store: number of processes. By default one per core.")
@options.output("Write the best design: .json, or .fold and other formats for a sheet.")
@options.output("Draw the best design to this file (.svg, .png or .pdf).", "OUT", "--picture")
@options.output(
    "Write a page about the best design: figures, and its configurations with targets.", "OUT.html", "--page"
)
@options.output("Write a template of the best design (.pdf, .svg or .dxf).", "OUT", "--template")
@options.FORCE
@options.JSON
def design(
    mechanism: str, wishes: str, starts: int, spread: float, seed: int, store: str | None, resume: bool,
    freeze: tuple[int, ...], weigh: tuple[str, ...], begin: str | None, workers: int | None, output: str | None,
    picture: str | None, page: str | None, template: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Find dimensions of a mechanism with which its motion is as wished.

    MECHANISM is a file with coordinates (hinged solids, a linkage on a cone, a crease pattern) or the name of a
    generator; WISHES is a JSON file (docs/native-json.md). Axes, vertices or parameters change by least squares with
    exact derivatives, all configurations at once. A design counts only if its loops close to 1e-12, the verdict says
    that it moves, and its driven joint passes the configurations in order without turning back. The answer lists, for
    each wish, by how much it is missed and on which dimensions it depends most. Ctrl-C prints the designs found so
    far. To go on with other priorities, --begin names the store of an earlier run, and --freeze and --weigh change
    wishes by their numbers in WISHES.

    \b
    Examples:
      synth design data/hyatt/spherical-four-bar.json wishes.json
      synth design bennett wishes.json --starts 20 -o bennett.json
      synth design six-bar.json wishes.json --starts 200 --store designs.sqlite
      synth design six-bar.json wishes.json --begin designs.sqlite --freeze 1 --weigh 3=10

    Exit status 1: no design.
    """
    from synth.cli.output import check_picture
    from synth.synthesis.designing.job import DesignJob

    if (resume or workers is not None) and store is None:
        raise click.UsageError("--resume and --workers require --store STORE")
    check_output(output, force=force)
    check_picture(picture, force=force)
    for place in (page, template):
        check_output(place, force=force)
    if not Path(wishes).exists():
        raise FileError(wishes, "", "no such file", "a file of wishes")
    synth.synthesis.designing.read_wishes(wishes)
    frozen, weights = tuple(sorted({number - 1 for number in freeze})), options.weights_of(weigh)
    begun = () if begin is None else _begun(begin)
    job = DesignJob(mechanism, wishes, starts, spread, seed, frozen, weights, begun)
    with about(mechanism):
        job.search  # noqa: B018  # files are read, and names checked, before anything is computed
        if store is None:
            designs = _found(job)
        else:
            running = RunOptions(store, workers, resume=resume, quiet=as_json, force=force)
            designs = _from_store(job, running)
        written = _written(
            job, designs, {"": output, "picture": picture, "page": page, "template": template}, force=force
        )
    _print(designs, mechanism, written, as_json=as_json)


def _begun(store: str) -> tuple[tuple[float, ...], ...]:
    """Return the numbers of the designs in a store, best first."""
    from enumerate.runner.job import row_as_dict
    from enumerate.runner.store import read_rows
    from synth.synthesis.designing.job import COLUMNS, DesignJob

    if not Path(store).exists():
        raise FileError(store, "", "no such file", "a store that --store kept")
    rows = [row_as_dict(COLUMNS, row) for row in read_rows(Path(store))]
    return DesignJob.numbers(rows)


def _found(job: DesignJob) -> Designs:
    """Return the designs of all starts; those that there are when the user stops it."""
    from synth.synthesis.designing.designs import compared

    found: list[Design] = []
    with progress_line() as show:
        try:
            for start in range(job.starts):
                one = job.search.design(start)
                if one is not None:
                    found.append(one)
                best = min((one.miss for one in found if one.success), default=None)
                show(f"start {start + 1} of {job.starts}" + ("" if best is None else f", best miss {best:.1e}"))
        except KeyboardInterrupt:
            click.echo(f"stopped after {len(found)} of {job.starts} starts", err=True)
            return compared(found, len(found))
    return compared(found, job.starts)


def _from_store(job: DesignJob, running: RunOptions) -> Designs:
    """Run the starts into a store, and return the designs in it."""
    from enumerate.runner.job import row_as_dict
    from enumerate.runner.store import SqliteSink, read_rows
    from synth.synthesis.designing.designs import compared
    from synth.synthesis.designing.job import COLUMNS

    path = Path(str(running.output))
    if path.suffix != ".sqlite":
        raise FileError(path, "", "no store", "a name that ends in .sqlite")
    check_output(None if running.resume else str(path), force=running.force)
    if running.force and not running.resume:
        path.unlink(missing_ok=True)

    def sink_of(**how: Any) -> SqliteSink:
        return SqliteSink(path, resume=running.resume, **how)

    run_resumable(job, sink_of, running)
    rows = [row_as_dict(COLUMNS, row) for row in read_rows(path)]
    return compared(job.designs(rows), job.starts)


def _written(job: DesignJob, designs: Designs, places: dict[str, str | None], *, force: bool) -> list[str]:
    """Write the best design as a file, a picture, a page, and a template; return the names of the files."""
    from graphs.files.atomic import write_text

    best = designs.best
    written: list[str] = []
    for what, place in places.items():
        if best is None or place is None:
            continue
        if what == "picture":
            synth.draw(best.mechanism).save(place, force=force)
        elif what == "page":
            write_text(Path(place), job.search.page(best), force=force)
        elif what == "template":
            written += map(str, synth.write_template(synth.template(best.mechanism), place, force=force))
            continue
        else:
            synth.write(best.mechanism, place, force=force)
        written.append(place)
    return written


def _print(designs: Designs, mechanism: str, written: list[str], *, as_json: bool) -> None:
    """Print the designs, and what was written."""
    if as_json:
        print_json({"file": mechanism, **designs.to_json(), "written": written})
    else:
        print_result(designs, {}, as_json=False)
        tell_written(*written)
    if designs.best is None:
        sys.exit(1)
