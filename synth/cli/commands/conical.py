"""``synth enumerate conical``: the ways a chain can lie on one cone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

import graphs.files
import synth.linkages.conformed
import synth.synthesis.candidates
from graphs.errors import FileError
from synth.cli import options
from synth.cli.output import about, plain, print_note
from synth.cli.runner import RunOptions, check_method, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.runner import Limits, Sink
    from graphs.types import LinkId

_LIMITED = ("open_loops", "layers", "symmetry", "grashof_loops", "rank", "half_turn_steps")
"""Columns with an option for limits, in the order of the filters."""
_LINKAGE = ("one-way", "both-ways", "by-angles", "not-known")


@click.command(short_help="List or count the ways a chain can lie on one cone.")
@options.value(
    "--chain name", "CHAIN", "Chain: a name such as watt or stephenson, an id k1:..., or a FILE.", required=True
)
@options.value("--ground", "LINK", "Fixed link: an id; all, for one row per distinct ground link; or none.")
@options.number("--slots", "K", "Place the joints on K equal slots round the cone.", 3, most=720)
@options.flag("--opposites", "Tell apart the orders of the joints and of the points opposite to them.")
@options.number("--sample samples", "N", "Number of random sets of angles per order.")
@options.seed("Random seed for --sample.")
@options.cone_angle("Cone angle, for link angles and Grashof classes.")
@options.value(
    "--radius", "R", "Radius of a cylinder instead of a cone, for link lengths and Grashof classes.", type=float
)
@options.choice("--linkage", _LINKAGE, "Directions in which all moving links can go together.")
@options.limits("--open open_loops", "Number of open loops, as a number or range: 2, 1..2 or 2..")
@options.limits("--layers", "Least number of layers that the links require, as a number or range: 2 or ..3.")
@options.limits("--symmetry", "Number of symmetries, as a number or range: 1 or 2..")
@options.limits("--grashof grashof_loops", "Number of four-bar loops that are Grashof, as a number or range.")
@options.limits("--rank", "Rank of the closure equations at the conformed position, as a number or range.")
@options.flag("--singular/--regular", "List only candidates with, or without, rank deficiency.")
@options.limits("--half-turns half_turn_steps", "Number of steps of exactly 180 degrees, as a number or range.")
@options.value("--sort", "[-]COLUMN", "Sort by a column; a leading - sorts in descending order.")
@options.output("Draw each candidate, as a circle and on its cone, to a new folder.", "FOLDER", "--pictures")
@options.flag("--formulas", "Print only the outward rate of each joint, as a formula.")
@options.flag("--count only_count", "Print only the number; without filters, by formula.")
@options.choice("--method", ("burnside", "orbits"), "Counting method for --count; both give the same number.")
@runner_options
def conical(
    name: str, ground: str | None, slots: int | None, opposites: bool, samples: int | None, seed: int,
    cone_angle: float | None, radius: float | None, linkage: str | None, singular: bool | None, sort: str | None,
    pictures: str | None, formulas: bool, only_count: bool, method: str | None, running: RunOptions,
    **limits: Limits | None,
) -> None:  # fmt: skip
    """List or count all conical candidates of a chain: all joint axes are ruling lines of a cone or cylinder.

    The candidates are the cyclic orders of the joints; orders that a rotation, a reflection or a symmetry of the
    chain (one that keeps the ground link) exchanges count once. Each row has the circuits of all loops, their
    winding numbers, the layers, and with a ground link the directions in which each moving link can go, over all
    angles. With --slots or --sample, rows also have the rank, the Grashof classes and the first-order behaviour at
    these angles (Hyatt et al. 2020, section 7).

    \b
    Examples:
      synth enumerate conical --chain watt
      synth enumerate conical --chain four-bar --ground 0 --opposites
      synth enumerate conical --chain stephenson --ground all --count
      synth enumerate conical --chain four-bar --ground 0 --slots 6 --sort -grashof_loops
      synth enumerate conical --chain four-bar --ground 0 --slots 6 --radius 25
      synth enumerate conical --chain watt --ground 0 --formulas
      synth enumerate conical --chain watt --ground all --slots 12 -o watt.sqlite
      synth enumerate conical --chain data/surfaces/fig11-stephenson.json --open 3 --pictures pictures
    """
    from graphs.files.atomic import check_new_folder

    check_method(method, only_count)
    if only_count and (sort is not None or pictures is not None):
        raise click.UsageError("--count excludes --sort and --pictures: it lists no candidates")
    if running.resume and (sort is not None or pictures is not None):
        raise click.UsageError("--resume excludes --sort and --pictures, which require all rows at once")
    if pictures is not None:
        check_new_folder(Path(pictures))
    chain = _chain(name)
    grounds = _grounds(chain, ground)
    if formulas:
        _print_formulas(chain, grounds)
        return
    filters = [
        synth.synthesis.candidates.Filter(column, least=each.least, most=each.most)
        for column in _LIMITED
        if (each := limits[column])
    ]
    if singular is not None:
        filters.append(synth.synthesis.candidates.Filter("singular", singular))
    if linkage is not None:
        filters.append(synth.synthesis.candidates.Filter("linkage", linkage.replace("-", " ")))
    surface = options.surface_from_options(cone_angle, radius)
    job = synth.synthesis.candidates.CandidateJob(
        chain, grounds, slots, opposites, samples, seed, surface, tuple(filters)
    )
    if not only_count:
        run_rows(job, running, lambda sink: _around(sink, job, sort, pictures), numbered_rows=True)
        _say_next(running)
    elif filters or samples is not None:
        if method is not None:
            raise click.UsageError("--method counts all candidates, without filters and --sample")
        run_count(synth.synthesis.candidates.CandidateCountJob(job), running)
    else:
        from enumerate.conical.query import ConicalCountJob

        run_count(ConicalCountJob(job.query, method or "burnside"), running)


def _say_next(running: RunOptions) -> None:
    """Say which command makes a linkage that moves of a row."""
    from synth.making.drawing.list_pages import is_catalogue

    if running.as_json or running.quiet or (running.output is not None and not is_catalogue(running.output)):
        return
    file = "FILE.jsonl" if running.output is None else plain(running.output, 4096)
    first = "-o FILE.jsonl, then " if running.output is None else ""
    if running.output is not None:
        print_note(f"to see the rows: the same command without -o, or synth draw {file} -o rows.pdf")
    print_note(
        f"to move row K: {first}synth cone move {file} --row K --lambda 30; "
        f"a file of it: synth realise {file} --row K --as cone -o OUT.json"
    )


def _chain(name: str) -> synth.SCGraph:
    """Return the chain of a name, an id or a file."""
    from enumerate.chains.names import chain_named, chain_names
    from graphs.files.formats import is_id
    from synth.synthesis.candidates.listing import chain_of

    known = chain_names()
    code = chain_named(name) if name.lower() in known else name
    if not is_id(code) and not Path(code).exists() and not Path(code).suffix:
        raise FileError(name, "", "neither a chain nor a file", f"{' '.join(known)}, an id k1:..., or a file")
    with about(name):
        return chain_of(graphs.files.read(code))


def _grounds(chain: synth.SCGraph, ground: str | None) -> tuple[LinkId | None, ...]:
    """Return the fixed links of --ground; without it that of the chain."""
    from enumerate.conical.query import links_apart

    if ground is None:
        return (chain.ground,)
    if ground == "none":
        return (None,)
    return tuple(links_apart(chain.joints)) if ground == "all" else (options.link_of(chain, ground),)


def _around(sink: Sink, job: synth.synthesis.candidates.CandidateJob, sort: str | None, pictures: str | None) -> Sink:
    """Sort the rows before they go to the sink, and draw them."""
    if pictures is not None:
        sink = synth.synthesis.candidates.PictureSink(sink, job, Path(pictures))
    if sort is not None:
        from enumerate.runner import SortedSink

        sink = SortedSink(sink, sort)
    return sink


def _print_formulas(chain: synth.SCGraph, grounds: tuple[LinkId | None, ...]) -> None:
    click.echo("[a b c] = 4 sin((b - a) / 2) sin((c - b) / 2) sin((c - a) / 2); joints stand for their azimuths.")
    click.echo("A link can go one way if all its joints have one sign and lie on half the circle.")
    for ground in grounds:
        if ground is None:
            raise click.UsageError("--formulas requires --ground LINK, or --ground all")
        conformed = synth.linkages.conformed.ConformedChain.of(chain, ground)
        click.echo(f"link {plain(ground)} fixed, joint: outward rate, to one common scale")
        for joint, rates in zip(conformed.joints, synth.linkages.conformed.outward_rates(conformed), strict=True):
            if rates:
                click.echo(f"  {plain(joint)}: {plain(rates[0].text(conformed.joints), 2000)}")
