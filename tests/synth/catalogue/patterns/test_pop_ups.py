"""Pop-ups with cuts: files that are plane graphs, and the six-bar of a planar and a spherical loop."""

from collections import Counter
from math import atan, pi, radians, tan

import numpy as np
import pytest
from sizes import slow

import synth
from graphs.convert.conversions import to_sc
from graphs.mechanism.sheet import sides_of_face

CUT = (("box-pop-up", {}), ("slit-array", {"strips": 3}), ("beaked-box", {}), ("beaked-box", {"more": 0.1}))
CUT += (("beaked-box", {"more": 0.6, "angle": radians(45)}),)


@pytest.mark.parametrize(("name", "parameters"), [CUT[0], *(slow(*case) for case in CUT[1:4]), CUT[4]])
def test_what_is_written_is_a_plane_graph_with_cuts(name, parameters, tmp_path):
    made = synth.generate(name, **parameters)
    synth.write(made.mechanism, tmp_path / "card.fold")
    sheet = synth.read(tmp_path / "card.fold")
    places = np.array(sheet.coordinates)
    assert len(np.unique(places.round(9), axis=0)) == sheet.vertices
    for a, b in sheet.edges:
        along, to = places[b] - places[a], places - places[a]
        off = abs(along[0] * to[:, 1] - along[1] * to[:, 0])
        inside = (to @ along > 1e-9) & (to @ along < along @ along - 1e-9)
        assert not (inside & (off < 1e-9)).any(), "a vertex lies on an edge that does not end there"
    sides = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    letters = {frozenset(edge): letter for edge, letter in zip(sheet.edges, sheet.assignments, strict=True)}
    assert "C" in letters.values()
    assert all(sides[edge] == (1 if letter == "B" else 2) for edge, letter in letters.items())
    area = places[:, 0].max() - places[:, 0].min(), places[:, 1].max() - places[:, 1].min()
    panels = sum(abs(polygon_area(places[list(face)])) for face in sheet.faces)
    assert panels == pytest.approx(area[0] * area[1])
    assert synth.mobility(sheet).verdict.freedoms == made.freedoms == 1


def polygon_area(corners):
    x, y = corners.T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def test_the_beaked_box_is_a_six_bar_of_a_planar_and_a_spherical_loop():
    made = synth.generate("beaked-box")
    graph = to_sc(made.mechanism)
    assert (len(graph), len(graph.joints), made.count) == (6, 7, 1)
    assert sorted((loop.centre.value, len(loop.joints)) for loop in graph.loops) == [("finite", 4), ("infinite", 4)]
    first, second = (set(loop.joints) for loop in graph.loops)
    assert len(first & second) == 1


def test_the_beak_folds_as_its_vertex_says():
    """A vertex with sectors a, a, 180 - a, 180 - a: half-angle tangents, by hand."""
    angle = radians(35)
    folded = synth.generate("beaked-box", fold=radians(50), angle=angle).mechanism
    turns = {frozenset(edge): turn for edge, turn in zip(folded.edges, folded.fold_angles, strict=True) if turn}
    (tip,) = (v for v in range(folded.vertices) if sum(v in edge for edge in turns) == 4)
    at = [turn for edge, turn in turns.items() if tip in edge]
    assert len(at) == 4
    sizes = sorted(abs(turn) for turn in at)
    # lateral creases l, both creases along the line c: tan(l / 2) cos(a) = tan(c / 2) up to which pair is alike
    pairs = [sizes[:2], sizes[2:]]
    assert [one == pytest.approx(other) for one, other in pairs] == [True, True]
    low, high = (pair[0] for pair in pairs)
    assert low == pytest.approx(2 * atan(cos_of(angle) * tan(high / 2)))
    assert high < pi


def cos_of(angle):
    return float(np.cos(angle))
