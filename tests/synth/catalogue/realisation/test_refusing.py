"""What no flat sheet has is refused with its reason; the reason is replayed, and its limit is reached."""

import numpy as np
import pytest

from enumerate.scd.jobs import scd_graphs
from graphs.convert.conversions import to_scd
from graphs.errors import UnsolvableError
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.mechanism.sheet import Sheet
from synth.catalogue.realisation._realise import NotFoundError, realise
from synth.catalogue.realisation.measures import corner_angles, crossings
from synth.catalogue.realisation.pattern import check_holes, half_turns, pattern_of

RING = "m1:a-b-.a-c-.b-d-.c-d-;i"
"""Four panels of four sides round a hole, the creases parallel."""
TWO_ABOUT_ONE = "m1:a---b.ac--.b-d-e.cf-g-.d-g-.e-f"
"""A vertex, and a hole beside it with the same centre."""
BESIDE_A_VERTEX = "m1:a---b.ac--.bd--e.ce-f-.d-g--.f--g-;fi"


@pytest.mark.parametrize(("code", "parts"), [(RING, "0 . 0 . 0 . 0"), (BESIDE_A_VERTEX, "0 . 1 . 0 . 0")])
def test_parallel_creases_round_a_hole_need_panels_in_which_they_turn(code, parts):
    with pytest.raises(UnsolvableError, match=f"2 half turns round the hole .* by {parts}") as refused:
        realise(mechanism_from_map_id(code))
    assert not isinstance(refused.value, NotFoundError)


def test_the_same_creases_through_a_point_are_not_refused():
    assert realise(mechanism_from_map_id(RING.removesuffix(";i")), tries=1).figures.edge_ratio > 0.0


def test_a_hole_beside_its_centre_is_as_a_centre_at_infinity():
    """Two panels turn by half a turn each: of this type a drawing is known."""
    pattern = pattern_of(mechanism_from_map_id(TWO_ABOUT_ONE))
    [one] = pattern.pointings
    assert one.vertex is not None
    assert sum(half_turns(pattern, one, one.holes[0]).values()) == 2
    check_holes(pattern)


@pytest.mark.slow
def test_nothing_that_is_drawn_would_be_refused():
    for scd in scd_graphs(6, 1, 5):
        check_holes(pattern_of(scd))


def test_random_drawings_of_the_ring_with_parallel_creases_cross_or_turn_panels_over():
    pattern = pattern_of(mechanism_from_map_id(RING))
    random = np.random.default_rng(0)
    for _ in range(100):
        places = random.uniform(-1.0, 1.0, (pattern.vertices, 2))
        for a, b in pattern.creases:
            places[b, 0] = places[a, 0]
        angles, _ = corner_angles(places, pattern.corners)
        around = np.bincount(pattern.panel_of_corner, np.mod(angles, 2 * np.pi))
        assert crossings(pattern, places) or np.abs(around - 2 * np.pi).max() > 1e-6


def _ring_of_pentagons_and_quadrangles():
    """Two panels of five sides, in which the directions of vertical creases turn by half a turn each."""
    inner, outer = [(-1, 1), (1, 1), (1.2, -1), (-1.2, -1)], [(-1, 2), (1, 2), (1.2, -2), (-1.2, -2)]
    faces = ((0, 1, 5, 4), (1, 2, 6, 9, 5), (2, 3, 7, 6), (3, 0, 4, 8, 7))
    creases = tuple((vertex, vertex + 4) for vertex in range(4))
    return Sheet(10, creases, "UUUU", faces, (*inner, *outer, (-3, 0), (3, 0)))


def test_two_panels_of_five_sides_are_enough():
    scd = to_scd(_ring_of_pentagons_and_quadrangles())
    assert map_id(scd).endswith(";i")
    pattern = pattern_of(scd)
    check_holes(pattern)
    [one] = pattern.pointings
    assert sorted(half_turns(pattern, one, 0).values()) == [0, 0, 1, 1]


def test_the_directions_of_creases_turn_in_the_panels_of_five_sides():
    """The exterior angles from crease to crease, less half a turn: what the reason counts."""
    sheet = _ring_of_pentagons_and_quadrangles()
    places = np.array(sheet.coordinates)
    turned = []
    for face in sheet.faces:
        start = next(i for i, vertex in enumerate(face) if vertex < 4 <= face[(i + 1) % len(face)])
        along = np.diff(places[[*face[start:], *face[:start]]], axis=0)
        directions = np.arctan2(along[:, 1], along[:, 0])
        exterior = np.mod(np.diff(directions) + np.pi, 2 * np.pi) - np.pi
        turned.append(float(exterior.sum() - np.pi) / np.pi)
    assert turned == pytest.approx([0, 1, 0, 1])
