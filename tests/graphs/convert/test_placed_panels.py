"""Panels with places: centres across holes, and which boundary is the outer one."""

import numpy as np
import pytest

from graphs.answer.identity import identify
from graphs.convert.conversions import to_scd
from graphs.errors import InvariantError
from graphs.loops.loop import Centre
from graphs.mechanism.sheet import Sheet

RING = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
OUTSIDE = ((-2, -2), (2, -2), (2, 2), (-2, 2))


def _ring(inside) -> Sheet:
    return Sheet(8, (), "", RING, (*OUTSIDE, *inside))


def test_creases_round_a_hole_that_meet_have_a_centre_there():
    sheet = _ring(((-1, -1), (1, -1), (1, 1), (-1, 1)))
    assert [loop.centre for loop in to_scd(sheet).loops] == [Centre.FINITE]
    assert identify(sheet).drawing == "m1:a-b-.a-c-.b-d-.c-d-"


def test_creases_round_a_hole_that_are_parallel_have_one_at_infinity():
    places = ((-2, 0), (2, 0), (3, 9), (-3, 9), (-2, 1), (2, 1), (3, 7), (-3, 7))
    assert [loop.centre for loop in to_scd(Sheet(8, (), "", RING, places)).loops] == [Centre.INFINITE]


def test_creases_that_do_not_meet_make_a_spatial_loop():
    assert not to_scd(_ring(((-1, -1), (1, -1), (1, 1), (-1.5, 1)))).loops


def test_the_outer_boundary_is_the_one_round_the_largest_area():
    half = np.pi * np.arange(8) / 4
    inside = [(np.cos(angle), np.sin(angle)) for angle in half]
    places = (*OUTSIDE, *inside)
    corners = [(0, 5), (1, 7), (2, 1), (3, 3)]
    faces = []
    for place, (outer, first) in enumerate(corners):
        following, last = corners[(place + 1) % 4]
        faces.append((outer, following, 4 + last, 4 + (first + 1) % 8, 4 + first))
    scd = to_scd(Sheet(12, (), "", tuple(faces), places))
    outer = scd.faces[scd.drawing.outer_face]
    assert outer.open_edges == 4 < max(face.open_edges for face in scd.faces)


@pytest.mark.parametrize("sides", [4, 32])
@pytest.mark.parametrize("size", [0.1, 10.0])
def test_a_lone_panel_is_a_part_of_its_own(sides, size):
    """It may bound the largest area, or have more open edges than all other panels."""
    ring = [(20 + size * np.cos(t), size * np.sin(t)) for t in np.linspace(0, 2 * np.pi, sides, endpoint=False)]
    places = (*((0, 0), (1, 0), (1, 1), (0, 1)), *ring)
    sheet = Sheet(4 + sides, (), "", ((0, 1, 2), (0, 2, 3), tuple(range(4, 4 + sides))), places)
    with pytest.raises(InvariantError, match="the graph has 2 parts; expected one"):
        to_scd(sheet)
    assert identify(sheet).chain == "k1:BG"
