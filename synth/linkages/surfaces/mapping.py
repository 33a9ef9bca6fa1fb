"""What mapping a loop to a cone or a cylinder gives: one circle after the other, and families of them.

Cones and cylinders share this (`synth.linkages.surfaces.loop_maps`). Where rounding decides whether there is a
circle, or leaves few digits of it, the circle says so. Theory: docs/theory/rounding.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, count
from math import cos, degrees, fsum, inf, isclose, pi, tan
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.printing import Block, TableBlock, plain
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.linkages.fourbar.closing import ILL_CONDITIONED, FourBarKind
from synth.linkages.surfaces.circuit import circuits
from synth.linkages.surfaces.loop_sums import (
    Base,
    LoopRoots,
    half_steps,
    loop_roots,
    loop_sum,
    put_together,
    sum_rounding,
)

_VAGUE = 1e-6
"""A circle whose size is relatively less certain than this has a caution."""
_NONE = np.zeros(0, dtype=np.intp)
_HALVINGS = 200
"""The least part of the interval looked at round a circle is 2^-200: sizes are known less well than that."""


@dataclass(frozen=True, slots=True)
class MappedLoop:
    """A loop on its circle.

    Attributes
    ----------
    size : float
        Cone angle lambda, radians, or radius R of the cylinder.
    circuit : {"open", "crossed"}
    signs : tuple of int
        Of the steps, in loop order; the first is +.
    turns, density : int
        k: the steps sum to 360 k degrees; how often the polygon winds, 1 if it is open.
    steps : tuple of float
        Projected angles, radians.
    residual : float
        Sum of the steps, as they are here, less 2 pi k, radians.
    double : bool
        Whether the loop sum, within its rounding, touches 360 k here, or ends here.
    half_turns : tuple of int
        Links that span half the circle: their steps have no sign and are listed as +.
    bounds : (float, float)
        Between these sizes the loop closes with these signs within the rounding of its links (to a factor of two).
    caution : str
        Where rounding decides whether there is a circle, or leaves few digits of its size; else empty.

    Examples
    --------
    >>> from synth.linkages.surfaces import map_to_cylinders
    >>> [(loop.circuit, loop.signs, loop.turns) for loop in map_to_cylinders([4, 3, 5, 1]).cylinders]
    [('open', (1, 1, 1, 1), 1), ('crossed', (1, 1, -1, -1), 0)]
    """

    size: float
    circuit: str
    signs: tuple[int, ...]
    turns: int
    density: int
    steps: tuple[float, ...]
    residual: float
    double: bool
    half_turns: tuple[int, ...]
    bounds: tuple[float, float]
    caution: str

    def to_json(self, *, angular: bool) -> dict[str, Any]:
        """Return the loop as plain data: on a cone (angular) or a cylinder."""
        size: dict[str, Any] = {"radius": self.size, "radius_bounds": [None if x == inf else x for x in self.bounds]}
        if angular:
            bounds = [degrees(x) for x in self.bounds]
            angle = degrees(self.size)
            size = {"lambda_deg": angle, "half_angle_deg": 90.0 - angle, "lambda_bounds_deg": bounds}
            size["R"] = cos(self.size)
        return {
            **size,
            "circuit": self.circuit,
            "signs": list(self.signs),
            "k": self.turns,
            "density": self.density,
            "steps_deg": in_degrees(self.steps),
            "residual_deg": degrees(self.residual),
            "double": self.double,
            "half_turns": list(self.half_turns),
            "caution": self.caution or None,
        }


@dataclass(frozen=True, slots=True)
class FamilyOfCircles:
    """An interval of circles on which a loop closes: its loop sum vanishes identically.

    Attributes
    ----------
    interval : (float, float)
        Least and greatest lambda (the least, 0, is the flat cone) or radius (the greatest is infinite).
    circuit : {"open", "crossed"}
        In the middle of the interval.
    signs, turns : tuple of int, int
        k is always 0.
    caution : str
        Where the loop sum vanishes within rounding only; else empty.

    Examples
    --------
    >>> from synth.linkages.surfaces import map_to_cylinders
    >>> [family.signs for family in map_to_cylinders([2, 1, 2, 1]).families]  # a parallelogram lies crossed
    [(1, 1, -1, -1), (1, -1, -1, 1)]
    """

    interval: tuple[float, float]
    circuit: str
    signs: tuple[int, ...]
    turns: int
    caution: str

    @property
    def typical(self) -> float:
        """The size that is taken if none is chosen: the middle, or of radii without end twice the least."""
        return typical_size(self.interval)

    def to_json(self, *, angular: bool) -> dict[str, Any]:
        """Return the family as plain data: of cones (angular) or cylinders."""
        return {
            **interval_json(self.interval, angular=angular),
            "circuit": self.circuit,
            "signs": list(self.signs),
            "k": self.turns,
            "caution": self.caution or None,
        }


def interval_json(interval: tuple[float, float], *, angular: bool) -> dict[str, Any]:
    """Return an interval of cones (angular) or of cylinders as plain data."""
    if angular:
        return {"lambda_deg": [degrees(x) for x in interval]}
    return {"radius": [None if x == inf else x for x in interval]}


def cautions_of(
    kind: FourBarKind | None, circles: Iterable[MappedLoop], families: Iterable[FamilyOfCircles], *more: str
) -> tuple[str, ...]:
    """Return the cautions of a map, each once."""
    cautions = [
        "" if kind is None else kind.caution,
        *(one.caution for one in circles),
        *(one.caution for one in families),
        *more,
    ]
    return tuple(dict.fromkeys(filter(None, cautions)))


def in_degrees(values: Iterable[float]) -> list[float]:
    """Return degrees without the last digits that conversion from and to radians spoils, and without -0."""
    return [round(degrees(value), 12) + 0.0 for value in values]


def signs_text(signs: Sequence[int]) -> str:
    """Return signs as text, such as ``+-+``."""
    return "".join("+" if sign > 0 else "-" for sign in signs)


def joints_text(joints: Sequence[JointId]) -> str:
    """Return names of joints as text."""
    return plain(" ".join(map(str, joints)))


def kind_line(kind: FourBarKind, *, angular: bool) -> str:
    """Return a line with class, type and differences of a four-bar."""
    unit = "°" if angular else ""
    shown = kind.rounded_differences(angular=angular)
    differences = ", ".join(f"T{i} = {t:.6g}{unit}" for i, t in enumerate(shown, start=1))
    return f"{kind.grashof}, {kind.name}   ({differences})"


def circles_table(
    loops: Sequence[MappedLoop], families: Sequence[FamilyOfCircles], *, flat: Sequence[MappedLoop], angular: bool
) -> list[Block]:
    """Return a table of the circles of a loop, one row for each, then its families; nothing without circles.

    `flat` are the loops that lie in a plane: no cone. `angular`: sizes are angles of cones, else lengths of
    cylinders.
    """
    number, size = ("cone", "lambda (deg)") if angular else ("cylinder", "radius")
    numbers = count(1)  # what --cone and --cylinder choose; a flat loop is no cone
    rows = []
    for one in loops:
        notes = ["flat, no cone"] * (one in flat)
        notes += [f"link {link + 1} spans half the circle" for link in one.half_turns]
        if one.caution:
            low, high = (degrees(x) if angular else x for x in one.bounds)
            notes.append(f"ill-conditioned, between {low:.6g} and {high:.6g}")
        radius = [f"{cos(one.size):.6g}"] if angular else []  # R of a cone (Hyatt et al. 2021, Eq. 14)
        half = [f"{90.0 - degrees(one.size):.10g}"] if angular else []
        rows.append((
            "" if one in flat else str(next(numbers)),
            f"{degrees(one.size) if angular else one.size:.10g}", *half, one.circuit, signs_text(one.signs),
            str(one.turns), *radius, " ".join(f"{degrees(step):.2f}" for step in one.steps),
            "; ".join(notes),
        ))  # fmt: skip
    for family in families:
        low, high = (degrees(x) if angular else x for x in family.interval)
        half = [f"{90.0 - high:.10g} to {90.0 - low:.10g}"] if angular else []
        rows.append((
            str(next(numbers)), f"{low:.10g} to {high:.10g}", *half, family.circuit, signs_text(family.signs),
            str(family.turns), *([""] if angular else []), "",
            "every one of these" + (", ill-conditioned" if family.caution else ""),
        ))  # fmt: skip
    half, radius = (["half angle (deg)"], ["R"]) if angular else ([], [])
    heads = (number, size, *half, "circuit", "signs", "k", *radius, "steps (deg)", "note")
    return [TableBlock(heads, rows, [number, size, *half, "k", *radius])] if rows else []


def mapped_loop(
    reach: Floats, base: Base, flat_steps: Floats | None = None
) -> tuple[tuple[MappedLoop, ...], tuple[FamilyOfCircles, ...]]:
    """Return all circles of one loop, and the families, on a cylinder (base 0) or a cone (base 1).

    `reach` is float[n]. For cones, `flat_steps` are the unsigned steps where the circle has size 0: the link
    angles themselves, of which the reach is rounded. A step of half a turn has no sign: sign patterns that differ
    in such steps only are one linkage, listed with +; where it ends a family it is not listed.
    """
    roots = loop_roots(reach, base)
    families = _families(roots, reach, base)
    vanishing = {family.signs for family in families}
    links = SizedLinks(reach, base, flat_steps)
    loops: dict[tuple[tuple[int, ...], float], MappedLoop] = {}
    for signs, turns, z, double in zip(roots.signs, roots.turns, roots.size, roots.double, strict=True):
        root = _as_listed(_Root(float(z), signs, int(turns), bool(double), _NONE), links)
        key = tuple(root.signs.tolist()), root.size
        ends_a_family = len(root.half) and in_a_family(root.signs, root.half, vanishing)
        if key not in loops and not ends_a_family:
            loops[key] = _on_its_circle(root, links)
    return tuple(sorted(loops.values(), key=lambda one: one.size)), families


def loops_on(
    size: float, loops: Iterable[MappedLoop], families: Iterable[FamilyOfCircles], links: SizedLinks
) -> tuple[MappedLoop, ...]:
    """Return the loops on one chosen circle: those of its size, to the digits that are printed, and of families."""
    on_it = [loop for loop in loops if is_size(loop.size, size)]
    on_it += [member(family, size, links) for family in families if is_in(family.interval, size)]
    return tuple({(loop.signs, loop.turns): loop for loop in on_it}.values())  # families may end in one loop


def not_on(size: float, loops: Iterable[MappedLoop], families: Iterable[FamilyOfCircles], *, angular: bool) -> str:
    """Return why nothing lies on a chosen circle: the sizes on which something does."""

    def shown(value: float) -> str:
        return f"{degrees(value) if angular else value:.10g}"

    others = [shown(loop.size) for loop in loops]
    others += sorted({f"{shown(family.interval[0])} to {shown(family.interval[1])}" for family in families})
    what = "lambda" if angular else "radius"
    return f"{what} {shown(size)} was chosen, and the loop lies on {what} {', '.join(others)}"


def member(family: FamilyOfCircles, size: float, links: SizedLinks) -> MappedLoop:
    """Return the loop of a family on the circle of a size in its interval."""
    z = reach_at(size, links)
    ends = z == links.reach.min()
    root = _as_listed(_Root(z, np.array(family.signs, dtype=np.int8), 0, bool(ends), _NONE), links)
    return replace(_on_its_circle(root, links), size=size, bounds=family.interval, caution=family.caution)


def typical_size(interval: tuple[float, float]) -> float:
    """Return the size amid an interval, or of radii without end twice the least."""
    low, high = interval
    return 2.0 * low if high == inf else (low + high) / 2.0


def is_size(found: float, size: float) -> bool:
    """Check whether a circle has a size, to the ten digits that are printed."""
    return isclose(found, size, rel_tol=DOUBLE.same_point)


def is_in(interval: tuple[float, float], size: float) -> bool:
    """Check whether an interval, whose ends are printed with ten digits, has a size."""
    low, high = interval
    return 0.0 < size < inf and (low <= size <= high or is_size(low, size) or is_size(high, size))


def reach_at(size: float, links: SizedLinks) -> float:
    """Return z of a circle of a size, as `size_of` has it, at most where the longest link ends."""
    return min(tan(size) ** 2 if links.base else (0.5 / size) ** 2, float(links.reach.min()))


def _families(roots: LoopRoots, reach: Floats, base: Base) -> tuple[FamilyOfCircles, ...]:
    end = float(reach.min())
    interval = (0.0, size_of(end, 1)) if base else (size_of(end, 0), np.inf)
    within = f"{ILL_CONDITIONED}: the loop closes here within the rounding of its links only"
    exact = dict(zip(map(tuple, roots.family_signs.tolist()), roots.family_exact.tolist(), strict=True))
    return tuple(
        FamilyOfCircles(
            interval,
            str(circuits(2.0 * np.array(signs) * half_steps(end / 2, reach, base)).names()),
            signs,
            0,
            "" if exact[signs] else within,
        )
        for signs in sorted(exact, reverse=True)
    )


class _Root(NamedTuple):
    """Where a loop closes, with its links of half a turn, whose signs are +."""

    size: float
    signs: npt.NDArray[np.int8]
    turns: int
    double: bool
    half: npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class SizedLinks:
    """The links of loops in loop sums: reach, and base 1 for link angles on cones, 0 for lengths.

    For cones, `flat_steps` are the unsigned steps where the circle has size 0.
    """

    reach: Floats
    base: Base
    flat_steps: Floats | None = None

    def spans(self, size: float) -> Floats:
        """Return the unsigned steps that the links span, radians."""
        if size == 0.0 and self.flat_steps is not None:
            return self.flat_steps
        return 2.0 * half_steps(size, self.reach, self.base)

    def half_turns(self, size: float) -> npt.NDArray[np.intp]:
        """Return which links span half of the circle that ends the interval, within rounding."""
        each = np.eye(len(self.reach))
        return np.flatnonzero(np.pi - self.spans(size) <= sum_rounding(size, self.reach, each, self.base))

    def sharp(self, half: npt.NDArray[np.intp]) -> bool:
        """Check whether links of half a turn are as long as the longest, to the last digit."""
        return bool((self.reach[half] == self.reach.min()).all())


def _on_its_circle(root: _Root, links: SizedLinks) -> MappedLoop:
    steps = root.signs * links.spans(root.size)
    residual = fsum([*steps.tolist(), -2.0 * pi * root.turns])
    least, most = _bounds(root, links)
    ends = sorted((size_of(least, links.base), size_of(most, links.base)))
    doubt = ""
    if root.double and not len(root.half) and (root.size or residual):
        doubt = "the loop sum touches 360 k degrees here within rounding: no circle, one, or two"
    elif not links.sharp(root.half):
        doubt = "several links span half the circle within rounding"
    elif root.size and most - least > _VAGUE * root.size:
        doubt = "rounding leaves few digits of the size"
    return MappedLoop(
        size_of(root.size, links.base),
        str(circuits(steps).names()),
        tuple(root.signs.tolist()),
        root.turns,
        int(circuits(steps).density),
        tuple(steps.tolist()),
        residual,
        root.double,
        tuple(root.half.tolist()),
        (float(np.nextafter(ends[0], 0.0)), float(np.nextafter(ends[1], np.inf))),
        f"{ILL_CONDITIONED}: {doubt}" if doubt else "",
    )


def _bounds(root: _Root, links: SizedLinks) -> tuple[float, float]:
    """Return the sizes about a root at which its loop closes, with any signs of links of nearly half a turn."""
    ends = [_closing_sizes(root, links)]
    if not links.sharp(root.half):
        for first, last in combinations(range(len(root.half) + 1), 2):
            signs = root.signs.copy()
            signs[root.half[first:last]] = -1
            turns = _whole_turns(signs * links.spans(root.size))
            ends.append(_closing_sizes(root._replace(signs=signs, turns=turns), links))
    return min(least for least, _ in ends), max(most for _, most in ends)


def _closing_sizes(root: _Root, links: SizedLinks) -> tuple[float, float]:
    """Return the sizes below and above a root from which on its loop sum is not 2 pi k, whatever the rounding."""
    weights, distinct = put_together(root.signs, links.reach)  # equal links cancel exactly
    away = distinct[0] * 0.5 ** np.arange(_HALVINGS, -1, -1)

    def first_open(sizes: Floats) -> float:
        over = np.abs(loop_sum(sizes, distinct, weights, links.base) - 2.0 * np.pi * root.turns)
        is_open = over > sum_rounding(sizes, distinct, weights, links.base)
        return float(sizes[is_open.argmax() if is_open.any() else -1])

    return first_open(np.maximum(root.size - away, 0.0)), first_open(np.minimum(root.size + away, distinct[0]))


def size_of(z: float, base: Base) -> float:
    """Return lambda, or of base 0 the radius, of a circle: z is tan(lambda)^2, or 1 / (2 R)^2."""
    if base:
        return float(np.arctan(np.sqrt(z)))
    return float(0.5 / np.sqrt(z)) if z else np.inf


def _as_listed(root: _Root, links: SizedLinks) -> _Root:
    """Return a root with + for half turns, or its mirror image, so that the first other sign is +."""
    half = links.half_turns(root.size) if root.double and root.size == links.reach.min() else _NONE
    if not len(half):
        return root
    rest = np.delete(root.signs, half)
    signs = -root.signs if len(rest) and rest[0] < 0 and 0 in half else root.signs.copy()
    signs[half] = 1
    return root._replace(signs=signs, turns=_whole_turns(signs * links.spans(root.size)), half=half)


def _whole_turns(steps: Floats) -> int:
    return round(float(steps.sum()) / (2.0 * pi))


def in_a_family(signs: npt.NDArray[np.int8], half: npt.NDArray[Any], families: Iterable[npt.ArrayLike]) -> bool:
    """Check whether signs, or their mirror image, are those of a family but for steps of half a turn.

    Half turns, which have no sign, are the numbers of the steps, or a mask.
    """
    rest = np.delete(signs, half)
    return any(np.array_equal(rest, mirrored * np.delete(family, half)) for family in families for mirrored in (1, -1))
