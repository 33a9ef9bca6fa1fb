"""Single vertices and folded bases, flat: waterbomb and preliminary base, bird base.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin, sqrt

from graphs.mechanism.sheet import Sheet
from synth.patterns.panels import Place, sheet_of_faces

__all__ = ["bird_base", "fan", "preliminary_base", "waterbomb_base"]


def fan(directions: Sequence[float], letters: str = "", title: str = "") -> Sheet:
    """Return a flat vertex with creases of length 1 in given directions, radians, rising.

    There is one letter per crease; without letters all are unassigned.
    """
    n = len(directions)
    places = ((0.0, 0.0), *((cos(t), sin(t)) for t in directions))
    faces = tuple((0, i + 1, (i + 1) % n + 1) for i in range(n))
    return Sheet(n + 1, tuple((0, i + 1) for i in range(n)), letters or "U" * n, faces, places, title)


def waterbomb_base() -> Sheet:
    """Return the waterbomb base: two diagonals and one line between middles of sides.

    Examples
    --------
    >>> waterbomb_base().assignments
    'MVVMVV'
    """
    return fan([k * pi / 4 for k in (0, 1, 3, 4, 5, 7)], "MVVMVV", "Waterbomb base")


def preliminary_base() -> Sheet:
    """Return the preliminary base with all its creases: two diagonals, two lines between middles of sides.

    Examples
    --------
    >>> preliminary_base()
    <Sheet: 8 faces, 8 creases, 9 vertices, flat>
    """
    return fan([k * pi / 4 for k in range(8)], "VUVMVUVM", "Preliminary base")


def bird_base() -> Sheet:
    """Return the crease pattern of the bird base of a square of side 2: 16 triangles, flat.

    The sides are folded to the diagonals, so creases from a corner halve the half of its right angle. They come
    to the lines between the middles of the sides at 1 - tan(pi / 8) = 2 - sqrt(2) from the centre: the tips.

    Examples
    --------
    >>> bird_base().coordinates[9][0] == 2 - sqrt(2)
    True
    """
    tip_at = 2 - sqrt(2)
    corners: list[Place] = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    middles: list[Place] = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    tips = [(tip_at * x, tip_at * y) for x, y in middles]
    faces, letters = [], {}
    for k in range(4):
        middle, tip = 5 + k, 9 + k
        for corner in (1 + (k - 1) % 4, 1 + k):
            faces += [(0, tip, corner), (tip, middle, corner)]
            letters[frozenset((tip, corner))] = "V"
            # Mountains along one diagonal; the other is folded over and back, and left open here.
            letters[frozenset((0, corner))] = "MU"[corner % 2]
        letters[frozenset((0, tip))] = "V"
        letters[frozenset((tip, middle))] = "M"
    return sheet_of_faces([(0, 0), *corners, *middles, *tips], faces, "Bird base", letters)
