"""How cones and cylinders of loops are told: lines and tables."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import TYPE_CHECKING

from graphs.printing import Block, TableBlock, plain

if TYPE_CHECKING:
    from graphs.ids import JointId
    from synth.fourbar.closing import FourBarKind
    from synth.surfaces.cone import ConeMap
    from synth.surfaces.cylinder import CylinderMap
    from synth.surfaces.mapping import FamilyOfCircles, MappedLoop

__all__ = ["blocks_of_cones", "blocks_of_cylinders", "joints_text", "signs_text"]


def signs_text(signs: Sequence[int]) -> str:
    """Return signs as text.

    Examples
    --------
    >>> signs_text((1, -1, 1))
    '+-+'
    """
    return "".join("+" if sign > 0 else "-" for sign in signs)


def joints_text(joints: Sequence[JointId]) -> str:
    """Return names of joints as text."""
    return plain(" ".join(map(str, joints)))


def blocks_of_cones(mapped: ConeMap) -> list[Block]:
    """Return the cones of a loop as a table, and why there are none."""
    blocks: list[Block] = []
    if mapped.kind is not None:
        blocks.append(_kind_line(mapped.kind, angular=True))
        if mapped.solutions in ("a", "b", "c", "d"):
            blocks.append(f"class {mapped.solutions} of Hyatt et al. 2020, Fig. 10")
    blocks += _circles([*mapped.flat, *mapped.cones], mapped.families, flat=mapped.flat, angular=True)
    blocks += _cautions(mapped)
    if mapped.why:
        blocks.append(f"no cone: {mapped.why}")
    if mapped.supplementary is not None:
        told = ", ".join(f"{degrees(angle):.6g}" for angle in mapped.supplementary.angles)
        blocks += ["", f"supplementary linkage, on the same joint lines: {told}", *mapped.supplementary.blocks()]
    return blocks


def blocks_of_cylinders(mapped: CylinderMap) -> list[Block]:
    """Return the cylinders of a loop as a table, and why there are none."""
    blocks: list[Block] = [] if mapped.kind is None else [_kind_line(mapped.kind, angular=False)]
    blocks += _circles(mapped.cylinders, mapped.families, flat=(), angular=False)
    blocks += _cautions(mapped)
    return [*blocks, f"no cylinder: {mapped.why}"] if mapped.why else blocks


def _kind_line(kind: FourBarKind, *, angular: bool) -> str:
    """Say in a line what a four-bar is."""
    unit = "°" if angular else ""
    shown = kind.told_differences(angular=angular)
    differences = ", ".join(f"T{i} = {t:.6g}{unit}" for i, t in enumerate(shown, start=1))
    return f"{kind.grashof}, {kind.name}   ({differences})"


def _cautions(mapped: ConeMap | CylinderMap) -> list[Block]:
    return [f"caution: {caution}" for caution in mapped.cautions()]


def _circles(
    loops: Sequence[MappedLoop], families: Sequence[FamilyOfCircles], *, flat: Sequence[MappedLoop], angular: bool
) -> list[Block]:
    size = "lambda (deg)" if angular else "radius"
    rows = []
    for one in loops:
        notes = ["flat, no cone"] * (one in flat)
        notes += [f"link {link + 1} spans half the circle" for link in one.half_turns]
        if one.caution:
            low, high = (degrees(x) if angular else x for x in one.bounds)
            notes.append(f"ill-conditioned, between {low:.6g} and {high:.6g}")
        rows.append((
            f"{degrees(one.size) if angular else one.size:.10g}", one.circuit, signs_text(one.signs),
            str(one.turns), " ".join(f"{degrees(step):.2f}" for step in one.steps), "; ".join(notes),
        ))  # fmt: skip
    for family in families:
        low, high = (degrees(x) if angular else x for x in family.interval)
        rows.append((
            f"{low:.10g} to {high:.10g}", family.circuit, signs_text(family.signs), str(family.turns), "",
            "every one of these" + (", ill-conditioned" if family.caution else ""),
        ))  # fmt: skip
    heads = (size, "circuit", "signs", "k", "steps (deg)", "note")
    return [TableBlock(heads, rows, [size, "k"])] if rows else []
