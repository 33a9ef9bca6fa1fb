"""What lambda is: the same in the code and in the words of the documents."""

import re
from math import degrees, pi
from pathlib import Path

import numpy as np
import pytest

from graphs.mechanism.surfaces import joint_axes

DOCS = Path(__file__).resolve().parents[4] / "docs"


def test_lambda_is_what_the_words_say():
    axis, first = np.array([0.0, -1.0, 0.0]), joint_axes([0.0], 0.3)[0]
    half_the_apex = float(np.arccos(axis @ first))
    assert half_the_apex == pytest.approx(pi / 2 - 0.3)
    words = (DOCS / "words.md").read_text().replace("\n", " ")
    assert "**Lambda**: the angle between a ruling line and the plane across the axis" in words
    assert f"{degrees(pi / 2):.0f} degrees less half the apex angle" in words
    told = [*DOCS.rglob("*.md"), *(DOCS.parent / "synth").rglob("*.py"), *(DOCS.parent / "graphs").rglob("*.py")]
    for place in told:
        text = place.read_text()
        if "apex" not in text.lower():
            continue
        halves = re.findall(r"(.{0,16}) ?half (?:the|its) apex", text, re.IGNORECASE | re.DOTALL)
        assert all("less" in before for before in halves), place
