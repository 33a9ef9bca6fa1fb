"""Pop-ups: four links about a point or about parallel axes, and strips cut out of a card.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from math import acos, cos, degrees, radians, sin, sqrt, tan

from graphs.errors import InvariantError
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.patterns.panels import Place, sheet_of_faces
from synth.patterns.rings.axes import Line

__all__ = ["angle_pop_up", "beaked_box", "box_pop_up", "parallel_pop_up", "slit_card"]


def parallel_pop_up(opening: float, left: float, right: float, first: float, second: float) -> HingedSolids:
    """Return a card with two panels across its fold, their creases parallel to it.

    Links are the left half, the panel on it, the panel on the right half, and that half.

    Parameters
    ----------
    opening : float
        Angle between the halves of the card, radians.
    left, right : float
        How far from the fold the panels stand on the halves, any unit of length.
    first, second : float
        Widths of the panels on the left and on the right half.

    Raises
    ------
    InvariantError
        If the panels do not meet at this opening.

    Notes
    -----
    If left + first = right + second the card closes on it. Source: A. S. Glassner, "Interactive pop-up card
    design" (2002).

    Examples
    --------
    >>> parallel_pop_up(1.5, 2, 2, 1.6, 1.6)
    <HingedSolids: <SCGraph: 4 links, 4 joints, 1 centre>>
    """
    on_left = (-left * sin(opening / 2), left * cos(opening / 2))
    on_right = (right * sin(opening / 2), right * cos(opening / 2))
    x, y = on_right[0] - on_left[0], on_right[1] - on_left[1]
    between = sqrt(x * x + y * y)
    if not abs(first - second) < between < first + second:
        told = f"panels of {first:g} and {second:g} do not meet over {between:g}, at {degrees(opening):g} degrees"
        expected = f"widths of more than {between:g} together that differ by less"
        raise InvariantError("parallel-pop-up", told, expected)
    along = (first**2 - second**2 + between**2) / (2 * between)
    up = sqrt(first**2 - along**2)
    ridge = (on_left[0] + (along * x - up * y) / between, on_left[1] + (along * y + up * x) / between)
    corners = ((0.0, 0.0), on_left, ridge, on_right)
    return _four_links([((x, y, 0.0), (0.0, 0.0, 1.0)) for x, y in corners], Centre.INFINITE)


def angle_pop_up(opening: float, base: float, rise: float) -> HingedSolids:
    """Return a card with two panels across its fold whose creases meet on it: a V-fold, alike on both sides.

    Parameters
    ----------
    opening : float
        Angle between the halves of the card, radians.
    base : float
        Angle between the fold and the creases on the card, radians.
    rise : float
        Angle of each panel between its crease on the card and the ridge, radians, above the base angle.

    Raises
    ------
    InvariantError
        If the panels do not meet at this opening.

    Examples
    --------
    >>> angle_pop_up(1.5, 0.7, 1.2)
    <HingedSolids: <SCGraph: 4 links, 4 joints, 1 centre>>
    """
    # The halves lean to both sides of the y axis about the fold, x; the ridge is in the plane between them.
    on_left = (cos(base), sin(base) * cos(opening / 2), sin(base) * sin(opening / 2))
    flat = sqrt(on_left[0] ** 2 + on_left[1] ** 2)
    if cos(rise) > flat:
        told = f"panels of {degrees(rise):g} degrees do not meet at an opening of {degrees(opening):g}"
        raise InvariantError("angle-pop-up", told, "panels that reach each other")
    turn = acos(on_left[0] / flat) + acos(cos(rise) / flat)
    directions = ((1.0, 0.0, 0.0), on_left, (cos(turn), sin(turn), 0.0), (on_left[0], on_left[1], -on_left[2]))
    return _four_links([((0.0, 0.0, 0.0), one) for one in directions], Centre.FINITE)


def slit_card(strips: int, depth: float = 1.0, more: float = 0.5, width: float = 1.0) -> Sheet:
    """Return a flat card with strips between slits across its fold, creased beside the fold: boxes that pop up.

    The card and each strip are four links about four parallel axes. Slits are cuts: edges marked C.

    Parameters
    ----------
    strips : int
        One is a box, more a row of steps.
    depth : float, optional
        From the fold to a strip's crease on the left half, any unit of length.
    more : float, optional
        By how much the crease on the right half is farther from the fold.
    width : float, optional
        Of strips and of what is between them.

    Examples
    --------
    >>> slit_card(1)
    <Sheet: 4 faces, 5 creases, 14 vertices, flat>
    """
    far, high, knee = 3.0 * (depth + more), depth + more, more
    places: list[Place] = [(-far, 0.0), (far, 0.0), (0.0, 0.0)]
    left_side, right_side = [2], [2]  # of the halves, up the fold and round the strips' ends
    faces: list[tuple[int, ...]] = []
    slits: list[tuple[int, int]] = []
    for strip in range(strips):
        ends = ((2 * strip + 1) * width, (2 * strip + 2) * width)
        v = len(places)
        places += [(x, y) for x in (0.0, -depth, knee, high) for y in ends]
        left_side += [v, v + 2, v + 3, v + 1]
        right_side += [v, v + 4, v + 6, v + 7, v + 5, v + 1]
        faces += [(v + 2, v, v + 4, v + 5, v + 1, v + 3), (v + 4, v + 6, v + 7, v + 5)]
        slits += [pair for w in (v, v + 1) for pair in pairwise((w + 2, w, w + 4, w + 6))]
    height, end = (2 * strips + 1) * width, len(places)
    places += [(0.0, height), (-far, height), (far, height)]
    left, right = (0, *left_side, end, end + 1), (1, end + 2, end, *reversed(right_side))
    title = f"Card with {strips} strip{'s' * (strips > 1)}"
    return sheet_of_faces(places, [left, right, *faces], title, _cuts(slits))


def box_pop_up(depth: float = 1.0, more: float = 0.5, width: float = 1.0) -> Sheet:
    """Return a flat card with one box: `slit_card` with one strip.

    Examples
    --------
    >>> box_pop_up()
    <Sheet: 4 faces, 5 creases, 14 vertices, flat>
    """
    return slit_card(1, depth, more, width)


def beaked_box(
    depth: float = 1.0, more: float = 0.5, width: float = 1.0, angle: float = radians(40.0), reach: float = 0.6
) -> Sheet:
    """Return a flat card with one box whose ridge ends in a beak: a planar and a spherical loop, six links.

    Two creases go from a point of the ridge to the slit, on both sides of it. The card and the box are four links
    about parallel axes; the box and the two panels of the beak are four about that point. The loops share the
    ridge.

    Parameters
    ----------
    depth, more, width : float, optional
        As of `slit_card`.
    angle : float, optional
        Between the ridge and the creases of the beak, radians.
    reach : float, optional
        From the slit to the point where they meet, along the ridge.

    Raises
    ------
    InvariantError
        If the beak is longer than the ridge, or wider than a panel of the box.

    Examples
    --------
    >>> beaked_box()
    <Sheet: 6 faces, 8 creases, 17 vertices, flat>
    """
    side = reach * tan(angle)
    if not (reach < width and side < depth):
        told = f"a beak of {reach:g} by {2 * side:g} on a ridge of {width:g} between panels of {depth:g}"
        raise InvariantError("beaked-box", told, "reach below width, reach tan(angle) below depth")
    card = slit_card(1, depth, more, width)
    assert card.coordinates is not None
    v, (left, right, _, _) = 3, card.faces
    tip, near, far = card.vertices, card.vertices + 1, card.vertices + 2
    if abs(side - more) < DOUBLE.same_point * (depth + more):
        near, far = v, near  # the crease ends where the fold does
    places = [*card.coordinates, (more, width + reach)]
    places += [(more - side, width)] * (near != v) + [(more + side, width)]
    slit = sorted({v, v + 2, v + 4, v + 6, near, far}, key=lambda place: places[place][0])

    def along(first: int, last: int) -> list[int]:
        return slit[slit.index(first) : slit.index(last) + 1]

    faces = [
        _with_points(left, (v, v + 2), along(v + 2, v)[::-1]),
        _with_points(right, (v, v + 4, v + 6), along(v, v + 6)),
        (*along(v + 2, near), tip, v + 5, v + 1, v + 3),
        (tip, *along(far, v + 6), v + 7, v + 5),
        (*along(near, v + 4), tip),
        (*along(v + 4, far), tip),
    ]
    slits = [*pairwise(slit), *pairwise((v + 3, v + 1, v + 5, v + 7))]
    return sheet_of_faces(places, faces, "Card with a box that ends in a beak", _cuts(slits))


def _with_points(face: tuple[int, ...], part: tuple[int, ...], along: list[int]) -> tuple[int, ...]:
    """Return a face in which a walk along several of its vertices, either way round, goes through more of them."""
    turned = tuple(part) if part[1] == face[(face.index(part[0]) + 1) % len(face)] else tuple(part[::-1])
    start = face.index(turned[0])
    rolled = face[start:] + face[:start]
    assert rolled[: len(part)] == turned
    return (*(along if turned == tuple(part) else along[::-1]), *rolled[len(part) :])


def _cuts(slits: Iterable[tuple[int, int]]) -> dict[frozenset[int], str]:
    return dict.fromkeys(map(frozenset, slits), "C")


def _four_links(lines: list[Line], centre: Centre) -> HingedSolids:
    """Return four links about four axes; joint 0 is the fold of the card, between links 3 and 0."""
    chain = SCGraph(4, [((i - 1) % 4, i) for i in range(4)], [Loop(tuple(range(4)), centre)])
    axes: dict[JointId, Axis] = {i: ((p[0], p[1], p[2]), (d[0], d[1], d[2])) for i, (p, d) in enumerate(lines)}
    return HingedSolids(chain, axes)
