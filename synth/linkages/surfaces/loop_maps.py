"""Loops on cones and cylinders: the right cones of a spherical loop, or of many; the cylinders of a planar loop.

On a cone joint axes are ruling lines, and lambda is the angle between these and the plane across the axis: 0 is a
flat disk. A link of angle phi spans the projected angle phi_0 with sin(phi / 2) = cos(lambda) sin(phi_0 / 2).
Across the axis of a cylinder, the joints of a planar loop lie on a circle. Loop sums of many loops are solved
together; loops of which rounding or half turns decide something are mapped one by one. Sources: Hyatt, Magleby, Howell
2020; Hyatt et al. 2021, sections 3 and 4. Theory: docs/theory/mapping.md, docs/theory/loop-sums.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees, fsum
from typing import Any, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.mechanism.surfaces import Cylinder, checked_cone_angle
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints
from synth.linkages.fourbar import closing
from synth.linkages.fourbar.closing import can_close, rounding_of
from synth.linkages.surfaces import mapping
from synth.linkages.surfaces.circuit import azimuths, circuits
from synth.linkages.surfaces.loop_sums import MOST_LINKS, half_steps, loop_roots, sign_patterns

_Circle = TypeVar("_Circle", mapping.MappedLoop, mapping.FamilyOfCircles)


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
    notes : tuple of str
        Which link angles over pi are read as the rest of the circle.

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
    notes: tuple[str, ...] = ()

    def rows(self) -> tuple[mapping.MappedLoop, ...]:
        """Return the loop on the cone of each numbered row that is printed; of a family on a cone amid it."""
        links = mapping.SizedLinks(cone_reach(self.angles), 1, np.array(self.angles))
        return (*self.cones, *(mapping.member(family, family.typical, links) for family in self.families))

    def cautions(self) -> tuple[str, ...]:
        """Return where rounding decides: the type and class, circles, or families."""
        return mapping.cautions_of(self.kind, (*self.flat, *self.cones), self.families)

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        blocks: list[Block] = [f"note: {note}" for note in self.notes]
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
            "notes": list(self.notes),
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


def map_to_cones(angles: npt.ArrayLike, cone_angle: float | None = None) -> ConeMap:
    """Return every right cone on which a spherical loop of any number of links lies, by its loop sums.

    Parameters
    ----------
    angles : float[n]
        Link angles in loop order, radians, between 0 and 2 pi (over pi: the joint axes are those of 2 pi less the
        angle). Of a four-bar: ground, input, coupler, output.
    cone_angle : float, optional
        lambda of one cone, radians: only what lies on it, such as a parallelogram or a kite, which lie on every
        cone of an interval (Hyatt et al. 2021, Figs. 5, 6).

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
    if cone_angle is not None:
        size = float(checked_cone_angle(cone_angle))
        on_it = mapping.loops_on(size, cones, families, mapping.SizedLinks(cone_reach(links), 1, links))
        why = why or ("" if on_it else mapping.not_on(size, cones, families, angular=True))
        cones, families, flat = on_it, (), ()
    kind = solutions = supplement = None
    if len(links) == 4:
        kind, solutions = closing.kind_of_spherical(links), solution_class(links)
        if why and cone_angle is None and closing.spherical_differences(links)[3] < 0 and not _is_straight(links.max()):
            supplement = map_to_cones(closing.minimal_supplementary(links))
    notes = closing.read_the_other_way(angles)
    return ConeMap(tuple(links.tolist()), cones, flat, families, kind, solutions, why, supplement, notes)


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

    def rows(self) -> tuple[mapping.MappedLoop, ...]:
        """Return the loop on the cylinder of each numbered row that is printed; of a family on a typical one."""
        unit, links = _unit_and_links(np.array(self.lengths))
        members = (mapping.member(_scaled(one, 1 / unit), one.typical / unit, links) for one in self.families)
        return (*self.cylinders, *(_scaled(one, unit) for one in members))

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


def map_to_cylinders(lengths: npt.ArrayLike, radius: float | None = None) -> CylinderMap:
    """Return every cylinder on which a planar loop of any number of links lies, by its loop sums.

    Parameters
    ----------
    lengths : float[n]
        In loop order, any one unit. Of a four-bar: ground, input, coupler, output.
    radius : float, optional
        Of one cylinder: only what lies on it, such as a parallelogram or a kite, which lie on every cylinder from
        one on (Hyatt et al. 2021, Figs. 5, 6).

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
    unit, links = _unit_and_links(sides)
    loops, families = mapping.mapped_loop(links.reach, 0)
    why = "" if loops or families else "the loop closes stretched out only, at an infinite radius"
    stretched = _nearly_stretched(sides, {family.signs for family in families})
    if radius is not None:
        size = Cylinder(radius).radius / unit
        on_it = mapping.loops_on(size, loops, families, links)
        every = [_scaled(one, unit) for one in loops], [_scaled(one, unit) for one in families]
        why = why or ("" if on_it else mapping.not_on(radius, *every, angular=False))
        loops, families, stretched = on_it, (), ()
    return CylinderMap(
        tuple(sides.tolist()),
        tuple(_scaled(loop, unit) for loop in loops),
        tuple(_scaled(family, unit) for family in families),
        closing.kind_of_planar(sides) if len(sides) == 4 else None,
        why,
        stretched,
    )


def _unit_and_links(lengths: Floats) -> tuple[float, mapping.SizedLinks]:
    """Return a unit, and links in it for loop sums."""
    unit = unit_of(lengths)
    return unit, mapping.SizedLinks(cylinder_reach(lengths / unit), 0)


def _scaled(circle: _Circle, unit: float) -> _Circle:
    """Return a loop on a cylinder, or a family, whose unit of length is another."""
    if isinstance(circle, mapping.FamilyOfCircles):
        low, high = circle.interval
        return replace(circle, interval=(low * unit, high * unit))
    low, high = circle.bounds
    return replace(circle, size=circle.size * unit, bounds=(low * unit, high * unit))


def unit_of(lengths: Floats) -> float:
    """Return a power of two to divide lengths by, so that none is large and no digit of them is lost."""
    return float(2.0 ** np.frexp(lengths.max())[1])


def _nearly_stretched(lengths: Floats, families: set[tuple[int, ...]]) -> tuple[tuple[int, ...], ...]:
    """Return the signs, but for those of families, with which lengths sum to nearly zero, and not to zero."""
    patterns = sign_patterns(len(lengths))
    near = patterns[np.abs(patterns @ lengths) <= closing.rounding_of(lengths)]
    signs = [tuple(row) for row in near.tolist()]
    return tuple(one for one in signs if one not in families and fsum(np.multiply(one, lengths)) != 0.0)


STATUSES = ("cones", "no cone", "cannot close", "no link angles")
"""What may be said of a loop: it lies on a cone, or on none; its links do not close; an angle is out of range."""
_CONES, _NO_CONE, _OPEN, _NO_LINKS = range(4)


class _Circles(NamedTuple):
    """Rows of circles, by the number of their loop."""

    loop: Ints
    size: Floats
    signs: npt.NDArray[np.int8]
    turns: Ints
    steps: Floats
    double: Flags


@dataclass(frozen=True, slots=True, repr=False)
class ConesOfLoops(Printed):
    """All cones of many loops: a row for each loop, and rows of cones that name their loop.

    Attributes
    ----------
    angles : float[N, n]
        Link angles as they were given, radians.
    status : str[N]
        One of "cones", "no cone" (perhaps the flat one), "cannot close", "no link angles" (an angle is not between 0
        and 2 pi).
    loop : int[M]
        The loop that each cone is of, in rising order; cones of one loop by their sizes.
    size : float[M]
        lambda, radians, from 0 (flat) to pi / 2.
    flat : bool[M]
        Whether the loop is in a plane there, which is no cone.
    signs : int8[M, n]
        Of the steps; the first is +.
    turns : int[M]
        k: the steps sum to 2 pi k.
    steps : float[M, n]
        Projected angles, radians.
    open : bool[M]
        Whether the circuit is open; else it is crossed.
    residual : float[M]
        Sum of the steps less 2 pi k, radians.
    double : bool[M]
        Whether the loop sum touches 2 pi k there within its rounding.
    family_loop : int[F]
        Loops that lie on a whole interval of cones, once for each pattern of signs.

    Examples
    --------
    >>> cones = cones_of_loops(np.radians([[70, 80, 120, 40], [170, 10, 20, 30]]))
    >>> cones.status.tolist(), cones.loop.tolist(), np.degrees(cones.size).round(2).tolist()
    (['cones', 'cannot close'], [0], [25.21])
    >>> cones[0]
    <ConeMap: 4 links, 1 cone>
    """

    angles: Floats
    status: npt.NDArray[np.str_]
    loop: Ints
    size: Floats
    flat: Flags
    signs: npt.NDArray[np.int8]
    turns: Ints
    steps: Floats
    open: Flags
    residual: Floats
    double: Flags
    family_loop: Ints

    def __len__(self) -> int:
        return len(self.angles)

    def __getitem__(self, loop: int) -> ConeMap:
        """Return all that is known of one loop; raise as `map_to_cones` does."""
        return map_to_cones(self.angles[loop])

    def __repr__(self) -> str:
        return f"<ConesOfLoops: {numbered(len(self), 'loop')}, {numbered(int((~self.flat).sum()), 'cone')}>"

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        rows = [(status, str(int((self.status == status).sum()))) for status in STATUSES]
        table = TableBlock(("status", "loops"), [row for row in rows if row[1] != "0"], ["loops"])
        cones = numbered(int((~self.flat).sum()), "cone")
        return [f"{numbered(len(self), 'loop')} of {self.angles.shape[1]} links: {cones}", table]

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data, angles in degrees; cones in columns."""
        return {
            "angles_deg": np.degrees(self.angles).tolist(),
            "status": self.status.tolist(),
            "loop": self.loop.tolist(),
            "lambda_deg": np.degrees(self.size).tolist(),
            "flat": self.flat.tolist(),
            "circuit": np.where(self.open, "open", "crossed").tolist(),
            "signs": self.signs.tolist(),
            "k": self.turns.tolist(),
            "steps_deg": np.degrees(self.steps).tolist(),
            "residual_deg": np.degrees(self.residual).tolist(),
            "double": self.double.tolist(),
            "family_loop": self.family_loop.tolist(),
        }


def cones_of_loops(angles: npt.ArrayLike) -> ConesOfLoops:
    """Return every right cone of many spherical loops of as many links: `map_to_cones` by arrays.

    Parameters
    ----------
    angles : float[N, n]
        Link angles of each loop in loop order, radians, as `map_to_cones` takes them.

    Returns
    -------
    ConesOfLoops
        Loops that cannot close, or have angles out of range, have a status that says so, and no cones.

    Raises
    ------
    InvariantError
        If the angles are no rows of three or more numbers.
    UnsolvableError
        If the loops have too many links.

    Examples
    --------
    >>> angles = np.radians([[120, 95, 45, 85], [70, 80, 120, 40], [10, 20, 30, 100]])
    >>> cones = cones_of_loops(angles)
    >>> cones.status.tolist(), cones.loop.tolist()
    (['cones', 'cones', 'cannot close'], [0, 0, 1])
    """
    rows = np.asarray(angles, dtype=float)
    if rows.ndim != 2 or rows.shape[1] < 3:
        raise InvariantError("loops", f"an array of shape {rows.shape}", "float[N, n], n link angles in each row")
    if rows.shape[1] > MOST_LINKS:
        raise UnsolvableError(f"loops of {rows.shape[1]} links; expected 3 to {MOST_LINKS}")
    links = np.where(rows > np.pi, 2.0 * np.pi - rows, rows)
    good = np.asarray((np.isfinite(links) & (np.nan_to_num(links) >= DOUBLE.same_point)).all(axis=1))
    closed = np.array(good)
    closed[good] = can_close(links[good])
    numbers = np.flatnonzero(closed)
    circles, families = _circles(links[numbers])
    longest = links[numbers].max(axis=1, initial=0.0)
    flat = circles.size <= rounding_of(longest[:, np.newaxis])[circles.loop]
    status = np.where(good, np.where(closed, _NO_CONE, _OPEN), _NO_LINKS)
    status[numbers[circles.loop[~flat]]] = status[numbers[families]] = _CONES
    kinds = circuits(circles.steps)
    residual = circles.steps.sum(axis=1) - 2.0 * np.pi * circles.turns
    return ConesOfLoops(
        rows, np.array(STATUSES)[status], numbers[circles.loop], circles.size, flat, circles.signs, circles.turns,
        circles.steps, kinds.open, residual, circles.double, numbers[families],
    )  # fmt: skip


def _circles(links: Floats) -> tuple[_Circles, Ints]:
    """Return the circles of loops that close, float[N, n], in the order of loops and sizes; and loops of families."""
    reach = cone_reach(links)
    roots = loop_roots(reach, 1)
    special = np.union1d(roots.loop[roots.double], roots.family_loop)
    simple = ~np.isin(roots.loop, special)
    loop, signs, size = roots.loop[simple], roots.signs[simple], roots.size[simple]
    steps = signs * 2.0 * half_steps(size[:, np.newaxis], reach[loop], 1)
    plain = _Circles(loop, np.arctan(np.sqrt(size)), signs, roots.turns[simple], steps, np.zeros(len(loop), dtype=bool))
    parts, families = [plain], list[int]()
    for number in special.tolist():
        circles, of_families = mapping.mapped_loop(reach[number], 1, links[number])
        families += [number] * len(of_families)
        parts += [
            _Circles(
                np.array([number]), np.array([one.size]), np.array([one.signs], dtype=np.int8), np.array([one.turns]),
                np.array([one.steps]), np.array([one.double]),
            )
            for one in circles
        ]  # fmt: skip
    joined: list[Any] = [np.concatenate(columns) for columns in zip(*parts, strict=True)]
    order = np.lexsort((joined[1], joined[0]))
    return _Circles(*(column[order] for column in joined)), np.array(families, dtype=np.int64)
