import pickle
import re

import networkx as nx
import pytest
from hypothesis import given
from strategies import models, randoms

from graphs.count.equations import mobility_of_model, wampler_ground_free, wampler_scissors
from graphs.count.report import mobility_report
from graphs.errors import InvariantError
from graphs.mechanism.polyhedron import GROUND, PointConstraint, PolyhedronModel, RemoteCentre

TRIANGLE = [(0, 1), (1, 2), (2, 0)]


@pytest.mark.parametrize(
    ("vertices", "rods", "options", "message"),
    [
        ([1, "1"], [], {}, "vertex '1' occurs twice, has no name or is called 'ground' [distinct vertices]"),
        ([None], [], {}, "vertex None occurs twice, has no name"),
        ([GROUND], [], {}, "vertex 'ground' occurs twice"),
        (3, [(0, 9)], {}, "rod (0, 9) names 9, which is no vertex [known vertices]"),
        (3, [(0, 0)], {}, "a rod joins vertex 0 to itself; expected two vertices [no self-rod]"),
        (3, [(0, 1), (1, 0)], {}, "rod (1, 0) occurs twice; expected once [distinct rods]"),
        (2, [], {"coordinates": {0: (0, 0, 0)}}, "expected coordinates for all vertices"),
        (1, [], {"coordinates": {0: (0, 0)}}, "vertex 0 is at (0, 0); expected three finite numbers"),
        (1, [], {"coordinates": {0: (0, 0, float("nan"))}}, "vertex 0 is at (0, 0, nan); expected three finite"),
        (1, [], {"centres": [RemoteCentre(-1)]}, "a centre has k = -1; expected an integer k >= 0 [remote centre]"),
        (1, [], {"centres": [RemoteCentre(True)]}, "a centre has k = True"),
        (3, TRIANGLE[:1], {"centres": [RemoteCentre(3, ((0, 2),))]}, "a centre names (0, 2), which is no rod"),
        (
            3,
            [],
            {"on_line": [PointConstraint(0, (0, 1))]},
            "on_line of vertex 0 is spanned by [0, 1]; expected 2 other",
        ),
        (4, [], {"on_plane": [PointConstraint(0, (1, 2))]}, "on_plane of vertex 0 is spanned by [1, 2]; expected 3"),
        (4, [], {"on_plane": [PointConstraint(0, GROUND)]}, "needs the ground link; expected 'ground'"),
        (4, [], {"scissors": [(0, 1, 2, 2)]}, "a scissors element has 3 exposed vertices; expected four [scissors]"),
        (4, [], {"ground": [7]}, "ground names 7, which is no vertex"),
        (4, [], {"links": {"A": (0, 1, 0)}}, "link 'A' names a vertex twice; expected once [links]"),
    ],
)
def test_each_invariant_is_checked(vertices, rods, options, message):
    with pytest.raises(InvariantError, match=re.escape(message)):
        PolyhedronModel(vertices, rods, **options)


def test_networkx_accepts_it():
    model = PolyhedronModel(3, TRIANGLE)
    assert nx.is_frozen(model)
    assert nx.is_connected(model)
    assert type(model.copy()) is nx.Graph
    assert type(model.to_undirected()) is nx.Graph
    assert sorted(model.subgraph([0, 1]).edges) == [(0, 1)]
    assert len(PolyhedronModel()) == 0
    with pytest.raises(nx.NetworkXError, match="Frozen"):
        model.remove_node(0)


@given(models, randoms)
def test_relabelling_changes_nothing_that_counts(model, rng):
    names = rng.sample(range(100, 200), len(model))
    there = dict(zip(model.nodes, map(str, names), strict=True))
    other = model.relabel(there)
    assert mobility_report(other).to_json() == mobility_report(model).to_json()
    assert other.relabel({new: old for old, new in there.items()}).is_identical(model)
    assert pickle.loads(pickle.dumps(model)).is_identical(model)


@given(models)
def test_ground_is_left_out_of_the_count(model):
    counts = (
        model.free_vertices,
        model.counted_rods,
        len(model.on_plane),
        len(model.on_line),
        [c.k for c in model.centres],
        len(model.scissors),
    )
    equation = wampler_scissors if model.ground is None else wampler_ground_free
    assert mobility_of_model(model) == equation(*counts) == mobility_report(model).mobility


def test_a_rigid_ground_link_may_be_counted_or_left_out():
    """With three vertices or more fixed, Eqs. 9 and 10 agree."""
    rods = [*TRIANGLE, (0, 3), (1, 3), (3, 4), (0, 4)]
    free, fixed = PolyhedronModel(5, rods), PolyhedronModel(5, rods, ground=[0, 1, 2])
    assert mobility_of_model(free) == mobility_of_model(fixed) == 2
