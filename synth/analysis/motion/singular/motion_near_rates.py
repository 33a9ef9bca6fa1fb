"""One motion near wanted rates, without a search of all branches; for linkages too large for that.

Rates that agree to second order are found by Newton's method, each equation on the few joints that it is between,
so that one step costs as much as there are equations. At the flat state the loops say of the signs of rates only
what second order does, and Newton's method comes to rest where branches meet; at fold angles of some tenths of a
radian most configurations are regular. A folded state belongs to a motion from flat only if it can be followed
back there. Theory: docs/theory/folding.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from math import pi

import numpy as np

from graphs.rank.singular_values import Inertia, inertia, split
from graphs.tolerances import DOUBLE, MARGIN, canonical_basis, canonical_order, signed, trailing
from graphs.types import Floats, Ints
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.singular.sampling import rates_towards
from synth.analysis.motion.singular.second_order import (
    Quadric,
    RateSpace,
    equations_by_size,
    quadrics_of,
    rates_at,
    rates_near,
)
from synth.analysis.motion.walk.step import STRAY

_SCALES, _WEIGHTS = (0.4, 0.2, 0.6), (1.0, 0.7, 1.4)
"""Fold angles of valleys at the starts, radians, and those of mountains as multiples of these: where both are
alike, a symmetric start may lead back to the flat state."""
_FEW = 600
"""With more joints mountains and valleys start alike."""
_FINITE = 0.05
"""Configurations with smaller angles only, radians, are the flat state but for what Newton's method left."""
_STEPS, _PATIENCE = 30, 4
"""Steps from one start, and so many in turn that do not make the residual less."""
_BACK, _LEAST_BACK = 0.6, 0.98
"""Angles after a step back as part of those before, and where no such step is possible."""
_SMALL = 0.02
"""The way back ends where the largest angle is smaller, radians: loops there close to fourth order by rates."""


@dataclass(frozen=True, slots=True)
class FoldedStart:
    """A motion that was found at a folded state and followed back towards the flat one.

    `rates`, float[J], are the fold angles at the end of the way back, the largest 1 or -1; `agree` joints turn as
    wanted there. The largest fold angles are `found_at`, and `back_to` at the end of the way back, radians; `folded`,
    float[J], are those at the folded state.
    """

    rates: Floats
    agree: int
    found_at: float
    back_to: float
    folded: Floats


def folded_start(closure: ClosureEquations, wanted: Floats) -> FoldedStart | None:
    """Return a motion from the flat state on which most joints turn with wanted signs, float[J]; else None."""
    best = None
    goal = int(np.count_nonzero(wanted))
    for start in _starts(wanted):
        angles = _closed(closure, start)
        if angles is None or (best is not None and _agreement(angles, wanted) <= best.agree):
            continue
        back = _followed_back(closure, angles)
        if back is None:
            continue
        small, largest = back, float(np.abs(back).max())
        found_at = float(np.abs(angles).max())
        motion = FoldedStart(small / largest, _agreement(small, wanted), found_at, largest, angles)
        if best is None or motion.agree > best.agree:
            best = motion
        if best.agree == goal:
            break
    return best


def _starts(wanted: Floats) -> Iterator[Floats]:
    """Yield fold angles along the signs that are wanted, radians."""
    signs = np.sign(wanted)
    for weight in _WEIGHTS if len(wanted) <= _FEW and (signs > 0).any() and (signs < 0).any() else _WEIGHTS[:1]:
        for scale in _SCALES:
            yield scale * np.where(signs < 0.0, weight, 1.0) * signs


def _closed(closure: ClosureEquations, start: Floats) -> Floats | None:
    """Return a closed folded configuration near angles, by Newton's method with all its derivatives; or None."""
    angles, least, idle = start, np.inf, 0
    for _ in range(_STEPS):
        residual, entries = closure.evaluated(angles)
        error = float(np.abs(residual).max(initial=0.0))
        if error <= DOUBLE.closed:
            largest = float(np.abs(angles).max(initial=0.0))
            return angles if _FINITE <= largest <= pi else None
        idle = 0 if error < least else idle + 1
        least = min(error, least)
        if idle == _PATIENCE or np.abs(angles).max() > 2.0 * pi:
            return None
        angles = angles + closure.space(entries).step(residual)
    return None


def _followed_back(closure: ClosureEquations, angles: Floats) -> Floats | None:
    """Return the small angles at the end of the way back to the flat state; None where it does not lead there.

    All angles are made less in proportion, and corrected; a step is taken smaller where the correction is more
    than a part of it, or a joint turns over.
    """
    part = _BACK
    while float(np.abs(angles).max()) > _SMALL:
        end = corrected(closure, part * angles)
        largest = float(np.abs(angles).max())
        stray = float(np.abs(end.angles - part * angles).max())
        turned_over = (angles * end.angles < -(DOUBLE.zero_rate**2) * float(angles @ angles)).any()
        if not end.closed or stray > STRAY * (1.0 - part) * largest or turned_over:
            part = 1.0 - (1.0 - part) / 2.0
            if part > _LEAST_BACK:
                return None
            continue
        angles = end.angles
    return angles


MOST_RATES = 1500
"""With more joints the rates that close to first order are not all computed: their matrix is dense."""
_DEAD_ENDS = 200
"""After so many choices that leave nothing the search ends."""


@dataclass(frozen=True, slots=True)
class InitialMotion:
    """Initial rates, the largest 1 or -1, if any; whether it is rigid; the folded state that led to them."""

    rates: Floats | None
    rigid: bool
    folded: FoldedStart | None = None


def begun_near(closure: ClosureEquations, linkage: Linkage, wanted: Floats) -> InitialMotion:
    """Return rates that agree to second order, near wanted ones, of a linkage too large for all its branches.

    From folded states along the wanted rates, if the linkage is flat; unless these lead to a motion with all of
    them, by Newton's method from the wanted rates too. Where that comes to nothing, since on most branches many
    joints are immobile, within the nearest space. Wanted are rates or signs of them, float[J].
    """
    quadrics = quadrics_of(linkage)
    folded = _from_folded(closure, linkage, quadrics, wanted)
    if folded is not None and folded.folded is not None and folded.folded.agree == np.count_nonzero(wanted):
        return folded
    rates = rates_near(closure, linkage.angles, quadrics, wanted)
    if rates is not None and (folded is None or _agreement(rates, wanted) >= _agreement(folded.rates, wanted)):
        return InitialMotion(rates / np.abs(rates).max(), rigid=False)
    if folded is not None:
        return folded
    if closure.joints > MOST_RATES:
        return InitialMotion(None, rigid=False)
    tangent = rates_at(closure, linkage.angles)
    spaces, nothing = spaces_near(tangent, quadrics, wanted), True
    for space in islice(spaces, _DEAD_ENDS):
        if space is None:
            continue
        nothing = False
        for start in (wanted, space.basis.sum(axis=1)):
            rates = rates_towards(space, start)
            if rates.any():
                return InitialMotion(rates, rigid=False)
    through = not list(islice(spaces, 1))
    return InitialMotion(None, rigid=nothing and through)


def _from_folded(
    closure: ClosureEquations, linkage: Linkage, quadrics: Sequence[Quadric], wanted: Floats
) -> InitialMotion | None:
    """Return rates near those of a motion that is followed back from a folded state; None where none is found."""
    if np.abs(linkage.angles).max(initial=0.0) > DOUBLE.parallel:
        return None
    folded = folded_start(closure, wanted)
    if folded is None:
        return None
    near = rates_near(closure, linkage.angles, quadrics, folded.rates)
    lost = near is None or _agreement(near, wanted) < folded.agree
    rates = folded.rates if lost or near is None else near / np.abs(near).max()
    return InitialMotion(rates, rigid=False, folded=folded)


def _agreement(rates: Floats | None, wanted: Floats) -> int:
    """Return how many joints turn as is wanted: at rates or angles, float[J]."""
    return 0 if rates is None else int((rates * wanted > DOUBLE.zero_rate * np.abs(rates).max(initial=0.0)).sum())


def spaces_near(
    tangent: Floats, quadrics: Sequence[Quadric], wanted: Floats, zero: float = DOUBLE.zero
) -> Iterator[RateSpace | None]:
    """Yield spaces of rates that agree to second order, those near to wanted ones first; None for what is empty.

    Equations of one sign are used up first. Of the products, that one is decided which the wanted rates decide
    most clearly, by its factor that is nearer to vanishing at them. The tangent is as of `spaces_within`.
    """
    stack = _EquationGroups(quadrics, zero)
    for basis, left in stack.split(tangent, np.arange(len(quadrics)), wanted):
        left_there = tuple(quadrics[number] for number in left)
        yield RateSpace(canonical_basis(basis), left_there) if basis.shape[1] else None


class _EquationGroups:
    """Equations, those between as many joints in one array each."""

    def __init__(self, quadrics: Sequence[Quadric], zero: float) -> None:
        self._groups = [
            (numbers, joints, forms / np.abs(forms).max(axis=(1, 2), keepdims=True))
            for numbers, joints, forms in equations_by_size(quadrics)
        ]
        self._most = max((joints.shape[1] for _, joints, _ in self._groups), default=0)
        self._zero = zero

    def split(self, basis: Floats, left: Ints, wanted: Floats) -> Iterator[tuple[Floats, Ints]]:
        """Yield bases of spaces within one and the numbers of the equations left there, depth first."""
        while basis.shape[1]:
            on = self._on(basis, left)
            kept = np.abs(on.values).max(axis=1, initial=0.0) > self._zero
            left, on = left[kept], Inertia(on.values[kept], on.vectors[kept], on.signs[kept])
            positive, negative = on.positive, on.negative
            single = np.flatnonzero((positive == 0) | (negative == 0))
            if len(single):
                normals = [on.vectors[one][:, on.signs[one] != 0] for one in single]
                basis = self._part(basis, np.concatenate(normals, axis=1))
                continue
            products = np.flatnonzero((positive == 1) & (negative == 1))
            if not len(products):
                yield basis, left
                return
            for normal in _clearest(on.values[products], on.vectors[products], basis.T @ wanted, basis):
                yield from self.split(self._part(basis, normal[:, None]), left, wanted)
            return
        yield basis, left

    def _on(self, basis: Floats, left: Ints) -> Inertia:
        """Return eigenvalues [n, k] and vectors [n, s, k] of equations on a space, 0 past their own."""
        size = basis.shape[1]
        most = min(self._most, size)
        values, signs = np.zeros((len(left), most)), np.zeros((len(left), most), dtype=np.int64)
        axes = np.zeros((len(left), size, most))
        for numbers, joints, forms in self._groups:
            here = np.flatnonzero(np.isin(left, numbers))
            places = np.searchsorted(numbers, left[here])
            across, local = np.linalg.qr(basis[joints[places]].transpose(0, 2, 1))
            local_inertia = inertia(local @ forms[places] @ local.transpose(0, 2, 1), self._zero)
            number = local_inertia.values.shape[1]
            values[here, :number], signs[here, :number] = local_inertia.values, local_inertia.signs
            axes[here, :, :number] = across @ local_inertia.vectors
        return Inertia(values, axes, signs)

    def _part(self, basis: Floats, normals: Floats) -> Floats:
        parts = split(normals.T, self._zero)
        return np.asarray(basis @ parts.right[parts.rank :].T)


def _clearest(values: Floats, axes: Floats, wanted: Floats, basis: Floats) -> tuple[Floats, Floats]:
    """Return the normals of the factors between which wanted rates decide most clearly, the nearer one first.

    Values float[n, k] and axes float[n, s, k] are eigenvalues and eigenvectors of products: one value is positive,
    one negative. Where both factors are as near, the order of the joints, rows of the basis float[J, s], decides.
    """
    each = np.arange(len(values))
    first, last = values.argmin(axis=1), values.argmax(axis=1)
    up = np.sqrt(values[each, last])[:, None] * axes[each, :, last]
    down = np.sqrt(-values[each, first])[:, None] * axes[each, :, first]
    factors = np.stack([up + down, up - down], axis=1)
    factors /= np.linalg.norm(factors, axis=2, keepdims=True)
    off = np.abs(factors @ wanted)
    least, most = off.min(axis=1), off.max(axis=1)
    clear = most > DOUBLE.zero_rate * np.linalg.norm(wanted)  # others are on both factors, but for rounding
    best = factors[trailing(np.where(clear, least / np.where(clear, most, 1.0), 1.0), scale=1.0)]
    first, second = (best[place] for place in canonical_order([signed(basis @ normal) for normal in best]))
    swapped = abs(float(second @ wanted)) < abs(float(first @ wanted)) - MARGIN * float(np.linalg.norm(wanted))
    return (second, first) if swapped else (first, second)
