"""Right circular cylinders: every radius at which a planar loop lies on one.

Joint axes are ruling lines; across them, the joints of a planar loop lie on a circle. Source: Hyatt et al. 2021,
sections 3.1 and 4. Theory: docs/theory/mapping.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import fsum, inf
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, numbered
from graphs.mechanism.surfaces import Cylinder
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.fourbar.closing import FourBarKind, checked_link_lengths, kind_of_planar
from synth.fourbar.rounding import ILL_CONDITIONED, rounding_of
from synth.surfaces.circuit import azimuths
from synth.surfaces.loop_sums import sign_patterns
from synth.surfaces.mapping import FamilyOfCircles, MappedLoop, cautions_of, circles_table, kind_line, mapped_loop

__all__ = ["CylinderMap", "central_angles", "chords", "cylinder_reach", "joint_coordinates", "map_to_cylinders"]


@dataclass(frozen=True, slots=True)
class CylinderMap(Printed):
    """All cylinders on which a planar loop lies.

    Attributes
    ----------
    lengths : tuple of float
    cylinders : tuple of MappedLoop
        Their size is the radius.
    families : tuple of FamilyOfCircles
        Intervals of radii, up to infinity.
    kind : FourBarKind or None
        Of four-bars.
    why : str
        Why there is no cylinder; empty where there is one.
    stretched : tuple of tuples of int
        Signs with which the lengths sum to zero within their rounding, and not quite: the loop may be on one more
        circle, too large to be told.

    Examples
    --------
    >>> found = map_to_cylinders([4, 3, 5, 1])
    >>> len(found.cylinders), found.kind.name
    (2, 'rocker-crank')
    """

    lengths: tuple[float, ...]
    cylinders: tuple[MappedLoop, ...]
    families: tuple[FamilyOfCircles, ...]
    kind: FourBarKind | None
    why: str
    stretched: tuple[tuple[int, ...], ...]

    def cautions(self) -> tuple[str, ...]:
        """Return what of the map rounding decides: of its type, its circles, its families, and beyond them."""
        large = f"{ILL_CONDITIONED}: stretched out within rounding: one more cylinder may be very large"
        return cautions_of(self.kind, self.cylinders, self.families, large if self.stretched else "")

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        blocks: list[Block] = [] if self.kind is None else [kind_line(self.kind, angular=False)]
        blocks += circles_table(self.cylinders, self.families, flat=(), angular=False)
        blocks += [f"caution: {caution}" for caution in self.cautions()]
        for number, cylinder in enumerate(self.cylinders, start=1):
            rows = [
                (str(joint), f"{x + 0.0:.8g}", f"{y + 0.0:.8g}")
                for joint, (x, y) in enumerate(
                    joint_coordinates(cylinder.size, azimuths(cylinder.steps)).tolist(), start=1
                )
            ]
            blocks += [f"joints on cylinder {number}", TableBlock(("joint", "x", "y"), rows, ["x", "y"])]
        return [*blocks, f"no cylinder: {self.why}"] if self.why else blocks

    def __repr__(self) -> str:
        return f"<CylinderMap: {len(self.lengths)} links, {numbered(len(self.cylinders), 'cylinder')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the map as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "lengths": list(self.lengths),
            **({} if self.kind is None else self.kind.to_json(angular=False)),
            "cylinders": [
                {
                    "radius": cylinder.size,
                    "radius_bounds": [None if x == inf else x for x in cylinder.bounds],
                    **cylinder.to_json(),
                    "coordinates": joint_coordinates(cylinder.size, azimuths(cylinder.steps)).tolist(),
                }
                for cylinder in self.cylinders
            ],
            "families": [
                {"radius": [None if x == inf else x for x in family.interval], **family.to_json()}
                for family in self.families
            ],
            "why": self.why or None,
            "cautions": list(self.cautions()),
        }


def joint_coordinates(radius: float, places: npt.ArrayLike) -> Floats:
    """Return where joints at azimuths float[J] are across the axis of a cylinder: (R sin t, R cos t), float[J, 2].

    >>> joint_coordinates(2.0, [0.0, np.pi]).tolist()
    [[0.0, 2.0], [0.0, -2.0]]
    """
    points, _ = Cylinder(radius).axes(places)
    return np.where(np.abs(points) > DOUBLE.same_point * radius, points, 0.0)[:, ::2]


def central_angles(lengths: npt.ArrayLike, radius: npt.ArrayLike) -> Floats:
    """Return the angles that links span round the axis, psi = 2 asin(length / 2 R) (Hyatt et al. 2021, Eq. 19).

    Parameters
    ----------
    lengths, radius : float[...]
        Any one unit.

    Raises
    ------
    InvariantError
        If a link is longer than the diameter.

    Examples
    --------
    >>> float(np.degrees(central_angles(1.0, 1.0)).round(9))
    60.0
    """
    ratio = np.asarray(lengths, dtype=float) / (2.0 * np.asarray(radius, dtype=float))
    if not ((ratio >= 0) & (ratio <= 1)).all():
        raise InvariantError(
            "radius", "a link is longer than the diameter, or the radius is not positive", "2 R >= every length"
        )
    return np.asarray(2.0 * np.arcsin(ratio))


def chords(steps: npt.ArrayLike, radius: npt.ArrayLike) -> Floats:
    """Return the lengths of links that span angles, in radians, signed or not, on a cylinder of a radius."""
    return np.asarray(2.0 * np.asarray(radius) * np.abs(np.sin(np.asarray(steps, dtype=float) / 2.0)))


def cylinder_reach(lengths: npt.ArrayLike) -> Floats:
    """Return 1 / length^2, the reach of links in a loop sum."""
    return np.asarray(np.asarray(lengths, dtype=float) ** -2.0)


def map_to_cylinders(lengths: npt.ArrayLike) -> CylinderMap:
    """Return every cylinder on which a planar loop of any number of links lies, by its loop sums.

    Parameters
    ----------
    lengths : float[n]
        In loop order, any one unit. Of a four-bar: ground, input, coupler, output.

    Raises
    ------
    InvariantError
        If a length is not positive, or the links cannot close.
    UnsolvableError
        If there are too many links.

    Examples
    --------
    Hyatt et al. 2021, Fig. 10:

    >>> [(round(one.size, 2), one.circuit) for one in map_to_cylinders([4, 3, 5, 1]).cylinders]
    [(2.54, 'open'), (2.59, 'crossed')]
    """
    given = checked_link_lengths(lengths)
    unit = 2.0 ** np.frexp(given.max())[1]  # a power of two: no digit of the lengths is lost
    loops, families = mapped_loop(cylinder_reach(given / unit), 0)
    found = tuple(_scaled(one, unit) for one in loops)
    many = tuple(replace(one, interval=(one.interval[0] * unit, inf)) for one in families)
    kind = kind_of_planar(given) if len(given) == 4 else None
    why = "" if found or many else "the loop closes stretched out only, at an infinite radius"
    stretched = _nearly_stretched(given, {family.signs for family in many})
    return CylinderMap(tuple(given.tolist()), found, many, kind, why, stretched)


def _scaled(one: MappedLoop, unit: float) -> MappedLoop:
    least, most = one.bounds
    return replace(one, size=float(one.size * unit), bounds=(float(least * unit), float(most * unit)))


def _nearly_stretched(lengths: Floats, families: set[tuple[int, ...]]) -> tuple[tuple[int, ...], ...]:
    """Return the signs, but for those of families, with which lengths sum to nearly zero, and not to zero."""
    patterns = sign_patterns(len(lengths))
    near = patterns[np.abs(patterns @ lengths) <= rounding_of(lengths)]
    signs = [tuple(row) for row in near.tolist()]
    return tuple(one for one in signs if one not in families and fsum(np.multiply(one, lengths)) != 0.0)
