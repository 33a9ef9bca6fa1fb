"""How an answer about mobility is printed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.printing import Block, TableBlock, plain

if TYPE_CHECKING:
    from graphs.answer.report import MobilityAnswer

__all__ = ["blocks_of"]

_TITLES = {
    "traditional_cgk": "C-G-K (Wiener Eq. 1)",
    "modified_cgk": "modified C-G-K (Wiener Eq. 2)",
    "spherical_system": "spherical system (Wiener Eq. 3)",
    "polyhedron": "polyhedron (Wiener Eq. 4)",
    "loop_form": "loop form",
    "closed_surface": "closed surface",
    "wampler_eq5": "Wampler Eq. 5, rods",
    "wampler_eq6": "Wampler Eq. 6, points",
    "wampler_eq7": "Wampler Eq. 7, S+3",
    "wampler_eq8": "Wampler Eq. 8, S+k",
    "wampler_eq9": "Wampler Eq. 9, scissors",
    "wampler_eq10": "Wampler Eq. 10, no ground",
}

_COUNTS = {
    "vertices": "vertices V",
    "implicit_centres": "implicit centres C",
    "edges": "rods E",
    "external_edges": "external edges",
    "internal_edges": "internal edges",
    "spatial_loops": "spatial loops",
    "flaps": "flaps",
    "interior_vertices": "interior vertices",
    "parts": "parts",
    "passive": "passive freedoms",
    "remote": "sum of k over remote centres",
    "on_plane": "points on planes P",
    "on_line": "points on lines L",
    "scissors": "scissors X",
}


def blocks_of(answer: MobilityAnswer) -> list[Block]:
    """Return the lines and the table of an answer."""
    blocks: list[Block] = [f"mobility M = {plain(answer.mobility)}   ({answer.mechanism_class})"]
    if answer.exact is not None:
        exact = answer.exact
        blocks.append(f"exact generic mobility {exact.mobility}   (rank {exact.rank} modulo two primes)")
    if answer.pose is not None:
        blocks.append(_pose_line(answer))
    known = [
        ("links N", answer.links),
        ("joints J", answer.joints),
        ("loops L", answer.loops),
        ("centres", answer.centres),
        *((title, answer.counts.get(key)) for key, title in _COUNTS.items()),
    ]
    blocks.append(", ".join(f"{title} {value}" for title, value in known if value is not None))
    rows = [
        (_TITLES[name], plain(result.value), "yes" if result.applies else "no", result.why)
        for name, result in answer.equations.items()
    ]
    blocks.append(TableBlock(("equation", "M", "applies", "why"), rows, ["M"]))
    blocks += [f"repaired: {note}" for note in answer.repairs]
    blocks += [f"note: {note}" for note in answer.warnings]
    return blocks


def _pose_line(answer: MobilityAnswer) -> str:
    """Say in a line how a mechanism can move as it lies."""
    pose = answer.pose
    assert pose is not None
    if pose.dof is None:
        return "as it lies: indeterminate"
    gap = pose.to_json()["gap"]
    evidence = "no zero singular value" if gap is None else f"gap {gap:.0e}"
    state = "flat state: more infinitesimal freedoms than when folded; " if _is_only_flat(answer) else ""
    over = "" if answer.overconstraint is None else f"h = {answer.overconstraint}, "
    return f"as it lies: {pose.dof} infinitesimal freedom(s)   ({state}{over}{evidence})"


def _is_only_flat(answer: MobilityAnswer) -> bool:
    """Tell whether a sheet owes freedoms to lying flat."""
    pose, over = answer.pose, answer.overconstraint
    return pose is not None and pose.flat and bool(pose.flat_loops) and (over is None or over > 0)
