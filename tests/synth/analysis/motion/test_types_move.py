"""Random types of mechanisms: a general member moves with as many freedoms as the exact rank says."""

import random

import numpy as np
import pytest
from sizes import slow
from strategies import random_sc

from graphs.errors import UnsolvableError
from graphs.rank.exact import exact_mobility
from graphs.rank.realisation import Reals, realise
from synth.analysis.motion.branches import branches_of
from synth.analysis.motion.linkage import linkage_of_axes


def general_member(sc, seed):
    """Return the linkage of a general member: of each axis the point nearest to the origin, and its direction."""
    placed = realise(sc, Reals(seed))
    lines = {joint: np.array(line, dtype=float) for joint, line in placed.axes.items()}
    return linkage_of_axes(sc, {joint: (np.cross(u, m) / (u @ u), u) for joint, (u, m) in lines.items()})


@pytest.mark.parametrize("seeds", [range(5), slow(range(5, 400))])
def test_general_members_move_with_their_exact_mobility(seeds):
    moving = 0
    for seed in seeds:
        sc = random_sc(random.Random(seed))
        if not sc.joints:
            continue
        try:
            linkage = general_member(sc, seed)
        except UnsolvableError:  # three centres that one axis would have to pass through
            continue
        expected = exact_mobility(sc).mobility
        found = branches_of(linkage)
        if expected:
            [branch] = found.branches
            assert (branch.freedoms, found.regular) == (expected, True)
            assert branch.certainty != "not known"
            moving += 1
        else:
            assert found.no_motion == "proved"
    assert moving > len(seeds) // 4
