"""Realisation that ends when its allowance of work is used up, and says so."""

from math import cos, pi, sin

import pytest

from graphs.convert.panels import scd_from_panels
from graphs.mechanism.sheet import Sheet
from synth.analysis.motion.walk.step import Allowance
from synth.catalogue.realisation._realise import realise
from synth.catalogue.realisation.drawing import drawings
from synth.catalogue.realisation.pattern import pattern_of


def test_there_are_no_more_drawings_than_the_allowance_lets_be():
    fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    enough = Allowance(1_000)
    assert len(list(drawings(fan, 0, 5, allowance=enough))) == 5
    needed = 1_000 - enough.left
    assert [len(list(drawings(fan, 0, 5, allowance=Allowance(steps)))) for steps in (0, needed)] == [1, 5]
    assert 1 <= len(list(drawings(fan, 0, 5, allowance=Allowance(needed // 2)))) < 5


@pytest.mark.slow
def test_a_fan_of_a_thousand_panels():
    """Some seconds of a processor; it was over a minute."""
    places = [(0.0, 0.0), *((cos(2 * pi * k / 1000), sin(2 * pi * k / 1000)) for k in range(1000))]
    faces = tuple((0, k + 1, (k + 1) % 1000 + 1) for k in range(1000))
    found = realise(Sheet(1001, (), "", faces, tuple(places)))
    assert "its allowance of work was used up" in found.notes[-1]
    assert len(found.sheet.faces) == 1000
