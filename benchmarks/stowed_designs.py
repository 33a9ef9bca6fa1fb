"""Sheets whose stowed box is small beside the deployed one, at equal panels and area: before and after `synth.design`.

    python benchmarks/stowed_designs.py [NAME ...]

A Miura sheet, a storey of Kresling's pattern, a box that pops up from a card, and two types of eight links. The box is
that of `synth design`: along principal axes, edges at least so long as the thickness; its size is the product of the
two longest edges. Ratios of default and design are measured again by `synth.fold` from the sheet as it is drawn, with
collisions looked for on the way. The storey, whose polygons are open, has six degrees of freedom and six driven
creases, at angles of the default while its crease 2 is pushed in, in whole degrees.
Figures are written to benchmarks/results/stowed_designs.json.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import islice
from math import radians
from pathlib import Path
from time import process_time
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import synth
from synth.catalogue.patterns import GENERATORS
from synth.synthesis.designing import (
    EdgeLengths,
    Goal,
    PanelCorners,
    SheetArea,
    SizeRatio,
    WishedConfiguration,
    Wishes,
    design,
)

THICKNESS = 0.02
"""Of the material, in units of the sheets, which are one to four of them long."""
WISHED = 0.65
"""The ratio that is wished, in parts of the default: 30 % less and some to spare."""


@dataclass(frozen=True)
class Case:
    """A sheet, the angles of its driven creases where it is deployed and stowed, degrees, and what stays."""

    make: Callable[[], synth.Sheet]
    deployed: Mapping[str, float]
    stowed: Mapping[str, float]
    generator: str = ""
    how: Mapping[str, Any] = field(default_factory=dict)
    convex: bool = True
    corner: float = 15.0
    """The least corner, degrees."""
    edge: float = 0.15
    """The least edge, in parts of the shortest of the default."""
    rules: tuple[Any, ...] = ()


def _eight_links(number: int) -> Callable[[], synth.Sheet]:
    """Return what realises a type of eight links and one freedom by its number in the list of SCD graphs."""

    def make() -> synth.Sheet:
        graph = next(islice(synth.scd_graphs(8, 1, max_degree=4), number, None))
        return synth.realise(graph).sheet

    return make


def _generated(name: str, **parameters: float) -> Callable[[], synth.Sheet]:
    return lambda: synth.generate(name, **parameters).mechanism


CASES = {
    "Miura, 9 panels": Case(_generated("miura"), {"2": 40.0}, {"2": 150.0}, "miura"),
    "storey of Kresling's pattern": Case(
        _generated("kresling"),
        {"1": -27.0, "2": 0.0, "7": -43.0, "14": -27.0, "19": -68.0, "22": -27.0},
        {"1": -41.0, "2": 157.0, "7": -53.0, "14": -43.0, "19": -105.0, "22": -41.0},
    ),
    "box from a card": Case(_generated("box-pop-up"), {"1": 90.0}, {"1": 170.0}, "box-pop-up", convex=False),
    "eight links, number 23": Case(_eight_links(23), {"1": 18.0}, {"1": 125.0}),
    "eight links, number 69": Case(_eight_links(69), {"3": 18.0}, {"3": 116.0}),
}


def _box(places: np.ndarray) -> float:
    """Return the product of the two longest edges of the box along principal axes."""
    centred = places - places.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1]
    edges = np.sort(np.maximum(np.ptp(centred @ axes, axis=0), THICKNESS))
    return float(edges[1] * edges[2])


def measured(sheet: synth.Sheet, case: Case) -> tuple[float, bool]:
    """Return the box of a sheet stowed over deployed, by its motion, and whether no panels cross on the way."""
    sizes, free = [], True
    for angles in (case.deployed, case.stowed):
        drive = {int(joint): radians(angle) for joint, angle in angles.items()}
        motion = synth.fold(sheet, drive=drive, frames=12, collisions=True)
        free &= not motion.path.stopped
        sizes.append(_box(np.array(motion.sheets()[-1].coordinates)))
    return sizes[1] / sizes[0], free


def area_of(sheet: synth.Sheet) -> float:
    """Return the area of all panels."""
    places = np.zeros((sheet.vertices, 3))
    places[:, : len(sheet.coordinates[0])] = sheet.coordinates
    return sum(
        float(np.linalg.norm(np.cross(places[list(face)], np.roll(places[list(face)], -1, axis=0)).sum(axis=0)) / 2)
        for face in sheet.faces
    )


def wishes_of(case: Case, sheet: synth.Sheet, ratio: float) -> Wishes:
    """Return the wish for a ratio, at equal area, with least corners and edges."""
    places = np.array(sheet.coordinates)
    least = min(float(np.linalg.norm(places[a] - places[b])) for a, b in sheet.edges)
    wish = SizeRatio(at="stowed", over="deployed", size_of="area", goal=Goal(at_most=ratio), thickness=THICKNESS)
    rules = (
        SheetArea(goal=Goal(equals=area_of(sheet))),
        PanelCorners(goal=Goal(at_least=radians(case.corner), at_most=np.pi if case.convex else None)),
        EdgeLengths(goal=Goal(at_least=case.edge * least)),
        *case.rules,
    )
    configurations = tuple(
        WishedConfiguration(name, {joint: radians(angle) for joint, angle in angles.items()})
        for name, angles in (("deployed", case.deployed), ("stowed", case.stowed))
    )
    return Wishes((wish,), configurations, rules, **case.how)


def row(name: str, starts: int = 4) -> dict[str, object]:
    """Return the figures of one case: the first design that meets the wish, else the nearest."""
    case = CASES[name]
    sheet = case.make()
    before = measured(sheet, case)[0]
    wishes = wishes_of(case, sheet, WISHED * before)
    begun = process_time()
    for start in range(1, starts + 1):
        designs = design(GENERATORS[case.generator] if case.generator else sheet, wishes, starts=start)
        if designs.best is not None and designs.best.figures[0].met:
            break
    one = designs.best or designs.failures[0]
    seconds = process_time() - begun
    after, free = measured(one.mechanism, case)
    return {
        "panels": len(sheet.faces),
        "ratio_before": round(before, 4),
        "ratio_after": round(after, 4),
        "improved_percent": round(100 * (1 - after / before), 1),
        "area_changed": float(f"{abs(area_of(one.mechanism) / area_of(sheet) - 1):.1e}"),
        "residual": float(f"{one.error:.1e}"),
        "no_collision": bool(free),
        "success": one.success,
        "faults": list(one.faults),
        "verdict": str(synth.mobility(one.mechanism)).splitlines()[0],
        "starts": start,
        "seconds": round(seconds, 1),
    }


def main() -> None:
    """Measure all or those named, print and write."""
    names = sys.argv[1:] or list(CASES)
    rows = {}
    for name in names:
        rows[name] = row(name)
        print(name, json.dumps(rows[name]), flush=True)
    if names == list(CASES):
        result = {"python": platform.python_version(), "thickness": THICKNESS, "sheets": rows}
        Path(__file__).with_name("results").joinpath("stowed_designs.json").write_text(
            json.dumps(result, indent=2) + "\n"
        )


if __name__ == "__main__":
    main()
