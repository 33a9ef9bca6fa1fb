"""The hoop method: whether a spherical RR dyad takes its orientations in their order.

A *hoop* is half a great circle through the ends of the fixed axis G. It starts at the relative axis S_12 and turns
about G by 180 degrees; on its way it crosses every other relative axis S_ij once. The crank of any dyad about G
takes the orientations 1, 2, ..., n in this order, turning as the hoop turns, if and only if the hoop crosses
S_13, S_14, ..., S_1n, S_2n in this order (Tipparthi and Larochelle 2011, Theorem 1). Theory: docs/theory/order.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from typing import Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.geometry import across
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats
from synth.guidance.orientations import Orientations, Pair, unit_vector

__all__ = [
    "DIRECTIONS",
    "Crossing",
    "Direction",
    "Hoop",
    "direction_words",
    "hoop",
    "hoop_sequence",
    "pair_name",
    "required_sequence",
]

Direction: TypeAlias = Literal["ccw", "cw"]
"""Counter-clockwise or clockwise, seen from the tip of the fixed axis."""

DIRECTIONS: tuple[Direction, Direction] = ("ccw", "cw")


@dataclass(frozen=True, slots=True)
class Crossing:
    """The hoop crosses a relative axis.

    Attributes
    ----------
    pair : (int, int)
        Which one: S_ij.
    angle : float
        How far the hoop has turned from S_12: radians from 0 to pi.
    """

    pair: Pair
    angle: float


@dataclass(frozen=True, slots=True)
class Hoop:
    """What a hoop crosses, and what that says of the order.

    Attributes
    ----------
    direction : "ccw" or "cw"
        How the hoop turns about the fixed axis.
    crossings : tuple of Crossing
        All relative axes but S_12, as they are crossed.
    required : tuple of (int, int)
        The axes that must be crossed in this order: S_13, ..., S_1n, S_2n.
    in_order : bool
        Whether they are.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> turned = hoop(Orientations.from_rotation(body), (0, 0, 1))
    >>> [pair_name(pair) for pair in turned.required], turned.in_order
    (['S13', 'S23'], True)
    """

    direction: Direction
    crossings: tuple[Crossing, ...]
    required: tuple[Pair, ...]
    in_order: bool

    @property
    def sequence(self) -> tuple[Pair, ...]:
        """All pairs in the order of their crossings."""
        return tuple(crossing.pair for crossing in self.crossings)

    @property
    def breaks_at(self) -> tuple[Pair, Pair] | None:
        """Return where the order breaks: the axis that was due and the one crossed instead; None if it is kept."""
        needed = set(self.required)
        met = [pair for pair in self.sequence if pair in needed]
        return next(((due, here) for due, here in zip(self.required, met, strict=True) if due != here), None)

    @property
    def margin(self) -> float:
        """Least angle, in radians, between required crossings (S_12 included): by how much the verdict stands."""
        angles = sorted(c.angle for c in self.crossings if c.pair in set(self.required))
        return float(np.diff([0.0, *angles, np.pi]).min())


def required_sequence(n: int) -> tuple[Pair, ...]:
    """Return the axes whose crossings decide: S_13, ..., S_1n, S_2n."""
    return (*((1, j) for j in range(3, n + 1)), (2, n))


def pair_name(pair: Pair) -> str:
    """Return S23 for (2, 3), and S2,13 where the numbers would run together."""
    i, j = pair
    return f"S{i}{j}" if j < 10 else f"S{i},{j}"


def direction_words(direction: Direction | None) -> str:
    """Return a direction in words.

    >>> direction_words("cw"), direction_words(None)
    ('clockwise', 'neither way')
    """
    return "neither way" if direction is None else {"ccw": "counter-clockwise", "cw": "clockwise"}[direction]


def hoop(orientations: Orientations, axis: npt.ArrayLike, direction: Direction = "ccw") -> Hoop:
    """Turn the hoop about a fixed axis: the analytic form, by angles.

    Parameters
    ----------
    orientations : Orientations
    axis : float[3]
        The fixed axis G in the fixed frame, any length.
    direction : "ccw" or "cw", optional
        Seen from the tip of the axis: -axis and the other direction give the same.

    Raises
    ------
    InvariantError
        If the axis has no direction.
    UnsolvableError
        If it lies on a relative axis, which the hoop then holds all the way.

    Examples
    --------
    A crank about z turns to 90 and 200 degrees, while the body turns about x, the moving axis, too:

    >>> from scipy.spatial.transform import Rotation
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> turned = hoop(Orientations.from_rotation(body), (0, 0, 1))
    >>> [(pair_name(c.pair), round(float(np.degrees(c.angle)), 6)) for c in turned.crossings], turned.in_order
    ([('S13', 55.0), ('S23', 100.0)], True)
    """
    g = unit_vector(axis, "fixed axis")
    lines = _lines_off_axis(orientations, g)
    start = across(lines[1, 2], g)
    beside = np.cross(g, start) * (1.0 if direction == "ccw" else -1.0)
    angles = {
        pair: float(np.arctan2(s @ beside, s @ start)) % np.pi for pair, s in lines.items() if pair != (1, 2)
    }
    pairs = list(angles)
    order = canonical_order([np.array([angles[pair]]) for pair in pairs])
    crossings = tuple(Crossing(pairs[place], angles[pairs[place]]) for place in order)
    required = required_sequence(len(orientations))
    turned = [0.0, *(angles[pair] for pair in required)]
    return Hoop(direction, crossings, required, bool(np.all(np.diff(turned) > 0.0)))


def hoop_sequence(
    orientations: Orientations, axis: npt.ArrayLike, direction: Direction = "ccw"
) -> tuple[Pair, ...]:
    """Return all relative axes but S_12 as the hoop crosses them: the geometric form, without angles.

    The end of each axis line that lies ahead of the plane of the hoop at its start is the one that the hoop meets;
    of two such ends that one is met first from which the other lies ahead. Both are signs of triple products. The
    errors are those of :func:`hoop`.
    """
    g = unit_vector(axis, "fixed axis") * (1.0 if direction == "ccw" else -1.0)
    lines = _lines_off_axis(orientations, g)
    start = lines.pop((1, 2))
    met = {pair: s * np.copysign(1.0, _ahead(g, start, s)) for pair, s in lines.items()}

    def later(a: Pair, b: Pair) -> int:
        return int(-np.sign(_ahead(g, met[a], met[b])))

    return tuple(sorted(met, key=cmp_to_key(later)))


def _ahead(g: Floats, here: Floats, there: Floats) -> float:
    """Return [G, here, there], positive if a turn about G by less than 180 degrees leads there."""
    return float(g @ np.cross(here, there))


def _lines_off_axis(orientations: Orientations, g: Floats) -> dict[Pair, Floats]:
    lines = orientations.relative_axes()
    on: Sequence[Pair] = [pair for pair, s in lines.items() if np.linalg.norm(np.cross(g, s)) < DOUBLE.parallel]
    if on:
        raise UnsolvableError(
            f"the fixed axis lies on the relative axis {pair_name(on[0])}: the hoop holds it at every angle, "
            "and no order follows; move the axis off it"
        )
    return lines
