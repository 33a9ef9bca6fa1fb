"""Linkages of several loops: their steps and circuits on one cone (Hyatt et al. 2020, section 7).

Projected angles always fit: put the joints anywhere round a cone, and every loop closes, since its steps lead
back to where they began. All functions take many linkages of one chain at a time. From link angles:
`synth.surfaces.common`. Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Pair
from graphs.types import Floats, JointId
from synth.surfaces.circuit import HALF_TURN, Circuits, circuits, wrapped
from synth.surfaces.cone import link_angles

__all__ = ["LoopSteps", "link_pairs", "loop_steps"]


@dataclass(frozen=True, slots=True)
class LoopSteps:
    """One loop of many linkages of one chain.

    Attributes
    ----------
    joints : tuple of joint ids
        In loop order; step i leads from joint i to the next.
    steps : float[..., n]
        Projected angles, radians, in (-pi, pi].
    circuits : Circuits
    """

    joints: tuple[JointId, ...]
    steps: Floats
    circuits: Circuits

    @property
    def half_turns(self) -> npt.NDArray[np.bool_]:
        """Return which steps are half a turn and have no sign, though they are listed as +: bool[..., n]."""
        return np.asarray(np.abs(self.steps) > HALF_TURN)

    def angles(self, cone_angle: npt.ArrayLike) -> Floats:
        """Return the link angles on cones: float[..., n] (Eq. 5).

        Parameters
        ----------
        cone_angle : float[...]
        """
        return link_angles(self.steps, np.asarray(cone_angle, dtype=float)[..., np.newaxis])


def link_pairs(chain: SCGraph) -> dict[Pair, object]:
    """Return all pairs of joints that share a link, and the link.

    Parameters
    ----------
    chain : SCGraph

    Examples
    --------
    A binary link has one pair, a ternary one three:

    >>> watt = SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)])
    >>> len(link_pairs(watt))
    10
    """
    at_link: dict[object, list[JointId]] = {link: [] for link in chain}
    for joint, ends in chain.joints.items():
        for link in ends:
            at_link[link].append(joint)
    return {pair: link for link, joints in at_link.items() for pair in combinations(joints, 2)}


def loop_steps(chain: SCGraph, places: npt.ArrayLike) -> tuple[LoopSteps, ...]:
    """Return the steps and circuits of every loop of a chain, from the azimuths of its joints.

    Parameters
    ----------
    chain : SCGraph
        Its loops are those given; where none are, the faces of an embedding are not looked for: give them.
    places : float[..., J]
        Azimuths in the order of the chain's joints, radians. Many linkages at a time.

    Returns
    -------
    tuple of LoopSteps

    Raises
    ------
    InvariantError
        If the number of azimuths is not that of the joints.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> (loop,) = loop_steps(four_bar, np.radians([[0, 90, 180, 270], [0, 180, 90, 270]]))
    >>> loop.circuits.names().tolist(), np.degrees(loop.angles(np.radians(30))[0]).round(4).tolist()
    (['open', 'crossed'], [75.5225, 75.5225, 75.5225, 75.5225])
    """
    t = np.asarray(places, dtype=float)
    number = {joint: i for i, joint in enumerate(chain.joints)}
    if t.shape[-1:] != (len(number),):
        raise InvariantError(
            "azimuths", f"azimuths of {t.shape[-1] if t.ndim else 0} joints", f"those of the {len(number)} joints"
        )
    made = []
    for loop in chain.loops:
        mine = t[..., [number[joint] for joint in loop.joints]]
        steps = wrapped(np.roll(mine, -1, axis=-1) - mine)
        made.append(LoopSteps(loop.joints, steps, circuits(steps)))
    return tuple(made)
