"""Conical candidates as a job: rebuilt and moved in space, on slots, sampled, filtered, resumed."""

from __future__ import annotations

import os
import pickle
import signal

import numpy as np
import pytest
from commands import run
from conical import STEPHENSON, WATT
from conical_rows import canonical_row
from rebuilt import Space, closing_error
from sizes import slow

from enumerate.chains.jobs import chains
from enumerate.conical.query import Portion, count_conical_orders, links_apart
from enumerate.runner._run import run as run_job
from enumerate.runner.job import row_as_dict
from enumerate.runner.sinks import RowSink
from enumerate.runner.stopping import Interrupted
from enumerate.runner.store import SqliteSink, read_rows
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.geometry import angles_between
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, joint_axes
from synth.linkages.conformed.behaviours import link_arcs
from synth.linkages.conformed.rates import ConformedChain, loops_of_chain
from synth.linkages.surfaces.circuit import link_angles, link_pairs, loop_steps
from synth.linkages.surfaces.linkage_maps import common_surfaces
from synth.synthesis.candidates.job import CandidateJob, Filter
from synth.synthesis.candidates.rows import four_bar_classes


def eight_bars():
    return [sc_from_link_joint_graph(graph) for graph in chains(8, 1)]


# ---- rebuilt in space ---------------------------------------------------------------------------------------


def random_candidates(rng, count):
    """Jobs with lambda, and one row of each."""
    pool = [(chain, ground) for chain in (WATT, STEPHENSON) for ground in links_apart(chain.joints)]
    pool += [(chain, rng.choice(list(chain))) for chain in eight_bars()]
    for number in range(count):
        chain, ground = pool[number % len(pool)]
        lam, joints = rng.uniform(0.15, 1.2), len(chain.joints)
        one = CandidateJob(chain, (ground,), samples=1, seed=number, surface=None if lam is None else Cone(lam))
        order = canonical_row(rng.permutation(joints), one.query.symmetries(ground), joints)
        [row] = one.work(Portion(ground, order))
        yield one, dict(zip(one.columns, row, strict=True))


@pytest.mark.parametrize("count", [20, slow(1000)])
def test_random_candidates_rebuilt_in_space(count, rng):
    """Axes on the cone, loops close, sums are multiples of 360 degrees, links go where velocities say."""
    told = 0
    for job, row in random_candidates(rng, count):
        lam, places = job.surface and job.surface.angle, job.places(row)
        chain = job.chain
        axes = joint_axes(places, lam)
        np.testing.assert_allclose(np.arctan2(-axes[:, 1], np.hypot(axes[:, 0], axes[:, 2])), lam, atol=1e-12)
        joints = list(chain.joints)
        angles = {(a, b): x for a, b, x in row["link_angles_deg"]}
        for pair in link_pairs(chain):
            i, j = (joints.index(joint) for joint in pair)
            measured = float(np.degrees(angles_between(axes[i], axes[j])))
            assert angles[str(joints[min(i, j)]), str(joints[max(i, j)])] == pytest.approx(measured, abs=1e-7)
        every = loops_of_chain(chain)
        whole = SCGraph(chain.nodes, chain.joints, chain.loops)
        for loop, turns in zip(every, row["turns"], strict=True):
            mine = places[[joints.index(joint) for joint in loop]]
            steps = np.remainder(np.roll(mine, -1) - mine + np.pi, 2 * np.pi) - np.pi
            rounds = steps.sum() / (2 * np.pi)
            assert abs(rounds - round(rounds)) < 1e-9
            assert abs(round(rounds)) == turns
            if len(loop) > 2:
                assert closing_error(steps, link_angles(steps, lam), lam) < 1e-7
        assert all(abs(loop.circuits.residual) < 1e-9 for loop in loop_steps(whole, places))
        if row["freedoms"] == 1:
            told += moved_as_told(job, row, places, lam)
    assert told > 0.9 * count


def moved_as_told(job, row, places, lam):
    """Move a candidate a little both ways; compare with its row. Whether something could be compared."""
    ground = next(link for link in job.chain if str(link) == row["ground"])
    space = Space(job.chain, ground, places, lam)
    _, values, rows = np.linalg.svd(space.jacobian())
    rank = int((values > 1e-9 * values[0]).sum())
    assert rank == row["rank"]
    if values[rank - 1] < 1e-3 * values[0]:
        return False  # so near to a singular position that a small motion is not small
    h = 2e-5
    ahead, back = (space.moved(sign * h * rows[-1]) for sign in (1, -1))
    assert max(ahead[1], back[1]) < 1e-12
    conformed = ConformedChain.of(job.chain, ground)
    arcs = dict(zip(conformed.links, link_arcs(conformed, places), strict=True))
    rates = {}
    for link in job.chain:
        start, length = arcs[link]
        points = start + length * np.linspace(0, 1, 25)
        rates[link] = (space.outward(link, points, ahead[0]) - space.outward(link, points, back[0])) / (2 * h)
    scale = max(np.abs(one).max() for one in rates.values())
    ways = dict(row["ways"])
    first = {}
    for link, rate in rates.items():
        out, into = (rate > 1e-4 * scale).any(), (rate < -1e-4 * scale).any()
        edge = np.abs(rate[[0, -1]]).min() < 1e-3 * scale and str(ways[str(link)]) == "both"
        if link == ground:
            assert not out
            assert not into
        elif out and into:
            assert ways[str(link)] == "both"
        elif (out or into) and not edge:  # slower links are too near to standing still for finite differences
            first[link] = 1 if out else -1
            assert ways[str(link)] in ("outward", "inward")
    sense = {first[link] * (1 if ways[str(link)] == "outward" else -1) for link in first}
    assert len(sense) <= 1  # one sense of the motion for all links
    return True


# ---- the job --------------------------------------------------------------------------------------------------


def test_slots_agree_with_the_counts_and_the_inverse(rng):
    """Link angles of a candidate with lambda give the cone, its signs and its azimuths back."""
    job = CandidateJob(STEPHENSON, (0,), slots=8, surface=Cone(np.radians(35)))
    rows = job.rows()
    assert len(rows) == count_conical_orders(job.query)
    assert len({tuple(row["slots"]) for row in rows}) == len(rows)
    assert not any(row["singular"] for row in rows)
    for row in rng.choice(rows, 25):
        places = job.places(row)
        at = dict(zip(STEPHENSON.joints, places, strict=True))
        half = [abs(abs(np.remainder(at[a] - at[b], 2 * np.pi)) - np.pi) < 1e-9 for a, b in link_pairs(STEPHENSON)]
        assert sum(half) == row["half_turn_steps"] == len(row["half_turns"])
        if any(half):
            continue
        angles = {(a, b): float(link_angles(at[b] - at[a], job.surface.angle)) for a, b in link_pairs(STEPHENSON)}
        cones, families = common_surfaces(STEPHENSON, angles)
        assert not families
        hits = [one for one in cones if abs(one.surface.angle - job.surface.angle) < 1e-7]
        assert any(
            np.abs(np.exp(1j * np.array([one.places[j] for j in at])) - turned).max() < 1e-5
            for one in hits
            for turned in (
                np.exp(1j * (places - places[0])) * np.exp(1j * one.places[next(iter(at))]),
                np.exp(-1j * (places - places[0])) * np.exp(1j * one.places[next(iter(at))]),
            )
        )


def test_samples_are_the_same_every_time_and_in_any_process():
    job = CandidateJob(WATT, (0, 1), samples=2, seed=5)
    rows = job.rows()
    assert len(rows) == 2 * (192 + 360)
    found = []
    run_job(pickle.loads(pickle.dumps(job)), RowSink(lambda names, more: found.extend(more)), workers=2)
    assert [row_as_dict(job.columns, row) for row in found] == rows
    assert rows != CandidateJob(WATT, (0, 1), samples=2, seed=6).rows()
    for row in rows[::50]:
        places = job.places(row)
        assert [str(j) for j in np.array(list(WATT.joints))[np.argsort(places)]] == row["order"]


def test_filters_keep_what_they_say():
    job = CandidateJob(WATT, (0,), slots=8)
    rows = job.rows()
    kept = CandidateJob(
        WATT, (0,), slots=8, filters=(Filter("open_loops", least=1, most=2), Filter("linkage", "one way"))
    ).rows()
    assert kept == [row for row in rows if 1 <= row["open_loops"] <= 2 and row["linkage"] == "one way"]
    assert 0 < len(kept) < len(rows)


@pytest.mark.parametrize(("slots", "number"), [(8, 3_792), slow(9, 15_168)])
def test_a_stopped_run_goes_on(slots, number, tmp_path):
    store = tmp_path / "watt.sqlite"
    job = CandidateJob(WATT, (0, 1), slots=slots, surface=Cone(0.3))

    def press(progress):
        if progress.done == 3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted):
        run_job(job, SqliteSink(store), report=press)
    assert 0 < len(list(read_rows(store))) < number
    progress = run_job(job, SqliteSink(store, resume=True), workers=2)
    assert progress.done == progress.units > 3
    found = list(read_rows(store))
    assert len(found) == count_conical_orders(job.query) == number
    first = job.work(job.units()[0].payload)[:200]
    assert [row_as_dict(job.columns, row) for row in found[: len(first)]] == [
        row_as_dict(job.columns, row) for row in first
    ]


@pytest.mark.slow
def test_a_chain_of_two_freedoms_and_singular_eight_bars():
    five = SCGraph(5, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)])
    rows = CandidateJob(five, (0,)).rows()
    assert len(rows) == 8
    assert "linkage" not in rows[0]
    placed = CandidateJob(five, (0,), slots=6).rows()
    assert {row["linkage"] for row in placed} == {"not known"}
    assert {row["rank"] for row in placed} == {3}
    # a chain without four-bar loops can be singular: two of its joints' rates vanish, or three axes' planes agree
    hard = next(sc for sc in eight_bars() if min(map(len, loops_of_chain(sc))) > 4)
    job = CandidateJob(hard, slots=10)
    some = [row for unit in job.units()[:40] for row in job.work(unit.payload)]
    ranks = {row[list(job.columns).index("rank")] for row in some}
    assert 9 in ranks


def test_parallel_joints():
    rows = CandidateJob(SCGraph(3, {"a": (0, 1), "b": (0, 1), "c": (1, 2), "d": (2, 0)}), (2,)).rows()
    assert all(row["loops"] == [["a", "b"], ["a", "c", "d"], ["b", "c", "d"]] for row in rows)


def check_eight_bars(job, portion):
    """Rows of some cyclic orders: each order with opposites is of one kind."""
    found = [dict(zip(job.columns, row, strict=True)) for row in job.work(portion)]
    assert found
    assert all(sum(row[k] for k in ("one_way", "both_ways", "by_angles", "not_known")) == 512 for row in found)


@pytest.mark.parametrize("cases", [1, slow(2)])
def test_eight_bars_by_orders(cases, rng):
    job = CandidateJob(eight_bars()[0], (0,))
    for _ in range(cases):
        check_eight_bars(job, Portion(0, canonical_row(rng.permutation(10), job.query.symmetries(0), 10)))


@pytest.mark.slow
def test_a_unit_of_eight_bars_by_orders():
    job = CandidateJob(eight_bars()[0], (0,))
    check_eight_bars(job, job.units()[0].payload)


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: CandidateJob(WATT, slots=9, opposites=True), InvariantError, "several of"),
        (lambda: CandidateJob(WATT, surface=Cone(0.3)), InvariantError, "without angles"),
        (lambda: CandidateJob(WATT, ("x",)), InvariantError, "no link"),
        (lambda: CandidateJob(WATT, slots=6), InvariantError, "6 slots for 7 joints"),
        (lambda: CandidateJob(WATT, filters=(Filter("rank", 6),)), InvariantError, "no column 'rank'"),
        (lambda: CandidateJob(SCGraph(4, [(0, 1), (1, 2), (2, 3)])), UnsolvableError, "no loops"),
        (lambda: CandidateJob(SCGraph(4, [(0, 1), (2, 3)])), InvariantError, "connected"),
    ],
)
def test_jobs_that_make_no_sense(make, error, message):
    with pytest.raises(error, match=message):
        make()


def test_candidates_on_a_cylinder_have_lengths(data):
    """Of a file on a cylinder: lengths of links by coordinates, the class of their chords, rows written as files."""
    chain = read(data / "surfaces" / "fig10-four-bar.json").chain
    job = CandidateJob(chain, (1,), slots=7, surface=Cylinder(3.0))
    rows = job.rows()
    assert len(rows) > 5
    for row in rows:
        corners = {
            joint: 3.0 * np.array([np.sin(t), np.cos(t)])
            for joint, t in zip(chain.joints, job.places(row), strict=True)
        }
        for first, second, length in row["link_lengths"]:
            assert length == pytest.approx(np.linalg.norm(corners[first] - corners[second]), rel=1e-9)
        lengths = [length for *_, length in row["link_lengths"]]
        assert (row["grashof_loops"] == 1) == (2 * (max(lengths) + min(lengths)) < sum(lengths) - 1e-12)
        assert "synthedra/cylindrical" in job.mechanism_text(row)
    told = run(
        "enumerate", "conical", "--chain", data / "surfaces" / "fig10-four-bar.json", "--slots", 7, "--radius", 3
    )
    assert "radius 3.0" in told.stdout
    assert "one of them" in run("enumerate", "conical", "--chain", "watt", "--radius", 3, "--lambda", 3, code=2).output


def test_a_crossed_loop_need_not_be_grashof_on_a_steep_cone():
    places = np.radians([0, 150, 20, 160])
    classes = [str(four_bar_classes([(0, 1, 2, 3)], places, surface)[0]) for surface in (None, Cone(0.3))]
    assert classes == ["Grashof", "non-Grashof"]
