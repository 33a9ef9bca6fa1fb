"""The order of positions of a body in the plane: the propeller, of which the hoop is the spherical form.

The pole P_ij is the point about which the plane turns from position i to position j. A crank about a fixed pivot A
has its moving pivot at equal distances from A in all positions, so that the line from A to P_ij bisects the angle
between the crank at i and at j, as the plane of G and S_ij does on the sphere: with crank angles b_i it is at (b_i +
b_j) / 2 modulo 180 degrees. So Theorem 1 of Tipparthi and Larochelle 2011 and its Eqs. 1 and 2 hold word for word
with poles in place of relative axes: a *propeller*, a line that turns about A by 180 degrees from P_12, passes P_13,
..., P_1n, P_2n in this order if and only if the crank takes the positions in theirs. Theory: docs/theory/order.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.geometry import best_plane
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.linkages.guidance.order import (
    DIRECTIONS,
    Direction,
    Hoop,
    OrderAnalysis,
    checked_order,
    crossed,
    order_by_crank_angles,
    required_sequence,
)
from synth.linkages.guidance.orientations import Pair

_FEWEST = 3


@dataclass(frozen=True, slots=True, eq=False)
class PlanarPositions:
    """Three or more different positions of a body in the plane, numbered from 1.

    Attributes
    ----------
    rows : float[n, 3]
        Where the origin of the body is, x and y, and how far the body is turned, radians. `InvariantError` if there
        are fewer than three, or two are equal.

    Examples
    --------
    >>> x, y, w = PlanarPositions([(0, 0, 0), (1, 0, np.pi / 2), (0, 1, np.pi)]).pole(1, 2)
    >>> round(float(x / w), 6), round(float(y / w), 6)
    (0.5, 0.5)
    """

    rows: Floats

    def __post_init__(self) -> None:
        rows = np.array(self.rows, dtype=float)
        if rows.ndim != 2 or rows.shape[1] != 3 or not np.isfinite(rows).all():
            raise InvariantError("positions", f"an array of shape {rows.shape}", "finite numbers, n by 3: x, y, angle")
        if len(rows) < _FEWEST:
            raise InvariantError("positions", numbered(len(rows), "position"), f"{_FEWEST} or more")
        object.__setattr__(self, "rows", rows)
        for i, j in combinations(range(1, len(rows) + 1), 2):
            if self._same(i, j):
                raise InvariantError("different positions", f"positions {i} and {j} are equal", "different ones")

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<PlanarPositions: {numbered(len(self), 'position')}>"

    @property
    def extent(self) -> float:
        """The largest distance between origins, or 1 if they are one point."""
        return float(np.ptp(self.rows[:, :2], axis=0).max()) or 1.0

    def _same(self, i: int, j: int) -> bool:
        one, other = self.rows[i - 1], self.rows[j - 1]
        turn = abs(np.sin((other[2] - one[2]) / 2.0))
        return bool(turn < DOUBLE.parallel and np.abs(other[:2] - one[:2]).max() < DOUBLE.same_point * self.extent)

    def pole(self, i: int, j: int) -> Floats:
        """Return P_ij in homogeneous coordinates, float[3]: of a translation it is at infinity, across its direction.

        From half of the sum and difference of origins: z + w i d cot(turn / 2), both times sin(turn / 2).
        """
        one, other = self.rows[i - 1], self.rows[j - 1]
        half = (other[2] - one[2]) / 2.0
        middle, step = (one[:2] + other[:2]) / 2.0, (other[:2] - one[:2]) / 2.0
        across = np.array([-step[1], step[0]])
        return np.array([*(np.sin(half) * middle + np.cos(half) * across), np.sin(half)])

    def of_fixed(self, pivot: Floats) -> Floats:
        """Return where a fixed point lies in the body at each position: float[n, 2]."""
        c, s = np.cos(self.rows[:, 2]), np.sin(self.rows[:, 2])
        x, y = (pivot - self.rows[:, :2]).T
        return np.stack([c * x + s * y, c * y - s * x], axis=1)

    def of_moving(self, point: Floats) -> Floats:
        """Return where a point of the body lies at each position: float[n, 2]."""
        c, s = np.cos(self.rows[:, 2]), np.sin(self.rows[:, 2])
        x, y = point
        return np.asarray(self.rows[:, :2] + np.stack([c * x - s * y, s * x + c * y], axis=1))

    def subset(self, numbers: Sequence[int]) -> PlanarPositions:
        """Return some of the positions, numbered from 1, in the order of the numbers."""
        return PlanarPositions(self.rows[[number - 1 for number in numbers]])


def analyse_planar_order(
    positions: PlanarPositions, pivot: npt.ArrayLike, direction: Direction = "ccw", desired: Sequence[int] | None = None
) -> OrderAnalysis:
    """Check in three ways whether a crank about a fixed pivot takes planar positions in order, by a propeller.

    Parameters
    ----------
    positions : PlanarPositions
    pivot : float[2]
        The fixed pivot; `UnsolvableError` if it lies on a pole, or if the best moving pivot is at infinity.
    direction : "ccw" or "cw", optional
    desired : sequence of int, optional
        Numbers of three or more positions in the order in which the crank is to take them.

    Examples
    --------
    >>> turns = np.radians([0, 90, 200])  # of a crank of length 2 about the origin; the body turns as it likes
    >>> rows = np.stack([2 * np.cos(turns), 2 * np.sin(turns), [0.0, 0.3, -0.4]], axis=1)
    >>> analysis = analyse_planar_order(PlanarPositions(rows), (0, 0))
    >>> analysis.in_order, analysis.agree, np.degrees(analysis.crank_angles).round(6).tolist()
    (True, True, [0.0, 90.0, 200.0])
    """
    at = np.array(pivot, dtype=float)
    if at.shape != (2,) or not np.isfinite(at).all():
        raise InvariantError("fixed pivot", "the fixed pivot has not two finite numbers", "x, y")
    order = checked_order(len(positions), desired, "position")
    lines = {pair: line for pair, line in _lines_off_pivot(positions, at).items() if set(pair) <= set(order)}
    turned = {way: crossed(lines, order, way) for way in DIRECTIONS}
    taken = positions.subset(order)
    moving = _nearest_moving_pivot(taken, at)
    cranks = taken.of_moving(moving) - at
    angles = np.arctan2(cranks[:, 1], cranks[:, 0])
    angles = np.mod(angles - angles[0], 2.0 * np.pi)
    lengths = np.hypot(*cranks.T)
    return OrderAnalysis(
        tuple(at.tolist()),
        turned[direction],
        next((way for way in DIRECTIONS if turned[way].in_order), None),
        _by_inequalities(lines, turned[direction], order),
        order_by_crank_angles(angles),
        moving,
        angles,
        float(np.abs(lengths / lengths.mean() - 1.0).max()),
        order,
    )


def _lines_off_pivot(positions: PlanarPositions, pivot: Floats) -> dict[Pair, Floats]:
    """Return the directions from the pivot to all poles, float[2], of any length."""
    lines = {}
    for i, j in combinations(range(1, len(positions) + 1), 2):
        pole = positions.pole(i, j)
        line = pole[:2] - pole[2] * pivot
        size = abs(pole[2]) * (positions.extent + float(np.abs(pivot).max())) + float(np.abs(pole[:2]).max())
        if np.abs(line).max() <= DOUBLE.parallel * size:
            raise UnsolvableError(
                f"the fixed pivot lies on the pole P{i}{j}: the propeller holds it at every angle, and no order "
                "follows; move the pivot off it"
            )
        lines[i, j] = line
    return lines


def _nearest_moving_pivot(positions: PlanarPositions, pivot: Floats) -> Floats:
    """Return the point of the body whose distance from a fixed pivot changes least: float[2].

    In the body the fixed pivot lies on a circle about it. Lifted to the paraboloid z = x^2 + y^2 circles are planes,
    and the plane nearest to the points gives the centre.
    """
    seen = positions.of_fixed(pivot)
    middle = seen.mean(axis=0)
    unit = float(np.abs(seen - middle).max()) or 1.0
    around = (seen - middle) / unit
    normal = best_plane(np.column_stack([around, (around**2).sum(axis=1)])).direction
    if abs(normal[2]) <= DOUBLE.parallel:
        raise UnsolvableError("the moving pivot is at infinity: a slider, and no crank, takes the positions")
    return np.asarray(middle - unit * normal[:2] / (2.0 * normal[2]))


def _by_inequalities(lines: dict[Pair, Floats], turned: Hoop, order: Sequence[int]) -> Direction | None:
    """Return the direction in which the order is kept by the signs of Eq. 2, seen along the normal of the plane."""
    start = lines[turned.start]
    sequence = [lines[pair] for pair in required_sequence(len(order), order)]
    signs = [
        np.sign(_cross(start, a)) * np.sign(_cross(a, b)) * np.sign(_cross(start, b)) for a, b in pairwise(sequence)
    ]
    return {1.0: DIRECTIONS[0], -1.0: DIRECTIONS[1]}.get(signs[0] if len(set(signs)) == 1 else 0.0)


def _cross(a: Floats, b: Floats) -> float:
    return float(a[0] * b[1] - a[1] * b[0])
