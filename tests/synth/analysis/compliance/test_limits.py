"""Ride-alongs that go straight: the angles they leave, what remains, and the cylinder that they stop."""

import json
from math import acos, atan2, cos, degrees, pi, radians, sin

import numpy as np
import pytest
from commands import run

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.compliance import limits
from synth.analysis.compliance.joint_limits import RideAlongCorner, angles_left
from synth.catalogue.patterns import generate


def closes(corner, angle):
    """Whether a ride-along reaches from one axis to the other, by the triangle it makes with where they are."""
    (a, b), (c, d) = corner.base, corner.links
    if corner.parallel:
        apart = np.hypot(b * cos(angle) - a, b * sin(angle))
        return abs(c - d) <= apart <= c + d
    one = np.array([sin(a), 0.0, cos(a)])
    other = np.array([sin(b) * cos(angle), sin(b) * sin(angle), cos(b)])
    apart = acos(np.clip(one @ other, -1.0, 1.0))
    return abs(c - d) <= apart <= min(c + d, 2 * pi - c - d)


@pytest.mark.parametrize("parallel", [False, True])
def test_the_range_is_where_the_ride_along_reaches(parallel):
    """By trying angles all round: closed from the lower to the upper end, open just beyond each."""
    random = np.random.default_rng(5)
    seen = set()
    for _ in range(60):
        numbers = random.uniform(0.2, 1.4, 4) if parallel else random.uniform(0.2, 2.9, 4)
        corner = RideAlongCorner(tuple(numbers[:2]), tuple(numbers[2:]), parallel)
        all_round = np.linspace(0.0, 2 * pi, 91)[:-1] + 0.003
        closed = [angle for angle in all_round if closes(corner, angle)]
        if not closed:
            continue
        now = closed[int(random.integers(len(closed)))]
        lower, upper = angles_left(corner, now)
        if lower is None:
            assert upper is None
            assert len(closed) == len(all_round)
            seen.add("any")
            continue
        assert lower.angle <= now <= upper.angle
        assert all(closes(corner, angle) for angle in np.linspace(lower.angle + 1e-6, upper.angle - 1e-6, 20))
        assert not closes(corner, lower.angle - 1e-4)
        assert not closes(corner, upper.angle + 1e-4)
        seen.add((lower.how, upper.how))
    assert seen == {"any", *((a, b) for a in ("stretched", "folded") for b in ("stretched", "folded"))}


def test_a_path_ends_where_the_limit_says():
    """The crease of a vertex with a ride-along, driven until nothing closes: by folding, not by the formula."""
    sheet = generate("deployable-cylinder", pleats=3, short=radians(12)).mechanism
    found = limits(sheet)
    outer = next(one for one in found.ride_alongs if one.upper.angle < 0.0)
    assert degrees(outer.upper.angle) == pytest.approx(-130.0)
    moved = synth.fold(sheet, drive={outer.joint: outer.upper.angle + 0.1}, frames=4)
    reached = moved.path.angles[:, moved.joints.index(outer.joint)].max()
    assert outer.upper.angle - 0.01 < reached <= outer.upper.angle
    assert moved.path.stopped


def test_all_ride_alongs_of_the_cylinder_are_straight_at_once():
    """So it stops there as a whole; the angles are those of its corners, and of the walls beside."""
    for pleats in (3, 5):
        made = generate("deployable-cylinder", pleats=pleats, short=radians(20), slack=radians(4))
        for one in limits(made.mechanism).ride_alongs:
            ends = [abs(end.angle - one.angle) for end in (one.lower, one.upper)]
            assert min(ends) == pytest.approx(radians(20), abs=1e-9)
        assert made.freedoms == made.count == 2 * pleats - 3


def test_the_cylinder_with_ride_alongs_held_is_a_truss():
    for pleats in (3, 4):
        found = limits(generate("deployable-cylinder", pleats=pleats).mechanism)
        assert {one.freedoms for one in found.ride_alongs} == {2 * pleats - 4}  # each takes one
        assert (found.truss.freedoms, found.truss.redundant) == (0, 3)
        assert (found.truss.links, found.truss.joints) == (4 * pleats, 6 * pleats)
        assert found.truss.rank == found.truss.joints


def test_walls_have_their_width_and_ride_alongs_their_sectors():
    sheet = generate("deployable-cylinder", pleats=5, short=radians(25), slack=radians(3), height=0.7).mechanism
    places = np.array(sheet.coordinates)
    for face in sheet.faces[:10]:
        foot, following = places[list(face[:2])]
        assert np.linalg.norm(following - foot) == pytest.approx(1.0)
    for number, face in enumerate(sheet.faces[10:]):
        top, *ends = places[list(face)]
        a, b = (end - top for end in ends)
        sector = atan2(np.linalg.norm(np.cross(a, b)), a @ b)
        assert degrees(sector) == pytest.approx(87.0 if number // 2 % 2 else 51.0)


def test_a_planar_ride_along_on_a_four_bar():
    """Four parallel axes, and bars of 0.8 and 0.7 between two sides, 1 and 0.6 from their corner A: a right angle."""
    joints = {
        "A": ("a", "b"), "B": ("b", "c"), "C": ("c", "d"), "D": ("d", "a"),
        "p": ("a", "u"), "q": ("u", "v"), "r": ("v", "b"),
    }  # fmt: skip
    loops = [Loop(("A", "B", "C", "D"), "infinite"), Loop(("A", "p", "q", "r"), "infinite")]
    p, r = np.array([0.0, 1.0]), np.array([0.6, 0.0])
    far = np.linalg.norm(r - p)
    along, across = (r - p) / far, np.array([1.0, 0.6]) / far
    foot = (0.8**2 - 0.7**2 + far**2) / (2.0 * far)
    q = p + foot * along + np.sqrt(0.8**2 - foot**2) * across
    at = {"A": (0, 0), "B": (2, 0), "C": (2, 2), "D": (0, 2), "p": p, "q": q, "r": r}
    axes = {name: ((*place, 0.0), (0.0, 0.0, 1.0)) for name, place in at.items()}
    solids = HingedSolids(SCGraph("abcduv", joints, loops), axes)
    [found] = limits(solids, keep="cd").ride_alongs
    assert (found.joint, found.freedoms) == ("A", 0)
    widest = acos((1.0 + 0.6**2 - 1.5**2) / 1.2)  # the bars in line; folded they reach less than 0.4, and never are
    assert sorted((found.lower.angle, found.upper.angle)) == pytest.approx([pi / 2 - widest, pi / 2 + widest])
    assert {found.lower.how, found.upper.how} == {"stretched"}


def test_what_is_refused():
    with pytest.raises(UnsolvableError, match="there are no ride-alongs"):
        limits(generate("four-bar").mechanism)
    with pytest.raises(InvariantError, match="expected less than 40 degrees"):
        generate("deployable-cylinder", pleats=3, slack=radians(10), short=radians(45))


def test_the_command(tmp_path):
    file = tmp_path / "cylinder.fold"
    run("generate", "deployable-cylinder", "--pleats", "3", "-o", file)
    told = json.loads(run("limits", file, "--json").stdout)
    assert len(told["ride_alongs"]) == 6
    assert told["ride_alongs"][0].keys() == {"joints", "joint", "angle_deg", "lower", "upper", "freedoms"}
    assert told["truss"]["freedoms"] == 0
    out = run("limits", file).stdout
    assert "6 ride-alongs" in out
    assert (
        "with all of them held at this configuration: 0 degrees of freedom (12 links, 18 joints; rank 18, 3 redundant)"
        in out
    )
