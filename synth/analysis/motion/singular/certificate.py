"""Certificates for common points of quadratic forms, in ball arithmetic.

Krawczyk's operator maps a box of balls into its own interior only if the box holds exactly one solution, and that is
regular (R. Krawczyk 1969; R. E. Moore 1977; for polynomial systems J. D. Hauenstein and F. Sottile, Algorithm 921:
alphaCertified, ACM Transactions on Mathematical Software 38 (2012), certify with Smale's numbers instead). The forms
are balls too: what is certified holds for all forms as close to those in double precision. A box of real balls holds
a real solution. Theory: docs/theory/branches.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import NumericalError
from graphs.tolerances import DOUBLE
from graphs.types import Floats

_WIDER, _WIDENINGS = 8.0, 4
"""The box is so many times as wide as Newton's method would move its middle, and as wide again if that fails."""
# Largest imaginary part of a point that is tried as a real one first: of badly conditioned forms a path ends that far
# off. Where this leads to another point's box, that box is there twice, and nothing is proved.
_NEARLY_REAL = 1e-4
_CORRECTIONS = 3  # Newton's method doubles the digits at each: 1e-4 becomes 1e-32, which is less than rounding
_LEAST_WIDTH = 1e-13
"""Boxes are no smaller: as wide as the rounding of their middles."""
_INSIDE = 1.0 - 2.0**-30
"""Ends of balls are rounded when they are made floating-point numbers: what is inside is so by more than that."""


@dataclass(frozen=True, slots=True)
class CertifiedPoint:
    """A regular common point of quadratic forms, alone in a box.

    The box is about `middle`, complex[s], whose entry at place `chart` is 1; other entries are off by at most
    `radius`. `real` says that the point is.
    """

    middle: npt.NDArray[np.complex128]
    radius: float
    chart: int
    real: bool


def _flint() -> Any:
    import flint  # motions that need no certificate go without it

    return flint


class FormBalls:
    """Quadratic forms in balls: each entry is uncertain by a part of the largest of all."""

    def __init__(self, forms: Floats, error: float = DOUBLE.closed) -> None:
        self._forms = forms / np.abs(forms).max()
        self._count, self._size = forms.shape[:2]
        rows = self._forms.reshape(-1, self._size).tolist()
        self._real = _flint().arb_mat([[_flint().arb(entry, error) for entry in row] for row in rows])
        self._complex: Any = None

    def certified(self, point: npt.NDArray[np.complex128]) -> CertifiedPoint | None:
        """Return the certificate of a point near one at which all forms vanish; None without one."""
        chart = int(np.argmax(np.abs(point)))
        middle = point / point[chart]
        middle[chart] = 1.0
        if np.abs(middle.imag).max() <= _NEARLY_REAL:
            real = self._about(self._settled(middle.real.astype(complex), chart), chart, real=True)
            if real is not None:
                return real
        point_there = self._about(middle, chart, real=False)
        # a box that meets the real space may hold a real point, and then says neither that it is nor that it is not
        apart = point_there is not None and np.abs(middle.imag).max() > point_there.radius
        return point_there if apart else None

    def _settled(self, middle: npt.NDArray[np.complex128], chart: int) -> npt.NDArray[np.complex128]:
        """Return a real point after corrections of Newton's method, which leave rounding only beside a regular one."""
        others = [place for place in range(self._size) if place != chart]
        for _ in range(_CORRECTIONS):
            slopes = self._forms @ middle.real
            change = np.linalg.lstsq(2.0 * slopes[:, others], slopes @ middle.real, rcond=DOUBLE.zero)[0]
            middle[others] -= change
        return middle

    def _about(self, middle: npt.NDArray[np.complex128], chart: int, *, real: bool) -> CertifiedPoint | None:
        others = [place for place in range(self._size) if place != chart]
        slopes = 2.0 * (self._forms @ middle)[:, others]
        try:
            inverse = np.linalg.inv(slopes.real if real else slopes)
        except np.linalg.LinAlgError:
            return None
        return self._within_box(middle, inverse, others, chart, real=real)

    def _within_box(
        self,
        middle: npt.NDArray[np.complex128],
        inverse: npt.NDArray[Any],
        others: list[int],
        chart: int,
        *,
        real: bool,
    ) -> CertifiedPoint | None:
        made = (_flint().arb_mat, _arb) if real else (_flint().acb_mat, _acb)
        about = self._box(middle, chart, 0.0, real=real)
        values = self._slopes(about, real=real) * about
        nearly = made[0](inverse.tolist())
        change = nearly * values
        moved = max(float(abs(change[row, 0]).upper()) for row in range(self._count))
        width = max(_WIDER * moved, _LEAST_WIDTH)
        for _ in range(_WIDENINGS):
            box = self._box(middle, chart, width, real=real)
            slopes = self._slopes(box, real=real).table()
            derivative = made[0]([[2 * row[place] for place in others] for row in slopes])
            unit = made[0](np.eye(self._count).tolist())
            across = made[0]([[made[1](0.0, width)] for _ in others])
            image = (unit - nearly * derivative) * across - change
            if max(_reach(image[row, 0], real=real) for row in range(self._count)) < _INSIDE * width:
                return CertifiedPoint(middle, width, chart, real)
            width *= _WIDER
        return None

    def _box(self, middle: npt.NDArray[np.complex128], chart: int, width: float, *, real: bool) -> Any:
        ball: Any = _arb if real else _acb
        entries: list[Any] = (middle.real if real else middle).tolist()
        balls = [[ball(entry, 0.0 if place == chart else width)] for place, entry in enumerate(entries)]
        return (_flint().arb_mat if real else _flint().acb_mat)(balls)

    def _slopes(self, box: Any, *, real: bool) -> Any:
        """Return half the derivatives of all forms over a box, a matrix of balls."""
        if not real and self._complex is None:
            self._complex = _flint().acb_mat(self._real)
        products = (self._real if real else self._complex) * box
        entries = products.entries()
        made = _flint().arb_mat if real else _flint().acb_mat
        return made(self._count, self._size, entries)


def _arb(entry: float, width: float) -> Any:
    return _flint().arb(entry, width)


def _acb(entry: complex, width: float) -> Any:
    entry = complex(entry)
    return _flint().acb(_flint().arb(entry.real, width), _flint().arb(entry.imag, width))


def _reach(ball: Any, *, real: bool) -> float:
    """Return how far from zero a ball reaches, in its real and in its imaginary part."""
    if real:
        return float(abs(ball).upper())
    return max(float(abs(ball.real).upper()), float(abs(ball.imag).upper()))


def all_distinct(points: Sequence[CertifiedPoint]) -> bool:
    """Tell whether the boxes of certified points are apart in projective space.

    The sine of the angle between two middles is more than the sum of those within the boxes; it is computed to 1e-15.
    """
    if len(points) < 2:
        return True
    lengths = np.array([np.linalg.norm(point.middle) for point in points])
    units = np.array([point.middle for point in points]) / lengths[:, None]
    # entries of a box of complex balls are off by sqrt(2) of its radius
    reach = np.array([point.radius for point in points]) * np.sqrt(2.0 * len(points[0].middle)) / lengths
    if not np.isfinite(units).all():
        raise NumericalError("points at which forms vanish are not finite")
    for number in range(1, len(points)):
        before = units[:number]
        across = units[number] - (before.conj() @ units[number])[:, None] * before
        if (np.linalg.norm(across, axis=1) <= reach[number] + reach[:number] + DOUBLE.zero).any():
            return False
    return True
