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
from synth.cli.things.driven import driven_angles, numbers_of_joints

if TYPE_CHECKING:
    from graphs.ids import JointId
    from graphs.mechanism.sc import SCGraph

__all__ = ["fold"]


@click.command(short_help="Fold a crease pattern with rigid panels; list its ways to fold.")
@click.argument("file", metavar="FILE")
@click.option("--drive", multiple=True, metavar="JOINT=DEGREES", help="Fold a crease so far; may be repeated.")
@click.option("--along", multiple=True, metavar="JOINT=RATE", help="Begin at these rates, then go straight on.")
@click.option("--all", "whole", is_flag=True, help="Fold all creases together, by one freedom (without --drive).")
@click.option(
    "--branch", type=BRANCH, metavar="K", help="Take this way from a flat state: its number, or its signs."
)
@click.option("--branches", "listed", is_flag=True, help="List the ways to fold from this pose.")
@click.option(
    "--frames", type=click.IntRange(1, 10_000), default=20, show_default=True, help="Frames after the first."
)
@click.option("--collisions", is_flag=True, help="End before panels pass through each other.")
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    help="Write the poses: .fold with frames, a series of .obj files, .gif, or .png, .svg (a strip).",
)
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def fold(
    file: str,
    drive: tuple[str, ...],
    along: tuple[str, ...],
    whole: bool,
    branch: int | str | None,
    listed: bool,
    frames: int,
    collisions: bool,
    output: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fold a crease pattern, or move another linkage. Panels stay rigid; all loops close to 1e-12 in every pose.

    Fold angles are in degrees, valleys positive. From a flat state there are several ways to fold; without
    --branch it is the one that agrees best with the mountains and valleys of the file. Without --drive, as with
    --all, the crease that moves most is folded as far as it goes, and the others follow. With several freedoms
    --along says in which direction: rates of some creases, others as little as may be. JOINT is an id, or two
    links A,B.
    What has no panels (solids hinged at edges, rods, a linkage on its cone) moves by joint angles, from the pose;
    solids are drawn with -o (.png, .svg, .gif).

    \b
    Examples:
      synth fold data/patterns/bird-base.fold --branches
      synth fold data/patterns/four-bar-vertex.fold --drive 2=90 --frames 5 -o folded.fold
      synth fold data/patterns/bird-base.fold --all -o folded.gif
      synth fold data/linkages/sarrus.json --frames 11 -o rising.svg
    """
    from graphs.files.formats import read
    from synth.drawing.foldings import check_output, write_motion
    from synth.moving.made import configuration_of
    from synth.moving.motion import move

    if sum(map(bool, (whole, drive, along))) > 1:
        raise click.UsageError("--drive, --along and --all each say how to move: leave all but one out")
    if output is not None:
        check_output(output, force=force)
    thing = read(file)
    with about(file):
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
        written = [] if output is None else write_motion(found, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **found.to_json()})
        return
    if listed and found.branches is not None:
        rows = table("way", "freedoms", "known", "still", "signs", numbers=["way", "freedoms", "still"])
        for number, one in enumerate(found.branches.branches):
            freedoms = "?" if one.freedoms is None else str(one.freedoms)
            rows.add_row(str(number), freedoms, one.certainty, str(len(one.still)), plain(one.signs, 4096))
        console().print(rows)
    for line in str(found).splitlines():
        click.echo(line)
    tell_written(*written)


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
