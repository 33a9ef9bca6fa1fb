"""``synth mobility``: the mobility of the mechanisms in files."""

from __future__ import annotations

import gc
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Literal

import click

from synth.cli.output import about, console, entries, plain, print_json, table

if TYPE_CHECKING:
    from rich.console import Console

    from synth.verdict.judged import JudgedMobility

__all__ = ["mobility"]

_LONGEST_PATH = 4096


@click.command(short_help="Say whether it moves, with how many freedoms, and how that is known.")
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON list, one object a mechanism.")
@click.option(
    "--exact/--no-exact",
    default=None,
    help="Compute the exact generic rank (by default, of what is not too large).",
)
@click.option("--hinge-flat", is_flag=True, help="Make hinges of the flat (F) edges of a crease pattern too.")
@click.option("--pose", type=click.IntRange(min=0), metavar="FRAME", help="Ask about this frame of a FOLD file.")
@click.option(
    "--no-geometry",
    is_flag=True,
    help="Take all loops round holes and cuts of a crease pattern for spatial, wherever their axes meet.",
)
@click.option("--no-pose", is_flag=True, help="Leave out the freedoms at the coordinates.")
@click.option(
    "--motion/--no-motion",
    "look_for_motion",
    default=None,
    help="Look for finite motions from the coordinates (by default, of what is not too large).",
)
def mobility(
    files: tuple[str, ...],
    as_json: bool,
    exact: bool | None,
    hinge_flat: bool,
    pose: int | None,
    no_pose: bool,
    no_geometry: bool,
    look_for_motion: bool | None,
) -> None:
    """Say how a mechanism moves, with how many degrees of freedom, and how that is known.

    FILE is an SC graph, an SCD graph, a polyhedron model or a vertex-edge graph (.json), a crease pattern
    (.fold, .svg, .dxf, .cp, .opx, .obj), or a bare link-joint graph (.g6, .s6, .graphml, .edges, .csv). One file
    gives the whole report, several give a table.

    The verdict comes first: whether a crease pattern folds from its coordinates, with how many freedoms, which
    creases cannot move; of a type without coordinates, what it does in general position. What supports it follows:
    counts, which are formulas, the exact generic mobility, and the infinitesimal freedoms of a crease pattern as
    it lies. By --pose all numbers are those of another frame (0 is the key frame).

    \b
    Example:
      synth mobility data/wiener/fortune-teller.json
      synth mobility data/patterns/bird-base.fold
    """
    from graphs.errors import FileError
    from synth.verdict.judged import mobility as asked

    if no_pose and pose is not None:
        raise click.UsageError("--pose names a pose that --no-pose leaves out")
    lies: int | Literal[False] | None = False if no_pose else pose
    failures: list[str] = []
    answers: list[tuple[str, JudgedMobility]] = []
    with _objects_stay():
        for entry in entries(files, failures):
            try:
                with about(entry.label):
                    answer = asked(
                        entry.mechanism,
                        exact=exact,
                        hinge_flat=hinge_flat,
                        pose=lies,
                        geometry=not no_geometry,
                        motion=look_for_motion,
                    )
                    answers.append((entry.label, answer))
            except FileError as error:
                failures.append(str(error))
    if as_json:
        print_json([{"file": label, **answer.to_json()} for label, answer in answers])
    elif len(answers) == 1 and not failures:
        _print_answer(*answers[0])
    elif answers:
        _print_table(console(), sorted(answers, key=lambda item: _in_number_order(item[0])), len(failures))
    for line in failures:
        click.echo(line, err=True)
    if failures:
        sys.exit(2)


@contextmanager
def _objects_stay() -> Iterator[None]:
    """Pause the garbage collector: to look through what was read again and again takes as long as the rest."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _in_number_order(label: str) -> list[str | int]:
    """Return what sorts names as people do: chains.g6:2 before chains.g6:10."""
    return [int(part) if part.isdecimal() else part for part in re.split(r"([0-9]+)", label)]


def _print_answer(label: str, answer: JudgedMobility) -> None:
    out = console()
    out.print(plain(label, _LONGEST_PATH), style="bold")
    for block in answer.blocks():
        out.print(block)


def _print_table(out: Console, answers: list[tuple[str, JudgedMobility]], failed: int) -> None:
    """Print a line a mechanism, with totals; one file alone tells its notes in full."""
    rows = table(
        "file",
        "class",
        *(numbers := ("freedoms", "N", "J", "L", "centres", "M", "exact", "pose", "notes")),
        numbers=numbers,
    )
    common = set.intersection(*(set(answer.warnings) for _, answer in answers))
    for label, answer in answers:
        notes = len(answer.repairs) + len(set(answer.warnings) - common)
        rows.add_row(
            plain(label, _LONGEST_PATH),
            answer.mechanism_class,
            plain(None if answer.verdict is None else answer.verdict.freedoms),
            *map(plain, (answer.links, answer.joints, answer.loops, answer.centres, answer.mobility)),
            plain(None if answer.exact is None else answer.exact.mobility),
            plain(None if answer.pose is None else answer.pose.dof),
            plain(notes or ""),
        )
    out.print(rows)
    out.print(f"{len(answers)} mechanism(s) reported, {failed} failed")
    for note in sorted(common):
        out.print(f"note, for all: {note}")
    if any(answer.repairs or set(answer.warnings) - common for _, answer in answers):
        out.print("ask for one file alone to read its notes")
