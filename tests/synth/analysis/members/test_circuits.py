"""Circuits of many members: they close, at every frame, and come back to where they begin."""

from __future__ import annotations

import numpy as np
import pytest

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import mechanism_of_id
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE
from synth.analysis.members.circuits import circuits_of, product, relative
from synth.linkages.fourbar.closing import can_close

WATT = "k1:E`hW"
CHAINS = ("k1:Cr", WATT)


@pytest.mark.parametrize("code", CHAINS)
def test_joints_turn_about_their_axes_at_every_frame(code: str) -> None:
    """Links are placed along a tree; the joints beside it turn about their axes only if loops are closed."""
    chain = mechanism_of_id(code)
    circuits = circuits_of(chain, np.random.default_rng(3).normal(size=(12, len(chain.joints), 3)))
    assert circuits.closed.all()
    turned = circuits.rotations()
    for joint, (one, other) in enumerate(chain.joints.values()):
        half = circuits.angles[..., joint, None] / 2.0
        expected = np.concatenate([np.cos(half), np.sin(half) * circuits.axes[:, None, joint]], axis=-1)
        off = product(expected * [1.0, -1.0, -1.0, -1.0], relative(turned[one], turned[other]))[..., 1:]
        assert np.abs(off).max() < 1e-4
        assert np.median(np.abs(off).max(axis=(1, 2))) < 1e-6


def test_a_circuit_begins_at_the_axes_and_moves_on_evenly() -> None:
    chain = mechanism_of_id("k1:Cr")
    circuits = circuits_of(chain, np.random.default_rng(4).normal(size=(20, 4, 3)), frames=400)
    assert np.abs(circuits.angles[:, 0]).max() < DOUBLE.closed
    steps = np.linalg.norm(np.diff(circuits.angles, axis=1), axis=2)
    assert (steps.max(axis=1) < 1.05 * steps.min(axis=1)).all()
    back = np.remainder(2.0 * circuits.angles[:, -1] - circuits.angles[:, -2] + np.pi, 2.0 * np.pi) - np.pi
    assert np.abs(back).max() < 0.05


def test_a_joint_goes_all_the_way_round_where_its_loop_closes_at_every_angle() -> None:
    """A second method: the diagonal of a four-bar closes both triangles at 720 angles of a joint."""
    chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    circuits = circuits_of(chain, np.random.default_rng(5).normal(size=(60, 4, 3)))
    axes = circuits.axes
    arcs = np.stack([np.arccos((axes[:, k] * axes[:, (k + 1) % 4]).sum(axis=1)) for k in range(4)], axis=1)
    turn = np.linspace(0.0, 2.0 * np.pi, 720)[:, None]
    cosine = np.cos(arcs[:, 0]) * np.cos(arcs[:, 3]) + np.sin(arcs[:, 0]) * np.sin(arcs[:, 3]) * np.cos(turn)
    diagonal = np.arccos(cosine)
    whole = np.array([
        all(can_close(np.stack([np.full(720, arcs[n, 1]), np.full(720, arcs[n, 2]), diagonal[:, n]], axis=1)))
        for n in range(60)
    ])  # fmt: skip
    wound = np.abs(circuits.angles[:, -1, 0]) > np.pi
    assert (wound == whole).all()
    assert 5 < whole.sum() < 55


def test_what_one_joint_does_not_determine_is_refused() -> None:
    five = SCGraph(5, [(k, (k + 1) % 5) for k in range(5)])
    with pytest.raises(UnsolvableError, match="M = 2"):
        circuits_of(five, np.ones((1, 5, 3)))
    with pytest.raises(InvariantError, match="float\\[N, 4, 3\\]"):
        circuits_of(mechanism_of_id("k1:Cr"), np.ones((1, 5, 3)))
