"""What drawings of theory pages show is so: counts, types, ranges, ways of links."""

import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs"))

from drawings import enumeration, turning  # noqa: E402
from drawings.pages import drawing_of  # noqa: E402

from graphs.mechanism.sc import SCGraph  # noqa: E402
from synth.linkages.conformed.behaviours import Way, behaviour  # noqa: E402
from synth.linkages.conformed.rates import ConformedChain  # noqa: E402
from synth.linkages.fourbar.closing import kind_of_planar  # noqa: E402
from synth.making.drawing.scene.shapes import Line  # noqa: E402

QUICK = ("four-bars", "behaviour", "conical-candidates")


@pytest.fixture(scope="module")
def drawn():
    return {page: drawing_of(page) for page in QUICK}


def texts(scene):
    return [label.text for label in scene.labels()]


def test_six_bars_come_of_two_placements():
    told = texts(enumeration.chains())
    assert [text for text in told if "binary links" in text] == ["2 + 2 + 0 binary links", "2 + 1 + 1 binary links"]
    assert [text for text in told if "chain" in text] == ["Watt's chain", "Stephenson's chain"]


def test_orders_are_counted(drawn):
    assert "6 of its 102 orders round a cone" in texts(drawn["conical-candidates"])


def test_the_four_bars_are_of_the_eight_types(drawn):
    names = [kind_of_planar(lengths).name for lengths in turning._LENGTHS]
    assert len(set(names)) == 8
    assert [text for text in texts(drawn["four-bars"]) if text in names] == names


@pytest.mark.parametrize("lengths", turning._LENGTHS)
def test_a_range_is_whole_exactly_for_a_crank(lengths):
    kind = kind_of_planar(lengths)
    lines = [shape for shape in turning._ranges(lengths).shapes() if isinstance(shape, Line) and len(shape.points) > 4]
    for side, dash in ((kind.input, ()), (kind.output, (3.0, 2.0))):
        arcs = [line for line in lines if line.dash == dash]
        closed = [line for line in arcs if np.allclose(line.points[0], line.points[-1])]
        assert len(arcs) == (2 if side == "rocker" else 1)
        assert len(closed) == (side == "crank")


RING = ConformedChain.of(SCGraph(4, {"O": (0, 1), "A": (1, 2), "B": (2, 3), "C": (3, 0)}))
WORDS = {"out": Way.OUTWARD, "in": Way.INWARD, "both ways": Way.BOTH}
OTHER = {Way.OUTWARD: Way.INWARD, Way.INWARD: Way.OUTWARD, Way.BOTH: Way.BOTH}


@pytest.mark.parametrize("azimuths", [(40, 90, 140, 0), (0, 75, 180, 285), (0, 60, 130, 200), (0, 130, 200, 290)])
def test_links_go_where_behaviour_says(azimuths):
    places = np.radians(azimuths)
    said = [Way(int(way)) for way in behaviour(RING, places).ways][1:]
    for turn in (1e-4, -1e-4):
        ground, *moving = turning.carried_links(places, turn)
        assert np.allclose(np.hypot(*ground.T), 1.0)
        seen = [WORDS[turning.way_of(link)] for link in moving]
        assert seen in (said, [OTHER[way] for way in said])


def test_the_pictures_of_behaviour_are_of_all_three_kinds(drawn):
    told = texts(drawn["behaviour"])
    assert [text for text in told if text.endswith("mobile")] == ["extramobile", "intramobile", "transmobile"]
