"""``synth mobility``: the mobility of the mechanisms in files."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING, Any

import click

import synth.analysis.verdict
from graphs.errors import FileError, numbered
from graphs.garbage import set_aside
from synth.cli import options
from synth.cli.output import about, console, plain, print_json, table
from synth.cli.reading import DRAWN, PRECISION, entries, precise

if TYPE_CHECKING:
    from rich.console import Console

_LONGEST_PATH = 4096


@click.command()
@options.FILES
@DRAWN
@options.flag("--json as_json", "Print a JSON list, one object per mechanism.")
@options.flag(
    "--exact/--no-exact",
    "Compute the exact generic rank. By default it is computed unless the mechanism is large.",
)  # fmt: skip
@options.flag("--hinge-flat", "Treat the flat (F) edges of a crease pattern as hinges too.")
@options.number("--pose", "FRAME", "Analyse this frame of a FOLD file; 0 is the key frame.", 0)
@options.flag("--no-geometry", "Treat every loop round a hole or cut as spatial, even if its axes meet in a point.")
@options.flag("--no-pose", "Leave out the infinitesimal degrees of freedom at the configuration of the file.")
@options.flag(
    "--motion/--no-motion look_for_motion",
    "Search for finite motions from the configuration of the file. By default the search is made unless the "
    "mechanism is large.",
)  # fmt: skip
@PRECISION
@options.flag("--more", "Search for motion branches with a hundred times the usual allowance, and list all of them.")
@options.flag("--verbose", "List all equations of mobility, with the reason why each applies or does not.")
def mobility(
    files: tuple[str, ...], as_json: bool, pose: int | None, no_pose: bool, no_geometry: bool,
    look_for_motion: bool | None, more: bool, verbose: bool, **counting: Any,
) -> None:  # fmt: skip
    """Report how a mechanism moves: its degrees of freedom, its motion branches, and the evidence.

    FILE holds an SC graph, an SCD graph, a polyhedron model or a vertex-edge graph (.json), a crease pattern
    (.fold, .svg, .dxf, .cp, .opx, .obj), or a bare link-joint graph (.g6, .s6, .graphml, .edges, .csv). One file
    gives a full report, several give a table.

    The verdict comes first: whether a crease pattern is rigid-foldable from its configuration, with how many
    degrees of freedom, and which creases are immobile; for a type without coordinates, what a generic realisation
    does. The evidence follows: counts by formula, the exact generic mobility, and the infinitesimal degrees of
    freedom of a crease pattern at its configuration. With --pose all numbers are those of another frame.

    \b
    Examples:
      synth mobility data/wiener/fortune-teller.json
      synth mobility data/patterns/bird-base.fold
    """
    if no_pose and pose is not None:
        raise click.UsageError("--pose and --no-pose exclude each other")
    counting["geometry"] = not no_geometry
    if not no_pose:
        counting |= {"frame": pose, "motion": look_for_motion, "more": more}
    judge = synth.analysis.verdict.mobility_of_type if no_pose else synth.mobility
    failures: list[str] = []
    answers: list[tuple[str, synth.analysis.verdict.JudgedMobility]] = []
    with set_aside(until=click.get_current_context().call_on_close):
        for entry in entries(files, failures):
            try:
                with about(entry.label):
                    answers.append((entry.label, judge(precise(entry.mechanism), **counting)))
            except FileError as error:
                failures.append(str(error))
    if as_json:
        print_json([{"file": label, **answer.to_json()} for label, answer in answers])
    elif len(answers) == 1 and not failures:
        [(label, answer)] = answers
        console().print(plain(label, _LONGEST_PATH), style="bold")
        for block in answer.blocks(verbose=verbose):
            console().print(block)
    elif answers:
        _print_table(console(), sorted(answers, key=lambda item: _in_number_order(item[0])), len(failures))
    for line in failures:
        click.echo(line, err=True)
    if failures:
        sys.exit(2)


def _in_number_order(label: str) -> list[str | int]:
    """Return a key that sorts numbers in names by value: chains.g6:2 before chains.g6:10."""
    return [int(part) if part.isdecimal() else part for part in re.split(r"([0-9]+)", label)]


def _print_table(out: Console, answers: list[tuple[str, synth.analysis.verdict.JudgedMobility]], failed: int) -> None:
    """Print one line per mechanism, with totals; of one file alone all notes are printed."""
    numbers = ("DOF", "N", "J", "L", "centres", "M", "exact", "pose", "notes")
    rows = table("file", "class", *numbers, numbers=numbers)
    common = set.intersection(*(set(answer.warnings) for _, answer in answers))
    for label, answer in answers:
        notes = len(answer.repairs) + len(set(answer.warnings) - common)
        rows.add_row(
            plain(label, _LONGEST_PATH),
            answer.mechanism_class,
            plain(answer.verdict.freedoms),
            *map(plain, (answer.links, answer.joints, answer.loops, answer.centres, answer.mobility)),
            plain(None if answer.exact is None else answer.exact.mobility),
            plain(None if answer.infinitesimal is None else answer.infinitesimal.dof),
            plain(notes or ""),
        )
    out.print(rows)
    out.print(f"{numbered(len(answers), 'mechanism')} reported, {failed} failed")
    for note in sorted(common):
        out.print(f"note, for all: {note}")
    if any(answer.repairs or set(answer.warnings) - common for _, answer in answers):
        out.print("notes are printed for a file on its own")
