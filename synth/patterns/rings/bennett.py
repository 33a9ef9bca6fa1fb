"""Bennett's linkage, and linkages made of it: Goldberg's and Myard's of five; Sarrus.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from math import atan2, degrees, isclose, pi, sin, tan

from graphs.errors import InvariantError
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.patterns.panels import sheet_of_faces
from synth.patterns.rings.axes import chain_frames, lines_of, ring

__all__ = ["bennett", "goldberg", "myard", "sarrus"]

_APART = 1e-3
"""Twists that differ by less make a linkage that is nearly another."""


def bennett(first: float, twist: float, other: float) -> HingedSolids:
    """Return Bennett's linkage: opposite solids alike, lengths in proportion to the sines of the twists.

    Parameters
    ----------
    first : float
        Angle of the first joint, radians; a quarter turn and less leaves it open.
    twist, other : float
        Angles between the axes of solids 0 and 2, and 1 and 3, radians; neither alike nor together half a turn.

    Raises
    ------
    InvariantError
        If the twists are alike, or together half a turn: it is then planar or folded.

    Notes
    -----
    Source: G. T. Bennett, "A new mechanism" (1903).

    Examples
    --------
    >>> bennett(1.0, 0.7, 1.2)
    <HingedSolids: <SCGraph: 4 links, 4 joints, 0 centres>>
    """
    return ring(lines_of(_frames(first, twist, other)))


def goldberg(first: float, twist: float, shared: float, other: float, offset: float = 0.0) -> HingedSolids:
    """Return Goldberg's linkage of five: two of Bennett's with a solid in common, which is left out.

    Beside the common solid two solids meet on an axis; they are made one.

    Parameters
    ----------
    first : float
        Angle of the first linkage's joint on the axis where solids are made one, radians.
    twist, shared, other : float
        Twists of the first linkage's own solids, of the common solid and of the second linkage's own, radians.
    offset : float, optional
        Angle between the two solids that are made one, radians; 0 lays them over each other.

    Raises
    ------
    InvariantError
        If a linkage has twists that are alike or together half a turn, or both linkages are the same.

    Notes
    -----
    Source: M. Goldberg, "New five-bar and six-bar linkages in three dimensions" (1943).

    Examples
    --------
    >>> goldberg(1.0, 0.7, 1.2, 0.5)
    <HingedSolids: <SCGraph: 5 links, 5 joints, 0 centres>>
    """
    if isclose(twist, other, abs_tol=_APART) and isclose(offset, 0.0, abs_tol=_APART):
        raise InvariantError(
            "goldberg", f"both linkages have the twist {twist:g} and lie on each other", "another"
        )
    # Both have the common solid as the last one of their chains, so in the same place; joint 3 is common too.
    _, a, d, q = lines_of(_frames(first, twist, shared))
    _, e, f, _ = lines_of(_frames(first + offset, other, shared))
    return ring([a, d, q, f, e])


def myard(first: float, twist: float) -> HingedSolids:
    """Return Myard's linkage of five: Goldberg's of two mirror images whose common twist is a right angle.

    Parameters
    ----------
    first : float
        Angle of a joint, radians.
    twist : float
        Of the solids that are no common ones, radians; the images have pi - twist. The solid between both has no
        length and the twist pi - 2 twist.

    Raises
    ------
    InvariantError
        If the twist is a right angle.

    Notes
    -----
    Source: F. E. Myard, "Contribution a la geometrie des systemes articules" (1931).

    Examples
    --------
    >>> linkage = myard(1.0, 0.7)
    >>> from math import dist
    >>> dist(linkage.axes[0][0], linkage.axes[4][0]) < 1e-12  # these axes meet
    True
    """
    return goldberg(first, twist, pi / 2, pi - twist)


def sarrus(side: float = 1.0, height: float = 1.6, out: float = 0.6) -> Sheet:
    """Return the linkage of Sarrus of six panels: two square plates, and two pairs of panels between them.

    Parameters
    ----------
    side : float, optional
        Of the plates, any unit of length.
    height : float, optional
        Between the plates.
    out : float, optional
        How far the knees between two panels stand out of the plates.

    Notes
    -----
    Source: P. F. Sarrus, "Note sur la transformation des mouvements rectilignes alternatifs" (1853).

    Examples
    --------
    >>> sarrus()
    <Sheet: 6 faces, 6 creases, 12 vertices, in space>
    """
    square = ((0.0, 0.0), (side, 0.0), (side, side), (0.0, side))
    corners = [(x, y, z) for z in (0.0, height) for x, y in square]
    half = height / 2
    knees = [(0.0, -out, half), (side, -out, half), (side + out, 0.0, half), (side + out, side, half)]
    faces = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 9, 8), (8, 9, 5, 4), (1, 2, 11, 10), (10, 11, 6, 5))
    return sheet_of_faces([*corners, *knees], faces, "Linkage of Sarrus")


def _frames(first: float, twist: float, other: float) -> Floats:
    """Return the frames of Bennett's linkage, the first at the origin and before it solid 3 along x."""
    if isclose(twist, other, abs_tol=_APART) or isclose(twist + other, pi, abs_tol=_APART):
        raise InvariantError(
            "bennett",
            f"twists of {degrees(twist):g} and {degrees(other):g} degrees",
            "neither alike nor together half a turn",
        )
    second = 2 * atan2(sin((other + twist) / 2), sin((other - twist) / 2) * tan(first / 2))
    angles = (first, second, 2 * pi - first, 2 * pi - second)
    twists = (twist, other, twist, other)
    return chain_frames([sin(one) for one in twists], twists, angles)
