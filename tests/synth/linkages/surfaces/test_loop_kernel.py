"""Roots of loop sums by the library of C and by numpy: the same roots, signs, turns and families."""

import numpy as np
import pytest

from graphs.c_libraries import library
from synth.linkages.fourbar.closing import can_close
from synth.linkages.surfaces import loop_sums
from synth.linkages.surfaces.loop_maps import cone_reach, cylinder_reach

needs_library = pytest.mark.skipif(
    library(loop_sums.SOURCE) is None, reason="there is no library: no compiler was at hand"
)


def loops(links, rng):
    """Reaches, and the base: angles and lengths at random, and whole ones, of which sums vanish or touch 360 k."""
    count = max(4, 2000 // 2**links)
    angles = rng.uniform(0.02, np.pi - 0.02, (count, links))
    whole = np.radians(10.0 * rng.integers(1, 18, (count, links)))
    cones = [cone_reach(one[can_close(one)]) for one in (angles, whole)]
    lengths = (rng.uniform(0.5, 1.0, (count, links)), rng.integers(1, 5, (count, links)).astype(float))
    return [*((reach, 1) for reach in cones), *((cylinder_reach(one), 0) for one in lengths)]


@needs_library
@pytest.mark.parametrize("links", [3, 4, 5, 6, 8])
def test_roots_are_those_of_numpy(links, monkeypatch):
    for reach, base in loops(links, np.random.default_rng(links)):
        fast = loop_sums.loop_roots(reach, base)
        monkeypatch.setattr(loop_sums, "roots_in_library", lambda *_: None)
        slow = loop_sums.loop_roots(reach, base)
        monkeypatch.undo()
        for name in ("loop", "signs", "turns", "double", "family_loop", "family_signs", "family_exact"):
            np.testing.assert_array_equal(getattr(fast, name), getattr(slow, name), err_msg=name)
        np.testing.assert_allclose(fast.size, slow.size, rtol=1e-8, atol=1e-12)
        np.testing.assert_allclose(fast.residual, slow.residual, rtol=0, atol=1e-13)


@needs_library
def test_there_is_room_for_more_roots_than_most_loops_have(monkeypatch):
    reach = cylinder_reach(np.random.default_rng(2).integers(1, 4, (60, 6)).astype(float))
    wanted = loop_sums.loop_roots(reach, 0)
    monkeypatch.setattr(loop_sums, "_ROOTS_OF_A_LOOP", 0)
    found = loop_sums.loop_roots(reach, 0)
    assert len(found.loop) == len(wanted.loop) > 60
    np.testing.assert_array_equal(found.size, wanted.size)
