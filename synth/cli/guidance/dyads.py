"""``synth dyads``: RR dyads that guide a body through orientations."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from synth.cli.guidance.order import AXIS, ORIENTATIONS
from synth.cli.output import FORCE, about, check_picture, print_answer, print_json, tell_written

if TYPE_CHECKING:
    from synth.guidance.dyads import Dyad
    from synth.guidance.orientations import Orientations
    from synth.guidance.synthesis import GuidingDyads

__all__ = ["AXES", "asked_for", "dyads", "samples_option"]

_Command = TypeVar("_Command", bound=Callable[..., Any])

AXES = click.option(
    "--axis",
    "axes",
    type=AXIS,
    multiple=True,
    metavar="X,Y,Z",
    help="Direction of a fixed axis, required for three orientations; may be repeated.",
)


def samples_option(most: int) -> Callable[[_Command], _Command]:
    """Return the option for how many dyads to take from the curves of four orientations."""
    return click.option(
        "--samples",
        type=click.IntRange(8, most),
        default=36,
        show_default=True,
        metavar="N",
        help="Number of dyads on each curve, for four orientations.",
    )


@click.command(short_help="Find the RR dyads that guide a body through orientations.")
@ORIENTATIONS
@AXES
@samples_option(100_000)
@click.option(
    "-o",
    "--picture",
    metavar="OUT",
    help="Draw a map of the sphere, coloured by order, to this file (.svg, .png or .pdf).",
)
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object.")
def dyads(
    file: str,
    axes: tuple[tuple[float, float, float], ...],
    samples: int,
    picture: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Find the RR dyads, fixed axis G and moving axis W, that guide a body through orientations.

    For three orientations every fixed axis has a dyad, so --axis is required. For four there are curves of dyads,
    which are sampled. For five there are up to six dyads, and all are found. For more orientations the
    best-fitting dyads are found. W is in the frame of the body. The residual is the largest |G . (Mi - M1) W|.

    \b
    Example:
      synth dyads --orientations data/orientations/tipparthi.json
    """
    from synth.guidance.orientations import read_orientations

    check_picture(picture, force=force)
    orientations = read_orientations(file)
    with about(file):
        guiding = asked_for(orientations, axes, samples)
        if picture is not None:
            from synth.drawing.scene.writing import save_scene

            save_scene(_drawn(orientations, guiding.dyads), picture, force=force)
    if as_json:
        print_json({"file": file, **guiding.to_json()})
        return
    print_answer(guiding)
    tell_written(picture)


def asked_for(
    orientations: Orientations, axes: tuple[tuple[float, float, float], ...], samples: int
) -> GuidingDyads:
    """Return the dyads of orientations; what is missing for them is a matter of usage."""
    from synth.guidance.synthesis import guiding_dyads

    if axes and len(orientations) != 3:
        raise click.UsageError(f"--axis is for three orientations; here are {len(orientations)}")
    if not axes and len(orientations) == 3:
        raise click.UsageError("three orientations leave the fixed axis to be chosen: add --axis x,y,z")
    return guiding_dyads(orientations, axes, samples)


def _drawn(orientations: Orientations, found: tuple[Dyad, ...]) -> Any:
    from synth.drawing.order_map import draw_map

    if len(orientations) == 4:
        from synth.guidance.dyads import centre_axes

        return draw_map(orientations, (), centre_axes(orientations, 720))
    return draw_map(orientations, found)
