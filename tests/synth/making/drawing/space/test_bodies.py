"""Solids hinged at edges, drawn: what their bodies are, that they stay rigid on the way, what the commands write."""

from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from commands import run

from graphs.files.formats import read
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import move
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text
from synth.making.drawing.space.panels import bodies_of, hinge_ends, panel_shapes, places_of_hinges, view_from_above

LINKAGES = Path(__file__).resolve().parents[5] / "data" / "linkages"


@pytest.fixture(scope="module")
def kaleidocycle():
    return configuration_of(read(LINKAGES / "kaleidocycle-6.json")).linkage


def faces_of(panels, link):
    return [face for number, face in enumerate(panels.faces) if panels.link_of[number] == link]


def test_links_of_a_kaleidocycle_are_tetrahedra(kaleidocycle):
    panels, corners = bodies_of(kaleidocycle)
    for link in kaleidocycle.graph:
        faces = faces_of(panels, link)
        assert sorted(map(len, faces)) == [3, 3, 3, 3]
        middle = corners[list({corner for face in faces for corner in face})].mean(axis=0)
        for a, b, c in faces:
            out = np.cross(corners[b] - corners[a], corners[c] - corners[a])
            assert out @ (corners[a] - middle) > 0
    for ends in panels.joint_of:
        assert sum(ends <= set(face) for face in panels.faces) == 4  # two of each of its two links


def test_links_of_a_sarrus_linkage_are_plates_but_two():
    """Hinges of a leg are parallel: plates, to be seen from both sides. Base and top join two directions."""
    linkage = configuration_of(read(LINKAGES / "sarrus.json")).linkage
    panels, _ = bodies_of(linkage)
    sizes = {link: sorted(map(len, faces_of(panels, link))) for link in linkage.graph}
    assert sorted(sizes.values()).count([4, 4]) == 4


def test_hinges_lie_on_their_axes(kaleidocycle):
    ends = hinge_ends(kaleidocycle)
    off = np.cross(ends - kaleidocycle.points[:, None], kaleidocycle.directions[:, None])
    assert np.abs(off).max() < 1e-12


def test_axes_through_one_point_have_hinges_beside_it():
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    axes = [(1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1)]
    ends = hinge_ends(
        configuration_of(HingedSolids(ring, {joint: ((0, 0, 0), axis) for joint, axis in enumerate(axes)})).linkage
    )
    middles = ends.mean(axis=1)
    assert min(np.linalg.norm(a - b) for a, b in combinations(middles, 2)) > 0.5


def test_bodies_stay_rigid_and_hinged():
    moved = move(read(LINKAGES / "sarrus.json"), frames=3)
    places = places_of_hinges(moved.linkage, moved.path.angles)
    panels, corners = bodies_of(moved.linkage)
    assert np.allclose(places[0], corners, atol=1e-12)
    assert np.ptp(places, axis=0).max() > 0.1
    for face in panels.faces:
        for a, b in combinations(face, 2):
            lengths = np.linalg.norm(places[:, a] - places[:, b], axis=1)
            assert np.ptp(lengths) < 1e-9


def test_what_looks_away_is_not_drawn(kaleidocycle):
    panels, corners = bodies_of(kaleidocycle)
    view = view_from_above(corners)
    _, drawn = panel_shapes(panels, corners, view, view.places(corners).tolist())
    assert 0 < len(drawn) < len(panels.faces)


def test_numbers_of_hinges_in_front_are_written():
    """Each is of a hinge that is drawn; one that a body hides has none."""
    root = ElementTree.fromstring(svg_text(draw(read(LINKAGES / "kaleidocycle-8.json"))))
    lines = {e.get("data-joint") for e in root.iter() if e.tag.endswith("path")} - {None}
    texts = {e.get("data-joint") for e in root.iter() if e.tag.endswith("text")} - {None}
    assert texts
    assert texts <= lines <= set("01234567")


def test_the_commands_draw_solids(tmp_path):
    assert draw(read(LINKAGES / "bennett.json")).layers[0].name == "solids"
    written = run("fold", LINKAGES / "sarrus.json", "--frames", 2, "-o", tmp_path / "a.svg").output
    assert written.endswith("a.svg\n")
    root = ElementTree.parse(tmp_path / "a.svg")
    assert {e.text for e in root.iter() if e.tag.endswith("text")} >= {"0", "1", "2"}
    told = run("fold", LINKAGES / "sarrus.json", "-o", tmp_path / "a.fold", code=2).stderr
    assert "solids are drawn as .gif, .png or .svg" in told
