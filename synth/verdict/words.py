"""Verdicts in a sentence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees

import networkx as nx

from graphs.errors import shown
from graphs.ids import JointId
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE
from synth.motion.branches import Certainty
from synth.motion.configuration import Configuration
from synth.motion.marked import Marked
from synth.verdict.verdict import Way

__all__ = ["Told", "flaps_of", "listed", "text_of_motion"]

_MOST = 12
_MARKED = {
    "has": " as it is marked",
    "none has": ", though no way begins as it is marked",
    "none found": ", though no way was found that begins as it is marked",
}


@dataclass(frozen=True, slots=True)
class Told:
    """What a sentence about motion is made of.

    Attributes
    ----------
    at : Configuration
    ways : tuple of Way
    marked : {"has", "none has", "none found"} or None
        Whether a way begins with all mountains and valleys as they are marked; None where nothing is.
    complete : bool
        Whether all ways were looked for.
    generic : int or None
        The mobility of the type.
    stiff : tuple of joint ids
    way : Way or None
        The one whose freedoms are told.
    """

    at: Configuration
    ways: Sequence[Way]
    marked: Marked | None
    complete: bool
    generic: int | None
    stiff: Sequence[JointId]
    way: Way | None


def flaps_of(graph: SCGraph) -> list[JointId]:
    """Return the joints that are in no loop: whatever hangs on one turns freely."""
    pairs = nx.Graph()
    pairs.add_nodes_from(graph.nodes)
    between: dict[frozenset[object], list[JointId]] = {}
    for joint, ends in graph.joints.items():
        between.setdefault(frozenset(ends), []).append(joint)
        pairs.add_edge(*ends)
    bridges = {frozenset(pair) for pair in nx.bridges(pairs)}
    return [joints[0] for pair, joints in between.items() if pair in bridges and len(joints) == 1]


def text_of_motion(told: Told, freedoms: int | None, certainty: Certainty) -> str:
    """Return the sentence about a motion."""
    flaps = flaps_of(told.at.linkage.graph)
    if told.way is not None and freedoms is None and certainty != "not known":
        how = f"{_followed(told.way)}; with how many freedoms is not known"
        return f"{told.at.verb} from {_start(told)}{_ways(told)}; {how}."
    if freedoms is None:
        return f"No motion found, and none excluded{told.at.doubt}."
    if not freedoms:
        return f"Rigid: nothing moves{told.at.doubt}."
    if flaps and freedoms == len(flaps) and len(told.stiff) == len(told.at.linkage.graph.joints) - len(flaps):
        hang = "freedom is the flap" if len(flaps) == 1 else "freedoms are the flaps"
        if told.stiff:
            stiff = f"joints {listed(told.stiff)} cannot move"
            return f"Rigid but for flaps: {stiff}; {len(flaps)} {hang} {listed(flaps)}."
    parts = [f"{told.at.verb} with {freedoms} {_freedom(freedoms)} from {_start(told)}{_ways(told)}"]
    if told.stiff:
        parts.append(f"joint{'s' * (len(told.stiff) > 1)} {listed(told.stiff)} cannot move")
    if certainty != "proved":
        parts.append("not known for certain" if told.way is None else _followed(told.way))
    return "; ".join(parts) + _generally(told, freedoms) + "."


def listed(joints: Sequence[JointId]) -> str:
    """Return ids in a row, not too many."""
    names = [shown(joint) for joint in joints[:_MOST]]
    more = f" and {len(joints) - _MOST} more" if len(joints) > _MOST else ""
    return ", ".join(names) + more


def _start(told: Told) -> str:
    return "flat" if told.at.flat else "its pose"


def _followed(way: Way) -> str:
    return f"followed to {degrees(way.followed):.3g} degrees, loops closed to {DOUBLE.closed:.0e}"


def _freedom(number: int) -> str:
    return "freedom" if number == 1 else "freedoms"


def _ways(told: Told) -> str:
    marked = "" if told.marked is None else _MARKED[told.marked]
    if len(told.ways) < 2:
        only = told.at.flat and told.ways and not told.complete and told.marked != "has"
        return f"{marked}, on the one way that was looked for" if only else marked
    kinds = Counter(way.freedoms for way in told.ways)
    least = "" if told.complete else "at least "
    if len(kinds) == 1:
        return f"{marked}, in {least}{len(told.ways)} ways"
    each = ", ".join(
        f"{count} with {'not known' if kind is None else kind}"
        for kind, count in sorted(kinds.items(), key=lambda item: -(item[0] or 0))
    )
    return f"{marked} ({least}{len(told.ways)} ways: {each})"


def _generally(told: Told, freedoms: int | None) -> str:
    """Return how the type compares in general position."""
    generic = told.generic
    if generic is None or freedoms is None or freedoms <= generic or freedoms <= 0:
        return ""
    would = "would be rigid" if generic <= 0 else f"has {generic}"
    special = f"its geometry is special, h = {freedoms - generic}"
    return f"; in general position this type {would} (M = {generic}): {special}"
