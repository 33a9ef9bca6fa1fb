import random

import pytest
from strategies import random_scd

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.identity.drawings import drawing_of, map_code, map_id, map_text, mechanism_from_map_id, symbols_of
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import trace_faces
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

RING = [(0, 1), (1, 2), (2, 3), (3, 0)]


def mirrored(scd):
    rotation = {link: sides[::-1] for link, sides in scd.rotation.items()}
    joint, side = scd.outer
    other = {"left": "right", "right": "left"}[side]
    return SCDGraph(scd.nodes, scd.joints, scd.loops, rotation=rotation, outer=(joint, other), ground=scd.ground)


@pytest.mark.parametrize("seed", range(60))
def test_names_and_mirrors_do_not_count(seed):
    scd = random_scd(random.Random(seed))
    try:
        code = map_id(scd)
    except UnsolvableError:
        return  # a link cuts it in two, or loops share a centre
    links = {link: f"l{hash(str(link)) % 997}-{link}" for link in scd.nodes}
    joints = {joint: f"j{(i * 7919) % 101}-{joint}" for i, joint in enumerate(scd.joints)}
    assert map_id(scd.relabel(links, joints)) == code
    if scd.outer is not None:
        assert map_id(mirrored(scd)) == code
    again = mechanism_from_map_id(code)
    assert isinstance(again, SCDGraph)
    assert map_id(again) == code
    assert again.counts == scd.counts


def test_ids_of_the_data(data):
    """Every file of an SC or SCD graph whose loops are faces keeps its id on the way through the id."""
    found = 0
    for file in sorted((data / "wiener").glob("*.json")):
        thing = read(file)
        if not isinstance(thing, SCGraph):
            continue
        try:
            code = map_id(thing)
        except UnsolvableError:
            continue
        assert map_id(mechanism_from_map_id(code)) == code
        found += 1
    assert found >= 12


def test_the_outer_face_and_the_kinds_of_centres_count():
    theta = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    four, four_too, six = (0, 1, 2, 3), (3, 4, 5, 6), (0, 1, 2, 4, 5, 6)
    inside = SCGraph(6, theta, [Loop(four), Loop(four_too)])
    outside = SCGraph(6, theta, [Loop(four), Loop(six)])
    assert map_id(inside) != map_id(outside)
    kinds = [
        map_id(SCGraph(6, theta, [Loop(four, a), Loop(four_too, b)]))
        for a, b in [("finite", "finite"), ("finite", "none"), ("none", "finite"), ("infinite", "finite")]
    ]
    assert kinds[1] == kinds[2]
    assert len(set(kinds)) == 3
    assert kinds[1].endswith(";fs")
    again = mechanism_from_map_id(kinds[3])
    assert sorted(loop.centre.value for loop in again.loops) == ["finite", "infinite"]


def test_the_drawing_of_loops_has_these_faces():
    sc = mechanism_from_map_id("m1:ab.ac.bde.cfd.eg.fg")
    rotation, (joint, link) = drawing_of(sc)
    faces, left_of = trace_faces(sc.joints, rotation)
    outside = left_of[joint, link]
    assert {frozenset(f.joints) for f in faces if f.index != outside} == {frozenset(x.joints) for x in sc.loops}


def test_more_than_52_joints_are_numbers():
    ring = SCGraph(60, [(i, (i + 1) % 60) for i in range(60)], [Loop(range(60))])
    code = map_id(ring)
    assert code.startswith("m1:0,1.0,2.1,3.")
    assert map_id(mechanism_from_map_id(code)) == code
    symbols, labels = symbols_of(code)
    assert (map_text(symbols, labels), map_code(ring)[0]) == (code, symbols)


def test_parallel_joints():
    assert map_id(mechanism_from_map_id("m1:ab.ab")) == "m1:ab.ab"


@pytest.mark.parametrize(
    ("sc", "message"),
    [
        (SCGraph(4, RING), "tree without open edges"),
        (SCGraph(4, [*RING, (0, 2)], [Loop((0, 1, 4))]), "1 more would be needed"),
        (SCGraph(5, [(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2)], [Loop((0, 1, 2)), Loop((3, 4, 5))]), "cuts in two"),
        (SCGraph(4, [(0, 1), (2, 3)]), "cuts in two"),
        (SCGraph(4, RING, [Loop(range(4))], closing=[]), None),
        (
            SCGraph(
                6,
                [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)],
                [Loop((0, 1, 2, 3), at="O"), Loop((3, 4, 5, 6), at="O")],
            ),
            "no place for that",
        ),
        (
            SCGraph(
                4,
                [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)],
                [Loop((0, 3, 1)), Loop((0, 4, 2)), Loop((0, 3, 5, 2))],
            ),
            "faces of a drawing",
        ),
    ],
)  # fmt: skip
def test_what_has_no_id(sc, message):
    if message is None:
        assert map_id(sc)
        return
    with pytest.raises(UnsolvableError, match=message):
        map_id(sc)


@pytest.mark.parametrize(
    "code",
    ["", "k1:Cr", "m1:", "m1:aa", "m1:ab", "m1:a.a.b", "m1:ac.ac", "m1:a!.a", "m1:ab.ab;x", "m1:ab.ab;ff", "m1:0,a.0",
     "m1:abc.abc", "m1:999999999,1.1"],
)  # fmt: skip
def test_what_is_no_id(code):
    with pytest.raises(InvariantError):
        mechanism_from_map_id(code)


def test_closed_surfaces_have_no_id():
    import networkx as nx

    from graphs.convert.link_joint import sc_from_link_joint_graph

    with pytest.raises(UnsolvableError, match="outer face"):
        map_id(sc_from_link_joint_graph(nx.octahedral_graph(), Centre.FINITE, closed=True))
