"""Pictures of linkages whose joints have hostile names."""

import numpy as np
import pytest

from graphs.mechanism.sc import SCGraph
from synth.conformed.rates import ConformedChain
from synth.drawing.conformed import draw_conformed
from synth.drawing.figure import save_figure


@pytest.mark.parametrize("kind", ["png", "svg"])
def test_names_are_no_formulas_and_no_control_characters(tmp_path, kind):
    """Two dollar signs begin and end a formula of matplotlib; control characters make what is no XML."""
    pytest.importorskip("matplotlib")
    names = ["$x^$", "\\$_{$", "\x1b[3", "a$\x07"]
    chain = ConformedChain.of(SCGraph(4, dict(zip(names, [(0, 1), (1, 2), (2, 3), (3, 0)], strict=True))))
    figure = draw_conformed(chain, np.radians([40, 90, 140, 0]), None, "$\\frac$ " + " ".join(names))
    save_figure(figure, tmp_path / f"a.{kind}")
    assert (tmp_path / f"a.{kind}").stat().st_size > 1_000
    if kind == "svg":
        import xml.etree.ElementTree as ET

        ET.parse(tmp_path / "a.svg")


def test_circle_and_cone_are_seen_from_the_same_side():
    """Joints follow each other in one sense in both: neither is the other's mirror image."""
    pytest.importorskip("matplotlib")
    from mpl_toolkits.mplot3d import proj3d

    names = "OABC"
    chain = ConformedChain.of(SCGraph(4, dict(zip(names, [(0, 1), (1, 2), (2, 3), (3, 0)], strict=True))))
    figure = draw_conformed(chain, np.radians([20, 140, 250, 300]), 0.4)
    circle, cone = figure.axes
    on_circle = {text.get_text(): text.get_position() for text in circle.texts}
    matrix = cone.get_proj()
    on_cone = {text.get_text(): proj3d.proj_transform(*text.get_position_3d(), matrix)[:2] for text in cone.texts}
    assert set(on_circle) == set(on_cone) == set(names)
    assert turn(on_circle) > 0
    assert turn(on_cone) > 0
    assert "seen from the apex" in circle.get_title()
    assert "apex" in cone.get_title()


def turn(places):
    """Twice the signed area of the first three joints: positive if they are counter-clockwise."""
    (ax, ay), (bx, by), (cx, cy) = (places[name] for name in "OAB")
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
