"""``synth layers``: whether a crease pattern folds flat, and in how many layer orders."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

import synth.layering
from graphs.errors import check_argument
from graphs.mechanism import Sheet
from synth.cli import options
from synth.cli.output import about, print_answer, print_json
from synth.cli.reading import MECHANISM, PRECISION, precise_sheet, read

if TYPE_CHECKING:
    from synth.layering import FlatFolding, LayerOrder


@click.command()
@MECHANISM
@options.number("--frame", "N", "Frame of a FOLD file; 0 is the key frame.", 0)
@options.number("--order", "N", "Print this layer order, counted from 0: the panels over each cell, from below.", 0)
@options.number("--sample", "SEED", "Print a layer order drawn at random, each as likely as any other.", 0)
@options.flag(
    "--explain/--no-explain",
    "If there is no layer order, find panels and conditions that contradict each other, none of which can go.",
    default=True,
)
@options.JSON
@PRECISION
def layers(file: str, frame: int | None, order: int | None, sample: int | None, explain: bool, as_json: bool) -> None:
    """Check whether a crease pattern folds flat, and count its layer orders exactly.

    Every mountain, valley and unassigned crease is folded by 180 degrees. Vertices are checked first (Kawasaki,
    Maekawa, crimps), then whether the folded image closes; then the orders of the panels in which the paper passes
    nowhere through itself are counted, component by component. A layer order that is printed is checked by geometry
    alone.

    \b
    Examples:
      synth layers data/patterns/bird-base.fold
      synth layers data/patterns/bird-base.fold --order 0

    Exit status 1: the pattern does not fold flat.
    """
    if order is not None and sample is not None:
        raise click.UsageError("--order and --sample exclude each other")
    mechanism = read(file)
    with about(file):
        check_argument("layers", mechanism, Sheet)
        answer = synth.layering.layers(precise_sheet(mechanism), frame=frame, explain=explain)
        shown = _shown(answer, order, sample) if answer.foldable else None
    if as_json:
        print_json({"file": file, **answer.to_json(), "order": None if shown is None else shown.to_json()})
    else:
        print_answer(answer)
        if shown is not None:
            print_answer(shown)
    if not answer.foldable:
        sys.exit(1)


def _shown(answer: FlatFolding, order: int | None, sample: int | None) -> LayerOrder | None:
    """Return the layer order that was asked for, if any."""
    if order is not None:
        return answer.order(order)
    return None if sample is None else answer.sample(sample)
