"""Whole circuits of many spherical linkages of one chain with one degree of freedom, traced together.

The driven joint changes on the way: in each segment it is the joint that turned most in the last step, so that the
circuit goes on through the turning points of every other joint. Segments are taken by the compiled kernel
(`synth.members.kernel`), all members with the same driven joint at once. Theory: docs/theory/members.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.geometry import unit
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import independent_cycles
from graphs.types import Flags, Floats, Ints, JointId, LinkId
from synth.assembly.family import family_of
from synth.members.dimensions import checked_axes, type_of
from synth.members.kernel import CLOSED, Members, MemberType, swept
from synth.motion.linkage import linkage_of_axes

_STEP, _AT_ONCE, _MOST = 0.05, 8, 1280
"""Radians that the driven joint turns in a frame; frames of a segment; frames of a circuit, 64 radians, at most."""
_FIRST, _SHORTEST = 1e-3, 1e-5
"""Radians of the step that finds the rates at the start; steps of a member below the second end its circuit."""
_BEYOND = 8
"""Frames beyond its ends by which a circuit is continued for a spline."""


@dataclass(frozen=True, slots=True)
class Circuits:
    """The circuits of members, each at frames that are equally far apart along it, by the turns of all joints.

    Attributes
    ----------
    chain : SCGraph
        All loops have one finite centre.
    axes : float[N, J, 3]
        Unit vectors, at the first frame.
    angles : float[N, M, J]
        Radians from the first frame, not wrapped; nan for a member whose circuit did not close.
    closed : bool[N]
        Whether the circuit came back to its first frame.
    """

    chain: SCGraph
    axes: Floats
    angles: Floats
    closed: Flags

    def rotations(self) -> dict[LinkId, Floats]:
        """Return the rotation of each link from the first frame, against the first link: float[N, M, 4] each.

        Unit quaternions, scalar first, continuous along a circuit.
        """
        first = next(iter(self.chain.nodes))
        turned = {first: np.broadcast_to([1.0, 0.0, 0.0, 0.0], (*self.angles.shape[:2], 4))}
        queue = [first]
        ends = list(self.chain.joints.values())
        while queue:
            link = queue.pop(0)
            for joint, (one, other) in enumerate(ends):
                if link not in (one, other):
                    continue
                after, sign = (other, 0.5) if link == one else (one, -0.5)
                if after not in turned:
                    half = sign * self.angles[..., joint, None]
                    turn = np.concatenate([np.cos(half), np.sin(half) * self.axes[:, None, joint]], axis=-1)
                    turned[after] = product(turned[link], turn)
                    queue.append(after)
        return turned


def product(first: Floats, second: Floats) -> Floats:
    """Return Hamilton's products of quaternions, scalar first: float[..., 4]."""
    a, b = first[..., :1], first[..., 1:]
    c, d = second[..., :1], second[..., 1:]
    scalar = a * c - (b * d).sum(axis=-1, keepdims=True)
    return np.concatenate([scalar, a * d + c * b + np.cross(b, d)], axis=-1)


def relative(first: Floats, second: Floats) -> Floats:
    """Return the rotations of a second body in the frame of a first one, unit quaternions float[..., 4]."""
    return product(first * [1.0, -1.0, -1.0, -1.0], second)


def spherical_of(chain: SCGraph) -> SCGraph:
    """Return the linkage of a chain with one finite centre for all loops."""
    return chain.with_loops([Loop(loop.joints, Centre.FINITE) for loop in independent_cycles(chain.with_loops([]))])


def circuits_of(chain: SCGraph, axes: npt.ArrayLike, *, frames: int = 256) -> Circuits:
    """Trace the circuits through the configurations at which members of a spherical chain have given axes.

    Parameters
    ----------
    chain : SCGraph
        Its joints are determined by one of them, by count; centres are left out of account.
    axes : float[N, J, 3]
        Directions of the joints, of any length. Any directions are those of a closed configuration.
    frames : int, optional
        Frames of each circuit.

    Returns
    -------
    Circuits
        Frames come by a quintic spline through configurations 0.05 radians apart. A member whose circuit
        passes a singular configuration, or is longer than 1280 of these steps, is not closed.

    Raises
    ------
    UnsolvableError
        If one driven joint does not determine the others by count, or a joint is in no loop.
    InvariantError
        If the axes do not fit the chain.

    Examples
    --------
    >>> import networkx as nx
    >>> ring = SCGraph(4, list(nx.cycle_graph(4).edges))
    >>> circuits = circuits_of(ring, np.random.default_rng(5).normal(size=(20, 4, 3)))
    >>> circuits.angles.shape, int(circuits.closed.sum())
    ((20, 256, 4), 20)
    """
    chain = spherical_of(chain)
    directions = unit(checked_axes(len(chain.joints), axes))
    tracing = _Tracing(chain, directions)
    tracing.begin()
    while len(tracing.active):
        tracing.go_on()
    angles = np.full((len(directions), frames, len(chain.joints)), np.nan)
    for member in np.flatnonzero(tracing.closed):
        angles[member] = _resampled(tracing.angles[member, : tracing.count[member]], frames)
    return Circuits(chain, directions, angles, tracing.closed)


def _types(chain: SCGraph) -> list[MemberType]:
    """Return the loops of a chain with each of its joints driven."""
    names: list[JointId] = list(chain.joints)
    some = np.random.default_rng(len(names)).normal(size=(len(names), 3)).tolist()
    posed = linkage_of_axes(chain, {joint: (axis, axis) for joint, axis in zip(names, some, strict=True)})
    families = [family_of(posed, [joint]) for joint in names]
    if len(families[0][0].joints) < len(names):
        raise UnsolvableError("the chain has a joint in no loop; expected one degree of freedom for all")
    return [type_of(family) for family, _ in families]


class _Tracing:
    """Members on their way round their circuits: angles float[N, frames, J], of which `count` are there."""

    def __init__(self, chain: SCGraph, axes: Floats) -> None:
        count, joints = axes.shape[:2]
        self.types, self.axes = _types(chain), axes
        self.angles = np.zeros((count, _MOST + _AT_ONCE + 1, joints))
        self.count = np.ones(count, dtype=np.int64)
        self.rate, self.step = np.zeros((count, joints)), np.full(count, _STEP)
        self.start = np.zeros((count, joints))
        self.closed, self.active = np.zeros(count, dtype=bool), np.arange(count)

    def _swept(self, who: Ints, driven: int, inputs: Floats) -> tuple[Floats, Flags]:
        """Return angles, float[n, F, J], of members at inputs float[n, F] of a joint, and where they are closed."""
        kind = self.types[driven]
        here = self.angles[who, self.count[who] - 1]
        others = np.delete(here, driven, axis=1)
        members = Members(self.axes[who][:, kind.joint], np.hstack([others, here[:, [driven]]]))
        answer = swept(kind, members, np.ascontiguousarray(inputs[..., None]), len(who), kind.column)
        return answer.angles, answer.status == CLOSED

    def begin(self) -> None:
        """Find the rates at the start, by a short step of the first joint that can make one."""
        for driven in range(len(self.types)):
            who = np.flatnonzero(~self.start.any(axis=1))
            if not len(who):
                break
            angles, there = self._swept(who, driven, np.full((len(who), 1), _FIRST))
            self.start[who[there[:, 0]]] = unit(angles[there[:, 0], 0])
        self.rate[:] = self.start
        self.active = np.flatnonzero(self.start.any(axis=1))

    def go_on(self) -> None:
        """Take all members that are under way through a segment, as far as no joint leaps."""
        fastest = np.abs(self.rate[self.active]).argmax(axis=1)
        for driven in np.unique(fastest).tolist():
            who = self.active[fastest == driven]
            here = self.angles[who, self.count[who] - 1]
            turn = np.sign(self.rate[who, driven]) * self.step[who]
            inputs = here[:, [driven]] + turn[:, None] * np.arange(1, _AT_ONCE + 1)
            angles, there = self._swept(who, driven, inputs)
            steps = np.diff(np.concatenate([here[:, None], angles], axis=1), axis=1)
            with np.errstate(invalid="ignore"):
                there &= np.abs(steps).max(axis=2) <= 2.0 * self.step[who, None]
            reached = np.logical_and.accumulate(there, axis=1).sum(axis=1)
            self._keep(who, angles, steps, reached)
        under_way = (~self.closed & (self.step >= _SHORTEST) & (self.count <= _MOST))[self.active]
        self.active = self.active[under_way]

    def _keep(self, who: Ints, angles: Floats, steps: Floats, reached: Ints) -> None:
        """Add the frames that were reached; end circuits that are closed."""
        for frame in range(_AT_ONCE):
            some = (reached > frame) & ~self.closed[who]
            added = who[some]
            place = self.count[added]
            self.angles[added, place] = angles[some, frame]
            self.rate[added] = steps[some, frame]
            self.count[added] += 1
            self._close(added, place)
        self.step[who] = np.where(reached > 0, np.minimum(_STEP, 2.0 * self.step[who]), self.step[who] / 2.0)

    def _close(self, who: Ints, place: Ints) -> None:
        """Close the circuits whose last step passes their start in the direction in which they left it."""
        near = []
        for frames in (place - 1, place):
            off = np.remainder(self.angles[who, frames] + np.pi, 2.0 * np.pi) - np.pi
            near.append(((off * self.start[who]).sum(axis=1), np.abs(off).max(axis=1) <= 2.0 * _STEP))
        (before, was_near), (after, is_near) = near
        passed = was_near & is_near & (before < 0.0) & (after >= 0.0) & (place > 2)
        for member, last in zip(who[passed], place[passed], strict=True):
            wound = 2.0 * np.pi * np.round(self.angles[member, last] / (2.0 * np.pi))
            # frames that are all but the first one again would be knots of no length
            off = np.abs(self.angles[member, last - 3 : last] - wound).max(axis=1)
            end = last - int((off < 0.1 * _STEP).sum())
            self.angles[member, end], self.count[member] = wound, end + 1
            self.closed[member] = True


def _resampled(angles: Floats, frames: int) -> Floats:
    """Return frames equally far apart along a closed circuit whose last configuration is its first one again."""
    from scipy.interpolate import make_interp_spline

    steps = np.linalg.norm(np.diff(angles, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    around = angles - along[:, None] * angles[-1]
    around[-1] = around[0]
    # a quintic that goes on beyond both ends is periodic but for rounding
    knots = np.concatenate([along[-_BEYOND - 1 : -1] - 1.0, along, along[1 : _BEYOND + 1] + 1.0])
    values = np.concatenate([around[-_BEYOND - 1 : -1], around, around[1 : _BEYOND + 1]])
    at = np.arange(frames) / frames
    return np.asarray(make_interp_spline(knots, values, k=5)(at) + at[:, None] * angles[-1])
