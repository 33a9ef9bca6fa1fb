"""The least singular value across the freedoms, followed along a walk: compared with a singular value decomposition."""

import numpy as np
import pytest

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.motion.walk.step import RankWatch
from synth.analysis.motion.walk.walking import DrivenGoal, Walk


@pytest.mark.parametrize("joints", range(4, 13))
def test_many_freedoms_are_not_taken_for_a_rank_that_drops(joints):
    """Of the rates of a spherical ring all but three are freedoms; the vector that is followed is none of them."""
    axes = np.random.default_rng(joints).normal(size=(joints, 3))
    ring = SCGraph(joints, [(k, (k + 1) % joints) for k in range(joints)], [Loop(range(joints), "finite")])
    linkage = linkage_of_axes(ring, {joint: ((0.0, 0.0, 0.0), axis) for joint, axis in enumerate(axes)})
    closure = ClosureEquations(linkage)
    walk = Walk(closure, linkage.angles, watch=RankWatch(closure))
    goal = DrivenGoal([0], linkage.angles[[0]] + 0.3, walk.here, range(joints))
    walk.towards(goal, [])
    while goal.ahead(walk.here):
        next(walk)
        least = np.linalg.svd(walk.here.jacobian.toarray(), compute_uv=False)[-1]
        assert least > 0.01
        assert not walk.singular
