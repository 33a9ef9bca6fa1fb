"""Whole circuits of many spherical linkages of one chain with one degree of freedom, traced together.

The driven joint changes on the way: in each segment it is the joint that turned most in the last step, so that the
circuit goes on through the turning points of every other joint. Segments are taken by the compiled kernel
(`synth.analysis.members.member_kernel`), all members with the same driven joint at once. Theory:
docs/theory/members.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.geometry import unit
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import independent_cycles
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, JointId, LinkId
from synth.analysis.assembly.family import family_of
from synth.analysis.members.member_dimensions import checked_axes, type_of
from synth.analysis.members.member_kernel import CLOSED, MemberArrays, MemberType, swept
from synth.analysis.motion.linkage import linkage_of_axes

_STEP, _AT_ONCE, _MOST = 0.05, 8, 1280
"""Radians that the driven joint turns in a frame; frames of a segment; frames of a circuit, 64 radians, at most."""
_FIRST, _SHORTEST = 1e-3, 1e-5
"""Radians of the step that finds the rates at the start; steps of a member below the second end its circuit."""
_BEYOND = 8
"""Frames beyond its ends by which a circuit is continued for a spline."""


@dataclass(frozen=True, slots=True)
class MemberCircuits:
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
        for link, after, joint, sign in _tree(self.chain):
            half = 0.5 * sign * self.angles[..., joint, None]
            turn = np.concatenate([np.cos(half), np.sin(half) * self.axes[:, None, joint]], axis=-1)
            turned[after] = product(turned[link], turn)
        return turned

    def with_rates(self, pairs: Sequence[tuple[LinkId, LinkId]]) -> tuple[Floats, Floats]:
        """Return the motions of two links, one pair for each member, and how they change with the axes.

        Parameters
        ----------
        pairs : sequence of two link ids
            The motion is that of the second link in the frame of the first.

        Returns
        -------
        float[N, M, 4]
            Unit quaternions, scalar first.
        float[N, M, 2J, 3]
            Rates of rotation in the frame of the first link, radians for each radian by which an axis is turned about
            each of the two directions of `across`. Loops stay closed, while joint angles change as little as they can.
        """
        names = list(self.chain.nodes)
        first, second = ([names.index(pair[side]) for pair in pairs] for side in (0, 1))
        turned = self.rotations()
        every, member = np.stack([turned[name] for name in names]), np.arange(len(self.axes))
        seen = relative(every[first, member], every)
        matrices = _matrices(seen)
        paths = {name: np.zeros(len(self.chain.joints)) for name in names}
        for link, after, joint, sign in _tree(self.chain):
            paths[after] = paths[link].copy()
            paths[after][joint] = sign
        ends = list(self.chain.joints.values())
        loops = np.array([paths[one] - paths[other] for one, other in ends]) + np.eye(len(ends))
        loops = loops[np.abs(loops).sum(axis=1) > 0.0]  # joints of the tree close none
        one, other = ([names.index(pair[side]) for pair in ends] for side in (0, 1))
        axes = np.einsum("jnmab,njb->nmja", matrices[one], self.axes)
        moved = np.einsum("jnmab,njkb->nmjka", matrices[one] - matrices[other], across(self.axes))
        shape = (*axes.shape[:2], 3 * len(loops), -1)
        closing = np.einsum("lj,nmja->nmlaj", loops, axes).reshape(shape)
        opened = np.einsum("lj,nmjka->nmlajk", loops, moved).reshape(shape)
        gram = closing @ closing.swapaxes(2, 3) + DOUBLE.zero * np.eye(shape[2])
        turns = -closing.swapaxes(2, 3) @ np.linalg.solve(gram, opened)
        way = np.array([paths[names[b]] - paths[names[a]] for a, b in zip(first, second, strict=True)])[:, None, :]
        rates = (way[..., None] * axes).swapaxes(2, 3) @ turns
        rates = rates.swapaxes(2, 3) + (way[..., None, None] * moved).reshape(*rates.shape[:2], -1, 3)
        return seen[second, member], np.asarray(rates)


def across(axes: Floats) -> Floats:
    """Return two unit vectors across each axis, float[..., 2, 3]."""
    other = np.where(np.abs(axes[..., :1]) < 0.6, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    first = unit(np.cross(axes, other))
    return np.stack([first, np.cross(axes, first)], axis=-2)


def _tree(chain: SCGraph) -> Iterator[tuple[LinkId, LinkId, int, float]]:
    """Yield the steps from the first link to all others: a link, the next one, the joint, and its sign."""
    first = next(iter(chain.nodes))
    reached, queue = {first}, [first]
    while queue:
        link = queue.pop(0)
        for joint, (one, other) in enumerate(chain.joints.values()):
            after, sign = (other, 1.0) if link == one else (one, -1.0)
            if link in (one, other) and after not in reached:
                reached.add(after)
                queue.append(after)
                yield link, after, joint, sign


def _matrices(turns: Floats) -> Floats:
    """Return the matrices of rotations by unit quaternions, float[..., 3, 3]."""
    from scipy.spatial.transform import Rotation

    matrices = Rotation.from_quat(turns.reshape(-1, 4), scalar_first=True).as_matrix()
    return np.asarray(matrices.reshape(*turns.shape[:-1], 3, 3))


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


def circuits_of(chain: SCGraph, axes: npt.ArrayLike, *, frames: int = 256) -> MemberCircuits:
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
    MemberCircuits
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
    return MemberCircuits(chain, directions, angles, tracing.closed)


def _types(chain: SCGraph) -> list[MemberType]:
    """Return the loops of a chain with each of its joints driven."""
    names: list[JointId] = list(chain.joints)
    some = np.random.default_rng(len(names)).normal(size=(len(names), 3)).tolist()
    linkage = linkage_of_axes(chain, {joint: (axis, axis) for joint, axis in zip(names, some, strict=True)})
    families = [family_of(linkage, [joint]) for joint in names]
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
        members = MemberArrays(self.axes[who][:, kind.joint], np.hstack([others, here[:, [driven]]]))
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
        places = self.count[who, None] + np.arange(_AT_ONCE)
        passed = self._passed(who, angles) & (places > 2) & (np.arange(_AT_ONCE) < reached[:, None])
        ends = passed.any(axis=1)
        kept = np.where(ends, passed.argmax(axis=1) + 1, reached)
        self.angles[who[:, None], places] = angles  # those beyond the kept ones are replaced later
        moved = kept > 0
        self.rate[who[moved]] = steps[moved, kept[moved] - 1]
        self.count[who] += kept
        self._close(who[ends])
        self.step[who] = np.where(reached > 0, np.minimum(_STEP, 2.0 * self.step[who]), self.step[who] / 2.0)

    def _passed(self, who: Ints, angles: Floats) -> Flags:
        """Return which steps pass the start of the circuit in the direction in which it was left: bool[n, F]."""
        frames = np.concatenate([self.angles[who, self.count[who] - 1][:, None], angles], axis=1)
        with np.errstate(invalid="ignore"):
            off = np.remainder(frames + np.pi, 2.0 * np.pi) - np.pi
            along = (off * self.start[who, None]).sum(axis=2)
            near = np.abs(off).max(axis=2) <= 2.0 * _STEP
        return np.asarray(near[:, :-1] & near[:, 1:] & (along[:, :-1] < 0.0) & (along[:, 1:] >= 0.0))

    def _close(self, who: Ints) -> None:
        """Close circuits whose last step passes their start."""
        for member, last in zip(who, self.count[who] - 1, strict=True):
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
