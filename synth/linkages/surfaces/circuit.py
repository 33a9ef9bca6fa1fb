"""Circuits: how the joints of loops follow each other round the circle.

A loop has signed steps, the projected angles between successive joint axes. Projected angles always fit: put the
joints of a linkage anywhere round a cone, and every loop closes, since its steps lead back to where they began.
Sources: Hyatt et al. 2020, Table 1 (printed with every row inverted, docs/misprints.md 000-1), section 7. Theory:
docs/theory/conformed.md, docs/theory/multiloop.md.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, numbered
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Pair, checked_cone_angle
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId

HALF_TURN = np.pi - DOUBLE.parallel
"""Steps between azimuths that are this wide (radians) are half a turn, and have no sign."""


@dataclass(frozen=True, slots=True)
class Circuits:
    """What loops look like on the circle.

    Attributes
    ----------
    open : bool[...]
        Whether the joints follow each other once round the circle: a convex polygon of links. Else it is crossed.
    turns : int[...]
        k: the steps sum to 360 k degrees, so the links wind k times round the axis.
    density : int[...]
        How often the polygon winds when every step is taken the same way round, the shorter of both; 1 if it is
        open.
    residual : float[...]
        Sum of the steps less 2 pi k, radians.

    Examples
    --------
    >>> str(circuits([np.pi / 2] * 4).names())
    'open'
    """

    open: npt.NDArray[np.bool_]
    turns: npt.NDArray[np.int64]
    density: npt.NDArray[np.int64]
    residual: Floats

    def names(self) -> npt.NDArray[np.str_]:
        """Return ``open`` or ``crossed``."""
        return np.where(self.open, "open", "crossed")


def circuits(steps: npt.ArrayLike) -> Circuits:
    """Return the circuits of loops of any number of links.

    Parameters
    ----------
    steps : float[..., n]
        Projected angles in loop order, radians, in [-pi, pi]; they sum to a multiple of 2 pi but for the residual.

    Examples
    --------
    >>> loops = circuits(np.radians([[72, 72, 72, 72, 72], [144, 144, 144, 144, 144]]))  # a pentagon and its star
    >>> loops.names().tolist(), loops.turns.tolist(), loops.density.tolist()
    (['open', 'crossed'], [1, 2], [1, 2])
    """
    steps = np.asarray(steps, dtype=float)
    n = steps.shape[-1]
    total = steps.sum(axis=-1)
    turns = np.rint(total / (2 * np.pi)).astype(np.int64)
    winds = turns + (steps < 0).sum(axis=-1)  # each negative step the other way round adds one turn
    density = np.minimum(winds, n - winds)
    return Circuits(density == 1, turns, density, total - 2 * np.pi * turns)


def wrapped(angles: npt.ArrayLike) -> Floats:
    """Return angles, float[...], in (-pi, pi]."""
    angles = np.asarray(angles, dtype=float)
    turned = np.remainder(angles + np.pi, 2 * np.pi) - np.pi
    return np.where(turned <= -np.pi + 1e-15, np.pi, turned)


def azimuths(steps: npt.ArrayLike, first: float = 0.0) -> Floats:
    """Return the azimuths of the joints of loops, not wrapped: float[..., n]; the last step leads to the first.

    Parameters
    ----------
    steps : float[..., n]
        A small closure error is left to the longest step of each loop, whose link angle feels it least.
    first : float, optional
        Azimuth of the first joint, radians.

    Examples
    --------
    >>> np.degrees(azimuths(np.radians([90, 100, 80, 90]))).round(9).tolist()
    [0.0, 90.0, 190.0, 270.0]
    """
    steps = np.array(steps, dtype=float)
    longest = np.abs(steps).argmax(axis=-1)[..., np.newaxis]
    total = steps.sum(axis=-1, keepdims=True)
    error = total - 2 * np.pi * np.rint(total / (2 * np.pi))
    np.put_along_axis(steps, longest, np.take_along_axis(steps, longest, -1) - error, -1)
    places = np.cumsum(steps, axis=-1)
    return np.asarray(first + np.concatenate([np.zeros_like(error), places[..., :-1]], axis=-1))


def closing_step(steps: npt.ArrayLike) -> Floats:
    """Return the step that closes loops: float[...] in (-pi, pi] (Eq. 14).

    Parameters
    ----------
    steps : float[..., n - 1]

    Examples
    --------
    >>> float(np.degrees(closing_step(np.radians([-40, -20, -45, -68, 28, 30]))).round(9))  # 2020, Fig. 11
    115.0
    """
    return wrapped(-np.asarray(steps, dtype=float).sum(axis=-1))


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
        """Whether steps are half a turn and have no sign, though they are listed as +: bool[..., n]."""
        return np.asarray(np.abs(self.steps) > HALF_TURN)

    def angles(self, cone_angle: npt.ArrayLike) -> Floats:
        """Return the link angles on cones of angles float[...], radians: float[..., n] (Eq. 5)."""
        return link_angles(self.steps, np.asarray(cone_angle, dtype=float)[..., np.newaxis])


def link_pairs(chain: SCGraph) -> dict[Pair, object]:
    """Return all pairs of joints that share a link, and the link."""
    at_link: dict[object, list[JointId]] = {link: [] for link in chain}
    for joint, ends in chain.joints.items():
        for link in ends:
            at_link[link].append(joint)
    return {pair: link for link, joints in at_link.items() for pair in combinations(joints, 2)}


def loop_steps(chain: SCGraph, places: npt.ArrayLike) -> tuple[LoopSteps, ...]:
    """Return the steps and circuits of every declared loop of a chain, from the azimuths of its joints.

    Parameters
    ----------
    chain : SCGraph
    places : float[..., J]
        Azimuths in the order of the chain's joints, radians; `InvariantError` if they are another number.

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
            "azimuths", numbered(t.shape[-1] if t.ndim else 0, "azimuth"), f"{len(number)}, one per joint"
        )
    loops = []
    for loop in chain.loops:
        mine = t[..., [number[joint] for joint in loop.joints]]
        steps = wrapped(np.roll(mine, -1, axis=-1) - mine)
        loops.append(LoopSteps(loop.joints, steps, circuits(steps)))
    return tuple(loops)


def link_angles(steps: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the link angles of projected angles (Hyatt et al. 2020, Eq. 5): phi in [0, pi], float[...].

    cos(phi) = sin(lambda)^2 + cos(lambda)^2 cos(phi_0).

    Parameters
    ----------
    steps, cone_angle : float[...]
        Projected angles phi_0 and lambda (`InvariantError` if out of range), radians, broadcast against each
        other.

    Examples
    --------
    >>> np.degrees(link_angles(np.radians([40, -40, 120]), np.radians([20, 20, 35]))).round(4).tolist()
    [37.4945, 37.4945, 90.3733]
    """
    lam, half = checked_cone_angle(cone_angle), np.asarray(steps, dtype=float) / 2.0
    flat, rest = np.cos(lam) * np.sin(half), np.hypot(np.sin(lam) * np.sin(half), np.cos(half))
    return np.asarray(2.0 * np.arctan2(np.abs(flat), rest))
