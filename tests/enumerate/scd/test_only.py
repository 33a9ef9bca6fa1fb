"""An SC graph as its only SCD graph, as that one's polyhedron model, and back: ids stay."""

import json
import random
from itertools import count, islice

import pytest
from commands import run
from seeded import seed_file
from sizes import slow

import synth
from enumerate.runner._run import total_of
from enumerate.sc.jobs import sc_graphs
from enumerate.scd.jobs import mechanism_of, scd_count_job
from enumerate.scd.only import only_scd_graph
from graphs.errors import InvariantError, UnsolvableError
from graphs.identity.chains import class_code, isomorphism
from graphs.identity.drawings import map_id
from graphs.mechanism.sc import SCGraph


def _renamed(sc: SCGraph, rng: random.Random) -> SCGraph:
    """Return a mechanism under other names, its links and joints listed in another order, joints turned round."""
    links, joints = list(sc.nodes), list(sc.joints)
    rng.shuffle(links)
    rng.shuffle(joints)
    name = {link: f"L{i}" for i, link in enumerate(links)}
    listed = {f"j{i}": sc.joints[joint] for i, joint in enumerate(joints)}
    number = {joint: f"j{i}" for i, joint in enumerate(joints)}
    ends = {
        joint: tuple(name[link] for link in (pair if rng.random() < 0.5 else pair[::-1]))
        for joint, pair in listed.items()
    }
    loops = [type(loop)(tuple(number[one] for one in loop.joints), loop.centre) for loop in sc.loops]
    return SCGraph(name.values(), ends, loops, ground=rng.choice(list(name.values())))


def _with_one(rng: random.Random, sizes):
    """Yield random SC graphs, and a largest number of sides for which they have one SCD graph only."""
    pools = {size: list(islice(sc_graphs(*size), 200)) for size in sizes}
    for _ in count():
        sc = rng.choice(pools[rng.choice(sizes)])
        for degree in (3, 4):
            number = total_of(scd_count_job(mechanism_of(sc, degree)))
            if number == 1:
                yield _renamed(sc, rng), degree
            if number:
                break


FEW = [(4, 1), (5, 2), (6, 1), (6, 3), (7, 2), (7, 4), (8, 1), (8, 3)]
MORE = [*FEW, (8, 5), (9, 2), (9, 4), (10, 1), (10, 3), (11, 2)]


@pytest.mark.parametrize(("number", "sizes"), [(15, FEW), slow(200, MORE)])
def test_ids_stay_on_the_way_there_and_back(number, sizes):
    seen = set()
    for sc, degree in islice(_with_one(random.Random(number), sizes), number):
        scd = synth.convert(sc, "scd", max_degree=degree)
        assert scd.sc_graph().is_identical(sc)  # names, loops and ground too
        assert max(map(len, scd.rotation.values())) <= degree
        model = synth.convert(scd, "polyhedron")
        back = synth.convert(model, "scd")
        assert map_id(back) == map_id(scd)
        assert class_code(SCGraph(sc.nodes, sc.joints, sc.loops)) == class_code(synth.convert(back, "sc"))
        assert str(synth.identify(back.sc_graph())) == str(synth.identify(sc))
        seen.add(map_id(scd))
    assert len(seen) > 4


def test_the_message_names_the_command_and_convert_takes_the_only_one(tmp_path):
    file, out = seed_file("fortune-sc"), tmp_path / "scd.json"
    told = run("convert", file, out, "--to", "scd", code=2).output
    assert "synth enumerate scd --of FILE --max-degree D" in told
    printed = run("convert", file, out, "--to", "scd", "--max-degree", 3).stdout
    assert "the only SCD graph of the file whose links have up to 3 sides" in printed
    assert map_id(synth.read(out)) == map_id(synth.read(seed_file("fortune-scd")))
    assert (
        "10702 SCD graphs have links"
        in run("convert", file, out, "--to", "scd", "--max-degree", 4, "--force", code=2).output
    )
    assert "--max-degree" in run("convert", file, out, "--to", "sc", "--max-degree", 3, "--force", code=2).output
    notes = json.loads(run("convert", file, out, "--to", "scd", "--max-degree", 3, "--force", "--json").stdout)["notes"]
    assert len(notes) == 1


def test_none_and_several_are_refused():
    ring = SCGraph(5, [(i, (i + 1) % 5) for i in range(5)], [synth.Loop(range(5), "infinite")])
    with pytest.raises(UnsolvableError, match="no SCD graph has links of up to 3 sides"):
        only_scd_graph(ring, 3)  # a centre at infinity is reached by no link
    with pytest.raises(InvariantError, match="one of scd, polyhedron, sheet"):
        synth.convert(ring, "sc", max_degree=3)
    with pytest.raises(InvariantError, match="isomorphism"):
        isomorphism(ring, SCGraph(5, ring.joints))
