"""Members of a chain whose axes are fitted until two of their links move like a motion.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.geometry import unit
from graphs.least_squares.batched import BatchedSearch
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt
from graphs.least_squares.steps import by_the_mean
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints, LinkId
from synth.analysis.members.circuits import MemberCircuits, across, circuits_of, product, relative
from synth.synthesis.atlas.signatures import COMPARED, Around, MotionCurve


@dataclass(frozen=True, slots=True, kw_only=True)
class _Fitting(LevenbergMarquardt):
    """How members are fitted."""

    frames: int
    beginnings: int
    together: int
    nudge: float


_FITTING = _Fitting(
    first=1e-2,  # of the mean square of a column: random members are some degrees off, where angles are nearly linear
    raised=8.0,
    lowered=(8.0,),
    most=1e4,  # a step is then a ten-thousandth of the gradient, and its circuit still did not close or come nearer
    longest=0.3,  # radians of one turn: farther on circuits are other ones
    least_gain=1e-4,  # of the sum of squares: the next stage takes only the best members on
    frames=128,  # of circuits, joined by quintics: what these miss is far below what fits differ by
    beginnings=96,  # places on a circuit where a motion may begin: four for each that is compared
    together=64,  # members whose derivatives are found at once, so that these fit into memory
    nudge=1e-5,  # radians, for differences: the root of what rounding leaves of an angle
)


class AxisFit:
    """Members of a chain whose axes are changed until two of their links move like a motion.

    Residuals are differences of the angles between all pairs of 24 places of the motion and as many of the circuit,
    unknowns two turns of each axis and the place where the motion begins; all members go a step together. The motion
    stays on one circuit, which closes: a step to a member whose circuit does not is rejected.
    """

    def __init__(
        self, chain: SCGraph, axes: Floats, pairs: Sequence[tuple[LinkId, LinkId]], motion: MotionCurve
    ) -> None:
        self._chain, self._pairs, self._motion = chain, list(pairs), motion
        self._places = np.arange(COMPARED) / (COMPARED if motion.closed else COMPARED - 1)
        self._wanted = _angles(motion.at(motion.length * self._places)[None])[0]
        self._ways = np.ones(len(axes))
        begins, begun = self._begun(unit(axes))
        unknowns = np.concatenate([unit(axes).reshape(len(axes), -1), begins[:, None]], axis=1)
        self._search = BatchedSearch(self, unknowns, _FITTING, by_the_mean, begun)

    @property
    def axes(self) -> Floats:
        """Unit vectors, where members are now: float[N, J, 3]."""
        return self._parted(self._search.unknowns)[0]

    @property
    def costs(self) -> Floats:
        """Sums of squares of differences of angles, float[N]; infinite for a circuit that does not close."""
        return self._search.costs

    def run(self, stages: Sequence[tuple[int, int]]) -> None:
        """Go so many steps with so many of the members, the best ones, stage by stage."""
        for steps, kept in stages:
            self._search.run(steps, np.argsort(self.costs, kind="stable")[:kept])

    def residual_at(self, axes: Floats) -> Floats:
        """Return the residuals of all members with other axes, float[N, 276], where motions begin as now."""
        unknowns = self._search.unknowns.copy()
        unknowns[:, :-1] = axes.reshape(len(axes), -1)
        return self.residual(np.arange(len(axes)), unknowns)[0]

    def jacobian_of(self, which: Ints) -> Floats:
        """Return the derivatives of residuals by two turns of each axis and the beginning: float[n, 276, C]."""
        return self._search.jacobian(which)

    def residual(self, which: Ints, unknowns: Floats) -> tuple[Floats, Floats]:
        """Return residuals, infinite where circuits do not close, and the angles round these: `BatchedSystem`."""
        axes, begins = self._parted(unknowns)
        circuits = circuits_of(self._chain, axes, frames=_FITTING.frames)
        residual = np.full((len(which), len(self._wanted)), np.inf)
        good = np.flatnonzero(circuits.closed)
        if len(good):
            around = Around(self._rows(which, circuits)[good])
            residual[good] = self._residual(which[good], around, begins[good])
        return residual, circuits.angles

    def jacobian(self, which: Ints, unknowns: Floats, residual: Floats, data: Floats) -> Floats:
        """Return derivatives by differences of frames along which loops stay closed: `BatchedSystem`."""
        parts = [slice(first, first + _FITTING.together) for first in range(0, len(which), _FITTING.together)]
        return np.concatenate([self._jacobian(which[at], unknowns[at], residual[at], data[at]) for at in parts])

    def moved(self, which: Ints, unknowns: Floats, step: Floats) -> Floats:
        """Return unknowns after steps, each no longer than it may be: `BatchedSystem`."""
        step = step * np.minimum(1.0, _FITTING.longest / np.maximum(np.abs(step).max(axis=1), DOUBLE.zero))[:, None]
        axes, begins = self._parted(unknowns)
        turns = (step[:, :-1].reshape(*axes.shape[:2], 2, 1) * across(axes)).sum(axis=2)
        turned = unit(axes + np.cross(turns, axes))
        return np.concatenate([turned.reshape(len(axes), -1), (begins + step[:, -1])[:, None]], axis=1)

    @staticmethod
    def _parted(unknowns: Floats) -> tuple[Floats, Floats]:
        """Return axes float[n, J, 3] and where motions begin, float[n]."""
        return unknowns[:, :-1].reshape(len(unknowns), -1, 3), unknowns[:, -1]

    def _parts(self, which: Ints, lengths: Floats, begins: Floats) -> Floats:
        """Return where places of the motion are on circuits, as parts of their lengths: float[n, 24]."""
        reach = np.ones(len(lengths)) if self._motion.closed else self._motion.length / lengths
        return begins[:, None] + (self._ways[which] * reach)[:, None] * self._places

    def _residual(self, which: Ints, around: Around, begins: Floats) -> Floats:
        return np.asarray(_angles(around.at(self._parts(which, around.lengths, begins))) - self._wanted)

    def _rows(self, which: Ints, circuits: MemberCircuits) -> Floats:
        """Return the motions of the two links of some members."""
        turned = circuits.rotations()
        rows = np.empty((*circuits.angles.shape[:2], 4))
        for place, (first, second) in enumerate(self._pairs[member] for member in which.tolist()):
            rows[place] = relative(turned[first][place], turned[second][place])
        return rows

    def _begun(self, axes: Floats) -> tuple[Floats, tuple[Floats, Floats]]:
        """Find which way motions go on the circuits; return where they begin, and residuals and data there."""
        which, begins = np.arange(len(axes)), np.zeros(len(axes))
        circuits = circuits_of(self._chain, axes, frames=_FITTING.frames)
        rows, good = self._rows(which, circuits), np.flatnonzero(circuits.closed)
        back = _angles(self._motion.at(self._motion.length * self._places[::-1])[None])[0]
        starts = np.arange(_FITTING.beginnings) / _FITTING.beginnings
        for member in good:
            around, own = Around(rows[[member]]), which[[member]]
            reach = float((self._parts(own, around.lengths, np.zeros(1)))[0, -1])
            at = around.at((starts[:, None] + reach * self._places / self._places[-1]).reshape(1, -1))[0]
            angles = _angles(at.reshape(_FITTING.beginnings, COMPARED, -1))
            costs = [((angles - wanted) ** 2).sum(axis=1) for wanted in (self._wanted, back)]
            turned = int(costs[1].min() < costs[0].min())
            begin = float(starts[int(costs[turned].argmin())])
            begins[member], self._ways[member] = ((begin, 1.0), (begin + reach, -1.0))[turned]
        residual = np.full((len(axes), len(self._wanted)), np.inf)
        if len(good):
            residual[good] = self._residual(good, Around(rows[good]), begins[good])
        return begins, (residual, circuits.angles)

    def _jacobian(self, which: Ints, unknowns: Floats, residual: Floats, angles: Floats) -> Floats:
        axes, begins = self._parted(unknowns)
        circuits = MemberCircuits(self._chain, axes, angles, np.ones(len(which), dtype=bool))
        rows, rates = circuits.with_rates([self._pairs[member] for member in which.tolist()])
        turns = np.concatenate([np.zeros((*rates.shape[:3], 1)), 0.5 * _FITTING.nudge * rates], axis=-1)
        moved = unit(rows[:, :, None] + product(turns, np.broadcast_to(rows[:, :, None], turns.shape)))
        count = moved.shape[2]
        around = Around(moved.swapaxes(1, 2).reshape(-1, *rows.shape[1:]))
        there = self._residual(np.repeat(which, count), around, np.repeat(begins, count))
        shifted = self._residual(which, Around(rows), begins + _FITTING.nudge)
        every = np.concatenate([there.reshape(len(which), count, -1), shifted[:, None]], axis=1)
        return np.asarray((every - residual[:, None]).swapaxes(1, 2) / _FITTING.nudge)


def _angles(at: Floats) -> Floats:
    """Return the angles between all pairs of 24 places, radians up to a whole turn: [n, 276].

    Each quaternion is the one nearer to that of the place before; so angles are smooth beyond half a turn too.
    """
    near = (at[:, 1:] * at[:, :-1]).sum(axis=2) >= 0.0
    signs = np.cumprod(np.where(near, 1.0, -1.0), axis=1)
    at = np.concatenate([at[:, :1], at[:, 1:] * signs[..., None]], axis=1)
    one, other = np.triu_indices(COMPARED, 1)
    gap = at[:, one] - at[:, other]
    return np.asarray(4.0 * np.arcsin(np.minimum(np.sqrt(np.einsum("npi,npi->np", gap, gap)) / 2.0, 1.0)))
