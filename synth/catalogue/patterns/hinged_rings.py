"""Closed rings of solids hinged at edges, by their parameters: overconstrained ones, and spherical ones.

Sources: R. Bricard, "Lecons de cinematique" (1927); P. Schatz (1929); D. Schattschneider and W. Walker, "M. C.
Escher Kaleidocycles" (1977). Theory: docs/theory/generators.md.
"""

from collections.abc import Sequence
from math import acos, atan2, cos, degrees, hypot, isclose, pi, sin, tan

import numpy as np

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.geometry import unit
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats
from synth.catalogue.patterns.panels import DIGITS, rounded_vector, sheet_of_faces

Line = tuple[Sequence[float], Sequence[float]]
"""A point of an axis and its direction."""


def ring(lines: Sequence[Line], digits: int = DIGITS) -> HingedSolids:
    """Return a ring of solids by its axes, points and directions, rounded."""
    return ring_of_axes([(rounded_vector(point, digits), rounded_vector(along, digits)) for point, along in lines])


def ring_of_axes(axes: Sequence[Axis], centre: Centre | None = None) -> HingedSolids:
    """Return a ring of solids by its axes, and its centre if it has one: joint i connects solids i - 1 and i."""
    n = len(axes)
    loops = [] if centre is None else [Loop(tuple(range(n)), centre)]
    return HingedSolids(SCGraph(n, [((i - 1) % n, i) for i in range(n)], loops), dict(enumerate(axes)))


def chain_frames(lengths: Sequence[float], twists: Sequence[float], angles: Sequence[float]) -> Floats:
    """Return frames, float[n + 1, 4, 4], of a chain of joints and its end: each about z, then along and about x.

    Each solid has the length of the common normal of its axes, their twist, and the angle of the joint before it,
    radians. If the ring closes the last frame is the identity. Source: J. Denavit and R. S. Hartenberg (1955).
    """
    frames = [np.eye(4)]
    for length, twist, angle in zip(lengths, twists, angles, strict=True):
        step = np.eye(4)
        step[0, 3] = length
        frames.append(frames[-1] @ turned(angle, 2) @ step @ turned(twist, 0))
    return np.array(frames)


def lines_of(frames: Floats) -> list[Line]:
    """Return the axis of the joint of each frame but the last."""
    return [(tuple(frame[:3, 3]), tuple(frame[:3, 2])) for frame in frames[:-1]]


def ring_of_sides(across: Floats, lengths: Floats) -> HingedSolids:
    """Return a ring without offsets: axes along unit vectors, float[n, 3], each perpendicular to the next.

    Solid i is along the product of direction i and the next, of a signed length: float[n].
    """
    sides = lengths[:, None] * np.cross(across, np.roll(across, -1, axis=0))
    feet = np.concatenate([np.zeros((1, 3)), np.cumsum(sides, axis=0)[:-1]])
    assert abs(sides.sum(axis=0)).max() < 1e-12, "the ring does not close"
    return ring([(tuple(foot), tuple(along)) for foot, along in zip(feet, across, strict=True)])


def turned(angle: float, axis: int) -> Floats:
    """Return a rotation about a coordinate axis, float[4, 4]."""
    rotation = np.eye(4)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    rotation[a, a] = rotation[b, b] = cos(angle)
    rotation[a, b], rotation[b, a] = -sin(angle), sin(angle)
    return rotation


_APART = 1e-3
"""Twists that differ by less, radians, make a linkage that is nearly planar or folded."""


def bennett(first: float, twist: float, other: float) -> HingedSolids:
    """Return Bennett's linkage: opposite solids alike, lengths in proportion to the sines of the twists."""
    # G. T. Bennett, "A new mechanism" (1903).
    return ring(lines_of(_bennett_frames(first, twist, other)))


def goldberg(first: float, twist: float, shared: float, other: float, offset: float = 0.0) -> HingedSolids:
    """Return Goldberg's linkage of five: two of Bennett's with a solid in common, which is left out.

    Beside the common solid two solids meet on an axis; they are made one, with the angle `offset` between them: 0
    lays them over each other.
    """
    # M. Goldberg, "New five-bar and six-bar linkages in three dimensions" (1943).
    if isclose(twist, other, abs_tol=_APART) and isclose(offset, 0.0, abs_tol=_APART):
        what = f"both linkages have the twist {degrees(twist):g} degrees and coincide"
        raise InvariantError("goldberg", what, "different twists, or an offset")
    # Both have the common solid as the last one of their chains, so in the same place; joint 3 is common too.
    _, a, d, q = lines_of(_bennett_frames(first, twist, shared))
    _, e, f, _ = lines_of(_bennett_frames(first + offset, other, shared))
    return ring([a, d, q, f, e])


def myard(first: float, twist: float) -> HingedSolids:
    """Return Myard's linkage of five: Goldberg's of two mirror images whose common twist is a right angle."""
    # F. E. Myard, "Contribution a la geometrie des systemes articules" (1931).
    return goldberg(first, twist, pi / 2, pi - twist)


def sarrus(side: float = 1.0, height: float = 1.6, out: float = 0.6) -> Sheet:
    """Return the linkage of Sarrus of six panels: two square plates, and two pairs of panels between them."""
    # P. F. Sarrus, "Note sur la transformation des mouvements rectilignes alternatifs" (1853).
    square = ((0.0, 0.0), (side, 0.0), (side, side), (0.0, side))
    corners = [(x, y, z) for z in (0.0, height) for x, y in square]
    half = height / 2
    knees = [(0.0, -out, half), (side, -out, half), (side + out, 0.0, half), (side + out, side, half)]
    faces = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 9, 8), (8, 9, 5, 4), (1, 2, 11, 10), (10, 11, 6, 5))
    return sheet_of_faces([*corners, *knees], faces, "Linkage of Sarrus")


def _bennett_frames(first: float, twist: float, other: float) -> Floats:
    """Return the frames of Bennett's linkage, the first at the origin and before it solid 3 along x."""
    if isclose(twist, other, abs_tol=_APART) or isclose(twist + other, pi, abs_tol=_APART):
        raise InvariantError(
            "bennett",
            f"twists of {degrees(twist):g} and {degrees(other):g} degrees",
            "neither equal nor together 180 degrees",
        )
    second = 2 * atan2(sin((other + twist) / 2), sin((other - twist) / 2) * tan(first / 2))
    angles = (first, second, 2 * pi - first, 2 * pi - second)
    twists = (twist, other, twist, other)
    return chain_frames([sin(one) for one in twists], twists, angles)


_HALF: tuple[Line, ...] = (
    ((1, 0, 0.2), (0.3, 1, 2)),
    ((0.6, 1.1, -0.1), (1, -0.4, 0.7)),
    ((-0.7, 0.9, 0.5), (1, 1, -1)),
)
_CORNERS = ((4.0, 1.0, 0.0), (-1.0, 3.0, 1.0), (0.0, -1.0, 3.0))


def line_symmetric(lean: float = 0.0, half: Sequence[Line] | None = None) -> HingedSolids:
    """Return Bricard's line-symmetric linkage: a half turn about the z axis takes axes 0, 1, 2 to 3, 4, 5."""
    lines = [_leaning(line, lean) for line in half or _HALF]
    return ring([*lines, *(((-x, -y, z), (-u, -v, w)) for (x, y, z), (u, v, w) in lines)])


def plane_symmetric(height: float = 0.0) -> HingedSolids:
    """Return Bricard's plane-symmetric linkage: axes 0 and 3 in the plane y = 0, 5 and 4 the images of 1 and 2."""
    first, last = ((1.2, 0, 0), (0.4, 0, 1)), ((-1, 0, 0.3), (-0.5, 0, 1))
    half: list[Line] = [((0.7, 0.9, 0.1 + height), (1, 0.3, 0.8)), ((-0.5, 1.1, -0.2), (0.2, 1, 1.1))]
    images = [((x, -y, z), (u, -v, w)) for (x, y, z), (u, v, w) in half]
    return ring([first, *half, last, images[1], images[0]])


def trihedral(first: float = 1.0, second: float = 0.8, third: float = 1.3) -> HingedSolids:
    """Return Bricard's trihedral linkage: right twists, no offsets, the squares of alternate lengths alike in sum.

    Axes 0, 2, 4 have the directions of the corners of a spherical triangle, 1, 3, 5 those of its polar triangle.
    The lengths of three sides determine the others, and then the sums are equal.
    """
    across = around(*(np.array(one) / hypot(*one) for one in _CORNERS))
    sides = np.cross(across, np.roll(across, -1, axis=0))
    chosen = np.array([first, second, third])
    return ring_of_sides(across, np.concatenate([chosen, -np.linalg.solve(sides[3:].T, sides[:3].T @ chosen)]))


def around(*corners: Floats) -> Floats:
    """Return directions round a spherical polygon: a corner, the pole of its side, the next corner, ..."""
    directions = []
    for here, there in zip(corners, (*corners[1:], corners[0]), strict=True):
        directions += [here, unit(np.cross(here, there))]
    return np.array(directions)


def _leaning(line: Line, angle: float) -> Line:
    if not angle:
        return line
    c, s = cos(angle), sin(angle)
    (x, y, z), (u, v, w) = line
    return (x, c * y - s * z, s * y + c * z), (u, c * v - s * w, s * v + c * w)


_Range = tuple[float, float]


def spherical_ring(arcs: Sequence[float]) -> HingedSolids:
    """Return a spherical loop of links with some arcs, at a convex configuration about the middle of its range.

    The diagonals from the first joint are chosen one after the other, each in the middle of what the links before
    and after it leave; so it is no dead point unless the links allow only one configuration. Raise InvariantError
    if the arcs do not close.
    """
    diagonals = _diagonals(arcs)
    azimuth, spots = 0.0, [(0.0, 0.0), (arcs[0], 0.0)]
    for before, arc, after in zip(diagonals, arcs[1:], diagonals[1:], strict=False):
        value = (cos(arc) - cos(before) * cos(after)) / (sin(before) * sin(after))
        azimuth += acos(float(np.clip(value, -1.0, 1.0)))
        spots.append((after, azimuth))
    directions = [(sin(far) * cos(t), sin(far) * sin(t), cos(far)) for far, t in spots]
    return ring_of_axes([((0.0, 0.0, 0.0), direction) for direction in directions], Centre.FINITE)


def _diagonals(arcs: Sequence[float]) -> list[float]:
    """Return the arcs from joint 0 to joints 1 ... n - 1."""
    reach: list[_Range] = [(arcs[0], arcs[0])]
    for arc in arcs[1:-1]:
        reach.append(_third(reach[-1], arc))
    diagonals = [arcs[-1]]
    if not reach[-1][0] - 1e-12 <= arcs[-1] <= reach[-1][1] + 1e-12:
        raise _do_not_close(arcs)
    for arc, (least, most) in zip(reversed(arcs[1:-1]), reversed(reach[:-1]), strict=True):
        low, high = _third((diagonals[-1], diagonals[-1]), arc)
        diagonals.append((max(low, least) + min(high, most)) / 2)
    return diagonals[::-1]


def _do_not_close(arcs: Sequence[float]) -> InvariantError:
    """Return why: the longest is too long, or an odd number k of the longest, by more than k - 1 half turns.

    With the opposite point for a joint two arcs become their supplements, and each condition that of the longest.
    """
    lengths = ", ".join(f"{degrees(arc):g}" for arc in arcs)
    if 2.0 * max(arcs) > sum(arcs):
        why, expected = "the longest is longer than the others together", "no arc longer than the others together"
    else:
        longest = sorted(arcs, reverse=True)
        odd = [k for k in range(3, len(arcs) + 1, 2) if 2.0 * sum(longest[:k]) - sum(arcs) > (k - 1) * pi]
        numbers = {3: ("three", 360), 5: ("five", 720)}
        least = min(odd, default=3)
        many, turns = numbers.get(least, (str(least), (least - 1) * 180))
        why = "they are too long for the sphere"
        expected = f"no {many} longer than the others together by more than {turns} degrees"
    return InvariantError("arcs", f"links of {lengths} degrees do not close: {why}", expected)


def _third(side: _Range, arc: float) -> _Range:
    """Return how long the third side of a spherical triangle may be, of which one side has a range."""
    low, high = side
    least = max(low - arc, arc - high, 0.0)
    most = min(high + arc, 2 * pi - low - arc)
    if low <= pi - arc <= high:
        most = pi
    return least, most


_STARTS, _TRIES = 3, 100
"""Rings that are compared, and starts at most: from most starts, often from all, the same ring is found."""
_STEPS = 8
_NUDGE = 1e-6


def closed_chain(solids: int) -> Floats:
    """Return the frames, as in `chain_frames`, of a closed ring of 7 or more solids, right twists and lengths 1.

    The closed rings are a curve (seven solids) or more; the one returned has the largest sum of cosines of its
    angles, and of the ways to number it is the first in order. Raise UnsolvableError if none was found.
    """
    rings: list[Floats] = []
    for start in range(_TRIES):
        angles = _flattest(np.random.default_rng((solids, start)).uniform(-pi, pi, solids))
        if np.abs(_off_closing(angles)).max() < DOUBLE.closed:
            rings += _numbered(angles)
        if len(rings) >= _STARTS * 4 * solids:
            break
    if not rings:
        raise UnsolvableError(f"no closed ring of {solids} solids was found from {_TRIES} random starts")
    keys = [np.concatenate([[-np.cos(one).sum()], -np.cos(one), -np.sin(one)]) for one in rings]
    return _equal_frames(rings[canonical_order(keys)[0]])


def _flattest(start: Floats) -> Floats:
    """Return angles near to some with which the ring closes and is as flat as it can be, to the last digits."""
    from scipy.optimize import least_squares, minimize  # takes half a second to load

    closed: Floats = least_squares(_off_closing, start).x
    closing = {"type": "eq", "fun": _off, "jac": _screws}
    near: Floats = minimize(
        lambda angles: -np.cos(angles).sum(),
        closed,
        jac=np.sin,
        constraints=closing,
        method="SLSQP",
        options={"maxiter": 500},
    ).x
    forces = np.linalg.lstsq(_screws(near).T, -np.sin(near), rcond=None)[0]
    state = np.concatenate([near, forces])
    for _ in range(_STEPS):  # Newton's, on the conditions of Lagrange
        nudges = _NUDGE * np.eye(len(state))
        slopes = [(_off_flattest(state + d) - _off_flattest(state - d)) / (2 * _NUDGE) for d in nudges]
        state = state - np.linalg.lstsq(np.array(slopes).T, _off_flattest(state), rcond=1e-9)[0]
    return state[: len(start)]


def _numbered(angles: Floats) -> list[Floats]:
    """Return the angles of a ring as it may be numbered: from each solid, either way round, from either side."""
    both_ways = [angles, angles[::-1]]
    return [sign * np.roll(way, shift) for way in both_ways for shift in range(len(angles)) for sign in (1.0, -1.0)]


def _off_flattest(state: Floats) -> Floats:
    """Return by how much the conditions of Lagrange are missed, for angles and a multiplier per equation."""
    angles, forces = state[:-6], state[-6:]
    return np.concatenate([_off(angles), np.sin(angles) + _screws(angles).T @ forces])


def _screws(angles: Floats) -> Floats:
    """Return the motion of the end of the chain per angle, float[6, n]: of its origin, then its rotation."""
    frames = _equal_frames(angles)
    ends, along = frames[-1][:3, 3], frames[:-1, :3, 2]
    return np.hstack([np.cross(along, ends - frames[:-1, :3, 3]), along]).T


def _off(angles: Floats) -> Floats:
    """Return where the end of the chain is, and its small rotation: float[6], 0 where it closes."""
    end = _equal_frames(angles)[-1]
    turn = end[:3, :3] - end[:3, :3].T
    return np.array([*end[:3, 3], turn[2, 1] / 2, turn[0, 2] / 2, turn[1, 0] / 2])


def _equal_frames(angles: Floats) -> Floats:
    solids = len(angles)
    return chain_frames([1.0] * solids, [pi / 2] * solids, angles.tolist())


def _off_closing(angles: Floats) -> Floats:
    """Return by how much the end of a chain of solids with right twists and lengths 1 misses its beginning."""
    # The whole rotation counts: its antisymmetric part alone is 0 at a half turn too.
    off: Floats = (_equal_frames(angles)[-1] - np.eye(4))[:3].ravel()
    return off


_CLOSED_DIGITS = 9
"""Decimals of a ring that is closed numerically: it moves with any proportions, and these are the same on every
machine."""


def kaleidocycle(solids: int, tilt: float = 0.9) -> HingedSolids:
    """Return a ring of six or more solids with right twists and lengths 1.

    An even number is symmetric; an odd number is closed numerically, as flat as it can be (`closed_chain`). Raise
    InvariantError for less than six solids, UnsolvableError if an odd number was not closed.
    """
    if solids < 6:
        raise InvariantError("kaleidocycle", numbered(solids, "solid"), "6 or more: fewer are rigid")
    if solids % 2:
        return ring(lines_of(closed_chain(solids)), _CLOSED_DIGITS)
    half = solids // 2
    azimuths = np.arange(half) * 2 * pi / half
    corners = [np.array((sin(tilt) * cos(t), sin(tilt) * sin(t), cos(tilt))) for t in azimuths]
    return ring_of_sides(around(*corners), np.tile([1.0, -1.0], half))
