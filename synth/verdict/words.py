"""Verdicts in words: the answer first, then branches, then evidence in the order of its weight.

What is said without more is proved; a numerical answer says how far it was traced.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees

import networkx as nx

from graphs.errors import numbered, shown
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.motion.branches import Certainty
from synth.motion.configuration import Configuration
from synth.motion.marked import Marked
from synth.motion.misfit import at_most, size_of
from synth.verdict.verdict import AsWritten, Way

__all__ = ["MotionFindings", "flaps_of", "in_words", "listed", "text_of_motion"]

_MOST = 12
_ASSIGNMENT = {
    "has": " with the given mountain-valley assignment",
    "none has": ", but not with the given assignment (proved)",
    "none found": ", but no branch with the given assignment was found",
}
_TO_GO_ON = "The search for branches ended at its work limit; try --more."


@dataclass(frozen=True, slots=True)
class MotionFindings:
    """What a verdict on a motion is written from.

    Attributes
    ----------
    at : Configuration
    ways : tuple of Way
    marked : {"has", "none has", "none found"} or None
        Whether a branch begins with the given mountain-valley assignment; None without one.
    complete : bool
        Whether the search for branches came to its end.
    generic : int or None
        The mobility of the type.
    stiff : tuple of joint ids
        Joints that are immobile on every branch.
    way : Way or None
        The branch whose degrees of freedom the verdict states.
    written : AsWritten, optional
        What holds without the precision of the coordinates.
    """

    at: Configuration
    ways: Sequence[Way]
    marked: Marked | None
    complete: bool
    generic: int | None
    stiff: Sequence[JointId]
    way: Way | None
    written: AsWritten | None = None


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


def text_of_motion(findings: MotionFindings, freedoms: int | None, certainty: Certainty) -> str:
    """Return the verdict in sentences; `freedoms` of 0 is rigid, None unknown."""
    way = findings.way
    if freedoms is None and (way is None or certainty == "not known"):
        return _unknown(findings)
    if freedoms == 0:
        return f"Rigid{findings.at.doubt}."
    flaps = flaps_of(findings.at.linkage.graph)
    rest = len(findings.at.linkage.graph.joints) - len(flaps)
    if flaps and freedoms == len(flaps) and findings.stiff and len(findings.stiff) == rest:
        at = f"at the flap joint{'s' * (len(flaps) > 1)} {listed(flaps)}"
        return f"Rigid except for flaps: {in_words(freedoms)}, {at}. {_immobile(findings.stiff)}"
    sentences = [_answer(findings, freedoms), *_branches(findings)]
    if findings.stiff:
        sentences.append(_immobile(findings.stiff))
    if certainty != "proved":
        sentences.append("Not proved." if way is None else f"Numerical: {_traced(way)}.")
    sentences += _overconstrained(findings.generic, freedoms)
    return " ".join([*sentences, *_allowance(findings)])


def in_words(freedoms: int) -> str:
    """Return a number of degrees of freedom.

    >>> in_words(1), in_words(2)
    ('1 degree of freedom', '2 degrees of freedom')
    """
    return numbered(freedoms, "degree of freedom", "degrees of freedom")


def listed(joints: Sequence[JointId]) -> str:
    """Return ids in a row, not too many."""
    names = [shown(joint) for joint in joints[:_MOST]]
    more = f" and {len(joints) - _MOST} more" if len(joints) > _MOST else ""
    return ", ".join(names) + more


def _unknown(findings: MotionFindings) -> str:
    """Return the verdict where no motion was found, and none excluded."""
    if findings.written is not None and findings.written.freedoms == 0:
        within = f"within the drawing's precision, {size_of(findings.at.precision)}"
        return f"Unknown: no motion found {within}, and none excluded. Exactly as written it is rigid."
    none = f"Unknown: no motion found, and none excluded{findings.at.doubt}."
    return " ".join([none, *_allowance(findings)])


def _answer(findings: MotionFindings, freedoms: int | None) -> str:
    """Return the first sentence: whether it moves, from where, and with how many degrees of freedom."""
    moves = "Rigid-foldable" if findings.at.limited else "Mobile"
    start = "from the flat state" if findings.at.flat else "from this configuration"
    count = "degrees of freedom unknown"
    if freedoms is not None:
        count = in_words(freedoms)
        if findings.marked != "has" and any(way.freedoms != freedoms for way in findings.ways):
            most = findings.complete and all(way.freedoms is not None for way in findings.ways)
            count = f"up to {count}" if most else f"{count} on the freest branch found"
    assignment = "" if findings.marked is None else _ASSIGNMENT[findings.marked]
    if findings.marked == "has":
        first = f"{moves} {start}{assignment}: {count}"
    else:
        first = f"{moves} {start}: {count}{assignment}"
    misfit = None if findings.way is None else findings.way.misfit
    if not misfit:
        return f"{first}."
    moved = f"vertices moved by at most {at_most(misfit)} of the extent"
    return f"{first}, within the drawing's precision ({moved}). {_as_written(findings.written)}"


def _as_written(written: AsWritten | None) -> str:
    """Return what would be without the precision."""
    if written is None or written.freedoms is None:
        return "Whether it folds exactly as written is unknown."
    if not written.freedoms:
        return "Exactly as written it would be rigid."
    return f"Exactly as written it has {in_words(written.freedoms)}."


def _branches(findings: MotionFindings) -> list[str]:
    """Return the sentence that counts the branches, where there are several or others were not looked for."""
    ways, kind = findings.ways, "folding branch" if findings.at.flat else "motion branch"
    if len(ways) < 2:
        lone = findings.at.flat and ways and not findings.complete and findings.marked != "has"
        return [f"Only 1 {kind} was searched for."] if lone else []
    kinds = Counter(way.freedoms for way in ways)
    count = ("" if findings.complete else "At least ") + numbered(len(ways), kind, f"{kind}es")
    if len(kinds) == 1:
        return [f"{count}."]
    each = ", ".join(
        f"{number} with {'unknown' if freedoms is None else freedoms} DOF"
        for freedoms, number in sorted(kinds.items(), key=lambda item: -(item[0] or 0))
    )
    return [f"{count}: {each}."]


def _immobile(joints: Sequence[JointId]) -> str:
    return f"Immobile joint{'s' * (len(joints) > 1)}: {listed(joints)}."


def _traced(way: Way) -> str:
    """Return how far a branch was traced, and how well loops close there."""
    back = ""
    if way.from_folded is not None:
        folded, small = map(degrees, way.from_folded)
        back = f"found folded by {folded:.3g}° and traced back to {small:.2g}°; "
    return f"{back}traced to {degrees(way.followed):.3g}°, loop-closure residual below {DOUBLE.closed:.0e}"


def _overconstrained(generic: int | None, freedoms: int | None) -> list[str]:
    """Return the sentence that compares with a generic realisation of the type, if that has fewer."""
    if generic is None or freedoms is None or freedoms <= generic:
        return []
    type_has = "is rigid" if generic <= 0 else f"has {in_words(generic)}"
    return [f"Overconstrained: a generic realisation {type_has} (M = {generic}, h = {freedoms - generic})."]


def _allowance(findings: MotionFindings) -> list[str]:
    """Return the sentence on a search that ended at its allowance, with the way to go on."""
    ended = not findings.complete and findings.at.branches is not None and not findings.at.more
    return [_TO_GO_ON] if ended else []
