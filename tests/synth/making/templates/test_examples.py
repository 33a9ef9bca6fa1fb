"""The examples of docs/theory/templates.md: they print, and what is printed folds with rigid panels."""

import numpy as np
import pytest
from sizes import slow

from graphs.files.formats import read
from graphs.rank.infinitesimal import infinitesimal_mobility
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns._generate import generate
from synth.making.templates.template import pictured, template_of

EXAMPLES = {"watt": 1, "chain-UPS": 6, "fortune-teller": 5, "miura-tube": 1}
"""Freedoms on the way."""


@pytest.mark.parametrize("name", [slow(one) if one in ("fortune-teller", "miura-tube") else one for one in EXAMPLES])
def test_examples_print_with_a_picture_and_fold(name, data):
    path = data / "realised" / f"{name}.fold"
    sheet = read(path) if path.exists() else generate(name).mechanism
    template, why = pictured(template_of(sheet, size=160), sheet)
    assert why == ""
    assert template.picture is not None
    assert len(template.pieces) == 1
    folding = fold(sheet, frames=4)
    assert np.abs(folding.path.angles[-1] - folding.path.angles[0]).max() > np.radians(60)
    assert folding.closure < 1e-9
    assert infinitesimal_mobility(folding.frames()[1]).dof == EXAMPLES[name]
