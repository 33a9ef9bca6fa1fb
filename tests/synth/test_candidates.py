"""Conical candidates: rebuilt and moved in space, over all angles, on slots; the job, its files and pictures."""

from __future__ import annotations

import json
import os
import pickle
import re
import shlex
import signal

import numpy as np
import pytest
from commands import run
from conical import FOUR_BAR, STEPHENSON, WATT
from rebuilt import Space, closing_error

from enumerate.chains import chains
from enumerate.conical import Portion, count_conical_orders
from enumerate.joint_symmetries import links_apart
from enumerate.rounds import Rounds, canonical_row, placements
from enumerate.run import Interrupted
from enumerate.run import run as run_job
from enumerate.sinks import RowSink
from enumerate.store import SqliteSink, read_rows
from graphs.embedding import sc_from_link_joint_graph
from graphs.errors import InvariantError, UnsolvableError
from graphs.sc import SCGraph
from synth.behaviour import link_arcs
from synth.candidate_values import layers, loop_circuits
from synth.candidates import CandidateJob, Filter
from synth.chain_cycles import loops_of_chain, signed_cycles
from synth.common_cones import common_cones
from synth.cone import link_angles
from synth.conformed import angles_between, joint_axes
from synth.conical_file import read_conical
from synth.first_order import ConformedChain, first_order
from synth.multiloop import link_pairs, loop_steps
from synth.outward import joint_rates, outward_rates
from synth.over_angles import Allowed, never_singular, orders_with_opposites, over_angles, sampled

CHAINS = {"four-bar": FOUR_BAR, "watt": WATT, "stephenson": STEPHENSON}


def eight_bars():
    return [sc_from_link_joint_graph(graph) for graph in chains(8, 1)]


def named(row, key):
    return dict(part.rsplit(":", 1) for part in row[key].split())


# ---- rebuilt in space ---------------------------------------------------------------------------------------


def random_candidates(rng, count):
    """Jobs with lambda, and one row of each."""
    pool = [(chain, ground) for chain in (WATT, STEPHENSON) for ground in links_apart(chain.joints)]
    pool += [(chain, rng.choice(list(chain))) for chain in eight_bars()]
    for number in range(count):
        chain, ground = pool[number % len(pool)]
        lam, joints = rng.uniform(0.15, 1.2), len(chain.joints)
        one = CandidateJob(chain, (ground,), samples=1, seed=number, cone_angle=lam)
        order = canonical_row(rng.permutation(joints), one.query.symmetries(ground), joints)
        [row] = one.work(Portion(ground, order))
        yield one, dict(zip(one.columns, row, strict=True))


@pytest.mark.parametrize("count", [60, pytest.param(1000, marks=pytest.mark.slow)])
def test_random_candidates_rebuilt_in_space(count, rng):
    """Axes on the cone, loops close, sums are multiples of 360 degrees, links go where velocities say."""
    told = 0
    for job, row in random_candidates(rng, count):
        lam, places = job.cone_angle, job.places(row)
        chain = job.chain
        axes = joint_axes(places, lam)
        np.testing.assert_allclose(np.arctan2(-axes[:, 1], np.hypot(axes[:, 0], axes[:, 2])), lam, atol=1e-12)
        joints = list(chain.joints)
        angles = {pair: float(x) for pair, x in named(row, "link_angles_deg").items()}
        for pair in link_pairs(chain):
            i, j = (joints.index(joint) for joint in pair)
            measured = float(np.degrees(angles_between(axes[i], axes[j])))
            assert angles[f"{joints[min(i, j)]}-{joints[max(i, j)]}"] == pytest.approx(measured, abs=1e-7)
        every = loops_of_chain(chain)
        whole = SCGraph(chain.nodes, chain.joints, chain.loops)
        for loop, turns in zip(every, row["turns"].split(), strict=True):
            mine = places[[joints.index(joint) for joint in loop]]
            steps = np.remainder(np.roll(mine, -1) - mine + np.pi, 2 * np.pi) - np.pi
            rounds = steps.sum() / (2 * np.pi)
            assert abs(rounds - round(rounds)) < 1e-9
            assert abs(round(rounds)) == int(turns)
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
    ways = named(row, "ways")
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


# ---- closed forms and all angles ----------------------------------------------------------------------------


def measured_rates(chain, places):
    """Outward rates of joints by velocities."""
    motion = first_order(chain, places)
    found = []
    for joint in range(len(chain.joints)):
        link = next(n for n, joints in enumerate_links(chain) if joint in joints)
        w = motion.motions[:, link]
        found.append(w[:, 2] * np.sin(places[:, joint]) - w[:, 0] * np.cos(places[:, joint]))
    return np.stack(found, axis=-1), motion


def enumerate_links(chain):
    return zip(range(len(chain.links)), chain.joints_of, strict=True)


def test_outward_rates_are_those_of_velocities(rng):
    """Every formula, of every choice of loops and path, with one common scale for all joints."""
    for sc in [*CHAINS.values(), *eight_bars()[::3]]:
        chain = ConformedChain.of(sc, rng.choice(list(sc)))
        places = rng.uniform(0, 2 * np.pi, (50, len(chain.joints)))
        wanted, motion = measured_rates(chain, places)
        rates, formulas = joint_rates(chain), outward_rates(chain)
        q = np.stack([one[0].values(places) for one in rates], axis=-1)
        scale = (q * motion.rates).sum(axis=1)
        np.testing.assert_allclose(q, scale[:, None] * motion.rates, atol=1e-9 * np.abs(q).max())
        for joint, (of_rate, of_joint) in enumerate_pairs(rates, formulas):
            for one in of_rate:
                np.testing.assert_allclose(one.values(places), q[:, joint], atol=1e-9 * np.abs(q).max())
            for one in of_joint:
                np.testing.assert_allclose(
                    one.values(places), scale * wanted[:, joint], atol=1e-9 * np.abs(scale).max()
                )
            assert bool(of_joint) == (joint not in chain.joints_of[0])


def enumerate_pairs(rates, formulas):
    return zip(range(len(rates)), zip(rates, formulas, strict=True), strict=True)


@pytest.mark.parametrize("name", CHAINS)
def test_orders_with_opposites_are_those_that_are_enumerated(name):
    """2^(J - 1) of each cyclic order: together all placements on 2 J slots, one of each two opposite ones."""
    joints = len(CHAINS[name].joints)
    identity = np.arange(joints)[None]
    orders = placements(Rounds.orders(joints), identity)[0]
    found = orders_with_opposites(orders).reshape(-1, joints)
    listed = placements(Rounds.opposites(joints), identity)[0]
    both = np.concatenate([found, np.remainder(-found, 2 * joints)])
    assert len(found) == len(orders) * 2 ** (joints - 1) == len(listed)
    assert set(map(tuple, listed.tolist())) <= set(map(tuple, both.tolist()))


@pytest.mark.parametrize(("sc", "unknown"), [(FOUR_BAR, 0.0), (WATT, 0.03), (STEPHENSON, 0.12)], ids=list(CHAINS))
def test_what_holds_for_all_angles_holds_for_random_ones(sc, unknown, rng):
    """Against velocities at angles of their own; both examples exist where it is by angles."""
    joints = len(sc.joints)
    for ground in links_apart(sc.joints):
        chain = ConformedChain.of(sc, ground)
        orders = np.array([[0, *rng.permutation(np.arange(1, joints))] for _ in range(6)])
        sets = orders_with_opposites(orders).reshape(-1, joints)
        found = over_angles(chain, sets)
        places = sampled(sets, 24, seed=7)
        wanted, motion = measured_rates(chain, places.reshape(-1, joints))
        assert (motion.freedoms == 1).all()
        wanted = wanted.reshape(places.shape)
        clear = np.abs(wanted) > 1e-7 * np.abs(wanted).max(axis=-1, keepdims=True)
        certain = found.signs[:, None] * np.sign(wanted) * clear
        assert ((certain >= 0).all(axis=-1) | (certain <= 0).all(axis=-1)).all()
        full = never_singular(chain, sets * (np.pi / joints))
        assert full.all()
        arcs = link_arcs(chain, places)
        moving = [[j for j in mine if j not in chain.joints_of[0]] for mine in chain.joints_of]
        for number, mine in list(enumerate_links(chain))[1:]:
            del mine
            own = wanted[..., moving[number]]
            sure = clear[..., moving[number]].all(axis=-1)
            one = ((own > 0).all(axis=-1) | (own < 0).all(axis=-1)) & (arcs[..., number, 1] < np.pi)
            allowed = found.links[:, number]
            assert (one | ~sure)[allowed == Allowed.ONE].all()
            assert (~one | ~sure)[allowed == Allowed.BOTH].all()
        assert (found.links == Allowed.UNKNOWN).mean() <= unknown


def test_watt_with_a_ternary_ground_is_decided_by_the_order_with_opposites():
    rows = CandidateJob(WATT, (0,)).rows()
    assert len(rows) == 192
    assert {row["by_angles"] + row["not_known"] for row in rows} == {0}
    assert all(row["one_way"] + row["both_ways"] == 64 and row["full_rank"] for row in rows)


def test_circuits_follow_from_the_order_alone(rng):
    for sc in CHAINS.values():
        joints = len(sc.joints)
        number = {joint: i for i, joint in zip(range(joints), sc.joints, strict=True)}
        loops = [[number[joint] for joint in loop] for loop in loops_of_chain(sc)]
        order = rng.permutation(joints)
        even = loop_circuits(loops, order * (2 * np.pi / joints))
        uneven = np.sort(rng.uniform(0, 2 * np.pi, (500, joints)), axis=1)[:, order]
        for one, other in zip(even, loop_circuits(loops, uneven), strict=True):
            assert (other.density == one.density).all()
            assert (other.open == one.open).all()
        rows = CandidateJob(sc).rows()
        assert all(row["circuits"].count("open") == row["open_loops"] for row in rows)


def test_turns_and_layers_over_all_angles_are_reached_and_not_left(rng):
    job = CandidateJob(STEPHENSON)
    rows = job.rows()
    chain = ConformedChain.of(STEPHENSON)
    for row in rows[::17]:
        slots = np.array([int(one) for one in row["slots"].split()])
        places = sampled(orders_with_opposites(slots), 3, seed=int(rng.integers(1000))).reshape(-1, 7)
        deep = layers(chain, places)
        assert (deep.min(), deep.max()) == (row["layers"], row["most_layers"])
        joints = list(STEPHENSON.joints)
        loops = [[joints.index(joint) for joint in loop] for loop in loops_of_chain(STEPHENSON)]
        for one, told in zip(loop_circuits(loops, places), row["turns"].split(), strict=True):
            low, _, high = told.partition("..")
            turns = np.abs(one.turns)
            assert (turns.min(), turns.max()) == (int(low), int(high or low))


def test_signed_cycles_close(rng):
    for sc in [*CHAINS.values(), *eight_bars()]:
        chain = ConformedChain.of(sc)
        cycles = signed_cycles(chain)
        assert np.linalg.matrix_rank(cycles) == np.linalg.matrix_rank(np.vstack([cycles, chain.loops]))
        assert len({tuple(np.abs(row)) for row in cycles}) == len(cycles) >= 2 ** len(chain.loops) - 2
    del rng


# ---- the job --------------------------------------------------------------------------------------------------


def test_slots_agree_with_the_counts_and_the_inverse(rng):
    """Link angles of a candidate with lambda give the cone, its signs and its azimuths back."""
    job = CandidateJob(STEPHENSON, (0,), slots=8, cone_angle=np.radians(35))
    rows = job.rows()
    assert len(rows) == count_conical_orders(job.query)
    assert len({row["slots"] for row in rows}) == len(rows)
    assert not any(row["singular"] for row in rows)
    for row in rng.choice(rows, 25):
        places = job.places(row)
        at = dict(zip(STEPHENSON.joints, places, strict=True))
        half = [abs(abs(np.remainder(at[a] - at[b], 2 * np.pi)) - np.pi) < 1e-9 for a, b in link_pairs(STEPHENSON)]
        assert sum(half) == row["half_turn_steps"] == len(row["half_turns"].split())
        if any(half):
            continue
        angles = {(a, b): float(link_angles(at[b] - at[a], job.cone_angle)) for a, b in link_pairs(STEPHENSON)}
        cones, families = common_cones(STEPHENSON, angles)
        assert not families
        hits = [one for one in cones if abs(one.cone_angle - job.cone_angle) < 1e-7]
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
    assert found == [tuple(row.values()) for row in rows]
    assert rows != CandidateJob(WATT, (0, 1), samples=2, seed=6).rows()
    for row in rows[::50]:
        places = job.places(row)
        assert [str(j) for j in np.array(list(WATT.joints))[np.argsort(places)]] == row["order"].split()


def test_filters_keep_what_they_say():
    job = CandidateJob(WATT, (0,), slots=8)
    rows = job.rows()
    kept = CandidateJob(
        WATT, (0,), slots=8, filters=(Filter("open_loops", least=1, most=2), Filter("linkage", "one way"))
    ).rows()
    assert kept == [row for row in rows if 1 <= row["open_loops"] <= 2 and row["linkage"] == "one way"]
    assert 0 < len(kept) < len(rows)


def test_a_stopped_run_goes_on(tmp_path):
    store = tmp_path / "watt.sqlite"
    job = CandidateJob(WATT, (0, 1), slots=9, cone_angle=0.3)

    def press(progress):
        if progress.done == 3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted):
        run_job(job, SqliteSink(store), report=press)
    assert 0 < len(list(read_rows(store))) < 15_168
    progress = run_job(job, SqliteSink(store, resume=True), workers=2)
    assert progress.done == progress.units > 3
    found = list(read_rows(store))
    assert len(found) == count_conical_orders(job.query) == 15_168
    assert found[:200] == [tuple(row.values()) for row in job.rows()[:200]]


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


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: CandidateJob(WATT, slots=9, opposites=True), InvariantError, "together"),
        (lambda: CandidateJob(WATT, cone_angle=0.3), InvariantError, "without angles"),
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


# ---- the command line -----------------------------------------------------------------------------------------


def test_enumerate_conical(tmp_path, data):
    base = ("enumerate", "conical", "--chain", "stephenson")
    assert run(*base, "--count").stdout == run(*base, "--count", "--method", "orbits").stdout == "102\n"
    assert run(*base, "--ground", "all", "--count").stdout == "552\n"
    rows = json.loads(run(*base, "--json").stdout)
    assert len(rows) == 102
    assert list(rows[0]) == ["chain", "ground", "order", "slots", "symmetry", "loops", "circuits", "open_loops",
                             "density", "turns", "layers", "most_layers", "full_rank"]  # fmt: skip
    some = json.loads(run(*base, "--open", "2..", "--json").stdout)
    assert some == [row for row in rows if row["open_loops"] >= 2]
    assert run(*base, "--open", "2..", "--count").stdout == f"{len(some)}\n"
    file = data / "wiener" / "stephenson.json"
    assert run("enumerate", "conical", "--chain", file, "--ground", "none", "--count").stdout == "102\n"
    assert run("enumerate", "conical", "--chain", rows[0]["chain"], "--count").stdout == "102\n"
    placed = (*base, "--ground", 0, "--slots", 7, "--lambda", 20)
    files = {name: tmp_path / name for name in ("c.jsonl", "c.sqlite", "c.parquet", "folder")}
    for one in files.values():
        assert run(*placed, "-o", one).output == ""
    found = json.loads(run(*placed, "--json").stdout)
    assert [json.loads(line) for line in files["c.jsonl"].read_text().splitlines()] == found
    assert [tuple(row.values()) for row in found] == list(read_rows(files["c.sqlite"]))
    assert pytest.importorskip("pyarrow.parquet").read_table(files["c.parquet"]).to_pylist() == found
    for path, row in zip(sorted(files["folder"].iterdir()), found, strict=True):
        linkage = read_conical(path)
        assert str(linkage.chain.ground) == row["ground"]
        mapped = json.loads(run("cone", "map", path, "--json").stdout)["cones"]
        assert mapped[0]["lambda_deg"] == pytest.approx(20)
        break
    ordered = json.loads(run(*placed, "--sort", "-least_singular_value", "--json").stdout)
    values = [row["least_singular_value"] for row in ordered]
    assert values == sorted(values, reverse=True)
    assert sorted(row["slots"] for row in ordered) == sorted(row["slots"] for row in found)


def test_a_file_of_a_candidate_behaves_as_its_row_says(tmp_path):
    words = ("--ground", 0, "--slots", 6, "--lambda", 25)
    rows = json.loads(run("enumerate", "conical", "--chain", "four-bar", *words, "--json").stdout)
    run("enumerate", "conical", "--chain", "four-bar", *words, "-o", tmp_path / "folder")
    for path, row in zip(sorted((tmp_path / "folder").iterdir()), rows, strict=True):
        if row["half_turn_steps"]:  # its link may take either half
            continue
        [report] = json.loads(run("cone", "behaviour", path, "--json").stdout)["linkages"]
        assert report["rank"] == row["rank"]
        told = {one["link"]: one["way"] for one in report["links"]}
        assert {link: way for link, way in named(row, "ways").items() if way != "fixed"} == {
            link: way for link, way in told.items() if link != report["ground"]
        }


def test_pictures(tmp_path):
    pytest.importorskip("matplotlib")
    folder = tmp_path / "pictures"
    run("enumerate", "conical", "--chain", "four-bar", "--pictures", folder, "--json")
    assert sorted(path.name for path in folder.iterdir()) == ["00001.png", "00002.png"]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in folder.iterdir())
    again = run("enumerate", "conical", "--chain", "four-bar", "--pictures", folder, code=2)
    assert "exists already" in again.stderr


def test_examples_of_the_help_text_run(tmp_path, monkeypatch, data):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data").symlink_to(data)
    out = run("enumerate", "conical", "--help").stdout
    examples = re.findall(r"^ +synth (.*)$", out.partition("Example")[2], re.MULTILINE)
    assert len(examples) == 7
    for example in examples:
        if "--slots 12" not in example:  # the 249 600 of the benchmark
            run(*shlex.split(example))


def test_formulas():
    out = run("enumerate", "conical", "--chain", "four-bar", "--ground", 0, "--formulas").stdout
    assert "  2: " in out
    assert "link 0 fixed" in out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--chain", "wat"], "no chain and no file; expected four-bar"),
        (["--chain", "k1:!"], "the id 'k1:!'"),
        (["--chain", "nowhere.json"], "nowhere.json: no such file"),
        (["--chain", "watt", "--ground", "9"], "9"),
        (["--chain", "watt", "--slots", 6], "6 slots for 7 joints"),
        (["--chain", "watt", "--slots", 2], "2 is not in the range"),
        (["--chain", "watt", "--lambda", 20], "without angles"),
        (["--chain", "watt", "--slots", 8, "--lambda", 90], "cone angle is 90 degrees"),
        (["--chain", "watt", "--rank", 6], "no column 'rank'"),
        (["--chain", "watt", "--sort", "rank"], "no column 'rank'"),
        (["--chain", "watt", "--formulas"], "--formulas needs a fixed link"),
        (["--chain", "watt", "--method", "orbits"], "add --count"),
        (["--chain", "watt", "--count", "--sort", "order"], "leave out --sort"),
        (["--chain", "watt", "--count", "--open", 2, "--method", "orbits"], "leave out filters"),
        (["--chain", "watt", "-o", "x.sqlite", "--resume", "--sort", "order"], "--resume does not go with"),
        (["--chain", "watt", "-o", "x.g6"], "graph6 has no place for angles"),
    ],
)
def test_candidates_that_cannot_be_listed(words, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert message in run("enumerate", "conical", *words, code=2).stderr
