"""``synth enumerate conical``: the ways a chain can lie on one cone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from synth.cli.options import LimitsType, surface_from_options
from synth.cli.output import about, plain
from synth.cli.runner import RunOptions, check_method, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.runner.job import Sink
    from graphs.mechanism.sc import SCGraph
    from graphs.types import LinkId
    from synth.candidates.job import CandidateJob, Filter

__all__ = ["conical"]


_LIMITS = {
    "open_loops": "open_loops",
    "layers": "layers",
    "symmetry": "symmetry",
    "grashof": "grashof_loops",
    "rank": "rank",
    "half_turns": "half_turn_steps",
}
"""Option to the column that it limits."""
_LINKAGE = ("one-way", "both-ways", "by-angles", "not-known")


@click.command(short_help="List or count the ways a chain can lie on one cone.")
@click.option(
    "--chain", "name", required=True, metavar="CHAIN",
    help="Chain: a name such as watt or stephenson, an id k1:..., or a FILE.",
)  # fmt: skip
@click.option(
    "--ground", metavar="LINK", help="Fixed link: an id; all, for one row per distinct ground link; or none."
)
@click.option(
    "--slots", type=click.IntRange(min=3, max=720), metavar="K",
    help="Place the joints on K equal slots round the cone.",
)  # fmt: skip
@click.option(
    "--opposites", is_flag=True, help="Tell apart the orders of the joints and of the points opposite to them."
)
@click.option(
    "--sample", "samples", type=click.IntRange(min=1), metavar="N",
    help="Number of random sets of angles per order.",
)  # fmt: skip
@click.option(
    "--seed", type=click.IntRange(min=0), metavar="N", default=0, show_default=True,
    help="Random seed for --sample.",
)  # fmt: skip
@click.option(
    "--lambda", "cone_angle", type=float, metavar="DEGREES",
    help="Cone angle, for link angles and Grashof classes.",
)  # fmt: skip
@click.option(
    "--radius", type=float, metavar="R",
    help="Radius of a cylinder instead of a cone, for link lengths and Grashof classes.",
)  # fmt: skip
@click.option(
    "--linkage", type=click.Choice(_LINKAGE), help="Directions in which all moving links can go together."
)
@click.option(
    "--open", "open_loops", type=LimitsType(), metavar="K",
    help="Number of open loops, as a number or range: 2, 1..2 or 2..",
)  # fmt: skip
@click.option(
    "--layers", type=LimitsType(), metavar="K", help="Smallest number of layers, as a number or range: 2 or ..3."
)
@click.option(
    "--symmetry", type=LimitsType(), metavar="K", help="Number of symmetries, as a number or range: 1 or 2.."
)
@click.option(
    "--grashof", type=LimitsType(), metavar="K",
    help="Number of four-bar loops that are Grashof, as a number or range.",
)  # fmt: skip
@click.option(
    "--rank", type=LimitsType(), metavar="K",
    help="Rank of the closure equations at the conformed position, as a number or range.",
)  # fmt: skip
@click.option("--singular/--regular", default=None, help="List only candidates with, or without, rank deficiency.")
@click.option(
    "--half-turns", type=LimitsType(), metavar="K",
    help="Number of steps of exactly 180 degrees, as a number or range.",
)  # fmt: skip
@click.option("--sort", metavar="[-]COLUMN", help="Sort by a column; a leading - sorts in descending order.")
@click.option(
    "--pictures", metavar="FOLDER", help="Draw each candidate, as a circle and on its cone, to a new folder."
)
@click.option("--formulas", is_flag=True, help="Print only the outward rate of each joint, as a formula.")
@click.option("--count", "only_count", is_flag=True, help="Print only the number; without filters, by formula.")
@click.option(
    "--method", type=click.Choice(["burnside", "orbits"]),
    help="Counting method for --count; both give the same number.",
)  # fmt: skip
@runner_options
def conical(
    name: str,
    ground: str | None,
    only_count: bool,
    method: str | None,
    formulas: bool,
    sort: str | None,
    pictures: str | None,
    cone_angle: float | None,
    radius: float | None,
    **rest: Any,
) -> None:
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

    options = RunOptions.taken_from(rest, counting=only_count)
    _check_usage(options, only_count, method, sort, pictures)
    if pictures is not None:
        check_new_folder(Path(pictures))
    chain = _chain(name)
    grounds = _grounds(chain, ground)
    if formulas:
        _print_formulas(chain, grounds)
        return
    from synth.candidates.job import CandidateCountJob, CandidateJob

    filters = _filters(rest)
    job = CandidateJob(
        chain, grounds, rest["slots"], rest["opposites"], rest["samples"], rest["seed"],
        surface_from_options(cone_angle, radius), filters,
    )  # fmt: skip
    if not only_count:
        run_rows(job, options, lambda sink: _around(sink, job, sort, pictures))
    elif filters or rest["samples"] is not None:
        if method is not None:
            raise click.UsageError("--method counts all candidates, without filters and --sample")
        run_count(CandidateCountJob(job), options)
    else:
        from enumerate.conical.query import ConicalCountJob

        run_count(ConicalCountJob(job.query, method or "burnside"), options)


def _check_usage(
    options: RunOptions, only_count: bool, method: str | None, sort: str | None, pictures: str | None
) -> None:
    check_method(method, only_count)
    if only_count and (sort is not None or pictures is not None):
        raise click.UsageError("--count excludes --sort and --pictures: it lists no candidates")
    if options.resume and (sort is not None or pictures is not None):
        raise click.UsageError("--resume excludes --sort and --pictures, which require all rows at once")


def _chain(name: str) -> SCGraph:
    """Return the chain of a name, an id or a file."""
    from enumerate.chains.names import chain_named, chain_names
    from graphs.convert.link_joint import sc_from_link_joint_graph
    from graphs.convert.table import graph_of
    from graphs.errors import FileError
    from graphs.files.formats import is_id, read

    known = chain_names()
    code = chain_named(name) if name.lower() in known else name
    if not is_id(code) and not Path(code).exists() and not Path(code).suffix:
        raise FileError(name, "", "neither a chain nor a file", f"{' '.join(known)}, an id k1:..., or a file")
    with about(name):
        sc = graph_of(read(code))
        return sc if sc.loops else sc_from_link_joint_graph(sc)


def _grounds(chain: SCGraph, ground: str | None) -> tuple[LinkId | None, ...]:
    """Return the fixed links of --ground; without it that of the chain."""
    from enumerate.conical.query import links_apart
    from graphs.edit.named import link_named

    if ground is None:
        return (chain.ground,)
    if ground == "none":
        return (None,)
    return tuple(links_apart(chain.joints)) if ground == "all" else (link_named(chain, ground),)


def _filters(rest: dict[str, Any]) -> tuple[Filter, ...]:
    from synth.candidates.job import Filter

    filters = [
        Filter(column, least=rest[option].least, most=rest[option].most)
        for option, column in _LIMITS.items()
        if rest[option] is not None
    ]
    if rest["singular"] is not None:
        filters.append(Filter("singular", rest["singular"]))
    if rest["linkage"] is not None:
        filters.append(Filter("linkage", rest["linkage"].replace("-", " ")))
    return tuple(filters)


def _around(sink: Sink, job: CandidateJob, sort: str | None, pictures: str | None) -> Sink:
    """Sort the rows before they go to the sink, and draw them."""
    if pictures is not None:
        from synth.candidates.pictures import PictureSink

        sink = PictureSink(sink, job, Path(pictures))
    if sort is not None:
        from enumerate.runner.sinks import SortedSink

        sink = SortedSink(sink, sort)
    return sink


def _print_formulas(chain: SCGraph, grounds: tuple[LinkId | None, ...]) -> None:
    from synth.conformed.outward import outward_rates
    from synth.conformed.rates import ConformedChain

    click.echo("[a b c] = 4 sin((b - a) / 2) sin((c - b) / 2) sin((c - a) / 2); joints stand for their azimuths.")
    click.echo("A link can go one way if all its joints have one sign and lie on half the circle.")
    for ground in grounds:
        if ground is None:
            raise click.UsageError("--formulas requires --ground LINK, or --ground all")
        conformed = ConformedChain.of(chain, ground)
        click.echo(f"link {plain(ground)} fixed, joint: outward rate, to one common scale")
        for joint, rates in zip(conformed.joints, outward_rates(conformed), strict=True):
            if rates:
                click.echo(f"  {plain(joint)}: {plain(rates[0].text(conformed.joints), 2000)}")
