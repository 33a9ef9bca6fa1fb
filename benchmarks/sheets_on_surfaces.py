"""Triangulated sheets whose vertices are to lie on a bowl and on a hyperbolic paraboloid where they are folded.

    python benchmarks/sheets_on_surfaces.py [NAME ...]

The sheet is given folded, all its vertices may change, and a configuration in which all fold angles are 0 is to close:
so the sheet is made of flat material. The bowl is a cap of a unit sphere, the hypar z = x y / 2 over a square of side
2, its border on the straight sides of the surface. Distances are those of 10 000 points of the sheet from the part of
the surface, and of 10 000 points of that from the sheet, in parts of the largest distance of two points of the
surface. Designs are unfolded again by `synth.fold`, which shares nothing with the search, to a tenth of their fold
angles, with collisions looked for. Figures are written to benchmarks/results/sheets_on_surfaces.json.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations
from math import cos, radians, sin, sqrt, tan
from pathlib import Path
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from scipy.linalg import null_space, qr
from scipy.spatial import cKDTree

import synth
from graphs.geometry import unit
from graphs.types import Floats
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns.panels import sheet_of_faces
from synth.synthesis.designing import EdgeLengths, Goal, JointAngle, PointsOn, WishedConfiguration, Wishes
from synth.synthesis.designing.designs import DesignSearch
from synth.synthesis.designing.placement import DesignPoint
from synth.synthesis.designing.targets import Formula, Mesh

SAMPLES = 10_000
NEAR_FLAT = 0.1
"""Part of its fold angles to which a design is unfolded: the flat state itself is singular."""
FINE = 200
"""Parts of the side of a hypar from whose points the nearest point is looked for."""
ROUNDS = 40


@dataclass(frozen=True)
class Case:
    """A folded sheet that is nearly on its surface, wishes, and the distances from the surface and points of it."""

    sheet: synth.Sheet
    wishes: Wishes
    off: Callable[[Floats], Floats]
    points: Callable[[int, np.random.Generator], Floats]
    size: float


def flat_state(sheet: synth.Sheet) -> WishedConfiguration:
    """Return the configuration in which all fold angles are 0."""
    return WishedConfiguration("flat", {str(joint): 0.0 for joint in configuration_of(sheet).joints})


def hypar(rings: int, slope: float, offset: float, least: float, most: float) -> Case:
    """Return squares about a centre on z = slope x y, every second one above the surface, their trapezoids halved.

    With four vertices on the border, which stay, it has one degree of freedom. No edge becomes shorter than a part
    `least` of the distance of squares, no fold angle larger than `most`, radians.
    """
    places: list[Floats] = [np.zeros(3)]
    for ring in range(1, rings + 1):
        part = ring / rings
        for x, y in ((part, part), (-part, part), (-part, -part), (part, -part)):
            normal = np.array([-slope * y, -slope * x, 1.0])
            above = (-1) ** ring * offset * part * (ring < rings) / np.linalg.norm(normal)
            places.append(np.array([x, y, slope * x * y]) + above * normal)
    faces = [(0, 1 + corner, 1 + (corner + 1) % 4) for corner in range(4)]
    for ring in range(1, rings):
        for corner in range(4):
            a, b = (4 * ring - 3 + (corner + turn) % 4 for turn in (0, 1))
            c, d = b + 4, a + 4
            faces += [(a, d, c), (a, c, b)] if (ring + corner) % 2 else [(a, d, b), (d, c, b)]
    sheet = sheet_of_faces([tuple(place.tolist()) for place in places], faces, "Pleated hypar", {})
    flat, count = flat_state(sheet), len(places)
    rules = [JointAngle(joint=joint, goal=Goal(at_least=-most, at_most=most)) for joint in flat.inputs]
    wishes = Wishes(
        (PointsOn(target=Formula(f"z - {slope!r}*x*y")),),
        (flat,),
        (EdgeLengths(goal=Goal(at_least=least / rings)), *rules),
        fixed=tuple(str(vertex) for vertex in range(count - 4, count)),
    )

    def lifted(plane: Floats) -> Floats:
        return np.column_stack([plane, slope * plane[:, 0] * plane[:, 1]])

    def points(number: int, rng: np.random.Generator) -> Floats:
        plane = rng.uniform(-1.0, 1.0, (8 * number, 2))
        larger = np.sqrt((1.0 + slope**2 * (plane**2).sum(axis=1)) / (1.0 + 2.0 * slope**2))
        return lifted(plane[rng.random(len(plane)) < larger][:number])

    def off(points: Floats) -> Floats:
        side = np.linspace(-1.0, 1.0, FINE + 1)
        grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
        plane = grid[cKDTree(lifted(grid)).query(points)[1]]
        for _ in range(ROUNDS):  # descent along the gradient from the nearest point of the grid, within the square
            above = slope * plane[:, :1] * plane[:, 1:] - points[:, 2:]
            gradient = plane - points[:, :2] + slope * above * plane[:, ::-1]
            plane = np.clip(plane - gradient / (1.0 + 2.0 * slope**2), -1.0, 1.0)
        return np.asarray(np.linalg.norm(points - lifted(plane), axis=1))

    return Case(sheet, wishes, off, points, 2.0 * sqrt(2.0))


def bowl(rings: int, rays: int, half_angle: float, offset: float, least: float) -> Case:
    """Return rings about the pole of a unit sphere whose vertices are in turn outside and inside it.

    The border is to lie on the cone through the rim. No edge becomes shorter than a part `least` of the shortest of
    those from its ring to the one before, and round it.
    """
    places: list[Floats] = [np.array([0.0, 0.0, 1.0])]
    for ring in range(1, rings + 1):
        down = half_angle * ring / rings
        for ray in range(rays):
            turn = 2.0 * np.pi * ray / rays
            radius = 1.0 + (-1) ** ray * offset * (ring / rings) ** 2
            places.append(radius * np.array([sin(down) * cos(turn), sin(down) * sin(turn), cos(down)]))
    faces = [(0, 1 + ray, 1 + (ray + 1) % rays) for ray in range(rays)]
    for ring in range(1, rings):
        for ray in range(rays):
            a, b = (1 + rays * (ring - 1) + (ray + turn) % rays for turn in (0, 1))
            c, d = b + rays, a + rays
            faces += [(a, d, b), (d, c, b)] if ray % 2 else [(a, d, c), (a, c, b)]
    sheet = sheet_of_faces([tuple(place.tolist()) for place in places], faces, "Pleated bowl", {})
    rim = tuple(DesignPoint(vertex=vertex) for vertex in range(len(places) - rays, len(places)))
    rules = [PointsOn(points=rim, target=Formula(f"sqrt(x**2 + y**2) - {tan(half_angle)!r}*z"))]
    for ring in range(1, rings + 1):
        edges = tuple(edge for edge in sheet.edges if rays * (ring - 1) < max(edge) <= rays * ring)
        shortest = min(float(np.linalg.norm(places[a] - places[b])) for a, b in edges)
        rules.append(EdgeLengths(edges=edges, goal=Goal(at_least=least * shortest)))
    wishes = Wishes((PointsOn(target=Formula("sqrt(x**2 + y**2 + z**2) - 1")),), (flat_state(sheet),), tuple(rules))

    def points(number: int, rng: np.random.Generator) -> Floats:
        height = 1.0 - (1.0 - cos(half_angle)) * rng.random(number)
        turn, radius = 2.0 * np.pi * rng.random(number), np.sqrt(1.0 - height**2)
        return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height])

    def off(points: Floats) -> Floats:
        radius = np.hypot(points[:, 0], points[:, 1])
        within = np.arctan2(radius, points[:, 2]) <= half_angle
        from_rim = np.hypot(radius - sin(half_angle), points[:, 2] - cos(half_angle))
        return np.where(within, np.abs(np.linalg.norm(points, axis=1) - 1.0), from_rim)

    return Case(sheet, wishes, off, points, 2.0 * sin(half_angle))


CASES = {"bowl": lambda: bowl(5, 32, 0.6, 0.019, 0.8), "hypar": lambda: hypar(10, 0.5, 0.03, 0.4, radians(100.0))}


def points_of(triangles: Floats, number: int, rng: np.random.Generator) -> Floats:
    """Return random points of triangles float[T, 3, 3], as many in each as its area has parts."""
    a, b, c = triangles.transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = rng.choice(len(triangles), number, p=areas / areas.sum())
    parts = rng.random((number, 2))
    parts = np.where(parts.sum(axis=1, keepdims=True) > 1.0, 1.0 - parts, parts)
    return a[chosen] + parts[:, :1] * (b - a)[chosen] + parts[:, 1:] * (c - a)[chosen]


def distances(case: Case, sheet: synth.Sheet, number: int = SAMPLES) -> tuple[Floats, Floats]:
    """Return the distances of points of the sheet from the surface, and of the surface from the sheet."""
    rng = np.random.default_rng(0)
    triangles = np.array(sheet.coordinates)[np.array(sheet.faces)]
    there = case.points(number, rng)
    nearest = Mesh("sheet", triangles).nearest(there)[0]
    from_sheet = case.off(points_of(triangles, number, rng))
    return from_sheet / case.size, np.linalg.norm(there - nearest, axis=1) / case.size


def unfolded(sheet: synth.Sheet) -> tuple[float, float]:
    """Return the largest fold angle of a folded sheet, and after unfolding it, in degrees; not a number if it stops.

    As many creases are driven as there are degrees of freedom: those on which the infinitesimal motions depend most.
    """
    at = configuration_of(sheet)
    angles = at.linkage.angles
    motions = null_space(at.closure.at(angles)[1].toarray(), rcond=1e-9)
    driven = sorted(qr(motions.T, pivoting=True, mode="r")[1][: motions.shape[1]].tolist())
    drive = {at.joints[joint]: NEAR_FLAT * angles[joint] for joint in driven}
    path = synth.fold(sheet, drive=drive, frames=12, collisions=True).path
    ends = np.degrees([np.abs(angles).max(), np.abs(path.angles[-1]).max()])
    return float(ends[0]), float("nan") if path.stopped else float(ends[1])


def flatness(sheet: synth.Sheet) -> tuple[float, bool]:
    """Return how far vertices are off one plane, and whether a sheet laid flat nowhere lies on itself.

    It does not if no panel is turned over and no two edges of the border cross.
    """
    places = np.array(sheet.coordinates)
    a, b, c = places[np.array(sheet.faces)].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    up = unit(normals[0])
    first = unit((b - a)[0])
    plane = np.column_stack([(places - places[0]) @ first, (places - places[0]) @ np.cross(up, first)])
    border = [edge for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter == "B"]
    crossed = any(_cross(plane[list(one)], plane[list(other)]) for one, other in combinations(border, 2))
    return float(np.abs((places - places[0]) @ up).max()), bool((normals @ up > 0.0).all()) and not crossed


def _cross(one: Floats, other: Floats) -> bool:
    """Return whether two lines in the plane, float[2, 2] each, cross between their ends."""

    def sides(line: Floats, points: Floats) -> float:
        (x, y), off = line[1] - line[0], points - line[0]
        return float(np.prod(x * off[:, 1] - y * off[:, 0]))

    return sides(one, other) < 0.0 and sides(other, one) < 0.0


def row(case: Case, number: int = SAMPLES) -> dict[str, object]:
    """Return the figures of one case: the design of the first start."""
    begun = process_time()
    search = DesignSearch(case.sheet, case.wishes)
    design = search.design(0)
    assert design is not None
    seconds = process_time() - begun
    before = distances(case, case.sheet, number)
    one, other = distances(case, design.mechanism, number)
    laid = search.placed(design, "flat")
    assert laid is not None
    angles = unfolded(design.mechanism)
    return {
        "panels": len(case.sheet.faces),
        "distance_before": round(float(np.mean(before)), 5),
        "distance": round(float(np.mean([one, other])), 5),
        "largest_from_sheet": round(float(one.max()), 5),
        "largest_from_surface": round(float(other.max()), 5),
        "residual": float(f"{design.error:.1e}"),
        "residual_before": float(f"{np.abs(search.problem.evaluated(search.problem.start).closure).max():.1e}"),
        "flat_to": float(f"{flatness(laid)[0]:.1e}"),
        "flat_without_overlaps": flatness(laid)[1],
        "success": design.success,
        "settled": design.settled,
        "faults": list(design.faults),
        "freedoms": design.freedoms,
        "verdict": design.verdict,
        "largest_fold_angle": round(angles[0], 2),
        "unfolded_to": round(angles[1], 2),
        "seconds": round(seconds, 1),
    }


def main() -> None:
    """Measure all or those named, print and write."""
    names = sys.argv[1:] or list(CASES)
    rows = {}
    for name in names:
        rows[name] = row(CASES[name]())
        print(name, json.dumps(rows[name]), flush=True)
    if names == list(CASES):
        result = {"python": platform.python_version(), "samples": SAMPLES, "sheets": rows}
        Path(__file__).with_name("results").joinpath("sheets_on_surfaces.json").write_text(
            json.dumps(result, indent=2) + "\n"
        )


if __name__ == "__main__":
    main()
