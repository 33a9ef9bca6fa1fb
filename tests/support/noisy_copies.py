"""Crease patterns that move, and some that do not, by construction; copies of them with errors of a known size."""

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import pairwise
from math import cos, pi, radians, sin, sqrt

import numpy as np

from graphs.mechanism.precision import extent_of
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.verdict._mobility import verdict_of_motion
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import polygon_twist


def generated(name, **parameters):
    return generate(name, **parameters).mechanism


def tapered(size):
    """A Miura sheet whose straight lines meet in a point: zigzags are reflected at them."""
    turn, places, inside, radius = 0.1, [(0.0, 1.0)], 1.9, 1.0
    for line in range(size):
        across = pi - turn - inside
        radius *= sin(inside) / sin(across)
        places.append(((line + 1) * turn, radius))
        inside = across
    corners = tuple(
        (0.72**row * far * cos(angle), 0.72**row * far * sin(angle)) for row in range(size + 1) for angle, far in places
    )
    wide = size + 1
    faces = tuple(
        (i * wide + j, i * wide + j + 1, (i + 1) * wide + j + 1, (i + 1) * wide + j)
        for i in range(size)
        for j in range(size)
    )
    return Sheet(wide * wide, (), "", faces, corners)


def fish_base():
    """Two rabbit ears on either side of a diagonal, their perpendiculars in one line."""
    off = 1.0 - 1.0 / sqrt(2.0)
    corners = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0 - off, off), (off, 1.0 - off), (0.5, 0.5))
    faces = ((0, 1, 4), (1, 2, 4), (2, 6, 4), (6, 0, 4), (2, 3, 5), (3, 0, 5), (0, 6, 5), (6, 2, 5))
    return Sheet(7, (), "", faces, corners)


def bent(sheet, size, seed):
    """A sheet with its vertices displaced by far more than any precision."""
    by = np.random.default_rng(seed).uniform(-size, size, (sheet.vertices, 2))
    return with_places(sheet, np.array(sheet.coordinates) + by)


def misdrawn(sheet, corners, size, seed):
    """A sheet of which some corners within were displaced far, as in a drawing with faults; all others lie as they should."""
    edges = Counter(frozenset((a, b)) for face in sheet.faces for a, b in pairwise((*face, face[0])))
    outline = {corner for edge, faces in edges.items() if faces == 1 for corner in edge}
    within = [corner for corner in range(sheet.vertices) if corner not in outline][:corners]
    places = np.array(sheet.coordinates, dtype=float)
    places[within] += np.random.default_rng(seed).uniform(-size, size, (len(within), 2))
    return with_places(sheet, places)


def with_places(sheet, places):
    return replace(sheet, coordinates=tuple(map(tuple, places.tolist())), fold_angles=None)


MOVING = {
    "miura 3 x 3": lambda: generated("miura", rows=3, columns=3),
    "miura 4 x 4": lambda: generated("miura", rows=4, columns=4, sector=radians(70)),
    "tapered 3 x 3": lambda: tapered(3),
    "tapered 5 x 5": lambda: tapered(5),
    "square twist": lambda: generated("square-twist"),
    "square twist, 30 degrees": lambda: generated("square-twist", twist=radians(30)),
    "hexagon twist": lambda: generated("hexagon-twist"),
    "huffman 3 x 3": lambda: generated("huffman-grid", rows=3, columns=3),
    "map 3 x 3": lambda: generated("map", rows=3, columns=3),
    "map 4 x 4": lambda: generated("map", rows=4, columns=4),
    "chicken wire 3 x 3": lambda: generated("chickenwire", rows=3, columns=3),
    "waterbomb base": lambda: generated("waterbomb-base"),
    "bird base": lambda: generated("bird-base"),
    "yoshimura 2 x 2": lambda: generated("yoshimura", rows=2, columns=2),
    "fish base": fish_base,
}
RIGID = {
    "bent miura 3 x 3": lambda: bent(generated("miura", rows=3, columns=3), 0.08, 1),
    "bent miura 4 x 4": lambda: bent(generated("miura", rows=4, columns=4), 0.08, 2),
    "hexagon twist of 20 degrees": lambda: polygon_twist(6, radians(20)),
    "bent map 3 x 3": lambda: bent(generated("map", rows=3, columns=3), 0.1, 3),
    "bent square twist": lambda: bent(generated("square-twist"), 0.08, 5),
}
MISDRAWN = {
    "misdrawn miura 3 x 3": lambda: misdrawn(generated("miura", rows=3, columns=3), 2, 0.08, 4),
    "misdrawn miura 4 x 4": lambda: misdrawn(generated("miura", rows=4, columns=4), 6, 0.08, 4),
    "misdrawn map 3 x 3": lambda: misdrawn(generated("map", rows=3, columns=3), 4, 0.1, 3),
    "misdrawn square twist": lambda: misdrawn(generated("square-twist"), 2, 0.08, 5),
}
"""Rigid too, but with most of what drawings are: a precision can be estimated, as it cannot where every vertex is bent.

No mechanism was found within a hundredth of their extent, ten times the largest error of a copy.
"""
PATTERNS = {**MOVING, **RIGID, **MISDRAWN}


@cache
def exact(name):
    """The verdict on the pattern itself."""
    return verdict_of_motion(configuration_of_sheet(PATTERNS[name]()))


def copy_of(name, size, seed):
    """A copy with errors up to a size of the extent, turned and scaled, some of single precision; and the size of the errors."""
    sheet, rng = PATTERNS[name](), np.random.default_rng((seed, len(name)))
    places = np.array(sheet.coordinates, dtype=float)
    places = places + rng.uniform(-size, size, places.shape) * extent_of(places)
    angle, factor = rng.uniform(0.0, 2.0 * pi), 10.0 ** rng.uniform(-2, 3)
    places = factor * places @ np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
    if seed % 2:
        places = places.astype(np.float32).astype(float)
        size += np.finfo(np.float32).eps / 2 * np.abs(places).max() / extent_of(places)
    return with_places(sheet, places), float(size)


def verdict_on_copy(name, size, seed):
    return verdict_of_motion(stated(*copy_of(name, size, seed)))


def stated(sheet, size):
    """The configuration of a sheet whose coordinates are wrong by up to a size, in units of the extent."""
    return configuration_of_sheet(sheet, precision=size * extent_of(np.array(sheet.coordinates, dtype=float)))


def kinds(verdict):
    """How many ways have how many freedoms."""
    return Counter(way.freedoms for way in verdict.branches)


def sentence(verdict):
    """What the first sentence says: it moves, is rigid, or neither is known."""
    first = verdict.text.split()[0].rstrip(":;.")
    return {"Rigid-foldable": "moves", "Mobile": "moves", "Rigid": "rigid"}.get(first, "unknown")


def agrees(name, verdict):
    """Whether the verdict on a copy is that on the pattern: of ways where both are exhaustive."""
    meant = exact(name)
    same = (verdict.freedoms, sentence(verdict)) == (meant.freedoms, sentence(meant))
    return same and (not (verdict.exhaustive and meant.exhaustive) or kinds(verdict) == kinds(meant))


def wrongly_proved(name, verdict):
    return verdict.certainty == "proved" and verdict.freedoms != exact(name).freedoms
