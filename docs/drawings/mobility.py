"""Mobility: verdicts, counts, ranks, poses, what can be taken off, edits."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

import numpy as np

import synth
from drawings.altered import DOTTED, over, plain_graph, without_letters
from drawings.examples import generated_sheet, graph_of_file, sheet_of_file, with_places
from drawings.patterned import Patterned
from drawings.together import above, beside, said
from graphs.convert.duality import mechanism_of_sheet
from graphs.count.report import mobility_report
from graphs.creasing.edits import SheetEdit, crease_sheet, lock_crease, take_off_panels
from graphs.errors import numbered
from graphs.mechanism.estimate import Corners, estimate_of, nearly_exact
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.exact import diagnose
from graphs.rank.infinitesimal import InfinitesimalMobility, closure_at_configuration, infinitesimal_mobility
from graphs.types import Floats
from synth.making.drawing import Scene
from synth.making.drawing.scene.frame import Plot, signed
from synth.making.drawing.scene.shapes import FINE, NORMAL, SMALL, STRONG, Disc, Label, Layer, Line, Polygon, Shape

__all__ = ["DRAWINGS"]


def verdict() -> Scene:
    """A Miura sheet, and the same with its vertices moved: what the verdict says of both."""
    miura = generated_sheet("miura", rows=3, columns=4)
    return beside(
        _judged(miura, "Miura sheet"), _judged(_shaken(miura, 0.1), "vertices moved a little: general angles")
    )


def _judged(sheet: Sheet, name: str) -> Scene:
    """Return a pattern coloured by the verdict on it, with its count and the verdict in words."""
    found = synth.mobility(sheet)
    assert found.verdict is not None
    assert found.mobility is not None
    freedoms = found.verdict.freedoms
    moves = f"folds with {numbered(freedoms, 'freedom')}" if freedoms else "rigid"
    creases = "whole lines, orange: creases that move" if freedoms else "dotted, grey: creases that cannot move"
    pattern = Patterned(sheet, 200.0).scene(colour="verdict")
    return said(
        pattern, name, f"by count M = {signed(found.mobility)}; verdict: {moves}, {found.verdict.certainty}", creases
    )


def _shaken(sheet: Sheet, part: float) -> Sheet:
    """Return a flat sheet with its vertices moved at random, by at most a part of a typical side."""
    places = np.array(sheet.coordinates)[:, :2]
    sides = np.array([places[a] - places[b] for a, b in sheet.edges])
    most = part * float(np.median(np.hypot(*sides.T)))
    moved = places + np.random.default_rng(2).uniform(-most, most, places.shape)
    return with_places(sheet, moved)


def mobility_by_count() -> Scene:
    """Five types by the centres of their loops, with the count that holds for each."""
    names = {
        "six-bar-loop-spatial": "no centre",
        "six-bar-loop-spherical": "one centre",
        "fortune-teller": "several centres",
        "hybrid-ten-bar": "some loops without",
        "concentric-loops": "a closing loop",
    }
    pictures = [_counted(name, centres) for name, centres in names.items()]
    return above(beside(*pictures[:3]), beside(*pictures[3:], gap=40.0), gap=8.0)


def _counted(name: str, centres: str) -> Scene:
    """Return a type with its class and its mobility by the loops, by those of a closed surface if there is one."""
    graph = graph_of_file(f"wiener/{name}.json")
    report = mobility_report(graph)
    assert report.mobility is not None
    picture = without_letters(plain_graph(synth.draw(graph, kind="graph", box=(130.0, 130.0), caption=None)))
    return said(picture, f"{report.mechanism_class}:", centres, f"M = {_terms(graph)} = {signed(report.mobility)}")


def _terms(graph: SCGraph) -> str:
    """Return joints, less what loops take; a closing loop is a face like the others."""
    faces = len(graph.centred_loops) + len(graph.closing)
    terms = [f"{len(graph.joints)}"]
    terms += [f"− 3 × {faces}"] * bool(faces) + [f"− 6 × {graph.spatial_loops}"] * bool(graph.spatial_loops)
    return " ".join([*terms, *["+ 6"] * bool(graph.closing)])


def exact_mobility() -> Scene:
    """A general mesh creased at its edge: creases that no motion turns, where the count is wrong."""
    sheet = _mesh_with_creased_edge()
    pattern = Patterned(sheet, 200.0)
    found = diagnose(pattern.mechanism.sc)
    ways = [
        Line(pattern.crease(joint), *(("grey", NORMAL, DOTTED) if joint in found.immobile else ("class1", STRONG)))
        for joint in pattern.mechanism.hinges
    ]
    count = signed(_count(sheet))
    return said(
        over(pattern.scene(), ways),
        f"M = {count} by count, {found.mobility} by rank: {numbered(found.idle, 'equation')} idle",
        "thick, orange: creases that move; dotted, grey: creases that no motion turns",
    )


def _mesh_with_creased_edge() -> Sheet:
    """Return a general mesh of sixteen panels, four of them, at its edge, creased along diagonals."""
    sheet = _shaken(generated_sheet("map", rows=4, columns=4), 0.12)
    for _, right, _, below in sheet.faces[:4]:
        sheet = crease_sheet(sheet, right, below).sheet
    return sheet


def pose() -> Scene:
    """Singular values of a folded sheet whose coordinates are rounded: the gap between equations and noise."""
    sheet = generated_sheet("miura", rows=4, columns=4, fold=1.2)
    rounded = with_places(sheet, np.array(sheet.coordinates).round(5))
    found = infinitesimal_mobility(rounded)
    assert found.dof is not None
    values = np.linalg.svd(closure_at_configuration(rounded, mechanism_of_sheet(rounded)).toarray(), compute_uv=False)
    picture = _singular_values(values / values[0], found)
    return beside(
        said(
            synth.draw(rounded, numbers=False, box=(130.0, 130.0), caption=None),
            "Miura sheet, folded;",
            "coordinates with five decimals",
        ),
        said(picture, f"{found.spectrum.rank} values count, {found.dof} does not: {numbered(found.dof, 'freedom')}"),
    )


def precision() -> Scene:
    """Deviations of relations in a rounded pattern, as displacements of a coordinate, the smallest first."""
    sheet = generated_sheet("hexagon-twist")
    turn = np.array([[np.cos(0.6), np.sin(0.6)], [-np.sin(0.6), np.cos(0.6)]])
    rounded = with_places(sheet, (np.array(sheet.coordinates) @ turn).round(4))
    points = np.zeros((rounded.vertices, 3))
    points[:, :2] = np.array(rounded.coordinates) - np.mean(rounded.coordinates, axis=0)
    off = np.sort(np.concatenate([one.off for one in nearly_exact(Corners(rounded, points / np.abs(points).max()))]))
    found = estimate_of(rounded)
    assert found is not None
    plot = Plot(40.0, 22.0, 220.0, 150.0, (0.0, len(off) + 1.0), (-8.0, 0.0))
    heights = np.maximum(np.log10(np.maximum(off, 1e-8)), plot.y[0]).tolist()
    level = [plot.at(side, float(np.log10(found.size))) for side in plot.x]
    shapes: list[Shape] = [
        *_powers_of_ten(plot, "relations, those that hold best first", "part of the extent"),
        *(Disc(plot.at(place, height), 1.6, "ink", None) for place, height in enumerate(heights, 1)),
        Line(level, "class1", NORMAL, DOTTED),
        Label((level[0][0] + 60.0, level[0][1] - 8.0), f"estimate {found.size:.0e}", SMALL, halo=False),
    ]
    return beside(
        said(
            synth.draw(rounded, numbers=False, box=(130.0, 130.0), caption=None),
            "hexagon twist, turned;",
            "coordinates with four decimals",
        ),
        said(Scene(270.0, 200.0, (Layer("values", tuple(shapes)),)), f"{found.relations} relations hold to that"),
    )


def _singular_values(values: Floats, found: InfinitesimalMobility) -> Scene:
    """Return singular values, on a scale of powers of ten, with what noise may come to."""
    plot = Plot(40.0, 22.0, 220.0, 150.0, (0.0, len(values) + 1.0), (-8.0, 0.0))
    lowest, noise = plot.y[0], float(np.log10(found.spectrum.noise))
    heights = np.maximum(np.log10(values), lowest).tolist()
    band = [plot.at(plot.x[side], height) for side, height in ((0, noise), (1, noise), (1, lowest), (0, lowest))]
    gap = [plot.at(len(values), height) for height in (np.log10(found.spectrum.smallest), noise)]
    shapes: list[Shape] = [
        Polygon(band, "faint", None),
        *_powers_of_ten(plot, "singular values, the largest first", "part of the largest"),
        *(Disc(plot.at(place, height), 2.4, "ink", None) for place, height in enumerate(heights, 1)),
        Line(gap, "class1", NORMAL, DOTTED),
        Label((gap[0][0] - 14.0, (gap[0][1] + gap[1][1]) / 2), "gap", SMALL, halo=False),
        Label(plot.at(0.4 * len(values), (noise + lowest) / 2), "what rounding may come to", SMALL, halo=False),
    ]
    return Scene(270.0, 200.0, (Layer("values", tuple(shapes)),))


def _powers_of_ten(plot: Plot, below: str, beside_it: str) -> list[Shape]:
    """Return the axes of a plot whose heights are powers of ten."""
    shapes = [*plot.below((), below), *plot.beside((), beside_it)]
    for power in range(int(plot.y[0]), 1, 2):
        x, y = plot.at(0.0, power)
        shapes.append(Label((x - 16.0, y), f"1e{power}" if power else "1", SMALL, halo=False))
        shapes.append(Line([(x - 3.0, y), (x, y)], "ink", FINE))
    return shapes


def reduction() -> Scene:
    """Ride-alongs taken off a sheet, one after the other: freedoms stay."""
    sheet = sheet_of_file("realised/adjunct-chain.fold")
    scenes = []
    while True:
        pattern = Patterned(sheet, 170.0)
        steps = synth.reduce(pattern.mechanism.sc).steps
        removed = [link for link in steps[0].removed if isinstance(link, int)] if steps else []
        scenes.append(_with_ride_along(pattern, removed))
        if not removed:
            return said(beside(*scenes, gap=8.0), "rimmed, yellow: the ride-along that is taken off next")
        sheet = take_off_panels(sheet, removed).sheet


def _with_ride_along(pattern: Patterned, removed: Collection[int]) -> Scene:
    """Return a pattern, the panels that are taken off next marked."""
    count = numbered(len(pattern.mechanism.panels), "link")
    faces = [pattern.sheet.faces[face] for link in removed for face in pattern.mechanism.panels[link]]
    marks = [Polygon([pattern.places[v] for v in face], "marked", "ink", STRONG, opacity=0.7) for face in faces]
    return said(over(pattern.scene(), marks), count, f"M = {_count(pattern.sheet)}")


def edits() -> Scene:
    """A pattern between two edits: a crease locked, and a panel creased."""
    sheet = generated_sheet("waterbomb-base")
    centre, first, second = sheet.faces[1]
    places = np.array(sheet.coordinates)
    locked = lock_crease(sheet, sheet.edges.index((centre, first)))
    creased = crease_sheet(sheet, centre, ((places[first] + places[second]) / 2).tolist())
    new = len(places)
    return beside(
        _edited(locked, Line([], "grey", STRONG, DOTTED), (centre, first), "one crease locked"),
        said(Patterned(sheet, 130.0).scene(), "before", f"M = {_count(sheet)}"),
        _edited(creased, Line([], "class1", STRONG), (centre, new), "one panel creased"),
    )


def _edited(edit: SheetEdit, mark: Line, crease: tuple[int, int], what: str) -> Scene:
    """Return a pattern after an edit, the crease that it is about marked."""
    pattern = Patterned(edit.sheet, 130.0)
    marked = replace(mark, points=[pattern.places[end] for end in crease])
    change = f"dM = {'+' * (edit.predicted > 0)}{signed(edit.predicted)}"
    return said(over(pattern.scene(), [marked]), f"{what}: {change}", f"M = {_count(edit.sheet)}")


def _count(sheet: Sheet) -> int:
    """Return the mobility of a sheet by count."""
    found = mobility_report(mechanism_of_sheet(sheet).sc).mobility
    assert found is not None
    return found


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "verdict": verdict,
    "mobility-by-count": mobility_by_count,
    "exact-mobility": exact_mobility,
    "pose": pose,
    "precision": precision,
    "reduction": reduction,
    "edits": edits,
}
"""Theory page to what draws its picture."""
