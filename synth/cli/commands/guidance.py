"""``synth order``, ``dyads``, ``fourbar`` and ``sixbar``: a body guided through orientations."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from functools import partial
from math import degrees, radians
from typing import TYPE_CHECKING, Any

import click
import numpy as np

import synth.linkages.guidance
import synth.making.drawing
from graphs.errors import UnsolvableError, numbered
from synth.cli import options
from synth.cli.output import about, check_output, check_picture, console, plain, print_json, print_result, table

if TYPE_CHECKING:
    from synth.linkages.guidance.order import Direction
    from synth.linkages.guidance.sixbars import Carrier

_ORIENTATIONS = options.value(
    "--orientations file", "FILE", "File of three or more orientations (docs/native-json.md).", required=True,
    type=options.FILE_NAME,
)  # fmt: skip


@click.command()
@options.value(
    "--orientations file", "FILE", "File of three or more orientations (docs/native-json.md); requires --axis.",
    type=options.FILE_NAME,
)  # fmt: skip
@options.value("--axis", "X,Y,Z", "Direction of the fixed axis G of the dyad, of any length.", type=options.AXIS)
@options.repeated(
    "--position positions", "X,Y,DEGREES",
    "Positions in the plane, in place of --orientations: the origin of the body, and how far it is turned; three "
    "times or more. Requires --pivot.",
    type=options.NUMBERS,
)  # fmt: skip
@options.value("--pivot", "X,Y", "With --position: the fixed pivot of the crank.", type=options.NUMBERS)
@options.value(
    "--desired", "2,1,3,...",
    "Numbers of three or more of them, in the order in which the crank is to take them. By default all, in the order "
    "in which they are listed.",
    type=options.NUMBERS,
)  # fmt: skip
@options.choice(
    "--direction", ("ccw", "cw"), "Direction in which the crank turns, seen from the tip of the axis.",
    default="ccw",
)  # fmt: skip
@options.output("Draw the sphere and the hoop to this file (.svg, .png or .pdf).", "OUT", "-o --picture")
@options.FORCE
@options.JSON
def order(
    file: str | None, positions: Sequence[tuple[float, ...]], desired: tuple[float, ...] | None, picture: str | None,
    force: bool, as_json: bool, **about_what: Any,
) -> None:  # fmt: skip
    """Check whether a crank guides a body through orientations in order (Tipparthi and Larochelle 2011).

    The hoop, half a great circle through the ends of the axis, turns by 180 degrees from S12; the order in which
    it crosses the axes Sij, of the rotation from orientation i to orientation j, decides. In the plane it is a
    propeller, a line about the fixed pivot, that passes the poles Pij. Inequalities and the crank angles of the
    best-fitting dyad check the result. Exit status 1: the order is not kept.

    \b
    Examples:
      synth order --orientations data/orientations/tipparthi.json --axis -0.349,-0.144,0.926 --direction cw
      synth order --orientations data/orientations/tipparthi.json --axis -0.349,-0.144,0.926 --desired 5,4,3,2,1
      synth order --position 2,0,0 --position 0,2,20 --position -1,-1.7,70 --pivot 0,0
    """
    check_picture(picture, force=force)
    if (file is None) == (not positions):
        raise click.UsageError("one of --orientations and --position is required")
    if file is None:
        analysis, where = _planar_order(positions, picture, _numbers_of(desired), **about_what)
    else:
        analysis, where = _spherical_order(file, _numbers_of(desired), **about_what)
        if picture is not None:
            orientations = synth.linkages.guidance.read_orientations(file)
            synth.making.drawing.draw_hoop(orientations, analysis.axis, analysis.hoop).save(picture, force=force)
    print_result(analysis, where, as_json=as_json, written=[picture])
    if not analysis.in_order:
        sys.exit(1)


def _numbers_of(desired: tuple[float, ...] | None) -> list[int] | None:
    """Return the whole numbers of --desired."""
    for number in desired or ():
        if number != int(number):
            raise click.UsageError(f"--desired: {number:g} is not the number of an orientation, such as 2")
    return None if desired is None else [int(number) for number in desired]


def _spherical_order(
    file: str, desired: list[int] | None, *, axis: tuple[float, float, float] | None,
    pivot: tuple[float, ...] | None, direction: Direction,
) -> tuple[synth.linkages.guidance.OrderAnalysis, dict[str, Any]]:  # fmt: skip
    if axis is None or pivot is not None:
        raise click.UsageError("--orientations requires --axis" if axis is None else "--pivot requires --position")
    orientations = synth.linkages.guidance.read_orientations(file)
    with about(file):
        analysis = synth.linkages.guidance.analyse_order(orientations, axis, direction, desired)
    return analysis, {"file": file, "axis": list(axis)}


def _planar_order(
    positions: Sequence[tuple[float, ...]], picture: str | None, desired: list[int] | None, *,
    axis: tuple[float, float, float] | None, pivot: tuple[float, ...] | None, direction: Direction,
) -> tuple[synth.linkages.guidance.OrderAnalysis, dict[str, Any]]:  # fmt: skip
    if pivot is None or axis is not None:
        raise click.UsageError("--position requires --pivot" if pivot is None else "--axis requires --orientations")
    if picture is not None:
        raise click.UsageError("-o draws the hoop on the sphere, and requires --orientations")
    for position in positions:
        if len(position) != 3:
            raise click.UsageError(f"--position: {len(position)} numbers; expected X,Y,DEGREES, such as 0,2,20")
    if len(pivot) != 2:
        raise click.UsageError(f"--pivot: {len(pivot)} numbers; expected X,Y, such as 0,0")
    rows = synth.linkages.guidance.PlanarPositions(np.array([(x, y, radians(turn)) for x, y, turn in positions]))
    analysis = synth.linkages.guidance.analyse_planar_order(rows, pivot, direction, desired)
    return analysis, {"positions": [list(position) for position in positions], "pivot": list(pivot)}


_AXES = options.repeated(
    "--axis axes", "X,Y,Z", "Direction of a fixed axis, required for three orientations; may be repeated.",
    type=options.AXIS,
)  # fmt: skip


_samples = partial(
    options.number, "--samples", "N", "Number of dyads on each curve, for four orientations.", 8, default=36
)


@click.command()
@_ORIENTATIONS
@_AXES
@_samples(most=100_000)
@options.output(
    "Draw a map of the sphere, coloured by order, to this file (.svg, .png or .pdf).", "OUT", "-o --picture"
)
@options.FORCE
@options.JSON
def dyads(
    file: str, axes: tuple[tuple[float, float, float], ...], samples: int, picture: str | None, force: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """Find the RR dyads, fixed axis G and moving axis W, that guide a body through orientations.

    For three orientations every fixed axis has a dyad, so --axis is required. For four there are curves of dyads,
    which are sampled. For five there are up to six dyads, and all are found. For more orientations the
    best-fitting dyads are found. W is in the frame of the body. The residual is the largest |G . (Mi - M1) W|,
    Mi being the matrix of orientation i.

    \b
    Example:
      synth dyads --orientations data/orientations/tipparthi.json
    """
    check_picture(picture, force=force)
    orientations = synth.linkages.guidance.read_orientations(file)
    with about(file):
        guiding = _guiding_dyads(orientations, axes, samples)
        if picture is not None:
            _drawn(orientations, guiding.dyads).save(picture, force=force)
    print_result(guiding, {"file": file}, as_json=as_json, written=[picture])


def _guiding_dyads(
    orientations: synth.linkages.guidance.Orientations, axes: tuple[tuple[float, float, float], ...], samples: int
) -> synth.linkages.guidance.GuidingDyads:
    """Return the dyads of orientations; refuse an --axis for other than three, or its absence for three."""
    if axes and len(orientations) != 3:
        raise click.UsageError(f"--axis requires three orientations, got {len(orientations)}")
    if not axes and len(orientations) == 3:
        raise click.UsageError("three orientations require --axis X,Y,Z: every fixed axis has a dyad")
    return synth.linkages.guidance.guiding_dyads(orientations, axes, samples)


def _drawn(
    orientations: synth.linkages.guidance.Orientations, guiding: tuple[synth.linkages.guidance.Dyad, ...]
) -> Any:
    """Return the map of orders, with the dyads, or with the curve of fixed axes for four orientations."""
    if len(orientations) == 4:
        return synth.making.drawing.draw_map(orientations, (), synth.linkages.guidance.centre_axes(orientations, 720))
    return synth.making.drawing.draw_map(orientations, guiding)


@click.command()
@_ORIENTATIONS
@_AXES
@_samples(most=200)
@options.number("--best", "K", "Largest number of four-bars to list.", default=12)
@options.flag("--usable", "List only four-bars without defects.")
@options.flag("--cones", "Map each four-bar listed to cones.")
@options.output("Write the motion of the best four-bar without defects, as orientations.", "OUT.json", "--motion")
@options.number("--steps", "N", "Number of steps of the motion between two orientations.", most=100_000, default=20)
@options.FORCE
@options.JSON
def fourbar(
    file: str, axes: tuple[tuple[float, float, float], ...], samples: int, best: int, usable: bool, cones: bool,
    motion: str | None, steps: int, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Find the four-bars that guide their coupler through orientations, and rank them.

    Each pair of dyads is listed twice, with either dyad as the driver. A circuit defect: the orientations cannot
    be reached without taking the linkage apart. A branch defect: the driver would have to pass a dead point. An
    order defect: the driver, turning one way within its range, reaches them in another order. For three
    orientations, two axes are required. With --cones each four-bar listed is mapped to cones, by either end of
    each of its axes.

    \b
    Examples:
      synth fourbar --orientations data/orientations/tipparthi.json --best 5
      synth fourbar --orientations data/orientations/crank-rocker.json --usable --cones --motion motion.json
    """
    check_output(motion, force=force)
    orientations = synth.linkages.guidance.read_orientations(file)
    with about(file):
        ranked = synth.linkages.guidance.four_bars(orientations, _guiding_dyads(orientations, axes, samples).dyads)
    good = [four_bar for four_bar in ranked if not four_bar.defects]
    frames = None
    if motion is not None:
        with about(file):
            if not good:
                raise UnsolvableError("--motion requires a four-bar without defects, and there is none")
            quaternions = synth.linkages.guidance.motion_of(orientations, good[0], steps).quaternions
            synth.linkages.guidance.write_orientations(quaternions, motion, force=force)
            frames = len(quaternions)
    listed = (good if usable else ranked)[:best]
    if as_json:
        print_json(
            {
                "file": file,
                "orientations": len(orientations),
                "fourbars": [{**each.to_json(), **(_cones_json(each) if cones else {})} for each in listed],
                "found": len(ranked),
                "usable": len(good),
                "motion": None if motion is None else {"file": motion, "frames": frames},
            }
        )
        return
    out = console()
    out.print(f"{len(orientations)} orientations: {numbered(len(ranked), 'four-bar')}, {len(good)} without defects")
    out.print(_table(listed))
    if cones:
        out.print(_table_of_cones(listed))
    if motion is not None:
        out.print(f"written: {plain(motion, 4096)} ({frames} orientations)")


@click.command()
@_ORIENTATIONS
@options.number("--best", "K", "Number of six-bars after which the search ends.", most=100, default=1)
@options.number(
    "--tries", "N", "Largest number of populations of linkages to search; seconds each.", most=100_000, default=60
)
@options.choice("--driven", ("ground", "body"), "Link that carries the driven joint; by default either.")
@options.output("Write the best six-bar at orientation 1 as hinged solids.", "OUT.json", "-o --output")
@options.output("Write the motion of its body, as orientations.", "OUT.json", "--motion")
@options.FORCE
@options.JSON
def sixbar(
    file: str, best: int, tries: int, driven: Carrier | None, output: str | None, motion: str | None, force: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """Find six-bars that guide a body through five orientations in order, on one circuit and one branch.

    They are Watt's: two four-bars in a row, whose driven joint turns one way, less than a whole turn. Every six-bar
    listed was traced from the first orientation to the last. Exit status 1: none was found, which proves nothing.

    \b
    Example:
      synth sixbar --orientations data/orientations/tipparthi.json -o six-bar.json
    """
    check_output(output, force=force)
    check_output(motion, force=force)
    orientations = synth.linkages.guidance.read_orientations(file)
    with about(file):
        found = synth.linkages.guidance.six_bars(orientations, most=best, tries=tries, driven=driven)
    if not found.six_bars:
        print_result(found, {"file": file}, as_json=as_json)
        sys.exit(1)
    if output is not None:
        from graphs.files.formats import write

        write(found.six_bars[0].linkage, output, force=force)
    if motion is not None:
        synth.linkages.guidance.write_orientations(found.six_bars[0].motion.quaternions, motion, force=force)
    print_result(found, {"file": file}, as_json=as_json, written=[output, motion])


def _cones_json(four_bar: synth.linkages.guidance.GuidedFourBar) -> dict[str, Any]:
    """Return every cone, and interval of cones, on which a four-bar can lie."""
    forms = synth.linkages.guidance.conical_forms(four_bar)
    return {
        "cones": [cone for form in forms for cone in form.cones_json()],
        "families": [family for form in forms for family in form.families_json()],
    }


def _with_half_angle(angle: float) -> str:
    return f"{angle:.4f} ({90.0 - angle:.4f})"


def _table_of_cones(listed: Sequence[synth.linkages.guidance.GuidedFourBar]) -> Any:
    rows = table("row", "ground driver coupler follower", "lambda (half angle)", "circuit", numbers=["row"])
    for number, four_bar in enumerate(listed, start=1):
        forms = _cones_json(four_bar)
        sizes = [(cone, _with_half_angle(cone["lambda_deg"])) for cone in forms["cones"]]
        sizes += [(family, " to ".join(map(_with_half_angle, family["interval_deg"]))) for family in forms["families"]]
        if not sizes:
            rows.add_row(str(number), "on no cone", "", "")
        for cone, size in sizes:
            links = " ".join(f"{angle:7.2f}" for angle in cone["link_angles_deg"])
            rows.add_row(str(number), links, size, cone["circuit"])
    return rows


def _table(listed: Sequence[synth.linkages.guidance.GuidedFourBar]) -> Any:
    from synth.linkages.guidance.order import direction_words

    rows = table(
        "driver G", "follower G", "ground driver coupler follower", "type", "driver turns", "defects",
        "transmission", numbers=["transmission"],
    )  # fmt: skip
    for four_bar in listed:
        g, h = (" ".join(f"{x:7.4f}" for x in dyad.fixed) for dyad in (four_bar.driver, four_bar.follower))
        links = " ".join(f"{degrees(angle):7.2f}" for angle in four_bar.link_angles)
        kind = f"{four_bar.kind.grashof} {four_bar.kind.name}"
        rows.add_row(
            g, h, links, kind, direction_words(four_bar.direction), ", ".join(four_bar.defects) or "none",
            f"{degrees(four_bar.transmission):.2f}",
        )  # fmt: skip
    return rows
