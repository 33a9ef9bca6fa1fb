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
