"""``synth mobility``: the mobility of the mechanisms in files."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import about, console, entries, plain, print_json, table

if TYPE_CHECKING:
    from rich.console import Console

    from graphs.convert.table import Mechanism
    from graphs.count.report import MobilityReport
    from graphs.mechanism.sheet import Sheet

__all__ = ["mobility"]

_LONGEST_PATH = 4096


@click.command(short_help="Say how many freedoms a mechanism has, and which formula tells.")
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON list, one object a mechanism.")
@click.option(
    "--exact/--no-exact",
    default=None,
    help="Compute the exact generic rank (by default, of what is not too large).",
)
@click.option("--hinge-flat", is_flag=True, help="Make hinges of the flat (F) edges of a crease pattern too.")
@click.option(
    "--pose", type=click.IntRange(min=0), metavar="FRAME", help="Freedoms as this frame of a FOLD file lies."
)
def mobility(
    files: tuple[str, ...], as_json: bool, exact: bool | None, hinge_flat: bool, pose: int | None
) -> None:
    """Say how many degrees of freedom a mechanism has, and which formula tells.

    FILE is an SC graph, an SCD graph, a polyhedron model or a vertex-edge graph (.json), a crease pattern
    (.fold, .svg, .cp, .obj), or a bare link-joint graph (.g6, .s6, .graphml, .edges). One file gives the whole
    report, several give a table.

    Counts are formulas. Beside them stand the exact generic mobility, and the freedoms of a crease pattern as it
    lies, by --pose in another frame (0 is the key frame).

    \b
    Example:
      synth mobility data/wiener/fortune-teller.json
    """
    from graphs.errors import FileError

    failures: list[str] = []
    reports: list[tuple[str, MobilityReport]] = []
    with _objects_stay():
        for entry in entries(files, failures):
            try:
                with about(entry.label):
                    reports.append((entry.label, _report(entry.label, entry.mechanism, exact, hinge_flat, pose)))
            except FileError as error:
                failures.append(str(error))
    if as_json:
        print_json([report.to_json(label) for label, report in reports])
    elif len(reports) == 1 and not failures:
        _print_report(console(), *reports[0])
    elif reports:
        _print_table(console(), sorted(reports, key=lambda item: item[0]), len(failures))
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


def _report(
    label: str, mechanism: Mechanism, exact: bool | None, hinge_flat: bool, pose: int | None
) -> MobilityReport:
    from graphs.answer import model_with_exact, with_exact
    from graphs.convert.table import to_sc
    from graphs.count.report import mobility_report
    from graphs.mechanism.polyhedron import PolyhedronModel
    from graphs.mechanism.sc import SCGraph
    from graphs.mechanism.sheet import Sheet

    if isinstance(mechanism, Sheet):
        return _report_of_sheet(label, mechanism, exact, hinge_flat, pose)
    if isinstance(mechanism, PolyhedronModel):
        report = mobility_report(mechanism)
        return report if exact is False else model_with_exact(report, mechanism, demanded=bool(exact))
    notes = [] if pose is None else ["no freedoms at a pose: a graph has no coordinates"]
    sc = mechanism if isinstance(mechanism, SCGraph) else to_sc(mechanism)
    report = mobility_report(sc).with_notes(warnings=notes)
    return report if exact is False else with_exact(report, sc, demanded=bool(exact))


def _report_of_sheet(
    label: str, sheet: Sheet, exact: bool | None, hinge_flat: bool, pose: int | None
) -> MobilityReport:
    """Report a crease pattern; where flat edges matter, say what it is the other way round."""
    from graphs.answer import with_exact, with_pose
    from graphs.convert.duality import mechanism_of_sheet
    from graphs.count.report import mobility_report
    from graphs.files.formats import read_frame

    found = mechanism_of_sheet(sheet, hinge_flat=hinge_flat)
    report = mobility_report(found.sc)
    report = replace(report, counts={**report.counts, "interior_vertices": found.interior_vertices})
    notes = []
    if flaps := report.counts["flaps"]:
        notes.append(f"{flaps} flap(s), panels with one hinge: a freedom each")
    if "F" in sheet.assignments:
        other = mechanism_of_sheet(sheet, hinge_flat=not hinge_flat)
        if len(other.sc) != len(found.sc):
            mobility = mobility_report(other.sc).mobility
            way = "merged" if hinge_flat else "hinged"
            notes.append(
                f"with flat edges {way}: links {len(other.sc)}, joints {len(other.sc.joints)}, M {mobility}"
            )
    report = report.with_notes(found.repairs, (*found.warnings, *notes))
    if exact is not False:
        report = with_exact(report, found.sc, demanded=bool(exact))
    has_frames = label.lower().endswith(".fold")
    lying = sheet
    if pose or (has_frames and (pose is not None or sheet.coordinates is None)):
        lying = read_frame(label, pose)
    return with_pose(report, lying, hinge_flat=hinge_flat, demanded=pose is not None)


_TITLES = {
    "traditional_cgk": "C-G-K (Wiener Eq. 1)",
    "modified_cgk": "modified C-G-K (Wiener Eq. 2)",
    "spherical_system": "spherical system (Wiener Eq. 3)",
    "polyhedron": "polyhedron (Wiener Eq. 4)",
    "loop_form": "loop form",
    "closed_surface": "closed surface",
    "wampler_eq5": "Wampler Eq. 5, rods",
    "wampler_eq6": "Wampler Eq. 6, points",
    "wampler_eq7": "Wampler Eq. 7, S+3",
    "wampler_eq8": "Wampler Eq. 8, S+k",
    "wampler_eq9": "Wampler Eq. 9, scissors",
    "wampler_eq10": "Wampler Eq. 10, no ground",
}

_COUNTS = {
    "vertices": "vertices V",
    "implicit_centres": "implicit centres C",
    "edges": "rods E",
    "external_edges": "external edges",
    "internal_edges": "internal edges",
    "spatial_loops": "spatial loops",
    "flaps": "flaps",
    "interior_vertices": "interior vertices",
    "parts": "parts",
    "remote": "sum of k over remote centres",
    "on_plane": "points on planes P",
    "on_line": "points on lines L",
    "scissors": "scissors X",
}


def _print_report(out: Console, label: str, report: MobilityReport) -> None:
    out.print(plain(label, _LONGEST_PATH), style="bold")
    out.print(f"mobility M = {plain(report.mobility)}   ({report.mechanism_class})")
    if report.exact is not None:
        out.print(
            f"exact generic mobility {report.exact['mobility']}   (rank {report.exact['rank']} modulo two primes)"
        )
    if report.pose is not None:
        out.print(_pose_line(report.pose))
    known = [
        ("links N", report.links),
        ("joints J", report.joints),
        ("loops L", report.loops),
        ("centres", report.centres),
        *((title, report.counts.get(key)) for key, title in _COUNTS.items()),
    ]
    out.print(", ".join(f"{title} {value}" for title, value in known if value is not None))
    rows = table("equation", "M", "applies", "why", numbers=["M"])
    for name, one in report.equations.items():
        rows.add_row(_TITLES[name], plain(one.value), "yes" if one.applies else "no", one.why)
    out.print(rows)
    for kind, notes in (("repaired", report.repairs), ("note", report.warnings)):
        for note in notes:
            out.print(f"{kind}: {note}")


def _pose_line(pose: Mapping[str, Any]) -> str:
    """Say in a line how a crease pattern can move as it lies."""
    if pose["dof"] is None:
        return "as it lies: indeterminate"
    gap = "no zero singular value" if pose["gap"] is None else f"gap {pose['gap']:.0e}"
    state = "flat state: more infinitesimal freedoms than when folded; " if pose["flat"] else ""
    over = "" if pose["h"] is None else f"h = {pose['h']}, "
    return f"as it lies: {pose['dof']} infinitesimal freedom(s)   ({state}{over}{gap})"


def _print_table(out: Console, reports: list[tuple[str, MobilityReport]], failed: int) -> None:
    """Print a line a mechanism, with totals; one file alone tells its notes in full."""
    rows = table(
        "file", "class", *(numbers := ("N", "J", "L", "centres", "M", "exact", "pose", "notes")), numbers=numbers
    )
    common = set.intersection(*(set(report.warnings) for _, report in reports))
    for label, report in reports:
        notes = len(report.repairs) + len(set(report.warnings) - common)
        rows.add_row(
            plain(label, _LONGEST_PATH),
            report.mechanism_class,
            *map(plain, (report.links, report.joints, report.loops, report.centres, report.mobility)),
            plain(None if report.exact is None else report.exact["mobility"]),
            plain(None if report.pose is None else report.pose["dof"]),
            plain(notes or ""),
        )
    out.print(rows)
    out.print(f"{len(reports)} mechanism(s) reported, {failed} failed")
    for note in sorted(common):
        out.print(f"note, for all: {note}")
    if any(report.repairs or set(report.warnings) - common for _, report in reports):
        out.print("ask for one file alone to read its notes")
