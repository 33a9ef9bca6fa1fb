"""Search by motion: signatures that frames, speed and direction do not change, and members found by their motions."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from itertools import product as product_of
from pathlib import Path

import numpy as np
import pytest
from commands import run
from scipy.optimize import differential_evolution

import synth
import synth.synthesis.atlas.motions
from graphs.errors import FileError, InvariantError, StoreError
from graphs.files.formats import mechanism_of_id
from graphs.geometry import unit
from graphs.types import Floats
from synth.analysis.members.circuits import across, circuits_of, product, relative
from synth.linkages.guidance.orientations import write_orientations
from synth.synthesis.atlas.atlas_file import Atlas, open_atlas
from synth.synthesis.atlas.axis_fit import AxisFit
from synth.synthesis.atlas.building import AtlasPlan, build_atlas
from synth.synthesis.atlas.in_order import differences_in_order
from synth.synthesis.atlas.motions import add_motions, like, motion_curve, planned_motions, stored_motions
from synth.synthesis.atlas.signatures import MotionCurve, angles_between, arc_distances, difference, signatures_of

ROOT = Path(__file__).resolve().parents[4]
MEMBERS = 24


@pytest.fixture(scope="session")
def moving_atlas(small_atlas: Atlas, tmp_path_factory: pytest.TempPathFactory) -> Atlas:
    """Return an atlas with motions of a few members of the chains of up to six links."""
    place = tmp_path_factory.mktemp("motions") / "moving.sqlite"
    shutil.copy(small_atlas.path, place)
    atlas = open_atlas(place)
    table = add_motions(atlas, members=MEMBERS)
    assert table.to_json() == planned_motions(atlas, MEMBERS).to_json()
    return atlas


@pytest.fixture(scope="session")
def few_motions(small_atlas: Atlas, tmp_path_factory: pytest.TempPathFactory) -> Atlas:
    """Return the atlas with motions of fewer members, 4 of each chain."""
    place = tmp_path_factory.mktemp("motions") / "few.sqlite"
    shutil.copy(small_atlas.path, place)
    atlas = open_atlas(place)
    add_motions(atlas, members=4)
    return atlas


def smooth(parameter: Floats) -> Floats:
    """Rotations of a circuit, at any parameters from 0 to 1."""
    turn = 2.0 * np.pi * parameter[:, None]
    vectors = np.hstack([np.cos(turn), np.sin(turn), 0.4 * np.cos(2 * turn), 0.3 * np.sin(3 * turn) + 0.5])
    return np.asarray(unit(vectors))


def elsewhere(rows: Floats, seed: int) -> Floats:
    """The same motion, in other frames of both links."""
    left, right = unit(np.random.default_rng(seed).normal(size=(2, 4)))
    return product(product(np.broadcast_to(left, rows.shape), rows), np.broadcast_to(right, rows.shape))


def test_a_signature_is_that_of_the_motion_in_other_frames_backwards_and_at_another_speed() -> None:
    every = np.arange(256) / 256
    own = signatures_of(smooth(every)[None])
    moved = 0.37 + every + 0.1 * np.sin(2.0 * np.pi * every)
    other = signatures_of(elsewhere(smooth(moved[::-1]), 1)[None])
    assert np.abs(own.circuits - other.circuits).max() < 1e-6
    curve = MotionCurve.of(elsewhere(smooth(moved), 2), closed=True)
    assert np.abs(curve.circuit_numbers() - own.circuits[0]).max() < 1e-6
    assert difference(curve, MotionCurve.of(smooth(every), closed=True)) < 1e-6


def test_numbers_of_known_motions() -> None:
    """A rotation about one axis: the angle of two places is the arc between them, so all ratios are 1."""
    turn = np.linspace(0.0, 2.0 * np.pi, 300, endpoint=False)
    about_z = np.stack([np.cos(turn / 2), 0.0 * turn, 0.0 * turn, np.sin(turn / 2)], axis=1)
    found = signatures_of(about_z[None])
    assert found.circuits[0, 0] == pytest.approx(0.5)
    # sin^2 of half of 180, 90, 45 and 135 degrees, and no harmonics
    means = (np.sin(np.pi / 4) ** 2, np.sin(np.pi / 8) ** 2, np.sin(3 * np.pi / 8) ** 2)
    assert found.circuits[0, 1:] == pytest.approx(
        [1, 0, 0, means[0], 0, 0, 0, means[1], 0, 0, 0, means[2], 0, 0, 0], abs=1e-6
    )
    assert found.spans[0] == pytest.approx(np.ones((24, 2)), abs=1e-6)
    circle = np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], axis=1)  # a great circle is the same path of a point
    assert signatures_of(circle[None]).circuits == pytest.approx(found.circuits, abs=1e-6)


@pytest.mark.parametrize("begin", [0.0, 0.21, 0.55, 0.93])
def test_a_third_of_a_circuit_is_found_in_it(begin: float) -> None:
    whole = MotionCurve.of(smooth(np.arange(500) / 500), closed=True)
    others = MotionCurve.of(unit(smooth(np.arange(500) / 500) * [1.0, 0.4, 2.0, 1.0]), closed=True)
    at = whole.length * (begin + np.linspace(0.0, 1.0 / 3.0, 200))
    arc = MotionCurve.of(elsewhere(whole.at(at)[::-1], 3))
    assert not arc.closed
    every = np.stack([whole.at(whole.length * np.arange(256) / 256), others.at(others.length * np.arange(256) / 256)])
    right, wrong = arc_distances(signatures_of(every), arc.goals())
    assert right < 0.01 < wrong
    assert difference(arc, whole) < 1e-6
    assert difference(whole, arc) == np.inf


def test_members_are_found_by_their_own_motions(moving_atlas: Atlas) -> None:
    with closing(sqlite3.connect(moving_atlas.path)) as connection:
        rows = dict(connection.execute("SELECT chain, axes FROM motions"))
    for code, first, second, points in (("k1:Cr", 0, 3, False), ("k1:E`hW", 0, 2, False), ("k1:E`hW", 3, 4, True)):
        chain = mechanism_of_id(code)
        joints = len(chain.joints)
        directions = np.frombuffer(rows[code][:-4]).reshape(-1, joints + len(chain), 3)[[17]]
        turned = circuits_of(chain, directions[:, :joints], frames=500).rotations()
        motion = relative(turned[first], turned[second])[0]
        if points:
            still = np.concatenate([[0.0], directions[0, joints + list(chain).index(second)]])
            moved = product(product(motion, np.broadcast_to(still, motion.shape)), motion * [1, -1, -1, -1])
            motion = (moved[:, 1:] @ np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0])[::-1]
        else:
            motion = elsewhere(motion, 5)[::-1]
        for rows_of_it, closed in ((np.roll(motion, 100, axis=0), True), (motion[40:260], None)):
            best = like(moving_atlas, rows_of_it, closed=closed).rows[0]
            assert best.distance < 2e-5, (code, closed)
            assert (best.chain, set(best.links)) == (code, {first, second})
            assert np.abs(np.array(list(best.axes.values())) - directions[0, :joints]).max() < 1e-12
            assert (best.point is None) != points


def in_space(first: Floats, second: Floats) -> float:
    """By how much vectors miss others that are turned or mirrored, of quaternions either sign: the second method."""
    least = np.inf
    for signs in product_of([1.0, -1.0], repeat=len(first) - 1 if first.shape[1] == 4 else 0):
        signed = second * np.concatenate([[1.0], signs, np.ones(len(first) - 1 - len(signs))])[:, None]
        left, _, right = np.linalg.svd(first.T @ signed)
        least = min(least, float(np.abs(first @ (left @ right) - signed).max()))
    return least


@pytest.mark.parametrize("atlas", ["few_motions", pytest.param("moving_atlas", marks=pytest.mark.slow)])
@pytest.mark.parametrize(("code", "first", "second", "backwards"), [("k1:Cr", 0, 3, False), ("k1:E`hW", 3, 4, True)])
def test_five_orientations_are_found_on_the_circuit_from_which_they_are(
    atlas: str, code: str, first: int, second: int, backwards: bool, request: pytest.FixtureRequest
) -> None:
    table: Atlas = request.getfixturevalue(atlas)
    with closing(sqlite3.connect(table.path)) as connection:
        axes = connection.execute("SELECT axes FROM motions WHERE chain = ?", (code,)).fetchone()[0]
    chain = mechanism_of_id(code)
    joints = len(chain.joints)
    directions = np.frombuffer(axes[:-4]).reshape(-1, joints + len(chain), 3)[[2]]
    turned = circuits_of(chain, directions[:, :joints], frames=500).rotations()
    circuit = relative(turned[first], turned[second])[0]
    own = elsewhere(circuit[[333, 402, 20, 111, 240]], 8)[:: -1 if backwards else 1]
    answer = like(table, own)
    best = answer.rows[0]
    assert best.distance < 1e-4
    assert (best.chain, set(best.links)) == (code, {first, second})
    assert np.abs(np.array(list(best.axes.values())) - directions[0, :joints]).max() < 1e-12
    assert answer.rows[1].distance > 1e-3
    off, places = differences_in_order(circuit[None], own)
    passed = MotionCurve.of(circuit, closed=True)
    taken = passed.at(passed.length * places[0])
    assert off[0] < 1e-3
    assert in_space(own, taken) < 2e-3
    steps = np.diff(places[0], append=places[0, 0]) * (-1.0 if backwards else 1.0)
    rounds = np.remainder(steps, 1.0).sum()
    to_and_fro = code != "k1:Cr"  # it passes each place twice, so the places are also in order the other way round
    assert rounds == pytest.approx(1.0) or (to_and_fro and rounds == pytest.approx(len(own) - 1.0))


def test_places_in_order_are_as_near_as_those_of_another_search() -> None:
    """Evolution of the places, read from splines, is the second method."""
    random = np.random.default_rng(3)
    circuits = unit(smooth(np.arange(256) / 256)[None] * random.uniform(0.4, 1.8, (6, 1, 4)))
    wanted = unit(smooth(np.array([0.1, 0.35, 0.5, 0.62, 0.9])) * random.uniform(0.6, 1.5, 4))
    found, places = differences_in_order(circuits, wanted)
    one, other = np.triu_indices(5, 1)
    angles = angles_between(wanted[one], wanted[other])
    for off, own, rows in zip(found, places, circuits, strict=True):
        curve = MotionCurve.of(rows, closed=True)

        def missed(parts: Floats, curve: MotionCurve = curve) -> Floats:
            at = curve.at(curve.length * parts)
            return np.asarray(
                np.sqrt(((angles_between(at[..., one, :], at[..., other, :]) - angles) ** 2).mean(axis=-1))
            )

        assert missed(own) == pytest.approx(off, abs=3e-4)
        for way in (1.0, -1.0):
            evolved = differential_evolution(
                lambda x, way=way: missed(way * (x[:1] + np.concatenate([0.0 * x[:1], np.sort(x[1:], axis=0)])).T),
                [(0.0, 1.0)] * 5, vectorized=True, updating="deferred", seed=1, maxiter=60, popsize=12, polish=False,
            )  # fmt: skip
            assert off < evolved.fun + 1e-3


def test_few_orientations_are_no_motion_unless_it_is_stated(few_motions: Atlas, tmp_path: Path) -> None:
    rows = smooth(np.arange(30) / 40)
    sparse = like(few_motions, rows[::4], limit=2)
    assert sparse.sparse
    assert (sparse.to_json()["motion"]["in_order"], sparse.to_json()["motion"]["length_deg"]) == (8, None)
    assert "8 orientations in order on one circuit, compared with 72 motions of the atlas" in str(sparse)
    assert not like(few_motions, rows[::4], closed=False, limit=1).sparse
    with pytest.raises(InvariantError, match="30 rows that are sparse; expected at most 24"):
        like(few_motions, rows, sparse=True)
    points = tmp_path / "points.csv"
    points.write_text("\n".join(",".join(map(repr, row)) for row in unit(rows[::6, 1:]).tolist()))
    result = run("atlas", "like", str(points), str(few_motions.path), "--sparse", "--json")
    assert json.loads(result.stdout)["motion"] == {"of": "a point", "closed": False, "length_deg": None, "in_order": 5}


def test_what_is_found_names_the_types_and_is_a_linkage(moving_atlas: Atlas) -> None:
    answer = like(moving_atlas, ROOT / "data" / "orientations" / "tipparthi.json", limit=4)
    assert answer.compared == stored_motions(moving_atlas).motions == MEMBERS * 18
    assert [row.distance for row in answer.rows] == sorted(row.distance for row in answer.rows)
    for row in answer.rows:
        for code in row.types:
            assert moving_atlas.show(code).values["chain_id"] == row.chain
        assert synth.move(row.linkage, frames=3).path.angles.shape[1] == len(row.axes)


def test_more_members_are_added_and_are_the_same_however_often_it_began(moving_atlas: Atlas, tmp_path: Path) -> None:
    place = tmp_path / "more.sqlite"
    shutil.copy(moving_atlas.path, place)
    atlas = open_atlas(place)
    add_motions(atlas, members=MEMBERS + 5, max_links=4)
    with closing(sqlite3.connect(place)) as one, closing(sqlite3.connect(moving_atlas.path)) as other:
        query = "SELECT motion_circuits FROM motions WHERE chain = 'k1:Cr'"
        more, few = one.execute(query).fetchone()[0], other.execute(query).fetchone()[0]
    assert more[: len(few) - 4] == few[:-4]
    with pytest.raises(StoreError, match="seed 0; expected version 1 and seed 1; try --force"):
        add_motions(atlas, members=5, seed=1)
    assert add_motions(atlas, members=5, max_links=4, seed=1, force=True).members == 5


def test_an_atlas_without_motions_or_with_damaged_ones_says_what_to_do(
    small_atlas: Atlas, moving_atlas: Atlas, tmp_path: Path
) -> None:
    with pytest.raises(StoreError, match="the atlas has no table of motions; try `synth atlas motions"):
        like(small_atlas, smooth(np.arange(20) / 20))
    place = tmp_path / "damaged.sqlite"
    shutil.copy(moving_atlas.path, place)
    with closing(sqlite3.connect(place)) as connection, connection:
        connection.execute("UPDATE motions SET motion_spans = substr(motion_spans, 5)")
    with pytest.raises(StoreError, match="the table of motions is damaged; try synth atlas motions --force"):
        like(open_atlas(place), smooth(np.arange(20) / 50))


def test_frames_of_a_sheet_give_the_fold_angle_of_a_crease(tmp_path: Path) -> None:
    place = tmp_path / "folded.fold"
    run("fold", ROOT / "data/patterns/four-bar-vertex.fold", "--frames", "40", "-o", place)
    sheet = synth.read(place)
    frames = json.loads(place.read_text())["file_frames"]
    turns = [
        abs(np.radians(frames[-1]["edges_foldAngle"][edge] - frames[0]["edges_foldAngle"][edge]))
        for edge in (0, 2, 4, 6)
    ]
    lengths = [motion_curve(place, links=pair).length for pair in ((0, 1), (1, 2), (2, 3), (0, 3))]
    assert sorted(lengths) == pytest.approx(sorted(turns), abs=1e-3)
    with pytest.raises(FileError, match="no links; expected two different faces from 0 to 3"):
        motion_curve(place)
    with pytest.raises(InvariantError, match="links 0, 9"):
        motion_curve(sheet, links=(0, 9))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1,2\n", "line 1: 2 numbers; expected 3 \\(a point\\), 4 \\(a quaternion\\) or 8"),
        ("x,y,z\n0,0,1\n0,1\n", "line 3: 2 numbers"),
        ("0 0 1\nabc\n", "line 2: .*abc.* is no row of numbers"),
        ("0 0 1\n0 1 0\n0 1 0\n", "2 different rows; expected 3 or more"),
        ("0 0 1\n0 0 0\n0 1 0\n", "row 2 is zero"),
    ],
)
def test_tables_that_are_no_motion_are_refused(text: str, message: str, tmp_path: Path) -> None:
    place = tmp_path / "motion.csv"
    place.write_text(text)
    with pytest.raises(FileError, match=message):
        motion_curve(place)


def test_poses_of_two_links_are_their_relative_motion(tmp_path: Path) -> None:
    own = smooth(np.arange(40) / 40)
    ground = unit(np.random.default_rng(1).normal(size=(40, 4)))
    place = tmp_path / "poses.csv"
    both = np.hstack([ground, product(ground, own)])
    place.write_text("\n".join(["# quaternions of both", *(",".join(map(repr, row)) for row in both.tolist())]))
    assert motion_curve(place, closed=True).length == pytest.approx(MotionCurve.of(own, closed=True).length)


def test_the_commands_answer_as_python_does(moving_atlas: Atlas, tmp_path: Path) -> None:
    place, start = tmp_path / "motion.json", tmp_path / "start.json"
    write_orientations(smooth(np.arange(40) / 40), place)
    words = ("atlas", "like", str(place), str(moving_atlas.path), "--closed", "-o", str(start), "--json")
    result = run(*words)
    assert result.exit_code == 0, result.output
    answer = json.loads(result.stdout)["nearest"]
    expected = like(moving_atlas, place, closed=True).to_json()["nearest"]
    for key in ("chain", "links", "types", "name", "point"):
        assert [row[key] for row in answer] == [row[key] for row in expected]
    assert [row["distance_deg"] for row in answer] == pytest.approx([row["distance_deg"] for row in expected])
    assert "at most 300 MB of memory" in result.stderr
    assert len(synth.read(start).axes) in (4, 7)
    result = run("atlas", "like", str(place), str(moving_atlas.path), "--closed", "--fit", "4")
    assert "; the axes of 4 members were fitted to it" in result.stdout
    result = run("atlas", "motions", str(moving_atlas.path), "--members", str(MEMBERS))
    assert f"{3 * MEMBERS} members of 3 chains" in result.stdout


@pytest.mark.slow
def test_hidden_members_come_near_members_of_the_atlas(moving_atlas: Atlas, tmp_path: Path) -> None:
    """Their own chain, or one with no more links, is among the nearest ten, to some degrees."""
    place = tmp_path / "many.sqlite"
    shutil.copy(moving_atlas.path, place)
    atlas = open_atlas(place)
    add_motions(atlas, members=2000)
    found, off = 0, []
    for number in range(30):
        chain = mechanism_of_id(("k1:Cr", "k1:E`hW", "k1:E@zO")[number % 3])
        axes = np.random.default_rng([2024, number]).normal(size=(1, len(chain.joints), 3))
        turned = circuits_of(chain, axes).rotations()
        pairs = [(a, b) for a in chain for b in chain if a < b and not chain.has_edge(a, b)]
        first, second = pairs[number % len(pairs)]
        rows = like(atlas, elsewhere(relative(turned[first], turned[second])[0], number), closed=True).rows
        found += any(len(mechanism_of_id(row.chain)) <= len(chain) for row in rows)
        off.append(rows[0].distance)
    assert found == 30
    assert np.median(off) < np.radians(6.0)


@pytest.mark.parametrize("part", [0.34, 0.5, 0.9])
def test_what_a_limit_leaves_out_is_farther_and_the_rest_is_as_without(part: float) -> None:
    """The search of every place of every circuit is the second method; a bound leaves out most of them."""
    random = np.random.default_rng(4)
    parameter = np.arange(128) / 128
    stretched = random.uniform(0.5, 1.6, (400, 1, 4))
    rows = unit(smooth(parameter)[None] * stretched)
    signatures = signatures_of(rows)
    whole = MotionCurve.of(rows[7], closed=True)
    goals = MotionCurve.of(elsewhere(whole.at(whole.length * part * np.linspace(0.0, 1.0, 150)), 6)).goals()
    every = arc_distances(signatures, goals)
    assert int(every.argmin()) == 7
    for place in (1, 10, 32):
        limit = float(np.sort(every)[place])
        bounded = arc_distances(signatures, goals, limit)
        near = every <= limit
        assert np.abs(bounded[near] - every[near]).max() < 1e-6
        assert (bounded[~near] > limit).all()
        assert np.isinf(bounded).sum() > np.isinf(every).sum() + 20


@pytest.mark.parametrize("part", [0.34, 0.6])
def test_blocks_that_are_bounded_find_what_one_block_of_all_finds(
    moving_atlas: Atlas, part: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    turned = circuits_of(mechanism_of_id("k1:E@zO"), np.random.default_rng(8).normal(size=(1, 7, 3))).rotations()
    arc = relative(turned[0], turned[3])[0][: int(256 * part)]
    found = []
    for first in (40, 1 << 20):
        monkeypatch.setattr(synth.synthesis.atlas.motions, "_FIRST", first)
        monkeypatch.setattr(synth.synthesis.atlas.motions, "_AT_ONCE", 80)
        answer = like(moving_atlas, arc, closed=False, limit=32)
        found.append((answer.compared, [(row.distance, row.chain, row.links, row.axes) for row in answer.rows]))
    assert found[0] == found[1]
    assert len(found[0][1]) > 10


@pytest.mark.parametrize("closed", [True, False])
def test_the_difference_is_that_of_the_best_of_many_beginnings_both_ways(closed: bool) -> None:
    turn = 2.0 * np.pi * np.arange(300)[:, None] / 300
    rows = np.hstack([np.cos(turn), np.sin(turn), 0.4 * np.cos(2 * turn + 1.0), 0.5 * np.sin(3 * turn + 0.3) + 0.5])
    whole = MotionCurve.of(unit(rows), closed=True)
    stretched = MotionCurve.of(unit(rows * [1.0, 0.9, 1.1, 1.0]), closed=True)
    rows = stretched.at(stretched.length * np.linspace(0.2, 1.2 if closed else 0.6, 200))
    motion = MotionCurve.of(rows[::-1], closed=closed)
    places = np.arange(24) / (24 if closed else 23)
    reach = whole.length if closed else motion.length
    begins = whole.length * np.arange(4000) / 4000
    mine = motion.at(motion.length * places)
    best = []
    for way in (1.0, -1.0):
        theirs = whole.at(begins[:, None] + way * reach * places)
        off = [
            angles_between(theirs[:, one], theirs[:, other]) - angles_between(mine[one], mine[other])
            for one in range(24)
            for other in range(one)
        ]
        best.append(float(np.sqrt((np.array(off) ** 2).mean(axis=0)).min()))
    assert abs(best[0] - best[1]) > 0.01  # the ways differ
    assert min(best) - 1e-4 < difference(motion, whole) <= min(best) + 1e-12


def six_bars(seed: int, count: int) -> tuple[Floats, list[tuple[int, int]]]:
    """Axes of six-bars of Watt's chain, and two links of each."""
    axes = unit(np.random.default_rng(seed).normal(size=(count, 7, 3)))
    return axes, [((0, 2), (1, 3), (2, 5), (0, 3), (1, 4), (0, 5))[number % 6] for number in range(count)]


@pytest.mark.parametrize("part", [1.0, 0.4])
def test_slopes_of_a_fit_are_differences_of_circuits_that_are_traced(part: float) -> None:
    """The second method turns each axis by 1e-4 radians both ways, and traces the circuits anew."""
    axes, pairs = six_bars(0, 4)
    whole = MotionCurve.of(smooth(np.arange(300) / 300), closed=True)
    motion = whole if part == 1.0 else MotionCurve.of(whole.at(whole.length * part * np.linspace(0.0, 1.0, 60)))
    fit = AxisFit(mechanism_of_id("k1:E`hW"), axes, pairs, motion)
    misses = {}
    for column in (0, 3, 9, 12):
        turn = 1e-4 * across(axes)[:, column // 2, column % 2]
        for way in (1.0, -1.0):
            turned = axes.copy()
            turned[:, column // 2] += np.cross(way * turn, axes[:, column // 2])
            misses[column, way] = fit.residual_at(unit(turned))
    slopes = fit.jacobian_of(np.arange(4))
    for column in (0, 3, 9, 12):
        traced = (misses[column, 1.0] - misses[column, -1.0]) / 2e-4
        off = np.linalg.norm(slopes[:, :, column] - traced, axis=1)
        assert (off < 0.05 * np.linalg.norm(traced, axis=1) + 0.01).all()


@pytest.mark.parametrize("part", [1.0, 0.5])
def test_axes_that_are_a_little_off_are_fitted_to_the_motion(part: float) -> None:
    axes, pairs = six_bars(0, 6)
    chain = mechanism_of_id("k1:E`hW")
    turned = circuits_of(chain, axes).rotations()
    random = np.random.default_rng(3)
    for member in (1, 5):
        first, second = pairs[member]
        rows = elsewhere(relative(turned[first], turned[second])[member], 4)[::-1]
        motion = MotionCurve.of(rows[: int(256 * part)], closed=part == 1.0)
        begun = unit(axes[[member] * 4] + 0.02 * random.normal(size=(4, 7, 3)))
        fit = AxisFit(chain, begun, [(first, second)] * 4, motion)
        before = fit.costs.copy()
        fit.run([(3, 4), (40, 2)])
        assert (fit.costs <= before).all()
        assert np.sqrt(fit.costs.min() / 276) < 2e-4 < 2e-3 < np.sqrt(before.min() / 276)


def test_members_are_fitted_and_only_to_motions_of_two_links(moving_atlas: Atlas) -> None:
    axes, pairs = six_bars(5, 1)
    first, second = pairs[0]
    turned = circuits_of(mechanism_of_id("k1:E`hW"), axes).rotations()
    motion = relative(turned[first], turned[second])[0]
    near, fitted = (like(moving_atlas, motion, closed=True, fit=fit) for fit in (0, 6))
    assert fitted.fitted == 6
    assert fitted.rows[0].distance < 0.5 * near.rows[0].distance
    best = fitted.rows[0]
    again = circuits_of(mechanism_of_id(best.chain), [list(best.axes.values())]).rotations()
    own = MotionCurve.of(relative(again[best.links[0]], again[best.links[1]])[0], closed=True)
    assert difference(MotionCurve.of(motion, closed=True), own) == pytest.approx(best.distance, abs=1e-4)
    with pytest.raises(InvariantError, match="the path of a point; expected a motion of two links"):
        like(moving_atlas, smooth(np.arange(20) / 20)[:, :3], fit=3)


def test_an_atlas_that_is_repaired_keeps_its_motions(moving_atlas: Atlas, tmp_path: Path) -> None:
    place = tmp_path / "repaired.sqlite"
    shutil.copy(moving_atlas.path, place)
    with closing(sqlite3.connect(place)) as connection, connection:
        connection.execute("DELETE FROM type WHERE rowid = 3")
    with pytest.warns(UserWarning, match="repaired a damaged store"):
        build_atlas(place, AtlasPlan(6, realised=False), resume=True)
    rows = []
    for path in (place, moving_atlas.path):
        with closing(sqlite3.connect(path)) as connection:
            rows.append(connection.execute("SELECT * FROM motions ORDER BY chain, unit").fetchall())
    assert rows[0] == rows[1]
    assert open_atlas(place).about() == moving_atlas.about()
