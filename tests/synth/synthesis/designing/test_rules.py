"""Rules on the shape of a sheet: they hold whatever is wished, by the coordinates of the design."""

import json

import numpy as np
import pytest

from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.sheet import Sheet
from synth.catalogue.patterns import GENERATORS, generate
from synth.synthesis.designing import (
    EdgeLengths,
    EqualLengths,
    Goal,
    JointAngle,
    PanelCorners,
    PointDistance,
    SheetArea,
    Symmetry,
    WishedConfiguration,
    Wishes,
    design,
    read_wishes,
)
from synth.synthesis.designing.placement import DesignPoint

SHEET = generate("miura", rows=2, columns=2).mechanism
MIDDLE = float(np.sqrt(3.0) / 2.0)
MIRROR = Symmetry(mirror=((MIDDLE, 0.0), (MIDDLE, 5.0)))
RIGHT = np.pi / 2


def apart(one, other, goal):
    return PointDistance(points=(DesignPoint(vertex=one), DesignPoint(vertex=other)), goal=goal)


def with_rules(*rules, wish=None, **how):
    """The places of the best design, if any is a success, of a sheet of four panels whose diagonal is to be long, or another wish."""
    wished = Wishes((wish or apart(0, 8, Goal(equals=3.5)),), rules=rules, **how)
    designs = design(SHEET, wished, starts=1)
    best = (*designs.pareto, *designs.failures)[0]
    return np.array(best.mechanism.coordinates), best


def corners_of(places):
    """The angles of all corners of panels, by the areas and products of their sides, degrees."""
    angles = []
    for face in SHEET.faces:
        for before, at, after in zip(np.roll(face, 1), face, np.roll(face, -1), strict=True):
            u, w = places[after] - places[at], places[before] - places[at]
            angles.append(np.degrees(np.arctan2(u[0] * w[1] - u[1] * w[0], u @ w)) % 360)
    return np.array(angles)


def lengths_of(places):
    return np.array([np.linalg.norm(places[a] - places[b]) for a, b in SHEET.edges])


def test_a_sheet_stays_its_own_mirror_image():
    lopsided, _ = with_rules(wish=apart(0, 4, Goal(equals=1.9)), flat_foldable=True)
    places, best = with_rules(MIRROR, wish=apart(0, 4, Goal(equals=1.9)), flat_foldable=True)
    images = [2, 1, 0, 5, 4, 3, 8, 7, 6]

    def off(of):
        return np.abs((2 * MIDDLE, 0) + of * (-1, 1) - of[images]).max()

    assert off(lopsided) > 0.01
    assert off(places) < 1e-12
    assert best.figures[0].met


def test_a_sheet_that_is_turned_into_itself():
    symmetry = Symmetry(turns=2, centre=(MIDDLE, 1.25))
    with pytest.raises(InvariantError, match="the sheet has no symmetry of 2 turns"):
        with_rules(symmetry)  # the number of its columns is even
    square = Sheet(
        5,
        (),
        "",
        ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
        ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.9, 1.1)),
    )
    rule = Symmetry(turns=4, centre=(1.0, 1.0))
    best = design(square, Wishes((SheetArea(goal=Goal(equals=5.0)),), rules=(rule,)), starts=1).best
    places = np.array(best.mechanism.coordinates) - 1.0
    np.testing.assert_allclose(places[[1, 2, 3, 0]], places[:4] @ np.array([(0, 1), (-1, 0)]), atol=1e-12)
    np.testing.assert_allclose(places[4], 0.0, atol=1e-12)
    assert best.figures[0].met


def test_least_sectors_edges_right_angles_and_equal_lengths_hold():
    rules = (
        PanelCorners(goal=Goal(at_least=np.radians(58), at_most=np.pi)),
        EdgeLengths(goal=Goal(at_least=0.95)),
        PanelCorners(corners=((0, 1, 4),), goal=Goal(equals=RIGHT)),
        EqualLengths(edges=((0, 1), (1, 2), (4, 7))),
    )
    places, best = with_rules(*rules)
    corners, lengths = corners_of(places), dict(zip(map(frozenset, SHEET.edges), lengths_of(places), strict=True))
    assert corners.min() > 58 - 1e-9
    assert corners.max() < 180 + 1e-9
    assert min(lengths.values()) > 0.95 - 1e-12
    assert np.abs(corners - 90).min() < 1e-9
    assert np.ptp([lengths[frozenset(edge)] for edge in ((0, 1), (1, 2), (4, 7))]) < 1e-12
    assert best.figures[0].met
    free, _ = with_rules()
    assert np.abs(corners_of(free) - 90).min() > 1e-3


def test_panels_stay_convex():
    pulled = apart(4, 0, Goal(equals=0.35))
    open_corners, _ = with_rules(wish=pulled)
    convex, best = with_rules(PanelCorners(goal=Goal(at_most=np.radians(150))), wish=pulled)
    assert corners_of(open_corners).max() > 150 > corners_of(convex).max() - 1e-9
    assert best.error <= 1e-12


def test_parameters_stay_within_bounds():
    wish = SheetArea(goal=Goal(equals=20.0))
    free, bound = (
        design(GENERATORS["miura"], Wishes((wish,), parameters={"rows": 2, "columns": 2}, bounds=bounds), starts=1).best
        for bounds in ({}, {"straight": (0.5, 1.2), "sector": (1.0, 1.2)})
    )
    assert free.numbers[1] > 1.2
    assert 0.5 <= bound.numbers[1] <= 1.2
    assert 1.0 <= bound.numbers[0] <= 1.2
    assert free.figures[0].met
    assert bound.figures[0].met
    for bounds, message in (
        ({"length": (0, 1)}, "no dimension 'length'"),
        ({"sector": (2.0, 1.0)}, "smaller one first"),
    ):
        with pytest.raises(InvariantError, match=message):
            design(GENERATORS["miura"], Wishes((wish,), bounds=bounds), starts=1)


def test_rules_of_panels_are_refused_where_there_are_none():
    for rule, message in (
        (PanelCorners(corners=((0, 1, 8),), goal=Goal(equals=1.0)), "no panel has the corner 0-1-8"),
        (EqualLengths(edges=((0, 1), (0, 8))), "no edge between vertices 0 and 8"),
        (EqualLengths(edges=((0, 1),)), "1 of equal length; expected 2 or more"),
        (Symmetry(), "a mirror and 2 turns or more"),
        (Symmetry(mirror=((0.0, 0.3), (1.0, 0.0))), "the sheet has no mirror symmetry"),
    ):
        with pytest.raises(InvariantError, match=message):
            with_rules(rule)
    with pytest.raises(UnsolvableError, match="the mechanism is no sheet"):
        design(generate("four-bar").mechanism, Wishes((EdgeLengths(goal=Goal(at_least=1.0)),)), starts=1)


def test_rules_are_read_from_files(tmp_path):
    rules = [
        {"kind": "corners", "at_least": 20, "at_most": 180},
        {"kind": "corners", "corners": [[0, 1, 4]], "equals": 90},
        {"kind": "edges", "at_least": 0.3},
        {"kind": "equal-lengths", "edges": [[0, 1], [1, 2]]},
        {"kind": "symmetry", "mirror": [[MIDDLE, 0], [MIDDLE, 5]]},
    ]
    text = {"format": "synthedra/wishes", "version": 1, "wishes": [{"kind": "area", "equals": 4}], "rules": rules}
    place = tmp_path / "wishes.json"
    place.write_text(json.dumps(text))
    read = read_wishes(place).rules
    assert read[1] == PanelCorners(corners=((0, 1, 4),), goal=Goal(equals=RIGHT))
    assert read[4] == MIRROR


def test_a_type_that_cannot_move_is_one_line():
    ends = [(float(np.cos(at)), float(np.sin(at))) for at in (0.0, 2.2, 4.1)]
    rigid = Sheet(4, (), "", ((0, 1, 3), (1, 2, 3), (2, 0, 3)), (*ends, (0.1, 0.2)))
    wish = JointAngle(at="open", joint="0", goal=Goal(equals=0.3))
    with pytest.raises(UnsolvableError, match=r"a generic one of its type \(M = 0\)") as caught:
        design(rigid, Wishes((wish,), (WishedConfiguration("open"),)), starts=1)
    assert "\n" not in str(caught.value)
