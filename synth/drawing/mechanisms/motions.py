"""What the creases of a pattern do when it moves, for its picture: by the verdict, or on one branch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from graphs.errors import numbered
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import JointId, LinkId
from synth.folding.configuration import SheetConfiguration
from synth.motion.beginning import Wanted, beginning
from synth.moving.made import configuration_of
from synth.verdict.of_motion import verdict_of_motion

__all__ = ["Doing", "Motions", "motions_by_verdict", "motions_on_branch"]

Doing: TypeAlias = Literal["moves", "still", "unknown", "mountain", "valley", "later"]
"""Later: at rest as the motion begins, and not for good."""


@dataclass(frozen=True, slots=True)
class Motions:
    """What each joint does, and the clusters of panels that move as one.

    `said` is what the colours mean, and the evidence.
    """

    of: Mapping[JointId, Doing] = field(default_factory=dict)
    clusters: tuple[tuple[LinkId, ...], ...] = ()
    said: str = ""


def motions_by_verdict(sheet: Sheet | SheetConfiguration) -> Motions:
    """Return the motions of the joints by the verdict on a sheet: moving on some branch, immobile, or unknown.

    Raise UnsolvableError if the sheet has no coordinates, or its panels do not fit at its configuration. Three
    creases that meet in a point hold each other in the flat state:

    Three creases that meet in a point hold each other, flat as they lie:

    >>> tent = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 1)), ((0, 0), (2, 0), (-1, 2), (-1, -2)))
    >>> motions = motions_by_verdict(tent)
    >>> set(motions.of.values()), motions.clusters, motions.said
    ({'still'}, ((0, 1, 2),), 'no crease moves (grey, dotted; proved); panels of one colour move as one')
    """
    pattern = configuration_of(sheet)
    verdict = verdict_of_motion(pattern)
    still = set() if verdict.certainty == "not known" else set(verdict.stiff_joints)
    ways = [set(way.stiff_joints) for way in verdict.ways if way.certainty != "not known"]
    of: dict[JointId, Doing] = {}
    for joint in pattern.linkage.graph.joints:
        if joint in still:
            of[joint] = "still"
        else:
            of[joint] = "moves" if any(joint not in stiff for stiff in ways) else "unknown"
    clusters = verdict.clusters if still else ()
    return Motions(of, clusters, _said_of_verdict(of, verdict.certainty))


def _said_of_verdict(of: Mapping[JointId, Doing], certainty: str) -> str:
    does = list(of.values())
    moving, still, unknown = (does.count(one) for one in ("moves", "still", "unknown"))
    if moving == len(does):
        return f"every crease moves (orange; {certainty})"
    if still == len(does):
        return f"no crease moves (grey, dotted; {certainty}); panels of one colour move as one"
    if unknown == len(does):
        return "which creases move is not known (purple)"
    told = [f"{numbered(moving, 'crease')} move{'s' * (moving == 1)} (orange)"] if moving else []
    if still:
        told.append(f"{still} still (grey, dotted; {certainty}), panels of one colour move as one")
    if unknown:
        told.append(f"of {unknown} (purple) it is not known")
    return "; ".join(told)


def motions_on_branch(sheet: Sheet | SheetConfiguration, branch: int | str | None = None) -> Motions:
    """Return the motions with which joints start on a branch.

    A branch is its number, as `synth fold --branches` lists them, or its signs; by default the one that agrees
    best with the mountains and valleys of the sheet. Raise UnsolvableError if the sheet has no coordinates,
    nothing moves, or panels do not fit at its configuration; InvariantError if there is no such branch.
    """
    pattern = configuration_of(sheet)
    linkage, found = pattern.linkage, pattern.branches
    joints = list(linkage.graph.joints)
    number, rates = beginning(pattern, Wanted(branch))
    taken = found.branches[number or 0] if found is not None else None
    for_good = set(taken.still) if taken is not None else set()
    of: dict[JointId, Doing] = {}
    for place, (joint, rate) in enumerate(zip(joints, rates / np.abs(rates).max(), strict=True)):
        if abs(rate) > DOUBLE.zero_rate:
            of[joint] = "valley" if rate > 0 else "mountain"
        else:
            of[joint] = "still" if place in for_good else "later"
    which = "one way to move" if found is None or taken is None else f"way {number or 0} of {len(found.branches)}"
    if taken is not None:
        freedoms = "freedoms not known" if taken.freedoms is None else numbered(taken.freedoms, "freedom")
        which += f" ({freedoms}, {taken.certainty})"
    looks = {"mountain": "red", "valley": "blue, dashed", "later": "purple", "still": "grey, dotted"}
    there = [f"{one} {look}" for one, look in looks.items() if one in of.values()]
    return Motions(of, (), f"{which}: {', '.join(there)}")
