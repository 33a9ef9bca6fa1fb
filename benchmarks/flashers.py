"""Flashers whose vertices are on a sphere where they are deployed, and whose panels wrap a hub where they are stowed.

    python benchmarks/flashers.py [SIDES ...]

A hub is a regular polygon of side 1 with its corners on the sphere. From each corner two lines go out: a valley,
which in the plane would continue a side of the hub, and a ridge, halfway to the next valley. Triangles between them
are rigid. Stowed, all panels are vertical on the sides of the prism over the hub, of no thickness, ridges above
valleys: vertex number k of a line is k corners farther round, and vertices at the same corner are above each other.
So each edge has a length in both configurations. Unknowns are two angles on the sphere and the height for each vertex
of a sector; all sectors are alike. Least squares with exact derivatives make the differences of lengths zero, from
starts at random beside the flasher of the plane put on the sphere. What closes is checked by the closure equations of
the deployed sheet at the fold angles of the stowed one, and by the verdict.

Two configurations of the same rigid panels are found, no motion that joins them: with panels of no thickness, those
that lie on each other when stowed say nothing of collisions. Angles and lengths are not rounded, nothing has slack.
Source: Lang, Magleby, Howell 2016 (planar); Wang et al., Mechanism and Machine Theory 167 (2022), on surfaces, 0.15 of
slack. Figures are written to benchmarks/results/flashers.json.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, pi, sin, tan
from pathlib import Path
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import synth
from graphs.convert.duality import mechanism_of_sheet
from graphs.least_squares.levenberg_marquardt import least_squares
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.folding.panel_collisions import shapes_of_panels
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.catalogue.patterns.panels import sheet_of_faces
from synth.synthesis.designing.search import SEARCH, seeded

RADIUS = 10.0
"""Of the sphere, in sides of the hub."""
RINGS = 3
SPREAD = 0.2
"""How far beside the first start others begin, in sides of the hub."""
STEPS = 200
CORNER = 5.0
"""The least corner of a panel, degrees: below it a design is degenerate."""

Vertex = tuple[str, int, int]
"""`valley` or `ridge`, number from the hub (0 of both is its corner), sector."""


@dataclass(frozen=True)
class Flasher:
    """The edges of a flasher of so many sides and rings, on a sphere, and how their lengths depend on its numbers.

    Numbers are azimuth, polar angle (times the radius) and stowed height of each vertex of the first sector.
    """

    sides: int
    rings: int = RINGS
    radius: float = RADIUS

    @property
    def hub(self) -> float:
        """The distance of the corners of the hub from its axis."""
        return 0.5 / sin(pi / self.sides)

    @cached_property
    def lines(self) -> list[tuple[str, int]]:
        """The vertices of a sector in the order of the numbers, without the corner of the hub."""
        return [(kind, ring) for ring in range(1, self.rings + 1) for kind in ("valley", "ridge")]

    def panels(self, sector: int) -> list[tuple[Vertex, Vertex, Vertex]]:
        """Return the triangles on both sides of the ridge of a sector, all turned alike."""
        found: list[tuple[Vertex, Vertex, Vertex]] = []
        for ring in range(1, self.rings + 1):
            here, before = ("ridge", ring, sector), ("ridge", ring - 1, sector)
            own, following = ("valley", ring, sector), ("valley", ring - 1, sector + 1)
            if ring > 1:
                found += [(before, ("valley", ring - 1, sector), own)]
            found += [(before, own, here), (before, here, following)]
            if ring > 1:
                found += [(before, following, ("valley", ring - 2, sector + 1))]
        return found

    @cached_property
    def edges(self) -> list[tuple[Vertex, Vertex]]:
        """One of each kind of edge that is alike in all sectors, without those of the hub."""
        kinds: dict[frozenset[tuple[str, int, int]], tuple[Vertex, Vertex]] = {}
        for panel in self.panels(0):
            for a, b in zip(panel, (*panel[1:], panel[0]), strict=True):
                if a[1] == b[1] == 0:
                    continue
                least = min(a[2], b[2])
                alike = ((kind if ring else "valley", ring, sector - least) for kind, ring, sector in (a, b))
                kinds.setdefault(frozenset(alike), (a, b))
        return list(kinds.values())

    def start(self) -> Floats:
        """Return the numbers of the flasher of the plane, put on the sphere along its axis."""
        corner, half = np.array([self.hub, 0.0]), pi / self.sides
        along = {"valley": -half, "ridge": 0.0}  # from the ray at right angles to the first axis, counterclockwise
        step = {"valley": 1.0, "ridge": 1.0 / cos(half)}
        numbers = []
        for kind, ring in self.lines:
            place = corner + ring * step[kind] * np.array([-sin(along[kind]), cos(along[kind])])
            polar = self.radius * float(np.arcsin(np.linalg.norm(place) / self.radius))
            height = ring * tan(pi / self.sides) if kind == "ridge" else 0.0
            numbers += [float(np.arctan2(place[1], place[0])), polar, height]
        return np.array(numbers)

    def place(self, vertex: Vertex, numbers: Floats, *, stowed: bool) -> tuple[Floats, Floats]:
        """Return where a vertex is, and the derivatives float[3, n]."""
        kind, ring, sector = vertex
        by = np.zeros((3, len(numbers)))
        first = 3 * self.lines.index((kind, ring)) if ring else None
        if stowed:
            corner = 2.0 * pi * (sector + ring) / self.sides
            height = 0.0 if first is None else float(numbers[first + 2])
            if first is not None:
                by[2, first + 2] = 1.0
            return np.array([self.hub * cos(corner), self.hub * sin(corner), height]), by
        azimuth = 2.0 * pi * sector / self.sides + (0.0 if first is None else float(numbers[first]))
        polar = float(np.arcsin(self.hub / self.radius)) if first is None else float(numbers[first + 1]) / self.radius
        s, c = sin(polar), cos(polar)
        if first is not None:
            by[:, first] = self.radius * s * np.array([-sin(azimuth), cos(azimuth), 0.0])
            by[:, first + 1] = c * cos(azimuth), c * sin(azimuth), -s
        return self.radius * np.array([s * cos(azimuth), s * sin(azimuth), c]), by

    def misses(self, numbers: Floats) -> tuple[Floats, Floats]:
        """Return how much longer each edge is deployed than stowed, and the derivatives."""
        off, by = np.zeros(len(self.edges)), np.zeros((len(self.edges), len(numbers)))
        for row, (a, b) in enumerate(self.edges):
            for stowed, sign in ((False, 1.0), (True, -1.0)):
                (one, by_one), (other, by_other) = (self.place(end, numbers, stowed=stowed) for end in (a, b))
                along = other - one
                length = float(np.linalg.norm(along))
                off[row] += sign * length
                by[row] += sign * (along / length if length > 0.0 else along) @ (by_other - by_one)
        return off, by

    def sheet(self, numbers: Floats, *, stowed: bool = False) -> synth.Sheet:
        """Return the whole sheet, hub first."""
        hub = [("valley", 0, sector) for sector in range(self.sides)]
        panels: list[tuple[Vertex, ...]] = [tuple(hub)]
        panels += [panel for sector in range(self.sides) for panel in self.panels(sector)]
        known: dict[Vertex, int] = {}
        faces = []
        for panel in panels:
            named = [(kind if ring else "valley", ring, sector % self.sides) for kind, ring, sector in panel]
            faces.append(tuple(known.setdefault(vertex, len(known)) for vertex in named))
        places = [tuple(self.place(vertex, numbers, stowed=stowed)[0].tolist()) for vertex in known]
        return sheet_of_faces(places, faces, f"Flasher of {self.sides} sides, {self.rings} rings", {})


def least_corner(sheet: synth.Sheet) -> float:
    """Return the least corner of the panels, degrees; -1 if one is turned over or has no area."""
    places = np.array(sheet.coordinates)
    least = pi
    for face in sheet.faces[1:]:
        a, b, c = places[list(face)]
        if not float(np.cross(b - a, c - a) @ (a + b + c)) > 0.0:
            return -1.0
        sides = [(b - a, c - a), (c - b, a - b), (a - c, b - c)]
        found = [float(np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v)) for u, v in sides]
        least = min(least, *found)
    return float(np.degrees(least))


def checked(flasher: Flasher, numbers: Floats) -> dict[str, object]:
    """Return what the engine says of a flasher: closure when stowed, panels that cross when deployed, its verdict."""
    deployed, stowed = (flasher.sheet(numbers, stowed=which) for which in (False, True))
    mechanism = mechanism_of_sheet(deployed)
    linkage, folded = (linkage_of_sheet(sheet, mechanism) for sheet in (deployed, stowed))
    places = np.array(deployed.coordinates)
    shapes = shapes_of_panels(deployed, mechanism, places, DOUBLE)
    return {
        "closure_stowed": float(f"{ClosureEquations(linkage).error(folded.angles):.1e}"),
        "panels_cross_deployed": shapes.crossing(places) is not None,
        "verdict": str(synth.mobility(deployed)).splitlines()[0],
    }


def row(sides: int, starts: int = 200) -> dict[str, object]:
    """Return the figures of a hub: how many starts closed, and the first flasher that did, else the least opening."""
    flasher, begun = Flasher(sides), process_time()
    first = flasher.start()
    free = np.full(len(first), np.inf)
    lengths = np.ones(len(first))
    lengths[::3] = np.abs(flasher.radius * np.sin(first[1::3] / flasher.radius))  # of an arc for a radian of azimuth
    rule = replace(SEARCH, most_trials=STEPS, least_gain=0.0)
    openings, found = [], []
    for start in range(starts):
        beside = SPREAD * seeded(f"flasher {sides}", start).normal(size=len(first)) if start else 0.0
        one = least_squares(flasher.misses, first + beside / lengths, rule, (-free, free))
        if one is not None:
            openings.append(float(np.abs(one.at.residual).max()))
            found.append(one.at.unknowns)
    closed = [number for number, opening in enumerate(openings) if opening <= DOUBLE.closed]
    sound = [number for number in closed if least_corner(flasher.sheet(found[number])) >= CORNER]
    best = (sound or closed or [int(np.argmin(openings))])[0]
    sheet = flasher.sheet(found[best])
    return {
        "panels": len(sheet.faces),
        "numbers": len(first),
        "lengths": len(flasher.edges),
        "starts": starts,
        "closed": len(closed),
        "sound": len(sound),
        "opening_of_the_start": float(f"{np.abs(flasher.misses(first)[0]).max():.2e}"),
        "opening": float(f"{openings[best]:.1e}"),
        "least_corner_deg": round(least_corner(sheet), 1),
        "off_sphere": float(f"{np.abs(np.linalg.norm(sheet.coordinates, axis=1) - flasher.radius).max():.1e}"),
        "radius_deployed": round(float(np.linalg.norm(np.array(sheet.coordinates)[:, :2], axis=1).max()), 3),
        "radius_stowed": round(flasher.hub, 3),
        "height_stowed": round(float(np.ptp([0.0, *found[best][2::3]])), 3),
        **checked(flasher, found[best]),
        "seconds": round(process_time() - begun, 1),
    }


def main() -> None:
    """Measure all hubs or those named, print and write."""
    hubs = [int(word) for word in sys.argv[1:]] or [3, 4, 6, 8]
    rows = {}
    for sides in hubs:
        rows[str(sides)] = row(sides)
        print(sides, json.dumps(rows[str(sides)]), flush=True)
    if hubs == [3, 4, 6, 8]:
        result = {"python": platform.python_version(), "rings": RINGS, "radius": RADIUS, "hubs": rows}
        Path(__file__).with_name("results").joinpath("flashers.json").write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
