"""Special geometry of types: known linkages come out of their types by search, checked by their own laws."""

import json

import numpy as np
import pytest
from sizes import slow

import synth
from graphs.convert.panels import scd_from_panels
from graphs.errors import InvariantError, UnsolvableError
from graphs.geometry import lines_meet, sectors
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import sides_of_face
from synth.catalogue.realisation.conditions import agreeing_ratios, bent_line, bundles, parallel_creases, straight_lines
from synth.catalogue.realisation.drawing import barycentric_start
from synth.catalogue.realisation.pattern import pattern_of
from synth.catalogue.realisation.special.families import AxisGroup, derivatives, equal_links, meeting, normal
from tests.support.commands import run

QUADS = "m1:a-b.acd-.b-ef.cfgh.di-.e-j.gj-k.hl-i.k-l"
"""Four vertices of four creases about a panel: M = 0."""


def ring(count):
    return SCGraph(count, [((k - 1) % count, k) for k in range(count)])


def axes_of(solids):
    points, directions = (np.array([axis[part] for axis in solids.axes.values()]) for part in (0, 1))
    return points, directions / np.linalg.norm(directions, axis=1)[:, None]


def found(graph, geometry="", **options):
    answer = synth.realise(graph, freedoms=1, geometry=geometry, **options)
    (member,) = answer.members
    assert answer.mobility <= 0
    assert member.freedoms == 1
    assert member.residual < 1e-12
    assert not member.branch.immobile
    moved = synth.move(member.mechanism, frames=4, branch=member.number)
    assert moved.closure < 1e-11
    assert np.ptp(moved.path.angles, axis=0).min() > 1e-3, "a joint does not move"
    return member


def test_bennett():
    """Opposite links alike, lengths as the sines of the twists, no offsets: by common normals."""
    points, axes = axes_of(found(ring(4), kind="space").mechanism)
    after = np.roll(np.arange(4), -1)
    normals = np.cross(axes, axes[after])
    sines = np.linalg.norm(normals, axis=1)
    lengths = abs(((points[after] - points) * normals).sum(axis=1)) / sines
    assert lengths / sines == pytest.approx(np.full(4, lengths[0] / sines[0]), rel=1e-8)
    assert lengths[:2] == pytest.approx(lengths[2:], rel=1e-8)
    assert sines[:2] == pytest.approx(sines[2:], rel=1e-8)
    assert min(lengths) > 0.01
    assert min(sines) > 0.01


def test_sarrus():
    _, axes = axes_of(found(ring(6), "two triples of parallel axes").mechanism)
    parallel = np.linalg.norm(np.cross(axes[:, None], axes[None]), axis=2) < 1e-9
    assert sorted(map(tuple, np.unique(parallel, axis=0))) == [(False,) * 3 + (True,) * 3, (True,) * 3 + (False,) * 3]


@pytest.mark.slow
def test_kaleidocycle():
    points, axes = axes_of(found(ring(6), "equal links").mechanism)
    after = np.roll(np.arange(6), -1)
    assert abs((axes * axes[after]).sum(axis=1)).max() < 1e-12
    lengths = abs(((points[after] - points) * np.cross(axes, axes[after])).sum(axis=1))
    assert lengths == pytest.approx(np.full(6, lengths[0]), rel=1e-10)


@pytest.mark.slow
def test_bricard_with_a_line_of_symmetry():
    points, axes = axes_of(found(ring(6), "line symmetry, 0 joints and 0 links").mechanism)
    moments = np.cross(points, axes)
    turned = np.concatenate([axes * (-1, -1, 1), moments * (-1, -1, 1)], axis=1)
    there = np.concatenate([axes, moments], axis=1)[[3, 4, 5, 0, 1, 2]]
    assert np.minimum(abs(turned - there).max(axis=1), abs(turned + there).max(axis=1)).max() < 1e-9


def inner_sectors(sheet):
    """The sectors about each inner vertex, in order."""
    places = np.array(sheet.coordinates)
    for vertex in range(sheet.vertices):
        round_it = [side for face in sheet.faces if vertex in face for side in sides_of_face(face) if vertex in side]
        ends = {a if b == vertex else b for a, b in round_it}
        if len(round_it) == 2 * len(ends):
            arms = sorted((places[end] - places[vertex] for end in ends), key=lambda arm: np.arctan2(arm[1], arm[0]))
            yield sectors(np.column_stack([np.array(arms), np.zeros(len(arms))]))


def middle_panel(sheet):
    counts = {}
    for face in sheet.faces:
        for a, b in sides_of_face(face):
            counts[frozenset((a, b))] = counts.get(frozenset((a, b)), 0) + 1
    (face,) = (f for f in sheet.faces if all(counts[frozenset(side)] == 2 for side in sides_of_face(f)))
    return np.array(sheet.coordinates)[list(face)]


def test_miura():
    """Each vertex is symmetric about a line that goes straight on, panels are parallelograms."""
    sheet = found(mechanism_from_map_id(QUADS), "lines 1 straight, opposite creases").mechanism
    vertices = list(inner_sectors(sheet))
    assert len(vertices) == 4
    acute = []
    for a, b, c, d in vertices:
        straight = (b, c, d, a) if a + b == pytest.approx(np.pi, abs=1e-9) else (c, d, a, b)
        one, other = min(a, b, c, d), max(a, b, c, d)
        assert one + other == pytest.approx(np.pi, abs=1e-9)
        assert sorted(straight) == pytest.approx([one, one, other, other], abs=1e-9)
        acute.append(one)
    assert acute == pytest.approx([acute[0]] * 4, abs=1e-9)
    corners = middle_panel(sheet)
    assert corners[1] - corners[0] == pytest.approx(corners[2] - corners[3], abs=1e-9)


def test_square_twist():
    sheet = found(mechanism_from_map_id(QUADS), "flat-foldable, turns by 90 degrees, lines bent").mechanism
    corners = middle_panel(sheet)
    sides = np.roll(corners, -1, axis=0) - corners
    assert np.linalg.norm(sides, axis=1) == pytest.approx([np.linalg.norm(sides[0])] * 4, rel=1e-9)
    assert abs((sides * np.roll(sides, -1, axis=0)).sum(axis=1)).max() < 1e-9
    for angles in inner_sectors(sheet):
        assert angles[0] + angles[2] == pytest.approx(np.pi, abs=1e-9)
        assert max(abs(angles - np.pi / 2)) > 0.05, "two lines that cross"


@pytest.mark.slow
def test_ratios_that_agree_round_a_pentagon():
    """Five vertices about a panel: half-angle tangents keep their ratios along the motion, by the angles alone."""
    pentagon = [tuple(range(5))]
    for v in range(5):
        pentagon += [(5 + 2 * v, v, 6 + 2 * v), (6 + 2 * v, v, (v + 1) % 5, 5 + 2 * ((v + 1) % 5))]
    scd = scd_from_panels(pentagon)
    assert not synth.realise(scd, freedoms=1, geometry="flat-foldable, lines", tries=2).members
    member = found(scd, "ratios that agree round panels, lines bent")
    angles = synth.move(member.mechanism, frames=4, branch=member.number).path.angles
    tangents = np.tan(angles[1:-1] / 2)
    ratios = tangents / tangents[:, :1]
    assert ratios == pytest.approx(np.broadcast_to(ratios[0], ratios.shape), rel=1e-7)
    for sectors_of in inner_sectors(member.mechanism):
        assert sectors_of[0] + sectors_of[2] == pytest.approx(np.pi, abs=1e-9)


def test_derivatives_of_conditions_on_drawings():
    pattern = pattern_of(mechanism_from_map_id(QUADS))
    random = np.random.default_rng(0)
    places = barycentric_start(pattern, random)[0]
    places = places + 0.05 * random.standard_normal(places.shape)
    conditions = [agreeing_ratios(pattern, [True, False, True, False]), bent_line(pattern, 0.3)]
    conditions += [parallel_creases(pattern), *(straight_lines(pattern, one) for one in bundles(pattern))]
    for condition in conditions:
        _, exact = condition(places)
        for place in range(places.size):
            nudge = np.zeros(places.size)
            nudge[place] = 1e-6
            ahead, back = (condition(places + sign * nudge.reshape(places.shape))[0] for sign in (1, -1))
            assert exact[:, place] == pytest.approx((ahead - back) / 2e-6, rel=1e-5, abs=1e-5)


def test_a_general_member_is_rigid():
    """Another way to say that the geometry is special: a member that was not chosen does not move."""
    at = synth.realise(mechanism_from_map_id(QUADS), tries=2).configuration
    assert all(one.freedoms is None or one.immobile for one in at.branches.branches)


@pytest.mark.parametrize("tries", [1, slow(2)])
def test_none_is_an_answer_with_the_work_done(tries):
    """A spatial ring of five: nothing in the families that end at once."""
    answer = synth.realise(ring(5), freedoms=1, geometry="joint and 1 link on themselves", tries=tries, kind="space")
    assert answer.members == ()
    assert answer.work > 0
    assert sum(number for _, number in answer.trials[0].reasons) == tries
    assert answer.type_with_mark.special is None
    assert "proves nothing" in str(answer)


def test_what_never_moves_is_proved():
    chain = SCGraph(6, [(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 5), (5, 2)], [Loop((0, 1, 2)), Loop((3, 4, 5, 6))])
    answer = synth.realise(chain, freedoms=2)
    assert "three axes about a point" in answer.proof
    assert not answer.trials


def test_trivial_motions_are_refused_unless_asked_for():
    """Two parallel lines fold alone: no member where all joints are to move."""
    scd = mechanism_from_map_id(QUADS)
    options = {"freedoms": 2, "geometry": "flat-foldable, turns by 90 degrees, 4", "tries": 1}
    assert not synth.realise(scd, **options).members
    (member,) = synth.realise(scd, **options, all_joints=False).members
    assert member.branch.immobile


def test_the_type_stays_the_same_and_the_mark_is_written(tmp_path):
    told = run(
        "realise", QUADS, "--freedoms", "1", "--json",
        "-o", str(tmp_path / "found.fold"), "--mark", str(tmp_path / "type.json"),
    )  # fmt: skip
    answer = json.loads(told.stdout)
    assert answer["found"]
    marked = synth.read(tmp_path / "type.json")
    assert map_id(marked) == QUADS
    assert marked.special.freedoms == 1
    assert marked.special.conditions == (answer["members"][0]["family"], *answer["members"][0]["reasons"])
    again = synth.realise(synth.read(tmp_path / "found.fold"), freedoms=1)
    assert map_id(again.graph) == QUADS
    assert synth.fold(synth.read(tmp_path / "found.fold"), frames=2).freedoms == 1


def test_wrong_questions_are_one_line():
    with pytest.raises(InvariantError, match="already"):
        synth.realise(mechanism_from_map_id("m1:a-b.ac-.b-d.cd-"), freedoms=1)
    with pytest.raises(UnsolvableError, match="no family"):
        synth.realise(ring(6), freedoms=1, geometry="nonsense")
    with pytest.raises(InvariantError):
        synth.realise(ring(6), freedoms=1, symmetric=True)


def test_derivatives_of_conditions():
    """By differences, a second method."""
    random = np.random.default_rng(0)
    rows = random.standard_normal((6, 6))
    groups = [AxisGroup((0, 1, 2), "finite"), AxisGroup((1, 3), "infinite")]
    for condition in (normal(4), meeting(groups, 4), equal_links((0, 1, 2, 3))):
        exact = derivatives(condition, rows)
        for place in range(rows.size):
            nudge = np.zeros(rows.size)
            nudge[place] = 1e-5
            ahead, back = (condition(rows + sign * nudge.reshape(rows.shape)) for sign in (1, -1))
            assert exact[:, place] == pytest.approx((ahead - back) / 2e-5, abs=1e-7)


@pytest.mark.slow
def test_axes_of_a_group_meet():
    of = found(ring(6), "two triples of axes").mechanism
    points, axes = axes_of(of)
    for triple in ([0, 1, 2], [3, 4, 5]):
        assert lines_meet(points[triple], axes[triple]).off.max() < 1e-9
