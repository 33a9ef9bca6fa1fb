"""Scenes as pixels: the paper lies below all of them, at every size."""

import numpy as np
import pytest

from synth.making.drawing.scene.shapes import Label, Layer
from synth.making.drawing.scene.writing import Scene, pixels

DARK = (0x14, 0x17, 0x1A)


@pytest.mark.parametrize("dots", [30, 60, 72, 200])
def test_the_paper_reaches_all_corners(dots):
    """Below 72 pixels an inch too; what is drawn where no paper is has black rims."""
    found = pixels(Scene(71, 31, ()), paper="dark", dots=dots)
    assert (found.reshape(-1, 3) == DARK).all()


def test_letters_have_the_same_ink_at_every_size():
    scene = Scene(120, 12, (Layer("a", (Label((4, 6), "link OCD: ground", anchor="start", halo=False),)),))
    inks = [float((255.0 - pixels(scene, dots=dots)).sum()) / dots**2 for dots in (45, 60, 200)]
    assert np.ptp(inks) < 0.03 * inks[-1]
