"""Rules that keep a flat sheet rigid-foldable: Kawasaki's at each vertex, and ratios that agree round panels.

At a flat-foldable vertex of four creases half-angle tangents of fold angles keep their ratios while it folds; a sheet
of such vertices folds rigidly if the product of the ratios round each panel between them is 1. Ratios are those of the
branch on which the sheet folds. Theory: docs/theory/design.md.
"""

from collections.abc import Callable

import numpy as np

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import SynthedraError, UnsolvableError
from graphs.geometry import signed_area
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.folding.motion import fold
from synth.catalogue.realisation.conditions import Condition, flat_folding, panels_between_vertices
from synth.catalogue.realisation.measures import opened_angles
from synth.catalogue.realisation.pattern import Pattern
from synth.synthesis.designing.dimensions import DesignedLinkage

_FRAMES = 6
_LEFT = 0.25
"""The part of the way of a corner to the ends of its range that a design leaves."""


def pattern_of_sheet(sheet: Sheet) -> Pattern:
    """Return the panels of a flat sheet as a pattern, with the numbers of its vertices.

    Raises `UnsolvableError` if it is not flat, or a panel has several faces.
    """
    mechanism = mechanism_of_sheet(sheet)
    places = in_space(sheet.coordinates or ())
    if np.ptp(places[:, 2]) > 0.0 or any(len(faces) > 1 for faces in mechanism.panels):
        raise UnsolvableError("rules of flat-foldable sheets need a flat sheet, each panel one face")
    faces = [sheet.faces[faces[0]] for faces in mechanism.panels]
    panels = tuple(face if signed_area(places[list(face), :2]) > 0.0 else face[::-1] for face in faces)
    sides = {side for panel in panels for side in sides_of_face(panel)}
    after = {a: b for a, b in sides if (b, a) not in sides}
    rings = []
    while after:
        ring = [min(after)]
        while (following := after.pop(ring[-1])) != ring[0]:
            ring.append(following)
        rings.append(tuple(ring))
    outer = max(rings, key=lambda ring: float(signed_area(places[list(ring), :2])))
    holes = tuple(ring[::-1] for ring in rings if ring is not outer)
    creases = tuple(mechanism.hinges[int(str(joint))] for joint in mechanism.sc.joints)
    return Pattern(
        tuple(mechanism.sc.nodes), tuple(mechanism.sc.joints), panels, sheet.vertices, creases, outer, holes, ()
    )


def flat_rules(sheet: Sheet) -> list[Callable[[DesignedLinkage], tuple[Floats, Floats]]]:
    """Return the rules on the vertices of a flat sheet: Kawasaki's, and ratios on its assigned branch.

    Raises `UnsolvableError` if it cannot be flat-foldable, or does not fold as it is.
    """
    pattern = pattern_of_sheet(sheet)
    rules = [flat_folding(pattern), _corners_kept(pattern, in_space(sheet.coordinates or ())[:, :2])]
    if panels_between_vertices(pattern):
        rules.append(_agreeing(pattern, _terms(sheet, pattern)))
    return [_by_numbers(rule) for rule in rules]


def _corners_kept(pattern: Pattern, places: Floats) -> Condition:
    """Return that corners of panels keep `_LEFT` of their way to the ends of the range in which they lie.

    The range is 0 to a straight angle for convex corners, a straight angle to a whole turn for others: a panel with a
    corner beyond is turned over, which is another mechanism. Straight corners are left free. Radians.
    """
    first, _ = opened_angles(pattern, places)
    start = np.where(first < np.pi, 0.0, np.pi)
    low, high = start + _LEFT * (first - start), start + np.pi - _LEFT * (start + np.pi - first)
    held = np.abs(first - np.pi) > DOUBLE.parallel

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns)
        off = np.where(held, angles - np.clip(angles, low, high), 0.0)
        return off, by_places * (off != 0.0)[:, None]

    return condition


def _by_numbers(condition: Condition) -> Callable[[DesignedLinkage], tuple[Floats, Floats]]:
    def rule(design: DesignedLinkage) -> tuple[Floats, Floats]:
        off, by = condition(design.vertices[:, :2])
        slopes = design.by_vertices[:, :2].reshape(-1, design.by_vertices.shape[2])
        return off, by @ slopes

    return rule


def folded_frames(sheet: Sheet) -> Floats:
    """Return fold angles of a sheet along its assigned branch, the flat state left out: float[F, J]; none without."""
    try:
        return np.asarray(fold(sheet, frames=_FRAMES).path.angles[1:])
    except SynthedraError:
        return np.zeros((0, 0))


_Term = tuple[int, int, bool]
"""Two corners at a vertex, on both sides of a crease, and whether its ratio is that of sines, else of cosines."""


def _logarithm(sector: float, other: float, *, sines: bool) -> tuple[float, tuple[float, float]]:
    """Return the logarithm of the ratio of half-angle tangents between sectors, and its derivatives by both.

    Of a crease to its neighbours at a flat-foldable vertex of four: cos((a + b) / 2) / cos((a - b) / 2), or the same
    with sines; if one crease has the ratio of cosines, the next has that of sines.
    """
    half, apart = (sector + other) / 2.0, (sector - other) / 2.0
    with np.errstate(divide="ignore", invalid="ignore"):
        if sines:
            ratio, first, second = np.sin(half) / np.sin(apart), 0.5 / np.tan(half), 0.5 / np.tan(apart)
        else:
            ratio, first, second = np.cos(half) / np.cos(apart), -0.5 * np.tan(half), -0.5 * np.tan(apart)
        return float(np.log(np.abs(ratio))), (float(first - second), float(first + second))


def _terms(sheet: Sheet, pattern: Pattern) -> list[list[_Term]]:
    """Return the ratios round each panel between vertices of four creases, on the assigned branch of the sheet."""
    frames = folded_frames(sheet)
    if not len(frames):
        raise UnsolvableError("the sheet does not fold as it is, so its branch is not known; try another start")
    halves = np.abs(np.tan(frames[len(frames) // 2] / 2.0))
    if (halves <= DOUBLE.zero_rate).any():
        raise UnsolvableError("creases of the sheet stay flat on its assigned branch; assign mountains and valleys")
    angles, _ = opened_angles(pattern, in_space(sheet.coordinates or ())[:, :2])
    number_of = {(int(at), int(before)): number for number, (before, at, _) in enumerate(pattern.corners)}
    crease_of = pattern.sides.creases
    rows: list[list[_Term]] = []
    for panel in panels_between_vertices(pattern):
        rows.append([])
        for before, at in sides_of_face(panel):
            after = pattern.sides.after[before, at][1]
            here, beyond = number_of[at, before], number_of[at, after]
            folded = float(np.log(halves[crease_of[at, after]] / halves[crease_of[before, at]]))
            off = [abs(folded - _logarithm(angles[here], angles[beyond], sines=sines)[0]) for sines in (False, True)]
            rows[-1].append((here, beyond, off[1] < off[0]))
    return rows


def _agreeing(pattern: Pattern, rows: list[list[_Term]]) -> Condition:
    """Return that the product of ratios round each panel is 1: its logarithm."""

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns)
        off, by = np.zeros(len(rows)), np.zeros((len(rows), unknowns.size))
        for row, terms in enumerate(rows):
            for here, beyond, sines in terms:
                value, (first, second) = _logarithm(float(angles[here]), float(angles[beyond]), sines=sines)
                off[row] += value
                by[row] += first * by_places[here] + second * by_places[beyond]
        return off, by

    return condition
