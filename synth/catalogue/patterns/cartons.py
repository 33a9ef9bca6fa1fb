"""What is made of card, by its parameters: pop-ups and cartons. Theory: docs/theory/generators.md.

Pop-ups are four links about a point or about parallel axes, or strips cut out of a card. Angles are radians,
lengths any unit. Source of pop-ups: A. S. Glassner, "Interactive pop-up card design" (2002).
"""

from collections.abc import Iterable
from itertools import pairwise
from math import acos, cos, degrees, pi, radians, sin, sqrt, tan

from graphs.errors import InvariantError, numbered
from graphs.loops.loop import Centre
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from synth.catalogue.patterns.hinged_rings import ring_of_axes
from synth.catalogue.patterns.panels import Place, sheet_of_faces


def parallel_pop_up(opening: float, left: float, right: float, first: float, second: float) -> HingedSolids:
    """Return a card with two panels across its fold, their creases parallel to it; links from the left half on."""
    on_left = (-left * sin(opening / 2), left * cos(opening / 2))
    on_right = (right * sin(opening / 2), right * cos(opening / 2))
    x, y = on_right[0] - on_left[0], on_right[1] - on_left[1]
    between = sqrt(x * x + y * y)
    if not abs(first - second) < between < first + second:
        gap = f"a gap of {between:g} at an opening of {degrees(opening):g} degrees"
        what = f"panels of widths {first:g} and {second:g} do not meet across {gap}"
        raise InvariantError("parallel-pop-up", what, f"a sum above {between:g} and a difference below it")
    along = (first**2 - second**2 + between**2) / (2 * between)
    up = sqrt(first**2 - along**2)
    ridge = (on_left[0] + (along * x - up * y) / between, on_left[1] + (along * y + up * x) / between)
    corners = ((0.0, 0.0), on_left, ridge, on_right)
    return ring_of_axes([((x, y, 0.0), (0.0, 0.0, 1.0)) for x, y in corners], Centre.INFINITE)


def angle_pop_up(opening: float, base: float, rise: float) -> HingedSolids:
    """Return a card with two panels across its fold whose creases meet on it: a V-fold, alike on both sides."""
    # The halves lean to both sides of the y axis about the fold, x; the ridge is in the plane between them.
    on_left = (cos(base), sin(base) * cos(opening / 2), sin(base) * sin(opening / 2))
    flat = sqrt(on_left[0] ** 2 + on_left[1] ** 2)
    if cos(rise) > flat:
        what = f"panels of {degrees(rise):g} degrees do not meet at an opening of {degrees(opening):g} degrees"
        raise InvariantError("angle-pop-up", what, "a smaller angle, or a smaller opening")
    turn = acos(on_left[0] / flat) + acos(cos(rise) / flat)
    directions = ((1.0, 0.0, 0.0), on_left, (cos(turn), sin(turn), 0.0), (on_left[0], on_left[1], -on_left[2]))
    return ring_of_axes([((0.0, 0.0, 0.0), direction) for direction in directions], Centre.FINITE)


def slit_card(strips: int, depth: float = 1.0, more: float = 0.5, width: float = 1.0) -> Sheet:
    """Return a flat card with strips between cuts (C) across its fold, creased beside it: boxes that pop up."""
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
    title = f"Card with {numbered(strips, 'strip')}"
    return sheet_of_faces(places, [left, right, *faces], title, _cuts(slits))


def box_pop_up(depth: float = 1.0, more: float = 0.5, width: float = 1.0) -> Sheet:
    """Return a flat card with one box: `slit_card` with one strip."""
    return slit_card(1, depth, more, width)


def beaked_box(
    depth: float = 1.0, more: float = 0.5, width: float = 1.0, angle: float = radians(40.0), reach: float = 0.6
) -> Sheet:
    """Return a flat card with one box whose ridge ends in a beak: a planar and a spherical loop, six links.

    Two creases go from a point of the ridge to the slit, on both sides of it: the box and the two panels of the
    beak are four links about that point. Raise InvariantError if the beak is longer than the ridge, or wider than
    a panel of the box.
    """
    side = reach * tan(angle)
    if not (reach < width and side < depth):
        what = f"a beak of {reach:g} by {2 * side:g} on a ridge of {width:g} between panels of {depth:g}"
        raise InvariantError("beaked-box", what, "reach below width, reach tan(angle) below depth")
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


def webbed_tray(length: float = 3.0, width: float = 2.0, height: float = 0.8) -> Sheet:
    """Return the flat blank of a tray: a bottom, four walls, at each corner a square web creased to it."""
    x, y = (-height, 0.0, length, length + height), (-height, 0.0, width, width + height)
    places = [(x[j], y[i]) for i in range(4) for j in range(4)]
    faces: list[tuple[int, ...]] = []
    letters = {}
    for i in range(3):
        for j in range(3):
            a, b, c, d = 4 * i + j, 4 * i + j + 1, 4 * i + j + 5, 4 * i + j + 4
            if i == 1 or j == 1:
                faces.append((a, b, c, d))
            elif i == j:
                faces += [(a, b, c), (a, c, d)]
                letters[frozenset((a, c))] = "M"
            else:
                faces += [(a, b, d), (b, c, d)]
                letters[frozenset((b, d))] = "M"
    for a, b in ((5, 6), (6, 10), (10, 9), (9, 5)):
        letters[frozenset((a, b))] = "V"
    return sheet_of_faces(places, faces, "Tray with webbed corners", letters)


def crash_lock(opening: float, length: float = 2.0, width: float = 1.4, height: float = 2.0) -> Sheet:
    """Return a tube of four walls with a crash-lock bottom, opened so far.

    At two opposite corners a panel of the bottom has a crease at 45 degrees, beyond which it is glued to the panel
    beside it; so the bottom unfolds when the tube is opened, and locks where the crease is flat: InvariantError if
    `opening` is not between 0 and a right angle. Source: J. S. Dai and F. Cannella, "Stiffness characteristics of
    carton folds for packaging" (2008).
    """
    if not 0.0 < opening < pi / 2:
        raise InvariantError(
            "crash-lock", f"opening = {degrees(opening):g} degrees", "more than 0, less than 90 degrees"
        )
    away = (width * cos(opening), width * sin(opening))
    ground: list[Place] = [(0.0, 0.0), (length, 0.0), (length + away[0], away[1]), away]
    # The crease makes 45 degrees with both bottom edges of its corner: it rises into the tube.
    near = sqrt(0.5) / cos(opening / 2)
    crease = 0.45 * min(length, width)
    inward = (crease * near * cos(opening / 2), crease * near * sin(opening / 2), crease * sqrt(1 - near * near))
    ends = [inward, (ground[2][0] - inward[0], ground[2][1] - inward[1], inward[2])]
    places = [(x, y, z) for z in (0.0, height) for x, y in ground] + ends
    walls = [(k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    bottom = [(0, 1, 8), (3, 0, 8), (2, 3, 9), (1, 2, 9)]
    return sheet_of_faces(places, [*walls, *bottom], "Carton with a crash-lock bottom")
