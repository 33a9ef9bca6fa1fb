"""Linkages of every kind of thing with coordinates, and what has none."""

import json

import numpy as np
import pytest
from commands import run

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, write
from graphs.loops.loop import Loop
from graphs.mechanism.polyhedron import PointConstraint, PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.vertex_edge import VertexEdgeGraph
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import link_motions
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import move
from synth.linkages.guidance._guiding_dyads import guiding_dyads
from synth.linkages.guidance.fourbars import four_bars
from synth.linkages.guidance.orientations import read_orientations

RING = [(0, 1), (1, 2), (2, 3), (3, 0)]


def freedoms(thing, *more):
    linkage = configuration_of(thing, *more).linkage
    return rates_at(ClosureEquations(linkage), linkage.angles).shape[1]


def test_sheets_and_linkages_on_cones(data):
    assert freedoms(read(data / "patterns" / "four-bar-vertex.fold")) == 1
    assert freedoms(read(data / "surfaces" / "fig11-stephenson.json")) == 1


def test_a_cut_sheet_is_opened_as_fold_does():
    """Two squares that touch along a slit beside their hinge share no vertex but those of the hinge."""
    from graphs.mechanism.sheet import Sheet

    corners = ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1))
    cut = Sheet(6, ((1, 4),), "C", ((0, 1, 4, 3), (1, 2, 5, 4)), corners)
    assert len(configuration_of(cut).linkage.graph.joints) == 0


def test_a_guided_four_bar_takes_its_body_through_the_orientations(data):
    """Driven by its crank angles, the body turns as the orientations say."""
    orientations = read_orientations(data / "orientations" / "crank-rocker.json")
    best = four_bars(orientations, guiding_dyads(orientations).dyads)[0]
    assert not best.defects
    linkage = configuration_of(best, orientations=orientations).linkage
    way = 1.0 if best.direction == "ccw" else -1.0
    turns = way * np.remainder(way * (best.angles - best.angles[0]), 2 * np.pi)
    for turn, wanted in [(turns[1], orientations.matrices[1]), (turns[-1], orientations.matrices[-1])]:
        motion = move(linkage, drive={"O": turn}, frames=1)
        assert motion.path.stopped == ""
        rotation, _ = link_motions(linkage, motion.path.angles, "ground")["body"]
        np.testing.assert_allclose(rotation[-1] @ orientations.matrices[0], wanted, atol=1e-9)
    with pytest.raises(UnsolvableError, match="expected its orientations"):
        configuration_of(best)


@pytest.mark.parametrize(
    ("thing", "told"),
    [
        (SCGraph(4, RING), "requires coordinates"),
        (VertexEdgeGraph({"O": ("a", "b", "c", "d")}), "requires coordinates"),
        (PolyhedronModel(4, RING), "requires coordinates"),
        (PolyhedronModel(2, [(0, 1)], coordinates={0: (0, 0, 0), 1: (1, 0, 0)}, ground=[0]), "a ground link"),
        (PolyhedronModel(4, RING[:1], coordinates={v: (v, v * v, 0) for v in range(4)}), "several parts"),
        (PolyhedronModel(3, RING[:2], coordinates={v: (v, 0, 0) for v in range(3)}), "in line"),
        (PolyhedronModel(2, RING[:1], coordinates={0: (1, 2, 3), 1: (1, 2, 3)}), "no length"),
    ],
)
def test_what_has_no_axes_says_so(thing, told):
    with pytest.raises((UnsolvableError, InvariantError), match=told):
        configuration_of(thing)


def test_a_linkage_on_two_cones_is_on_neither():
    from graphs.mechanism.surfaces import SurfaceLinkage

    ring = SCGraph(4, {name: (i, (i + 1) % 4) for i, name in enumerate("OABC")}, [Loop("OABC")])
    links = np.radians([120, 95, 45, 85])
    angles = dict(zip([("O", "A"), ("A", "B"), ("B", "C"), ("C", "O")], links.tolist(), strict=True))
    with pytest.raises(UnsolvableError, match="2 cones"):
        configuration_of(SurfaceLinkage(ring, angles=angles))


@pytest.mark.parametrize(("centre", "moved"), [("finite", (0, 0, 0.1)), ("infinite", (0, 0.1, 0))])
def test_centres_that_are_none_are_refused(centre, moved):
    """With three equations instead of six such a loop would come apart."""
    away = [(1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1)]
    axes = {i: ((0, 0, 0), d) if centre == "finite" else (d, (0, 0, 1)) for i, d in enumerate(away)}
    graph = SCGraph(4, RING, [Loop(range(4), centre)])
    assert freedoms(HingedSolids(graph, axes)) == 1
    point, along = axes[2]
    axes[2] = (moved, along) if centre == "finite" else (point, (0, 0.1, 1))
    with pytest.raises(InvariantError, match=r"axes of loop .* miss by"):
        configuration_of(HingedSolids(graph, axes))


def test_joints_that_are_none_are_refused(data):
    linkage = configuration_of(read(data / "linkages" / "bennett.json")).linkage
    with pytest.raises(InvariantError, match="9 is no joint"):
        move(linkage, drive={9: 1.0})
    with pytest.raises(InvariantError, match="expected a finite angle"):
        move(linkage, drive={0: np.inf})
    with pytest.raises(UnsolvableError, match="no joints"):
        move(configuration_of(HingedSolids(SCGraph(1), {})).linkage)


def test_synth_fold_moves_what_has_no_panels(data, tmp_path):
    file = data / "linkages" / "bennett.json"
    told = json.loads(run("fold", file, "--drive", "0=60", "--frames", 3, "--json").stdout)
    assert told["freedoms"] == 1
    assert told["stopped"] is None
    assert np.diff(told["joint_angles_deg"]["0"]) == pytest.approx([20, 20, 20])
    assert told["joint_angles_deg"]["2"][-1] == pytest.approx(-60)
    assert "1 degree of freedom (numerical)" in run("fold", file, "--drive", "0=3", "--frames", 1).stdout
    assert "no panels to write" in run("fold", file, "-o", tmp_path / "a.fold", code=2).stderr
    assert "requires coordinates" in run("fold", data / "wiener" / "watt.json", code=2).stderr


def test_synth_fold_folds_models_that_know_their_panels(data, tmp_path):
    from graphs.convert.conversions import to_polyhedron

    sheet = read(data / "linkages" / "wampler-fig1-open.fold")
    write(to_polyhedron(sheet), tmp_path / "model.json")
    told = json.loads(run("fold", tmp_path / "model.json", "--json", "--frames", 1).stdout)
    assert told["freedoms"] == 1
    assert "joint_angles_deg" in told


def test_axes_may_be_given_by_the_apex_itself():
    """A point in the apex says nothing of where a ray goes; the direction does."""
    directions = [np.cos(t) * np.eye(3)[0] + np.sin(t) * np.eye(3)[1] for t in np.radians([0, 60, 140, 260])]
    axes = {i: ((0, 0, 0), tuple(d)) for i, d in enumerate(directions)}
    motion = move(configuration_of(HingedSolids(SCGraph(4, RING, [Loop(range(4))]), axes)), drive={0: 0.5}, frames=1)
    assert len(motion.branches.branches) == 2  # the two modes of a flat vertex
    assert motion.path.stopped == ""


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({"ground": [0, 1]}, "a ground link"),
        ({"on_plane": [PointConstraint(3, (0, 1, 2))]}, "points on planes"),
        ({"on_line": [PointConstraint(3, (0, 1))]}, "points on lines"),
    ],
)
def test_what_models_say_beyond_their_panels_is_not_dropped(more, told):
    corners = {0: (0, 0, 0), 1: (1, 0, 0), 2: (0, 1, 0), 3: (1, 1, 0)}
    rods = [(0, 1), (1, 2), (2, 0), (1, 3), (2, 3)]
    links = {"a": (0, 1, 2), "b": (1, 3, 2)}
    assert len(configuration_of(PolyhedronModel(4, rods, coordinates=corners, links=links)).linkage.graph.joints) == 1
    with pytest.raises(UnsolvableError, match=told):
        configuration_of(PolyhedronModel(4, rods, coordinates=corners, links=links, **more))


@pytest.mark.slow
def test_by_default_what_moves_most_turns_once_round(data):
    motion = move(read(data / "linkages" / "bennett.json"), frames=2)
    assert motion.path.stopped == ""
    assert np.abs(list(motion.driven.values())) == pytest.approx([2 * np.pi])
    assert "drove joint 0 to 360°" in str(motion)


@pytest.mark.parametrize("turn", [-3.0, 3.0])
def test_a_joint_is_driven_by_the_least_rates_where_there_are_several_freedoms(turn, data):
    """Knees of a platform; begun by other rates one turned back after a tenth of a degree."""
    platform = read(data / "linkages" / "stewart.json")
    for leg in (0, 3):
        path = move(platform, drive={f"P{leg}-1": np.radians(turn)}, frames=1).path
        assert path.stopped == ""
        assert np.abs(path.angles[-1]).max() < np.radians(3 * abs(turn))
