"""Pictures of linkages at their conformed position: names, sides, layers, shadows."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone
from synth.linkages.conformed.rates import ConformedChain
from synth.making.drawing.conformed import draw_conformed
from synth.making.drawing.scene.shapes import Label, Polygon
from synth.making.drawing.scene.writing import svg_text


def four_bar(names="OABC"):
    return ConformedChain.of(SCGraph(4, dict(zip(names, [(0, 1), (1, 2), (2, 3), (3, 0)], strict=True))))


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_names_are_no_formulas_and_no_control_characters(tmp_path, kind):
    """Two dollar signs begin and end a formula of matplotlib; control characters make what is no XML."""
    pytest.importorskip({"svg": "xml", "png": "matplotlib", "pdf": "reportlab"}[kind])
    names = ["$x^$", "\\$_{$", "\x1b[3", "a$\x07"]
    scene = draw_conformed(four_bar(names), np.radians([40, 90, 140, 0]), None, "$\\frac$ " + " ".join(names))
    scene.save(tmp_path / f"a.{kind}")
    assert (tmp_path / f"a.{kind}").stat().st_size > 1_000
    if kind == "svg":
        ET.parse(tmp_path / "a.svg")


def test_circle_and_cone_are_seen_from_the_same_side():
    """Joints follow each other in one sense in both: neither is the other's mirror image."""
    circle, cone = draw_conformed(four_bar(), np.radians([20, 140, 250, 300]), Cone(0.4)).layers[:2]
    for layer in (circle, cone):
        labels = [shape for shape in layer.shapes if isinstance(shape, Label)]
        at = {label.text: label.at for label in labels if label.data}
        assert set(at) == set("OABC")
        (ax, ay), (bx, by), (cx, cy) = (at[name] for name in "OAB")
        assert (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) < 0  # counter-clockwise, y going down
        assert any("seen from the apex" in label.text for label in labels)


def test_the_shadow_holds_ground_and_coupler():
    """The double wedge between the lines of the side links, whatever the order of the joints."""
    from shapely import union_all
    from shapely.geometry import LineString, Polygon as Area

    for azimuths in ([20, 140, 250, 300], [20, 250, 140, 300], [0, 40, 90, 140], [10, 200, 60, 120]):
        circle = draw_conformed(four_bar(), np.radians(azimuths)).layers[0]
        shadow = union_all([Area(s.points) for s in circle.shapes if isinstance(s, Polygon) and s.fill == "faint"])
        chords = {
            dict(s.data)["link"]: s.points for s in circle.shapes if len(getattr(s, "points", ())) == 2 and s.data
        }
        for link in "02":
            assert shadow.buffer(1e-3).contains(LineString(chords[link])), (azimuths, link)


def test_the_picture_needs_no_matplotlib(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    assert 'data-layer="0"' in svg_text(draw_conformed(four_bar(), np.radians([40, 90, 140, 0]), Cone(0.4)))
