"""The order of orientations: the hoop method, and two more checks, by inequalities and by crank angles.

A *hoop* is half a great circle through the ends of the fixed axis G that starts at the relative axis S_12 and
turns about G by 180 degrees. The crank of any dyad about G takes the orientations 1, 2, ..., n in this order,
turning as the hoop turns, if and only if the hoop crosses S_13, S_14, ..., S_1n, S_2n in this order (Tipparthi and
Larochelle 2011, Theorem 1, Eqs. 1 and 2). The three checks share no step but the orientations. Theory:
docs/theory/order.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import degrees, radians
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.geometry import across, best_plane
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE, EPSILON, canonical_order
from graphs.types import Floats
from synth.linkages.guidance.orientations import Orientations, Pair, unit_vector

Direction: TypeAlias = Literal["ccw", "cw"]
"""Counter-clockwise or clockwise, seen from the tip of the fixed axis."""

DIRECTIONS: tuple[Direction, Direction] = ("ccw", "cw")


@dataclass(frozen=True, slots=True)
class HoopCrossing:
    """The hoop crosses a relative axis.

    Attributes
    ----------
    pair : (int, int)
        Which one: S_ij.
    angle : float
        Rotation of the hoop from S_12, radians from 0 to pi.
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
    crossings : tuple of HoopCrossing
        All relative axes but S_12, in the order of crossing.
    required : tuple of (int, int)
        The axes that must be crossed in this order: S_13, ..., S_1n, S_2n.
    in_order : bool
        Whether they are.
    start : (int, int)
        The axis at which the hoop starts: of the first two orientations of the desired order.

    Examples
    --------
    >>> hoop(Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7]), (3, 1, 2)).required
    ((1, 3), (2, 3))
    """

    direction: Direction
    crossings: tuple[HoopCrossing, ...]
    required: tuple[Pair, ...]
    in_order: bool
    start: Pair = (1, 2)

    @property
    def sequence(self) -> tuple[Pair, ...]:
        """All pairs in the order of their crossings."""
        return tuple(crossing.pair for crossing in self.crossings)

    @property
    def breaks_at(self) -> tuple[Pair, Pair] | None:
        """Where the order breaks: the axis that was due and the one crossed instead; None if it is kept."""
        needed = set(self.required)
        met = [pair for pair in self.sequence if pair in needed]
        return next(((due, here) for due, here in zip(self.required, met, strict=True) if due != here), None)

    @property
    def margin(self) -> float:
        """Least angle between required crossings (the start included), radians: by how much the verdict holds."""
        angles = sorted(c.angle for c in self.crossings if c.pair in set(self.required))
        return float(np.diff([0.0, *angles, np.pi]).min())


def required_sequence(n: int, desired: Sequence[int] | None = None) -> tuple[Pair, ...]:
    """Return the axes whose crossings decide: S_13, ..., S_1n, S_2n, or those of the same places of another order."""
    order = range(1, n + 1) if desired is None else desired
    first, second, *others = order
    return (*(_pair(first, other) for other in others), _pair(second, others[-1]))


def _pair(i: int, j: int) -> Pair:
    """Return two orientations as a pair: S_ij and S_ji are one line."""
    return min(i, j), max(i, j)


def checked_order(n: int, desired: Sequence[int] | None, what: str = "orientation") -> tuple[int, ...]:
    """Return the numbers in the desired order; by default all as they are numbered.

    `InvariantError` unless they are three or more, each one of the n and none of them twice.
    """
    order = tuple(range(1, n + 1)) if desired is None else tuple(desired)
    for place, number in enumerate(order):
        if not 1 <= number <= n:
            offender = f"{what} {number} is in the desired order, of {numbered(n, what)}"
            raise InvariantError("desired order", offender, f"numbers from 1 to {n}")
        if number in order[:place]:
            raise InvariantError("desired order", f"{what} {number} occurs twice", "each number once")
    if len(order) < 3:
        raise InvariantError("desired order", f"{numbered(len(order), what)} in order", "three or more")
    return order


def pair_name(pair: Pair) -> str:
    """Return S23 for (2, 3), and S2,13 where the numbers would run together."""
    i, j = pair
    return f"S{i}{j}" if j < 10 else f"S{i},{j}"


def direction_words(direction: Direction | None) -> str:
    """Return a direction in words: clockwise, counter-clockwise, or neither way."""
    return "neither way" if direction is None else {"ccw": "counter-clockwise", "cw": "clockwise"}[direction]


def hoop(
    orientations: Orientations, axis: npt.ArrayLike, direction: Direction = "ccw", desired: Sequence[int] | None = None
) -> Hoop:
    """Turn the hoop about a fixed axis: the analytic form, by angles.

    Parameters
    ----------
    orientations : Orientations
    axis : float[3]
        The fixed axis G in the fixed frame, any length but zero; `UnsolvableError` if it lies on a relative axis,
        which the hoop then holds all the way.
    direction : "ccw" or "cw", optional
        Seen from the tip of the axis: -axis and the other direction give the same.
    desired : sequence of int, optional
        Numbers of three or more orientations, from 1, in the order in which the crank is to take them; by default
        all in the order of their numbers.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> turned = hoop(Orientations.from_rotation(body), (0, 0, 1))  # the crank turns to 90 and 200 degrees
    >>> [(pair_name(c.pair), round(float(np.degrees(c.angle)), 6)) for c in turned.crossings], turned.in_order
    ([('S13', 55.0), ('S23', 100.0)], True)
    """
    g = unit_vector(axis, "fixed axis")
    order = checked_order(len(orientations), desired)
    lines = {pair: s for pair, s in _lines_off_axis(orientations, g).items() if set(pair) <= set(order)}
    start = across(lines[_pair(*order[:2])], g)
    beside = np.cross(g, start)
    seen = {pair: np.array([s @ start, s @ beside]) for pair, s in lines.items()}
    return crossed(seen, order, direction)


def crossed(lines: Mapping[Pair, Floats], order: Sequence[int], direction: Direction) -> Hoop:
    """Return what a line that turns by 180 degrees crosses: a hoop seen along its axis, or a propeller in the plane.

    `lines` are the directions of the lines of all pairs as they are seen there, float[2], of any length and sign. It
    starts at the line of the first two of the order.
    """
    start = _pair(*order[:2])
    sign = 1.0 if direction == "ccw" else -1.0
    zero = float(np.arctan2(lines[start][1], lines[start][0]))
    angles = {
        pair: float(sign * (np.arctan2(line[1], line[0]) - zero) % np.pi)
        for pair, line in lines.items()
        if pair != start
    }
    pairs = list(angles)
    sequence = canonical_order([np.array([angles[pair]]) for pair in pairs])
    crossings = tuple(HoopCrossing(pairs[place], angles[pairs[place]]) for place in sequence)
    required = required_sequence(len(order), order)
    turned = [0.0, *(angles[pair] for pair in required)]
    return Hoop(direction, crossings, required, bool(np.all(np.diff(turned) > 0.0)), start)


def _lines_off_axis(orientations: Orientations, g: Floats) -> dict[Pair, Floats]:
    lines = orientations.relative_axes()
    on: Sequence[Pair] = [pair for pair, s in lines.items() if np.linalg.norm(np.cross(g, s)) < DOUBLE.parallel]
    if on:
        raise UnsolvableError(
            f"the fixed axis lies on the relative axis {pair_name(on[0])}: the hoop holds it at every angle, "
            "and no order follows; move the axis off it"
        )
    return lines


_BLOCK = 1 << 15
"""Axes that are checked together: what they need stays in the processor's cache."""
_FITS = radians(1e-4)
"""Axes are printed to six digits or so."""


@dataclass(frozen=True, slots=True)
class OrderAnalysis(Printed):
    """The order of orientations about a fixed axis, with three verdicts.

    Attributes
    ----------
    axis : tuple of float
        The fixed axis as the user wrote it; in the plane the fixed pivot.
    hoop : Hoop
        The hoop turned in the required direction; its verdict is ``in_order``.
    kept, by_inequalities, by_crank_angles : "ccw", "cw" or None
        The direction in which the order is kept, if there is one: by the hoop, and by the other two checks.
    moving_axis : float[3]
        The moving axis W, in the body, of the dyad about this axis that fits best; in the plane the moving pivot.
    crank_angles : float[n]
        The angles of its crank from the first orientation, radians in [0, 2 pi), counter-clockwise, in the desired
        order.
    misfit : float
        Largest difference, in radians, between the crank's link angle at an orientation and its mean (in the plane
        between its lengths): zero if the dyad passes through all orientations. With four orientations or more most
        fixed axes have no such dyad.
    desired : tuple of int
        The orientations in the order that is analysed.

    Examples
    --------
    >>> analyse_order(Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7]), (3, 1, 2))
    <OrderAnalysis: counter-clockwise, order kept>
    """

    axis: tuple[float, ...]
    hoop: Hoop
    kept: Direction | None
    by_inequalities: Direction | None
    by_crank_angles: Direction | None
    moving_axis: Floats
    crank_angles: Floats
    misfit: float
    desired: tuple[int, ...]

    @property
    def planar(self) -> bool:
        """Whether it is about positions in the plane, and a propeller about a pivot."""
        return len(self.axis) == 2

    @property
    def in_order(self) -> bool:
        """Whether the order is kept in the required direction."""
        return self.hoop.in_order

    @property
    def agree(self) -> bool:
        """Whether the three checks agree; they must where there is no misfit."""
        return self.kept == self.by_inequalities == self.by_crank_angles

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        turned = self.hoop
        needed = set(turned.required)
        rows = [(self._line(turned.start), f"{0:.4f}", "starts here")]
        for crossing in turned.crossings:
            decides = "yes" if crossing.pair in needed else ""
            rows.append((self._line(crossing.pair), f"{degrees(crossing.angle):.4f}", decides))
        about = f"({', '.join(f'{x:g}' for x in self.axis)}) turning {direction_words(turned.direction)}"
        angles = ", ".join(f"{degrees(angle):.3f}" for angle in self.crank_angles)
        what, axis = ("positions", "pivot") if self.planar else ("orientations", "axis")
        misses = f"{self.misfit:.6g} of its length" if self.planar else f"{degrees(self.misfit):.4f} degrees"
        count, listed = len(self.crank_angles), ", ".join(map(str, self.desired))
        as_numbered = self.desired == tuple(range(1, count + 1))
        return [
            f"{count} {what}{'' if as_numbered else f' in the order {listed}'}, crank about {about}",
            TableBlock(("crossed", "angle", "decides"), rows, ["angle"]),
            "needed: " + " => ".join(map(self._line, turned.required)),
            self._verdict(),
            self._checks(),
            f"crank angles: {angles}",
            *(
                [f"note: no dyad about this {axis} takes all {what}; the best misses by {misses}"]
                * (self.misfit > _FITS)
            ),
        ]

    def _line(self, pair: Pair) -> str:
        """Return the name of a relative axis, or in the plane of a pole."""
        return pair_name(pair).replace("S", "P") if self.planar else pair_name(pair)

    def _verdict(self) -> str:
        if self.hoop.breaks_at is None:
            return f"order kept, by a margin of {degrees(self.hoop.margin):.3f} degrees of the {self._turning}"
        due, here = map(self._line, self.hoop.breaks_at)
        other = f"; it is kept {direction_words(self.kept)}" if self.kept is not None else ""
        return f"order defect: {here} is crossed where {due} is due{other}"

    @property
    def _turning(self) -> str:
        return "propeller" if self.planar else "hoop"

    def _checks(self) -> str:
        verdicts = ((self._turning, self.kept), ("inequalities", self.by_inequalities), ("crank", self.by_crank_angles))
        checks = ", ".join(f"{name} {direction_words(kept)}" for name, kept in verdicts)
        return f"kept by: {checks}{'' if self.agree else '   (they do not agree)'}"

    def __repr__(self) -> str:
        order = "kept" if self.in_order else "not kept"
        return f"<OrderAnalysis: {direction_words(self.hoop.direction)}, order {order}>"

    def to_json(self) -> dict[str, Any]:
        """Return the analysis as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        turned, breaks = self.hoop, self.hoop.breaks_at
        misfit = {"misfit": self.misfit} if self.planar else {"misfit_deg": degrees(self.misfit)}
        return {
            "direction": turned.direction,
            "desired": list(self.desired),
            "crossings": [{"pair": list(c.pair), "angle_deg": degrees(c.angle)} for c in turned.crossings],
            "required": [list(pair) for pair in turned.required],
            "in_order": self.in_order,
            "breaks_at": None if breaks is None else {"due": list(breaks[0]), "crossed": list(breaks[1])},
            "margin_deg": degrees(turned.margin),
            "kept": self.kept,
            "checks": {"hoop": self.kept, "inequalities": self.by_inequalities, "crank_angles": self.by_crank_angles},
            "agree": self.agree,
            "dyad": {
                "W": self.moving_axis.tolist(),
                "crank_angles_deg": [degrees(angle) for angle in self.crank_angles],
                **misfit,
            },
        }


def analyse_order(
    orientations: Orientations, axis: npt.ArrayLike, direction: Direction = "ccw", desired: Sequence[int] | None = None
) -> OrderAnalysis:
    """Check the order of orientations about a fixed axis in three ways.

    Parameters
    ----------
    orientations, axis, direction, desired
        As for `hoop`, as are the errors; the direction is that of the crank.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> analysis = analyse_order(Orientations.from_rotation(body), (0, 0, 1))
    >>> analysis.in_order, analysis.agree, np.degrees(analysis.crank_angles).round(6).tolist()
    (True, True, [0.0, 90.0, 200.0])
    >>> analyse_order(Orientations.from_rotation(body), (0, 0, 1), desired=[1, 3, 2])  # the other way round
    <OrderAnalysis: counter-clockwise, order not kept>
    """
    g = unit_vector(axis, "fixed axis")
    order = checked_order(len(orientations), desired)
    turned = {way: hoop(orientations, g, way, order) for way in DIRECTIONS}
    taken = orientations.subset(order)
    moving = nearest_moving_axis(taken, g)
    angles = crank_angles(taken, g, moving)
    link_angles = np.arccos(np.clip(taken.matrices @ moving @ g, -1.0, 1.0))
    return OrderAnalysis(
        tuple(np.asarray(axis, dtype=float).tolist()),
        turned[direction],
        next((way for way in DIRECTIONS if turned[way].in_order), None),
        order_by_inequalities(taken, g),
        order_by_crank_angles(angles),
        moving,
        angles,
        float(np.abs(link_angles - link_angles.mean()).max()),
        order,
    )


def order_by_inequalities(orientations: Orientations, axis: npt.ArrayLike) -> Direction | None:
    """Return the direction in which the order is kept, by the inequalities that are necessary and sufficient.

    Eq. 2 as signs: of each two successive axes a, b of S_13, ..., S_1n, S_2n, the triple products fulfil [G, S_12,
    a] [G, a, b] [G, S_12, b] > 0; < 0 for a crank that turns clockwise. Each axis occurs twice: its sign does not
    matter.
    """
    verdict = int(order_verdicts(orientations, unit_vector(axis, "fixed axis")[None])[0])
    return {1: DIRECTIONS[0], -1: DIRECTIONS[1]}.get(verdict)


def order_verdicts(orientations: Orientations, axes: npt.ArrayLike) -> npt.NDArray[np.int8]:
    """Check many fixed axes, float[m, 3] of any length, at once by the inequalities; return int8[m].

    It is 1 where a counter-clockwise crank keeps the order, -1 where a clockwise one does, 0 where neither does or
    the axis lies on a relative axis that decides.
    """
    g = np.asarray(axes, dtype=float)
    if g.ndim != 2 or g.shape[1] != 3:
        raise InvariantError("axes", f"an array of shape {g.shape}", "m by 3")
    start = orientations.relative_axis(1, 2)
    lines = np.array([orientations.relative_axis(*pair) for pair in required_sequence(len(orientations))])
    normals = np.cross(start, lines).T, np.cross(lines[:-1], lines[1:]).T
    kept = np.empty(len(g), dtype=np.int8)
    for first in range(0, len(g), _BLOCK):
        kept[first : first + _BLOCK] = _verdicts(g[first : first + _BLOCK], first, *normals)
    return kept


def nearest_moving_axis(orientations: Orientations, axis: npt.ArrayLike) -> Floats:
    """Return the axis W of the body whose angle with a fixed axis changes least: float[3].

    With three orientations there is one that keeps its angle; with more, where the fixed axis is that of a dyad. W
    is in the frame of the body: at orientation i it points along M_i W.
    """
    seen = orientations.matrices.transpose(0, 2, 1) @ unit_vector(axis, "fixed axis")
    return best_plane(seen).direction


def crank_angles(orientations: Orientations, fixed: npt.ArrayLike, moving: npt.ArrayLike) -> Floats:
    """Return the angles of a dyad's crank from orientation 1: float[n], radians in [0, 2 pi), the first zero.

    Parameters
    ----------
    orientations : Orientations
    fixed, moving : float[3]
        G, in the fixed frame, and W, in the body; angles are counter-clockwise seen from the tip of G.

    Examples
    --------
    >>> turns = Orientations.from_axis_angles([(0, 0, 1)] * 3, [0, 1.0, 4.0])
    >>> crank_angles(turns, (0, 0, 1), (1, 0, 1)).round(6).tolist()
    [0.0, 1.0, 4.0]
    """
    g = unit_vector(fixed, "fixed axis")
    w = orientations.matrices @ unit_vector(moving, "moving axis")
    start = across(w[0], g)
    angles = np.mod(np.arctan2(w @ np.cross(g, start), w @ start), 2.0 * np.pi)
    angles[0] = 0.0  # rounding may have made it a whole turn
    return np.asarray(angles)


def order_by_crank_angles(angles: npt.ArrayLike) -> Direction | None:
    """Return the direction in which crank angles (radians) grow: 0 < b_12 < ... < b_1n < 2 pi (Eq. 1)."""
    turned = np.asarray(angles, dtype=float)
    for way, sign in zip(DIRECTIONS, (1.0, -1.0), strict=True):
        if np.all(np.diff(np.mod(sign * (turned - turned[0]), 2.0 * np.pi)) > 0.0):
            return way
    return None


def _verdicts(axes: Floats, first: int, from_start: Floats, between: Floats) -> npt.NDArray[np.int8]:
    """Return the verdicts of a block of axes; ``first`` is the number of its first one, for messages."""
    lengths = np.sqrt(np.einsum("ij,ij->i", axes, axes))
    bad = np.flatnonzero(~(np.isfinite(lengths) & (lengths > 0.0)))
    if len(bad):
        raise InvariantError("axes", f"axis {first + bad[0] + 1} has no direction", "finite numbers, not all zero")
    unit = axes / lengths[:, None]
    ahead, apart = unit @ from_start, unit @ between
    products = ahead[:, :-1] * apart * ahead[:, 1:]
    lowest, highest = products.min(axis=1), products.max(axis=1)
    kept = (lowest > 0.0).astype(np.int8) - (highest < 0.0).astype(np.int8)
    kept[np.minimum(np.abs(ahead).min(axis=1), np.abs(apart).min(axis=1)) < 4 * EPSILON] = 0
    return np.asarray(kept)
