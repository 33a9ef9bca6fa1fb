"""What ``synth cone`` and ``synth cylinder`` share: reading lists of numbers, showing circles."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, pi, radians
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import console, plain, table

if TYPE_CHECKING:
    from synth.fourbar.closing import FourBarKind
    from synth.surfaces.cone import ConeMap
    from synth.surfaces.cylinder import CylinderMap
    from synth.surfaces.mapping import FamilyOfCircles, MappedLoop

__all__ = [
    "NumberList",
    "in_radians",
    "kind_line",
    "print_cones",
    "print_cylinders",
    "signs_text",
]


class NumberList(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """Numbers parted by commas, ``70,80,120,40``."""

    name = "numbers"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a tuple of numbers."""
        if isinstance(value, tuple):
            return value
        try:
            return tuple(float(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"{plain(value)!r} is no list of numbers such as 70,80,120,40", param, ctx)


def in_radians(values: Sequence[float]) -> list[float]:
    """Return angles given in degrees; where they look like radians, that is said on stderr."""
    if len(values) > 1 and all(0 < abs(value) <= 2 * pi and value != round(value, 1) for value in values):
        first = f"{values[0]:g} looks like radians: {degrees(values[0]):.4g} degrees"
        click.echo(f"note: angles are taken in degrees; {first}", err=True)
    return [radians(value) for value in values]


def signs_text(signs: Sequence[int]) -> str:
    """Return signs as text.

    Examples
    --------
    >>> signs_text((1, -1, 1))
    '+-+'
    """
    return "".join("+" if sign > 0 else "-" for sign in signs)


def kind_line(kind: FourBarKind, *, angular: bool) -> str:
    """Say in a line what a four-bar is."""
    unit = "°" if angular else ""
    shown = kind.told_differences(angular=angular)
    differences = ", ".join(f"T{i} = {t:.6g}{unit}" for i, t in enumerate(shown, start=1))
    return f"{kind.grashof}, {kind.name}   ({differences})"


def print_cones(found: ConeMap) -> None:
    """Print cones as a table, and why there are none."""
    out = console()
    if found.kind is not None:
        out.print(kind_line(found.kind, angular=True))
        if found.solutions in ("a", "b", "c", "d"):
            out.print(f"class {found.solutions} of Hyatt et al. 2020, Fig. 10")
    _print_circles([*found.flat, *found.cones], found.families, flat=found.flat, angular=True)
    _print_cautions(found)
    if found.why:
        out.print(f"no cone: {found.why}")
    if found.supplementary is not None:
        told = ", ".join(f"{degrees(angle):.6g}" for angle in found.supplementary.angles)
        out.print(f"\nsupplementary linkage, on the same joint lines: {told}")
        print_cones(found.supplementary)


def print_cylinders(found: CylinderMap) -> None:
    """Print cylinders as a table, and why there are none."""
    out = console()
    if found.kind is not None:
        out.print(kind_line(found.kind, angular=False))
    _print_circles(found.cylinders, found.families, flat=(), angular=False)
    _print_cautions(found)
    if found.why:
        out.print(f"no cylinder: {found.why}")


def _print_cautions(found: ConeMap | CylinderMap) -> None:
    for caution in found.cautions():
        console().print(f"caution: {caution}", markup=False)


def _print_circles(
    loops: Sequence[MappedLoop], families: Sequence[FamilyOfCircles], *, flat: Sequence[MappedLoop], angular: bool
) -> None:
    size = "lambda (deg)" if angular else "radius"
    rows = table(size, "circuit", "signs", "k", "steps (deg)", "note", numbers=[size, "k"])
    for one in loops:
        notes = ["flat, no cone"] * (one in flat)
        notes += [f"link {link + 1} spans half the circle" for link in one.half_turns]
        if one.caution:
            low, high = (degrees(x) if angular else x for x in one.bounds)
            notes.append(f"ill-conditioned, between {low:.6g} and {high:.6g}")
        rows.add_row(
            f"{degrees(one.size) if angular else one.size:.10g}", one.circuit, signs_text(one.signs),
            str(one.turns), " ".join(f"{degrees(step):.2f}" for step in one.steps), "; ".join(notes),
        )  # fmt: skip
    for family in families:
        low, high = (degrees(x) if angular else x for x in family.interval)
        rows.add_row(
            f"{low:.10g} to {high:.10g}", family.circuit, signs_text(family.signs), str(family.turns), "",
            "every one of these" + (", ill-conditioned" if family.caution else ""),
        )  # fmt: skip
    if loops or families:
        console().print(rows)
