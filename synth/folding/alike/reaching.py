"""A pattern folded until a crease has an angle: along the motion that keeps what looks alike alike, or another.

With several freedoms the motions at an angle are many, and the least rates that move one crease lead off every
symmetric one: by rounding, if by nothing else. So the motions that keep a symmetry come first, which have few
freedoms or one. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from math import degrees

import numpy as np

from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, Tolerances, leading
from graphs.types import Floats, Ints
from synth.folding.alike.classes import alike_classes
from synth.folding.alike.closure import AlikeClosure
from synth.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.motion.beginning import Wanted, beginning
from synth.motion.closure import ClosureEquations
from synth.motion.driving import Driven
from synth.motion.marked import rates_as_marked
from synth.motion.motion import Motion, motion_along
from synth.motion.path import PathOptions, driven_path
from synth.motion.second_order import rates_at
from synth.motion.singular.nearest import spaces_near
from synth.motion.singular.quadrics import quadrics_of
from synth.motion.singular.sampling import rates_towards
from synth.motion.walk.allowance import Allowance

__all__ = ["Reached", "fold_to"]

_WEIGHTS = (1.01, 0.8, 2.0, 0.5, 4.0, 0.25)
"""Of valleys against mountains in the rates from which those of a motion are looked for: where both weigh alike,
two motions of a symmetric vertex are as near, and rounding would choose."""
_DEAD_ENDS = 4
"""Spaces of rates that are tried for each of these."""
_DRIVERS = 3
"""Creases that are driven in turn, of different classes, where the one that moves most turns back."""
_STEPS = 1000
"""Of one path: 170 degrees take 20 to 100."""


@dataclass(frozen=True, slots=True)
class _Start:
    """A motion at its beginning.

    The equations are those of all motions, or of those that keep classes of joints alike; the largest of the
    rates, float[J], is 1 or -1.
    """

    pattern: SheetConfiguration
    closure: ClosureEquations
    rates: Floats
    classes: Ints
    branch: int | None = None


@dataclass(frozen=True, slots=True)
class Reached:
    """A folding, and how far it came.

    Attributes
    ----------
    folding : Motion
    angle : float
        Of the driven crease at its end, radians, without sign.
    alike : bool
        Whether creases that look alike fold alike on it.
    """

    folding: Motion
    angle: float
    alike: bool


def fold_to(sheet: Sheet, angle: float) -> Reached:
    """Fold a flat pattern as it is marked until the crease that moves most has an angle.

    Tried are, until one leads there: the motion on which creases that look alike fold alike; those that keep less
    of the symmetry; the branch that agrees best with the marks; others that agree with them. On each of these the
    motion goes straight on first, then by the least rates that move the driven crease; where that turns back, the
    next one is driven.

    Parameters
    ----------
    sheet : Sheet
    angle : float
        Radians, above 0.

    Raises
    ------
    UnsolvableError
        If nothing folds, or all motions that were tried end before; the farthest is named.

    Examples
    --------
    The waterbomb base has three freedoms. On its symmetric motion the diagonals fold alike, and so does the line:

    >>> from synth.patterns.creases.bases import waterbomb_base
    >>> reached = fold_to(waterbomb_base(), np.radians(41.54))
    >>> np.degrees(reached.folding.path.angles[-1]).round(2).tolist(), reached.alike
    ([-30.02, 41.54, 41.54, -30.02, 41.54, 41.54], True)
    """
    best = None
    for start in _starts(sheet):
        for driver in _drivers(start):
            for straight in (True, False):
                reached = _followed(start, driver, angle, straight=straight)
                if not reached.folding.path.stopped:
                    return reached
                if best is None or reached.angle > best.angle + DOUBLE.same_configuration:
                    best = reached
    if best is None:
        raise UnsolvableError("no motion is found that folds it as it is marked")
    raise UnsolvableError(
        f"its folding ends at {degrees(best.angle):.6g} degrees, before {degrees(angle):.6g}: "
        f"{best.folding.path.stopped}"
    )


def _starts(sheet: Sheet) -> Iterator[_Start]:
    """Yield motions, the most symmetric one first; all ways to move are looked for only when these are used up."""
    pattern = configuration_of_sheet(sheet)
    if pattern.flat:
        meant = Tolerances.of(pattern.precision.size)
        for classes in alike_classes(pattern.sheet, pattern.linkage, pattern.marks, meant):
            closure = AlikeClosure(pattern.linkage, classes)
            rates = _as_marked(pattern, closure)
            if rates is not None:
                yield _Start(pattern, closure, rates, classes)
    apart = np.arange(len(pattern.linkage.angles))
    number, rates = beginning(pattern, Wanted())
    yield _Start(pattern, pattern.closure, rates, apart, number)
    for other, branch in enumerate(() if pattern.branches is None else pattern.branches.branches):
        rates = rates_as_marked(branch, pattern.wanted)
        if other != (number or 0) and not _against(rates, pattern.marks):
            yield _Start(pattern, pattern.closure, rates, apart, other)


def _as_marked(pattern: SheetConfiguration, closure: ClosureEquations) -> Floats | None:
    """Return rates of a motion on which no marked joint goes against its mark, the largest 1 or -1.

    By factors of the equations of second order, and Newton's method in a basis of the rates that close to first
    order: the regularised steps of `rates_near` leave seven digits of them.
    """
    quadrics = quadrics_of(pattern.linkage)
    tangent = rates_at(closure, pattern.linkage.angles)
    for weight in _WEIGHTS:
        wanted = np.where(pattern.wanted > 0.0, weight, 1.0) * pattern.wanted
        for space in islice(spaces_near(tangent, quadrics, wanted), _DEAD_ENDS):
            rates = None if space is None else rates_towards(space, wanted)
            if rates is None or not rates.any():
                continue
            rates = np.where(np.abs(rates) <= DOUBLE.zero_rate, 0.0, rates)
            if not _against(rates, pattern.marks) and np.abs(rates[rates != 0.0]).min() >= DOUBLE.moved:
                return rates
    return None


def _against(rates: Floats, marks: Floats) -> bool:
    return bool((rates * marks < -DOUBLE.zero_rate).any())


def _drivers(start: _Start) -> list[int]:
    """Return the joints that move most, of different classes, the first of those that move alike."""
    left, drivers = np.abs(start.rates) > DOUBLE.zero_rate, list[int]()
    while left.any() and len(drivers) < _DRIVERS:
        drivers.append(leading(np.where(left, start.rates, 0.0)))
        left &= start.classes != start.classes[drivers[-1]]
    return drivers


def _followed(start: _Start, driver: int, angle: float, *, straight: bool) -> Reached:
    """Drive a joint to an angle on a motion."""
    pattern = start.pattern
    joints = tuple(pattern.linkage.graph.joints)
    goal = float(np.sign(start.rates[driver])) * angle
    limited = np.ones(len(joints), dtype=bool)
    still = (
        () if start.branch is None or pattern.branches is None else pattern.branches.branches[start.branch].still
    )
    options = PathOptions(
        start.rates, limited, straight=straight, names=joints, allowance=Allowance(_STEPS), locked=still
    )
    path = driven_path(start.closure, pattern.linkage.angles, [driver], [[goal]], options=options)
    folding = motion_along(pattern, Driven(start.branch, [driver], {joints[driver]: goal}, path))
    alike = int(start.classes.max(initial=0)) + 1 < len(joints)
    return Reached(folding, float(abs(folding.path.angles[-1, driver])), alike)
