"""Types and placements of a task: numbers by second methods, reasons, and what contradicts itself."""

import json
from dataclasses import replace
from itertools import combinations, permutations

import networkx as nx
import numpy as np
import pytest

import synth
from enumerate.chains import chains
from enumerate.runner import Limits
from enumerate.sc import sc_graphs
from enumerate.scd.jobs import scd_rows
from graphs.errors import InvariantError
from graphs.identity import class_code
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank import relative_mobilities
from graphs.rank.exact import independent_cycles
from synth.synthesis.tasks import RolePair, Task, placements_of, structure_of
from synth.synthesis.tasks.structure import _relative_at


def distinct(links, dof=1):
    """SC graphs of a size, one of those that differ by their drawing alone."""
    return list({class_code(sc): sc for sc in sc_graphs(links, dof)}.values())


def coloured(sc, roles):
    """The graph of links, joints and centres, links with the numbers of their roles."""
    graph = nx.Graph()
    graph.add_nodes_from((("link", link), {"colour": roles.index(link) if link in roles else -1}) for link in sc.nodes)
    for joint, ends in sc.joints.items():
        graph.add_node(("joint", joint), colour=-2)
        graph.add_edges_from((("joint", joint), ("link", end)) for end in ends)
    for number, one in enumerate(sc.centre_classes()):
        graph.add_node(("centre", number), colour=-3)
        graph.add_edges_from((("centre", number), ("joint", joint)) for joint in one.joints)
    return graph


@pytest.mark.parametrize(("links", "roles"), [(4, 2), (4, 3), (6, 2)])
def test_placements_are_the_classes_of_coloured_isomorphism(links, roles):
    for sc in distinct(links):
        classes = []
        for some in permutations(sc.nodes, roles):
            graph = coloured(sc, some)
            if not any(nx.vf2pp_is_isomorphic(graph, other, node_label="colour") for other in classes):
                classes.append(graph)
        assert len(placements_of(sc, roles)) == len(classes)


@pytest.mark.parametrize(("links", "number"), [(4, 2), (6, 27), pytest.param(8, 713, marks=pytest.mark.slow)])
def test_placements_are_the_canonical_ids_with_coloured_links(links, number):
    total = 0
    for sc in distinct(links):
        codes = {
            class_code(SCGraph(sc.nodes, sc.joints, sc.loops, ground=base), marked=[output])
            for base, output in permutations(sc.nodes, 2)
        }
        assert len(codes) == len(placements_of(sc, 2))
        total += len(codes)
    assert total == number


@pytest.mark.parametrize(("links", "dof"), [(5, 2), (7, 2), (6, 1)])
def test_relative_mobility_is_that_of_random_axes(links, dof):
    for chain in chains(links, dof):
        bare = SCGraph(chain.nodes, list(chain.edges))
        loops = [Loop(loop.joints, at="all") for loop in independent_cycles(bare)]
        sc = SCGraph(bare.nodes, bare.joints, loops)
        rng = np.random.default_rng(links)
        axes = {joint: ((0.0, 0.0, 0.0), tuple(rng.normal(size=3).tolist())) for joint in sc.joints}
        exact = relative_mobilities(sc)
        assert exact == _relative_at(HingedSolids(sc, axes))
        assert set(exact.values()) <= set(range(dof + 1))
        assert all(exact[frozenset(ends)] == 1 for ends in sc.joints.values())


def test_every_type_is_admitted_or_left_out_for_one_reason():
    task = Task(
        links=Limits(4, 6),
        sources=("sc", "chains"),
        system="spherical",
        distances=(RolePair(("base", "output"), Limits(2)),),
    )
    structure = structure_of(task)
    assert structure.types == len(structure.placed) + sum(structure.left_out.values())
    assert structure.placements == structure.admitted + sum(structure.placements_left_out.values())
    assert structure.left_out == {"the same as another type": 4, "system": 1}
    for one in structure.placed:
        for base, output in one.placements:
            assert nx.shortest_path_length(one.type.mechanism, base, output) >= 2


def test_overconstrained_families_are_found_by_their_generators():
    task = Task(links=Limits(4, 4), system="spatial", mobilities=(RolePair(("base", "output"), Limits(1, 1)),))
    structure = structure_of(Task(**{**vars(task), "generators": {"bennett": {}, "four-bar": {}, "sarrus": {}}}))
    assert [one.type.code for one in structure.placed] == ["bennett"]
    assert structure.left_out["links"] == 1
    relative = structure.placed[0].type.relative
    assert all(relative[frozenset(pair)] == 1 for pair in combinations(range(4), 2))


@pytest.mark.parametrize(("links", "placed"), [(4, 6), (6, 24)])
def test_sheets_without_implicit_centres_are_those_of_the_enumeration(links, placed):
    """Single sheets without holes (docs/sequences.md); each centre is explicit or implicit."""
    sheets = {row["code"] for row in scd_rows(links, 1, 4, sheets=True)}
    task = Task((), links=Limits(links, links), form="sheet", sources=("scd",), implicit_centres=Limits(0, 0))
    structure = structure_of(task)
    assert {one.type.code for one in structure.placed} == sheets
    assert len(sheets) == placed
    assert structure.left_out == {"implicit centres": structure.types - placed}
    loops = links // 2 - 1
    explicit = structure_of(replace(task, implicit_centres=Limits(0), explicit_centres=Limits(loops)))
    assert {one.type.code for one in explicit.placed} == sheets


def test_generators_of_sheets_have_explicit_centres_and_a_tube_an_implicit_one():
    names = {"miura": {}, "miura-tube": {}, "slit-array": {}}
    task = Task((), links=Limits(4, 20), form="sheet", sources=("generators",), generators=names)
    for key, codes in (("explicit_centres", ["miura", "miura-tube"]), ("implicit_centres", ["miura-tube"])):
        structure = structure_of(replace(task, **{key: Limits(1)}))
        assert [one.type.code for one in structure.placed] == codes


BAD = [
    (
        {"form": "sheet", "types": ["scd"], "links": 4, "explicit_centres": 0, "implicit_centres": 0},
        "0 explicit centres and 0 implicit centres exclude each other",
    ),
    ({"implicit_centres": 1}, "form space and 1 implicit centre exclude each other; expected form sheet"),
    ({"links": 5, "types": ["sc"]}, "5 links and 1 degree of freedom exclude each other"),
    ({"links": 4, "types": ["sc"], "centres": 2}, "no type of 4 links and 1 degree of freedom has 2 centres"),
    (
        {"links": 6, "types": ["sc"], "centres": [2, None], "system": "spherical"},
        "a spherical system and at least 2 centres exclude each other",
    ),
    ({"roles": ["base", "input", "output"]}, "the task does not distinguish input from output"),
    ({"relative_mobility": [{"roles": ["base", "output"], "number": 2}]}, "exclude each other"),
    ({"roles": ["output"]}, "there is no base"),
    ({"form": "cone", "system": "planar"}, "form cone and system planar exclude each other"),
    ({"form": "sheet", "types": ["sc"]}, "form sheet and types from sc exclude each other"),
    (
        {"distance": [{"roles": ["base", "output"], "number": 1}, {"roles": ["output", "base"], "number": [2, None]}]},
        "base and output: 1 and base and output: at least 2 exclude each other",
    ),
]


@pytest.mark.parametrize(("keys", "line"), BAD, ids=range(len(BAD)))
def test_a_task_that_contradicts_itself_gets_one_line(keys, line):
    with pytest.raises((InvariantError, synth.FileError)) as caught:
        synth.task({"format": "synthedra/task", "version": 1, **keys}, structure_only=True)
    assert line in str(caught.value)
    assert "\n" not in str(caught.value)


def test_all_numbers_are_in_the_json():
    asked = {"format": "synthedra/task", "version": 1, "links": [4, 6], "types": ["sc"]}
    structure = synth.task(asked, structure_only=True)
    told = json.loads(json.dumps(structure.to_json()))
    assert told["types"] == 5
    assert sum(len(one["placements"]) for one in told["admitted"]) == told["placements"] == structure.admitted == 29
