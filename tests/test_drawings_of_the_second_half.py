"""Drawings of theory pages: all mechanisms of a kind, types as things, cones and cylinders, guidance."""

import re
import sys
from html import unescape
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs"))

from drawings import cones, enumeration, guidance, things, turning  # noqa: E402
from drawings.pages import drawing_of  # noqa: E402

from graphs.mechanism.sc import SCGraph  # noqa: E402
from synth.conformed.behaviours import Way, behaviour  # noqa: E402
from synth.conformed.rates import ConformedChain  # noqa: E402
from synth.drawing import svg_text  # noqa: E402
from synth.drawing.scene.palette import SMALL  # noqa: E402
from synth.drawing.scene.shapes import Disc, Line  # noqa: E402
from synth.fourbar.closing import kind_of_planar  # noqa: E402

DRAWINGS = {
    page: draw for room in (enumeration, things, cones, turning, guidance) for page, draw in room.DRAWINGS.items()
}
PARTS = ("All mechanisms of a kind", "Types as things", "Cones and cylinders", "Guidance")
QUICK = ("strings", "four-bars", "behaviour", "conical-candidates", "rounding")
MOST_BYTES, MOST_POINTS = 60_000, 500


def pages_of_parts():
    index = (ROOT / "docs/theory/index.md").read_text()
    parts = {part.split("\n")[0]: part for part in index.split(":caption: ")[1:]}
    return [line for name in PARTS for line in parts[name].split("```")[0].split("\n")[1:] if line]


@pytest.fixture(scope="module")
def drawn():
    return {page: drawing_of(page) for page in QUICK}


def texts(scene):
    return [label.text for label in scene.labels()]


def test_every_page_of_these_parts_has_its_drawing_near_its_top():
    assert sorted(DRAWINGS) == sorted([*pages_of_parts(), "viewer"])
    for page in DRAWINGS:
        head = (ROOT / f"docs/theory/{page}.md").read_text().split("\n\n")[:4]
        [picture] = [part for part in head if part.endswith(f"](../pictures/theory/{page}.svg)")]
        assert len(picture.split("](")[0]) > 40  # the alternative text says what is seen
        drawing = (ROOT / f"docs/pictures/theory/{page}.svg").read_text()
        assert len(drawing) < MOST_BYTES
        assert float(drawing.split('width="')[1].split('"')[0].removesuffix("pt")) < MOST_POINTS


@pytest.mark.parametrize("page", QUICK)
def test_a_drawing_has_the_same_bytes_each_time(page, drawn):
    assert svg_text(drawing_of(page)) == svg_text(drawn[page])


@pytest.mark.parametrize("page", QUICK)
def test_the_drawing_that_is_kept_says_what_is_drawn_now(page, drawn):
    """Words and shapes, and not bytes: last digits of numbers are those of a machine."""
    kept = (ROOT / f"docs/pictures/theory/{page}.svg").read_text()
    assert unescape("|".join(re.findall("<text[^>]*>([^<]*)<", kept))) == "|".join(texts(drawn[page]))
    assert kept.count("<circle") == sum(isinstance(shape, Disc) for shape in drawn[page].shapes())


@pytest.mark.parametrize("page", QUICK)
def test_letters_can_be_read_and_lie_within_the_picture(page, drawn):
    scene = drawn[page]
    for label in scene.labels():
        left, top, right, low = label.box
        assert label.size >= SMALL
        assert min(left, top) > -1, label.text
        assert right < scene.width + 1, label.text
        assert low < scene.height + 1, label.text


def test_six_bars_come_of_two_placements():
    told = texts(enumeration.chains())
    assert [text for text in told if "binary links" in text] == [
        "2 + 2 + 0 binary links",
        "2 + 1 + 1 binary links",
    ]
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
    lines = [
        shape for shape in turning._ranges(lengths).shapes() if isinstance(shape, Line) and len(shape.points) > 4
    ]
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
