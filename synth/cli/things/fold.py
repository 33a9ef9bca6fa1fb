"""``synth fold``: a crease pattern folded, panels rigid, along one of its branches."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple

import click

from synth.cli.lengths import BRANCH
from synth.cli.output import FORCE, PATIENCE, about, console, plain, print_json, table, tell_written
from synth.cli.precision import PRECISION, precise
from synth.cli.reading import DRAWN, read
from synth.cli.things.driven import driven_angles, numbers_of_joints

if TYPE_CHECKING:
    from graphs.mechanism.sc import SCGraph
    from graphs.types import JointId, LinkId

__all__ = ["fold"]


@click.command(short_help="Fold a crease pattern with rigid panels; list its folding branches.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--drive", multiple=True, metavar="JOINT=DEGREES", help="Fold a crease to this angle; may be repeated."
)
@click.option(
    "--along",
    multiple=True,
    metavar="JOINT=RATE",
    help="Initial joint rates; the motion keeps their direction if it can.",
)
@click.option(
    "--point",
    "points",
    multiple=True,
    metavar="LINK=X,Y[,Z]",
    help="Print where this point of a link is in each frame (a coupler curve); may be repeated.",
)
@click.option(
    "--all",
    "whole",
    is_flag=True,
    help="Fold all creases together, with one degree of freedom. This is the default without --drive and --along.",
)
@click.option(
    "--branch",
    type=BRANCH,
    metavar="K",
    help="Folding branch from a flat state, by its number or its signs; --branches lists them.",
)
@click.option("--branches", "listed", is_flag=True, help="List the motion branches from this configuration.")
@click.option(
    "--frames",
    type=click.IntRange(1, 10_000),
    metavar="N",
    default=20,
    show_default=True,
    help="Number of frames after the first.",
)
@click.option("--collisions", is_flag=True, help="Stop the motion before panels pass through each other.")
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    help="Write the motion: .fold with frames, a series of .obj files, a .gif, or a strip of "
    "pictures (.png, .svg).",
)
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def fold(
    file: str,
    drive: tuple[str, ...],
    along: tuple[str, ...],
    whole: bool,
    branch: int | str | None,
    listed: bool,
    frames: int,
    points: tuple[str, ...],
    collisions: bool,
    output: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fold a crease pattern, or move another linkage, with rigid panels and closed loops.

    Fold angles are in degrees, valleys positive; the loop-closure residual is below 1e-12 in every frame. A flat
    state may have several folding branches; --branch chooses one, by default the one that agrees best with the
    mountains and valleys of the file. Without --drive, and with --all, the crease that moves most is folded until
    the motion stops, and the others follow. With several degrees of freedom, --along gives the direction: rates of
    some creases; the others move as little as possible. JOINT is an id, or two links A,B. Every fold angle keeps
    its sign as long as some motion allows it; the answer names creases that change sign, creases folded against
    their assignment, and frames in which panels pass through each other. A linkage without panels (solids hinged
    at edges, rods, a linkage on its cone) moves by joint angles, measured from the configuration of the file; -o
    draws solids (.png, .svg, .gif).

    \b
    Examples:
      synth fold data/patterns/bird-base.fold --branches
      synth fold data/patterns/four-bar-vertex.fold --drive 2=90 --frames 5 -o folded.fold
      synth fold data/patterns/bird-base.fold --all -o folded.gif
      synth fold data/linkages/sarrus.json --frames 11 -o rising.svg
    """
    from synth.drawing.foldings import check_output, write_motion
    from synth.moving.made import configuration_of
    from synth.moving.motion import move

    if sum(map(bool, (whole, drive, along))) > 1:
        raise click.UsageError("--drive, --along and --all each say how to move: leave all but one out")
    if output is not None:
        check_output(output, force=force)
    thing = read(file, warn=False)
    with about(file):
        thing = precise(thing)
        at = configuration_of(thing)
        asked, graph = _Joints(drive, along), at.linkage.graph
        with _progress(frames + 1) as report:
            found = move(
                at,
                drive=asked.driven(graph),
                along=asked.rates(graph),
                branch=branch,
                frames=frames,
                collisions=collisions,
                report=report,
            )
        curves = {text: found.path_of(*_point(graph, text)).tolist() for text in points}
        written = [] if output is None else write_motion(found, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **found.to_json(), "points": curves})
        return
    if listed and found.branches is not None:
        rows = table("branch", "DOF", "evidence", "immobile", "signs", numbers=["branch", "DOF", "immobile"])
        for number, one in enumerate(found.branches.branches):
            freedoms = "?" if one.freedoms is None else str(one.freedoms)
            rows.add_row(str(number), freedoms, one.certainty, str(len(one.still)), plain(one.signs, 4096))
        console().print(rows)
    for line in str(found).splitlines():
        click.echo(line)
    for text, places in curves.items():
        rows = table("frame", "x", "y", "z", title=f"point {plain(text)}", numbers=["frame", "x", "y", "z"])
        for number, place in enumerate(places):
            rows.add_row(str(number), *(f"{x + 0.0:.9g}" for x in place))
        console().print(rows)
    tell_written(*written)


def _point(graph: SCGraph, text: str) -> tuple[LinkId, list[float]]:
    """Return a link and the coordinates of a point, as they were typed."""
    from graphs.edit.named import link_named

    link, equals, numbers = text.rpartition("=")
    try:
        place = [float(number) for number in numbers.split(",")]
        if not equals or len(place) not in (2, 3):
            raise ValueError
    except ValueError:
        raise click.BadParameter(f"{plain(text)!r} is not LINK=X,Y or LINK=X,Y,Z", param_hint="--point") from None
    return link_named(graph, link.strip()), place


@contextmanager
def _progress(frames: int) -> Iterator[Callable[[int], None]]:
    """Show how many frames there are, on a terminal, where it takes longer than some seconds."""
    start, shown = monotonic(), False

    def report(made: int) -> None:
        nonlocal shown
        if sys.stderr.isatty() and monotonic() - start > PATIENCE:
            click.echo(f"\r{made} of {frames} frames", nl=False, err=True)
            shown = True

    try:
        yield report
    finally:
        if shown:
            click.echo("\r" + " " * 40 + "\r", nl=False, err=True)


class _Joints(NamedTuple):
    """What is asked of joints, as it was typed."""

    drive: tuple[str, ...]
    along: tuple[str, ...]

    def driven(self, graph: SCGraph) -> dict[JointId, float]:
        """Return the angles of driven joints, radians."""
        return driven_angles(graph, self.drive)

    def rates(self, graph: SCGraph) -> dict[JointId, float]:
        """Return the rates at which joints are to begin."""
        return numbers_of_joints(graph, self.along, "--along", "JOINT=RATE")
