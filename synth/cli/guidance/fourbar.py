"""``synth fourbar``: four-bars that guide a body through orientations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from synth.cli.guidance.dyads import AXES, asked_for, samples_option
from synth.cli.guidance.order import ORIENTATIONS
from synth.cli.output import FORCE, about, check_output, console, plain, print_json, table

if TYPE_CHECKING:
    from graphs.arrays import Floats
    from synth.guidance.fourbars import GuidedFourBar
    from synth.guidance.orientations import Orientations

__all__ = ["fourbar"]


@click.command(short_help="Find the four-bars that guide their coupler through orientations.")
@ORIENTATIONS
@AXES
@samples_option(200)
@click.option(
    "--best",
    type=click.IntRange(min=1),
    default=12,
    show_default=True,
    metavar="K",
    help="Largest number of four-bars to list.",
)
@click.option("--usable", is_flag=True, help="List only four-bars without defects.")
@click.option("--cones", is_flag=True, help="Map each four-bar listed to cones.")
@click.option(
    "--motion", metavar="OUT.json", help="Write the motion of the best four-bar without defects, as orientations."
)
@click.option("--steps", type=click.IntRange(1, 100_000), default=20, show_default=True, metavar="N",
              help="Number of steps of the motion between two orientations.")  # fmt: skip
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object.")
def fourbar(
    file: str,
    axes: tuple[tuple[float, float, float], ...],
    samples: int,
    best: int,
    usable: bool,
    cones: bool,
    motion: str | None,
    steps: int,
    force: bool,
    as_json: bool,
) -> None:
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
    from synth.guidance.fourbars import four_bars
    from synth.guidance.orientations import read_orientations, write_orientations

    check_output(motion, force=force)
    orientations = read_orientations(file)
    with about(file):
        found = four_bars(orientations, asked_for(orientations, axes, samples).dyads)
    good = [one for one in found if not one.defects]
    frames = None
    if motion is not None:
        with about(file):
            made = _motion(orientations, good, steps)
            write_orientations(made, motion, force=force)
            frames = len(made)
    listed = (good if usable else found)[:best]
    if as_json:
        print_json(
            {
                "file": file,
                "orientations": len(orientations),
                "fourbars": [_told(one, cones) for one in listed],
                "found": len(found),
                "usable": len(good),
                "motion": None if motion is None else {"file": motion, "frames": frames},
            }
        )
        return
    out = console()
    out.print(f"{len(orientations)} orientations: {len(found)} four-bar(s), {len(good)} without defects")
    out.print(_table(listed))
    if cones:
        out.print(_table_of_cones(listed))
    if motion is not None:
        out.print(f"written: {plain(motion, 4096)} ({frames} orientations)")


def _motion(orientations: Orientations, good: list[GuidedFourBar], steps: int) -> Floats:
    """Return the motion of the best four-bar, as quaternions."""
    from graphs.errors import UnsolvableError
    from synth.guidance.fourbars import motion_of

    if not good:
        raise UnsolvableError("no four-bar without defects: there is no motion to write")
    return motion_of(orientations, good[0], steps).quaternions


def _told(four_bar: GuidedFourBar, cones: bool) -> dict[str, Any]:
    return {**four_bar.to_json(), **(_told_cones(four_bar) if cones else {})}


def _told_cones(four_bar: GuidedFourBar) -> dict[str, Any]:
    """Return every cone, and interval of cones, on which a four-bar can lie."""
    from synth.guidance.fourbars import conical_forms

    forms = conical_forms(four_bar)
    return {
        "cones": [cone for form in forms for cone in form.cones_json()],
        "families": [family for form in forms for family in form.families_json()],
    }


def _table_of_cones(listed: Sequence[GuidedFourBar]) -> Any:
    rows = table("row", "ground driver coupler follower", "cone angle", "circuit", numbers=["row", "cone angle"])
    for number, one in enumerate(listed, start=1):
        told_ = _told_cones(one)
        found = [(cone, f"{cone['lambda_deg']:.4f}") for cone in told_["cones"]]
        found += [(family, "{:.4f} to {:.4f}".format(*family["interval_deg"])) for family in told_["families"]]
        if not found:
            rows.add_row(str(number), "on no cone", "", "")
        for cone, size in found:
            links = " ".join(f"{angle:7.2f}" for angle in cone["link_angles_deg"])
            rows.add_row(str(number), links, size, cone["circuit"])
    return rows


def _table(listed: Sequence[GuidedFourBar]) -> Any:
    from math import degrees

    from synth.guidance.order import direction_words

    rows = table(
        "driver G", "follower G", "ground driver coupler follower", "type", "driver turns", "defects",
        "transmission", numbers=["transmission"],
    )  # fmt: skip
    for one in listed:
        g, h = (" ".join(f"{x:7.4f}" for x in dyad.fixed) for dyad in (one.driver, one.follower))
        links = " ".join(f"{degrees(angle):7.2f}" for angle in one.link_angles)
        kind = f"{one.kind.grashof} {one.kind.name}"
        rows.add_row(
            g, h, links, kind, direction_words(one.direction), ", ".join(one.defects) or "none",
            f"{degrees(one.transmission):.2f}",
        )  # fmt: skip
    return rows
