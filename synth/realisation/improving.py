"""A drawing made to a better shape: corners neither sharp nor flat, edges alike, creases to their centres.

What is minimised are squares that grow without bound where a corner closes or opens; no step may turn a panel
over. Each step goes to where creases meet their centres, as far as derivatives tell, and within that to the better
shape (Gauss-Newton, damped). Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from graphs.geometry import unit
from graphs.mechanism.sheet import sides_of_face
from graphs.rank.singular_values import split
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.walk.allowance import Allowance
from synth.realisation.figures import crossings
from synth.realisation.measures import corner_angles, edge_lengths, is_drawn, opened_angles, sums_at
from synth.realisation.pattern import Pattern
from synth.realisation.pointing import off_centres
from synth.realisation.wanted.conditions import Condition, together

__all__ = ["improved"]

_ROUNDS = 40
_SHARP = np.radians(35.0)
"""Corners sharper than this, or as near to 180 degrees, cost more than they should."""
_LENGTH = 1.1
_BORDER = 0.15
"""Part of the mean turn at a vertex of the border below which it is near to straight."""
_OFF = 30.0
"""What a crease off its centre costs."""
_SEEN = np.radians(6.0)
"""Sides of bent panels that are seen from the hub under less than this cost more than they should."""
_TIGHT = 1e-14
_ENOUGH = 1e-3
"""A step that gains less than this part is the last, where creases are near to their centres."""
_LEAST = 1e-9
"""A step that gains less than this part may gain by rounding alone: it is none."""
_DIGITS = 6
"""Decimals that each step keeps, edges being about 1 long: where a symmetric drawing leaves its symmetry, steps
would make more of the rounding errors of the step before than of anything else."""
_IDLE = 1e-6
"""Motions of the whole plane of length 1 by which conditions are off by less than this change nothing."""
_NEAR = 1e-4
_NOTHING = 1e-5
"""Where they are not, a step that gains less than this is the last."""


@dataclass(frozen=True)
class _Cost:
    """Residuals at a drawing, and by how much creases miss their centres."""

    residuals: Floats
    by: Floats
    off: Floats
    off_by: Floats

    @property
    def merit(self) -> float:
        return float(self.residuals @ self.residuals + _OFF * np.abs(self.off).sum())

    @property
    def back(self) -> Floats:
        """The shortest step by which each crease turns to its centre."""
        return self._split[0]

    @property
    def free(self) -> Floats:
        """Steps, in columns, by which no crease turns off its centre."""
        return self._split[1]

    @cached_property
    def by_free(self) -> Floats:
        """Derivatives of the residuals along these."""
        free: Floats = self.by @ self.free
        return free

    @cached_property
    def _split(self) -> tuple[Floats, Floats]:
        parts = split(self.off_by)
        rank, right = parts.rank, parts.right
        return (right[:rank].T / parts.values[:rank]) @ parts.left[:, :rank].T, right[rank:].T


@dataclass(frozen=True, slots=True)
class _Wanted:
    """A convex border, logarithms of the lengths of edges, and what is to be met exactly."""

    convex: bool
    lengths: Floats
    exactly: Condition


@np.errstate(divide="ignore", invalid="ignore")  # steps on which vertices coincide are not taken
def improved(
    pattern: Pattern,
    start: Floats,
    *,
    convex: bool = True,
    aims: Floats | None = None,
    conditions: Sequence[Condition] = (),
    allowance: Allowance | None = None,
) -> Floats | None:
    """Return a drawing of better shape in which creases point to their centres; None if none was found.

    Drawings are float[V + C + B, 2], the first one with panels that are convex, or seen from their hubs; edges of
    the answer are 1 long in the mean, or as aimed at: aims, float[E], are logarithms of lengths, by default 0.
    Conditions are met exactly, besides that creases point to their centres. The allowance counts steps: the shape
    that is reached with them is taken.
    """
    exactly = together([partial(off_centres, pattern), *conditions])
    wanted = _Wanted(convex, np.zeros(len(pattern.edges)) if aims is None else aims, exactly)
    unknowns, cost = start, _cost(pattern, start, wanted)
    damping = 1e-2
    for _ in range(_ROUNDS):
        if cost is None:
            return None
        better, lower = None, 10.0
        while better is None and damping < 1e8 and (allowance is None or allowance.take()):
            step = _tried(unknowns, cost, damping, exactly) - unknowns
            trial = np.round(unknowns + _held(pattern, unknowns, cost, step), _DIGITS)
            found = _cost(pattern, trial, wanted)
            if found is not None and found.merit < (1.0 - _LEAST) * cost.merit:
                better = found
            else:
                damping, lower = damping * 6.0, 2.0
        if better is None:
            break
        gained = (cost.merit - better.merit) / cost.merit
        unknowns, cost, damping = trial, better, max(damping / lower, 1e-6)
        if gained < (_ENOUGH if np.abs(cost.off).max(initial=0.0) < _NEAR else _NOTHING):
            break
    return _closed(pattern, unknowns, exactly)


def _closed(pattern: Pattern, unknowns: Floats, exactly: Condition) -> Floats | None:
    """Return the drawing with all creases on their centres and all conditions met, moved as little as possible."""
    for _ in range(12):
        off, by = exactly(unknowns)
        if np.abs(off).max(initial=0.0) <= _TIGHT:
            break
        if not np.isfinite(by).all():  # vertices coincide
            return None
        unknowns = unknowns - (np.linalg.pinv(by, rcond=DOUBLE.zero) @ off).reshape(unknowns.shape)
    angles, _ = opened_angles(pattern, unknowns[: pattern.vertices])
    off, _ = exactly(unknowns)
    if np.abs(off).max(initial=0.0) > DOUBLE.closed or not is_drawn(pattern, angles):
        return None
    return unknowns


def _tried(unknowns: Floats, cost: _Cost, damping: float, exactly: Condition) -> Floats:
    """Return where a step leads that goes to the least cost, and a part of the way to where nothing is off.

    Creases turn on the way, so that the step misses their centres in second order. That is taken back; else the
    gain in shape would have to outweigh it, and steps would be short.
    """
    if not len(cost.off):
        step = -_least(cost.by, cost.residuals, damping)
        return unknowns + step.reshape(unknowns.shape)
    part = 1.0 / (1.0 + damping)
    there = -part * (cost.back @ cost.off)
    within = cost.free @ _least(cost.by_free, cost.residuals + cost.by @ there, damping)
    trial = unknowns + (there - within).reshape(unknowns.shape)
    missed = exactly(trial)[0] - (1.0 - part) * cost.off
    trial -= (cost.back @ missed).reshape(unknowns.shape)
    return trial


def _held(pattern: Pattern, unknowns: Floats, cost: _Cost, step: Floats) -> Floats:
    """Return a step without the motions of the whole plane that change nothing.

    There are none in it but for rounding, which the damping alone keeps small: it would turn the drawing by more
    in each round.
    """
    points = np.ones(len(unknowns))
    points[pattern.directions] = 0.0
    middle = points[:, None] * (points @ unknowns / points.sum())
    motions = np.zeros((3, *unknowns.shape))
    motions[0, :, 0] = motions[1, :, 1] = points
    motions[2] = (unknowns - middle)[:, ::-1] * (-1.0, 1.0)
    rows = unit(motions.reshape(3, -1))
    idle = rows[np.abs(cost.off_by @ rows.T).max(axis=0, initial=0.0) < _IDLE]
    along = np.linalg.qr(idle.T)[0]
    return step - (along @ (along.T @ step.ravel())).reshape(step.shape)


def _least(by: Floats, residuals: Floats, damping: float) -> Floats:
    """Return the damped solution of least squares.

    It is found by a QR decomposition: where corners are sharp derivatives are large, and squares of them would
    square the rounding errors too.
    """
    size = by.shape[1]
    q, r = np.linalg.qr(np.vstack([by, damping**0.5 * np.eye(size)]))
    return np.asarray(np.linalg.solve(r, q[: len(by)].T @ residuals), dtype=np.float64)


def _cost(pattern: Pattern, unknowns: Floats, wanted: _Wanted) -> _Cost | None:
    """Return what a drawing costs.

    None where vertices coincide, a panel is turned over or the border is not as it should be.
    """
    places = unknowns[: pattern.vertices]
    points = np.concatenate([places, unknowns[len(unknowns) - int(pattern.bent.sum()) :]])
    if len(np.unique(points, axis=0)) < len(points):
        return None
    angles, by = opened_angles(pattern, places)
    if not is_drawn(pattern, angles):
        return None
    lengths, by_lengths = edge_lengths(places, pattern.edges)
    lengths = lengths - wanted.lengths
    rows = [
        *_near(angles, by, _SHARP, 1.0),
        *_near(pattern.widest - angles, by, _SHARP, -1.0),
        _LENGTH * (lengths + lengths**3),
        _LENGTH * (1 + 3 * lengths[:, None] ** 2) * by_lengths,
    ]
    room = [(pattern.outer, np.pi if wanted.convex else 2 * np.pi), *((ring, 2 * np.pi) for ring in pattern.holes)]
    for ring, whole in room:
        sums = sums_at(pattern, np.array(ring, np.int64))
        left = whole - sums @ angles
        if left.min() <= 0.0:
            return None
        rows += _near(left, sums @ by, _BORDER * 2 * np.pi / len(ring), -1.0)
    residuals, derivatives = np.concatenate(rows[::2]), np.concatenate(rows[1::2])
    padded = np.zeros((len(residuals), unknowns.size))
    padded[:, : derivatives.shape[1]] = derivatives
    off, off_by = wanted.exactly(unknowns)
    if not (np.isfinite(off).all() and np.isfinite(off_by).all()):
        return None
    if not pattern.bent.any():
        return _Cost(residuals, padded, off, off_by)
    seen, by_seen = _seen(pattern, unknowns)
    if seen.min() <= 0.0 or crossings(pattern, places):
        return None
    return _Cost(np.concatenate([residuals, seen]), np.concatenate([padded, by_seen]), off, off_by)


def _seen(pattern: Pattern, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return what it costs that a side of a bent panel is hardly seen from its hub; negative if it is not seen."""
    hubs = range(len(unknowns) - int(pattern.bent.sum()), len(unknowns))
    panels = [pattern.panels[place] for place in np.flatnonzero(pattern.bent)]
    sides = [(b, hub, a) for hub, panel in zip(hubs, panels, strict=True) for a, b in sides_of_face(panel)]
    angles, by = corner_angles(unknowns, np.array(sides, np.int64))
    costs, by_costs = _near(angles, by, _SEEN, 1.0)
    return np.where(angles > 0.0, costs, -1.0), by_costs


def _near(angles: Floats, by: Floats, size: float, sign: float) -> tuple[Floats, Floats]:
    """Return residuals that grow as angles come near to 0, and derivatives; ``sign`` is that of their own."""
    residuals = (size / angles) ** 2
    return residuals, (-2.0 * sign * residuals / angles)[:, None] * by
