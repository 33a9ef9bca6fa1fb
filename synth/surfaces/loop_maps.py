"""Loops on cones and cylinders: every right cone of a spherical loop, every cylinder of a planar one.

On a cone joint axes are ruling lines, and lambda is the angle between these and the plane across the axis: 0 is a
flat disk. A link of angle phi spans the projected angle phi_0 with sin(phi / 2) = cos(lambda) sin(phi_0 / 2).
Across the axis of a cylinder, the joints of a planar loop lie on a circle. Sources: Hyatt, Magleby, Howell 2020;
Hyatt et al. 2021, sections 3 and 4. Theory: docs/theory/mapping.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees, fsum, inf
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import numbered
from graphs.mechanism.surfaces import Cylinder
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.fourbar import closing
from synth.surfaces import mapping
from synth.surfaces.circuit import azimuths
from synth.surfaces.loop_sums import sign_patterns


@dataclass(frozen=True, slots=True)
class ConeMap(Printed):
    """All right cones on which a spherical loop lies.

    Attributes
    ----------
    angles : tuple of float
        Link angles, radians, at most pi.
    cones, flat : tuple of MappedLoop
        Loops with 0 < lambda < 90 degrees, and with lambda = 0: in a plane.
    families : tuple of FamilyOfCircles
    kind, solutions : FourBarKind or None, {"a", "b", "c", "d", "crossed only", "none"} or None
        Of four-bars; the solutions are the class of Fig. 10.
    why : str
        Why there is no cone; empty where there is one.
    supplementary : ConeMap or None
        Of four-bars without a cone: the linkage on the same joint lines whose sum of angles is least.

    Examples
    --------
    >>> map_to_cones(np.radians([120, 95, 45, 85]))
    <ConeMap: 4 links, 2 cones>
    """

    angles: tuple[float, ...]
    cones: tuple[mapping.MappedLoop, ...]
    flat: tuple[mapping.MappedLoop, ...]
    families: tuple[mapping.FamilyOfCircles, ...]
    kind: closing.FourBarKind | None
    solutions: str | None
    why: str
    supplementary: ConeMap | None

    def cautions(self) -> tuple[str, ...]:
        """Return where rounding decides: the type and class, circles, or families."""
        return mapping.cautions_of(self.kind, (*self.flat, *self.cones), self.families)

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        blocks: list[Block] = []
        if self.kind is not None:
            blocks.append(mapping.kind_line(self.kind, angular=True))
            if self.solutions in ("a", "b", "c", "d"):
                blocks.append(f"class {self.solutions} of Hyatt et al. 2020, Fig. 10")
        blocks.append("chords, 2 sin(phi / 2): " + ", ".join(f"{x:.6g}" for x in cone_chords(self.angles)))
        blocks += mapping.circles_table([*self.flat, *self.cones], self.families, flat=self.flat, angular=True)
        blocks += [f"caution: {caution}" for caution in self.cautions()]
        if self.why:
            blocks.append(f"no cone: {self.why}")
        if self.supplementary is not None:
            angles = ", ".join(f"{degrees(angle):.6g}" for angle in self.supplementary.angles)
            blocks += ["", f"supplementary linkage, on the same joint lines: {angles}", *self.supplementary.blocks()]
        return blocks

    def __repr__(self) -> str:
        return f"<ConeMap: {len(self.angles)} links, {numbered(len(self.cones), 'cone')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the map as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        document: dict[str, Any] = {
            "angles_deg": mapping.in_degrees(self.angles),
            "chords": cone_chords(self.angles).tolist(),
            **({} if self.kind is None else self.kind.to_json(angular=True)),
            "cones": [cone.to_json(angular=True) for cone in self.cones],
            "families": [family.to_json(angular=True) for family in self.families],
            "flat": [{**loop.to_json(angular=True), "lambda_deg": 0.0} for loop in self.flat],
            "why": self.why or None,
            "cautions": list(self.cautions()),
        }
        if self.kind is not None:
            document["class"] = self.solutions
            document["supplementary"] = None if self.supplementary is None else self.supplementary.to_json()
        return document


def largest_cone_angle(angles: npt.ArrayLike) -> Floats:
    """Return the largest cone angle for links, pi / 2 - phi / 2, radians (Hyatt et al. 2021, Eqs. 15, 16)."""
    return np.asarray((np.pi - np.asarray(angles, dtype=float)) / 2.0)


def cone_chords(angles: npt.ArrayLike) -> Floats:
    """Return the chords of links on the unit sphere, 2 sin(phi / 2) (Hyatt et al. 2021, Eq. 13)."""
    return np.asarray(2.0 * np.sin(np.asarray(angles, dtype=float) / 2.0))


def is_flat(cone_angle: float, longest: float) -> bool:
    """Check whether a cone is flat within the rounding of the longest link, which ends the cones."""
    return bool(cone_angle <= closing.rounding_of([longest]))


def cone_reach(angles: npt.ArrayLike) -> Floats:
    """Return cot(angle / 2)^2, the reach of links in a loop sum."""
    half = np.asarray(angles, dtype=float) / 2.0
    return np.asarray((np.cos(half) / np.sin(half)) ** 2)


def map_to_cones(angles: npt.ArrayLike) -> ConeMap:
    """Return every right cone on which a spherical loop of any number of links lies, by its loop sums.

    Parameters
    ----------
    angles : float[n]
        Link angles in loop order, radians, between 0 and 2 pi (over pi: the joint axes are those of 2 pi less the
        angle). Of a four-bar: ground, input, coupler, output.

    Raises
    ------
    InvariantError, UnsolvableError
        If an angle is out of range, or the links cannot close; if there are too many links.

    Examples
    --------
    >>> (cone,) = map_to_cones(np.radians([70, 80, 120, 40])).cones  # Hyatt et al. 2021, Fig. 3
    >>> round(float(np.degrees(cone.size)), 2), cone.circuit
    (25.21, 'open')
    """
    links = closing.checked_link_angles(angles)
    loops, families = mapping.mapped_loop(cone_reach(links), 1, links)
    flat = tuple(loop for loop in loops if is_flat(loop.size, links.max()))
    cones = loops[len(flat) :]  # in the order of their sizes
    why = "" if cones or families else _why_not(links, bool(flat))
    kind = solutions = supplement = None
    if len(links) == 4:
        kind, solutions = closing.kind_of_spherical(links), solution_class(links)
        if why and closing.spherical_differences(links)[3] < 0 and not _is_straight(links.max()):
            supplement = map_to_cones(closing.minimal_supplementary(links))
    return ConeMap(tuple(links.tolist()), cones, flat, families, kind, solutions, why, supplement)


def solution_class(angles: npt.ArrayLike) -> str:
    """Return the class of a four-bar's cones, by its link angles, float[4], radians.

    The classes of Hyatt et al. 2020, Fig. 10 and section 5, are a: Grashof, two cones; b: non-Grashof, one, open;
    c: folding, one cone of angle 0; d: two pairs of equal angles, infinitely many. With T4 < 0: "none" if Grashof,
    "crossed only" if non-Grashof, one crossed cone (the paper says none, docs/misprints.md 000-6).
    """
    links = np.asarray(angles, dtype=float)
    t = closing.spherical_differences(links)
    zero = np.abs(t) <= closing.rounding_of(links)
    if zero[:3].sum() >= 2:
        return "d"
    if zero.any():
        return "c"
    grashof = np.sign(t).prod() > 0
    if t[3] < 0:
        return "none" if grashof else "crossed only"
    return "a" if grashof else "b"


def _is_straight(angle: float) -> bool:
    return bool(np.pi - angle <= closing.rounding_of([angle]))


def _why_not(angles: Floats, flat: bool) -> str:
    """Return why a loop has no cone."""
    if flat:
        return "the loop closes in a plane only, lambda = 0"
    if _is_straight(angles.max()):
        return "a link of 180 degrees fits on no cone but the flat one"
    if len(angles) == 4 and closing.spherical_differences(angles)[3] < 0:
        return "T4 < 0: the links wrap round the sphere"
    most = np.degrees(largest_cone_angle(angles.max()))
    return f"no loop sum is a multiple of 360 degrees for lambda up to {most:.6g}, where the longest link ends"


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
        Signs with which the lengths sum to nearly zero, within rounding: perhaps one more circle, too large to
        find.

    Examples
    --------
    >>> map_to_cylinders([4, 3, 5, 1])
    <CylinderMap: 4 links, 2 cylinders>
    """

    lengths: tuple[float, ...]
    cylinders: tuple[mapping.MappedLoop, ...]
    families: tuple[mapping.FamilyOfCircles, ...]
    kind: closing.FourBarKind | None
    why: str
    stretched: tuple[tuple[int, ...], ...]

    def cautions(self) -> tuple[str, ...]:
        """Return where rounding decides: the type, circles, families, or one more cylinder beyond them."""
        large = f"{closing.ILL_CONDITIONED}: stretched out within rounding: one more cylinder may be very large"
        return mapping.cautions_of(self.kind, self.cylinders, self.families, large if self.stretched else "")

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        blocks: list[Block] = [] if self.kind is None else [mapping.kind_line(self.kind, angular=False)]
        blocks += mapping.circles_table(self.cylinders, self.families, flat=(), angular=False)
        blocks += [f"caution: {caution}" for caution in self.cautions()]
        for number, cylinder in enumerate(self.cylinders, start=1):
            rows = [
                (str(joint), *(f"{value + 0.0:.8g}" for value in place))
                for joint, place in enumerate(_coordinates(cylinder), start=1)
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
                {**cylinder.to_json(angular=False), "coordinates": _coordinates(cylinder)}
                for cylinder in self.cylinders
            ],
            "families": [family.to_json(angular=False) for family in self.families],
            "why": self.why or None,
            "cautions": list(self.cautions()),
        }


def _coordinates(cylinder: mapping.MappedLoop) -> list[list[float]]:
    places: list[list[float]] = joint_coordinates(cylinder.size, azimuths(cylinder.steps)).tolist()
    return places


def joint_coordinates(radius: float, places: npt.ArrayLike) -> Floats:
    """Return where joints at azimuths float[J] are across a cylinder's axis: (R sin t, R cos t), float[J, 2]."""
    points, _ = Cylinder(radius).axes(places)
    return np.where(np.abs(points) > DOUBLE.same_point * radius, points, 0.0)[:, ::2]


def chords(steps: npt.ArrayLike, radius: npt.ArrayLike) -> Floats:
    """Return the lengths of links that span angles (radians, signed or not) on a cylinder of a radius."""
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
    InvariantError, UnsolvableError
        If a length is not positive, or the links cannot close; if there are too many links.

    Examples
    --------
    >>> [(round(loop.size, 2), loop.circuit) for loop in map_to_cylinders([4, 3, 5, 1]).cylinders]  # Fig. 10
    [(2.54, 'open'), (2.59, 'crossed')]
    """
    sides = closing.checked_link_lengths(lengths)
    unit = unit_of(sides)
    loops, families = mapping.mapped_loop(cylinder_reach(sides / unit), 0)
    cylinders = tuple(
        replace(loop, size=loop.size * unit, bounds=(loop.bounds[0] * unit, loop.bounds[1] * unit)) for loop in loops
    )
    families = tuple(replace(family, interval=(family.interval[0] * unit, inf)) for family in families)
    kind = closing.kind_of_planar(sides) if len(sides) == 4 else None
    why = "" if cylinders or families else "the loop closes stretched out only, at an infinite radius"
    stretched = _nearly_stretched(sides, {family.signs for family in families})
    return CylinderMap(tuple(sides.tolist()), cylinders, families, kind, why, stretched)


def unit_of(lengths: Floats) -> float:
    """Return a power of two to divide lengths by, so that none is large and no digit of them is lost."""
    return float(2.0 ** np.frexp(lengths.max())[1])


def _nearly_stretched(lengths: Floats, families: set[tuple[int, ...]]) -> tuple[tuple[int, ...], ...]:
    """Return the signs, but for those of families, with which lengths sum to nearly zero, and not to zero."""
    patterns = sign_patterns(len(lengths))
    near = patterns[np.abs(patterns @ lengths) <= closing.rounding_of(lengths)]
    signs = [tuple(row) for row in near.tolist()]
    return tuple(one for one in signs if one not in families and fsum(np.multiply(one, lengths)) != 0.0)
