"""A mechanism at a configuration: what every question about motion is asked of.

`synth.analysis.moving._configuration_of.configuration_of` makes it, from anything that has coordinates; closure
equations, tolerances and branches are computed when they are first needed, and kept. Theory: docs/theory/folding.md,
docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil, floor, log10
from typing import Any, NamedTuple

import numpy as np

from graphs.convert.conversions import Mechanism
from graphs.errors import UnsolvableError, numbered, shown
from graphs.loops.loop import Centre
from graphs.mechanism.precision import Precision
from graphs.mechanism.sheet import Reading, Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE, EPSILON, Tolerances
from graphs.types import Floats, JointId
from synth.analysis.motion.assigned_branch import (
    AssignedBranch,
    Disagreement,
    agreeing_best,
    assigned_branch,
    nearest_branch,
)
from synth.analysis.motion.branches import MOST_JOINTS, all_branches_of_many, branches_of, search_for
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.germ import Branch, Branches
from synth.analysis.motion.linkage import Linkage, moved, parts_of
from synth.analysis.motion.path import PassedPanels, Path
from synth.analysis.motion.singular.motion_near_rates import InitialMotion, begun_near
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.motion.walk.walking import Event

EXACT = DOUBLE.closed
"""Coordinates that are precise to this part of the extent are taken at their word: loops of them close."""


def doubt_of(precision: Precision) -> str:
    """Return what rounded coordinates leave open where a motion is not found or ends; empty if they are exact."""
    if precision.size <= EXACT:
        return ""
    precise = f"they are precise to {precision}"
    return f", with the coordinates as written; {precise}, and exact coordinates may allow motion"


def doubt_of_rigid(precision: Precision, misfit: float | None, searched: float, unsettled: bool = False) -> str:
    """Return how near a rigid pattern is to one that moves, after "rigid"; empty where there is nothing to add.

    The misfit is that of the nearest pattern that moves (`Configuration.misfit`), None if none was found with
    vertices displaced by up to what was `searched`.
    """
    exact = precision.size <= EXACT
    within = "" if exact else f" within the drawing's precision, {precision}"
    if misfit is None:
        if unsettled:
            return f"{within}; some branches nearly exist, and whether any does there is unknown"
        none = f"; no rigid-foldable pattern was found with vertices moved by up to {searched:.0e} of the extent"
        return "" if exact else within + none
    times = "" if exact else f", {misfit / precision.size:.0f} times the precision"
    moved = f"vertices moved by up to {at_most(misfit)} of the extent{times}"
    return f"{within}; the nearest rigid-foldable pattern has {moved}"


def at_most(number: float) -> str:
    """Return a positive number to one digit, rounded up: "3e-03" for 2.03e-3."""
    unit = 10.0 ** floor(log10(number))
    return f"{ceil(number / unit * (1.0 - 4.0 * EPSILON)) * unit:.0e}"


_NAMED = 12
"""At most so many joints are named in a line."""
_MOST_FLEXES = 100
"""With more flexes and dependent closure equations one motion is enough."""
_ONE_WAY, _HALVES = 100, 8
"""For flat sheets of more creases one motion as assigned is enough if the equations of more vertices are
no products: each may part the rates into two halves."""


class PointPlaces(NamedTuple):
    """Points float[F, n, 3] of a mechanism at joint angles, and by how much bodies disagree on one, in extents."""

    points: Floats
    apart: Floats


@dataclass(frozen=True, eq=False)
class Configuration:
    """A mechanism at a configuration: its linkage, and the precision of its coordinates as read.

    The axes are `exact` but for the rounding of double precision if the coordinates were, or were mended; `given`
    is the mechanism that was read; with `more` its branches are looked for with a hundred times the usual
    allowance.

    Examples
    --------
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> at = configuration_of(generate("bennett").mechanism)
    >>> at.linkage, at.branches.regular
    (<Linkage: 4 links, 4 joints, 1 loops>, True)
    """

    linkage: Linkage
    precision: Precision
    exact: bool = True
    given: Mechanism | None = None
    more: bool = field(default=False, kw_only=True)

    @property
    def joints(self) -> tuple[JointId, ...]:
        """The joints, in the order of all arrays."""
        return tuple(self.linkage.graph.joints)

    @property
    def flat(self) -> bool:
        """Whether it is a sheet that lies flat."""
        return False

    @property
    def has_panels(self) -> bool:
        """Whether it is of a sheet, whose frames are sheets."""
        return False

    @property
    def limited(self) -> bool:
        """Whether joints end at 180 degrees, where panels lie on each other."""
        return isinstance(self.given, HingedSolids) and self.given.flat_panels

    @property
    def marks(self) -> Floats:
        """The assignment: 1 for valleys and -1 for mountains, 0 for joints without one.

        Of solid panels it is the sense in which each hinge can turn, by the side at which it is.
        """
        if self.limited and isinstance(self.given, HingedSolids):
            return np.array(list(self.given.senses().values()), dtype=float)
        return np.zeros(len(self.linkage.angles))

    @property
    def wanted(self) -> Floats:
        """The sense in which joints are to go, 1 or -1: as they are assigned, else all alike."""
        marks = self.marks
        return marks if marks.any() else np.ones(len(marks))

    @property
    def doubt(self) -> str:
        """The caution on rounded coordinates where nothing moves; empty if they are exact."""
        return ""

    @property
    def misfit(self) -> float | None:
        """Largest displacement of a vertex that was mended, in units of the extent; None without vertices."""
        return None

    @property
    def nearly(self) -> bool:
        """Whether rates nearly agree that do not agree exactly, at the resolution of the coordinates."""
        return False

    @property
    def unsettled(self) -> bool:
        """Whether motion within the precision of its coordinates is neither found nor excluded."""
        return False

    @property
    def elsewhere(self) -> tuple[tuple[Configuration, int], ...]:
        """Branches of other mechanisms within the precision, each with its number there."""
        return ()

    def of_branch(self, branch: int | str | None) -> tuple[Configuration, int | str | None]:
        """Return the configuration that has a branch, by number or signs, and its number or signs there."""
        own = 0 if self.branches is None else self.branches.numbered
        if isinstance(branch, int) and own <= branch < own + len(self.elsewhere):
            return self.elsewhere[branch - own]
        if isinstance(branch, str) and self.branches is not None and self.branches.number_of(branch) is None:
            for other, number in self.elsewhere:
                there = other.branch(number)
                if there is not None and there.has_signs(branch):
                    return other, number
        return self, branch

    @property
    def mended(self) -> tuple[str, ...]:
        """The repairs of rounded coordinates."""
        return ()

    @property
    def reading(self) -> Reading | None:
        """The report on the drawing it was read from; None if it was not traced."""
        return self.given.reading if isinstance(self.given, Sheet) else None

    @cached_property
    def tolerances(self) -> Tolerances:
        """The tolerances of its coordinates."""
        return Tolerances.of(0.0 if self.exact else self.precision.size, len(self.linkage.angles))

    @cached_property
    def closure(self) -> ClosureEquations:
        """The closure equations of the linkage."""
        return ClosureEquations(self.linkage)

    @cached_property
    def thin(self) -> ClosureEquations | None:
        """For solid panels side by side: the closure equations of the thin sheet, all of whose hinges are level."""
        if self.has_panels or not self.limited:
            return None
        return ClosureEquations(replace(self.linkage, points=self.linkage.points * np.array([1.0, 1.0, 0.0])))

    @cached_property
    def branches(self) -> Branches | None:
        """The motion branches from here; None for a linkage that is too large to look for all."""
        parts = [part.linkage for part in parts_of(self.linkage)]
        if any(len(part.angles) > MOST_JOINTS for part in parts):
            return all_branches_of_many(self.linkage, self.closure, self.wanted)
        if any(map(_has_many_flexes, parts)) or any(map(self._one_way_enough, parts)):
            return None
        joints = max(len(part.angles) for part in parts)
        return branches_of(self.linkage, self.closure, search_for(joints, self.wanted, more=self.more))

    @cached_property
    def begun(self) -> InitialMotion:
        """One motion from here, near to the assignment, looked for without all others."""
        return begun_near(self.closure, self.linkage, self.wanted)

    @cached_property
    def marked(self) -> AssignedBranch:
        """The branch that begins as a flat sheet is assigned, if there is one."""
        if self.branches is None or not self.flat:
            return AssignedBranch(None, None)
        way = assigned_branch(self.branches, self.linkage, self.marks)
        folded = self.begun.folded if way.marked == "none found" else None
        if folded is None or folded.agree < np.count_nonzero(self.marks):
            return way
        return assigned_branch(self.branches, self.linkage, self.marks, self.begun.rates)

    @cached_property
    def chosen(self) -> int | None:
        """Number of the branch that is taken by default; None where there is none.

        That which begins as assigned, or with which the fewest assigned joints disagree; without an assignment,
        that on which most joints go alike.
        """
        if self.branches is None or not self.branches.branches:
            return None
        if self.marked.number is not None:
            return self.marked.number
        near = self.disagreement
        return agreeing_best(self.branches, self.wanted) if near is None else near.number

    @cached_property
    def disagreement(self) -> Disagreement | None:
        """How the assignment of a flat sheet differs from the nearest branch; None without an assignment."""
        if self.marked.marked is None or self.branches is None:
            return None
        number, _, rates = self.marked
        if number is None or rates is None:
            return nearest_branch(self.branches, self.marks)
        return Disagreement(number, (), (), rates)

    def nearest_to_json(self) -> dict[str, Any] | None:
        """Return the key ``assignment`` of an answer: whether a branch begins so, and how the nearest differs."""
        near, joints = self.disagreement, self.joints
        if near is None:
            return None
        branch = self.branch(near.number)
        return {
            "begins": self.marked.marked,
            "assigned": int(np.count_nonzero(self.marks)),
            "nearest_branch": near.number,
            "freedoms": None if branch is None else branch.freedoms,
            "opposite": [str(joints[place]) for place in near.opposite],
            "immobile": [str(joints[place]) for place in near.immobile],
        }

    @property
    def disagreeing(self) -> str:
        """A line with the creases whose assignment disagrees with the nearest branch; empty without any."""
        near = self.disagreement
        if near is None or not near.size:
            return ""
        parts = [
            f"{listed([self.joints[place] for place in places])} {verb if len(places) == 1 else verbs}"
            for places, verb, verbs in (
                (near.opposite, "folds the other way", "fold the other way"),
                (near.immobile, "is immobile", "are immobile"),
            )
            if places
        ]
        count, every = near.size, int(np.count_nonzero(self.marks))
        differing = f"{count} of {numbered(every, 'assigned crease')} {'disagrees' if count == 1 else 'disagree'}"
        seen = "see synth draw --as marks, synth edit --assign-branch"
        return f"{differing} with the nearest branch, {near.number}: {'; '.join(parts)} ({seen})"

    def branch(self, number: int | None) -> Branch | None:
        """Return a branch by its number; of a regular configuration there is one."""
        if number is None or self.branches is None or not self.branches.branches:
            return None
        return self.branches.branch(number)

    @cached_property
    def one_way(self) -> bool:
        """Whether one motion stands for all: others are not looked for, or only folded states led to one."""
        branches = self.branches
        if branches is None:
            return True
        known = branches.exhaustive or any(branch.certainty != "not known" for branch in branches.branches)
        return not known and self.flat and self.begun.folded is not None

    def _one_way_enough(self, part: Linkage) -> bool:
        """Tell whether branches of a part are too many to list, and a folded state leads to one with the assignment."""
        loops = sum(loop.centre is Centre.FINITE and len(loop.joints) > 4 for loop in part.loops)
        if not (self.flat and len(part.angles) > _ONE_WAY and loops > _HALVES and self.marks.any()):
            return False
        folded = self.begun.folded
        return folded is not None and folded.agree == np.count_nonzero(self.marks)

    def placed(self, angles: Floats) -> PointPlaces:
        """Return where its points are at joint angles float[F, J], radians."""
        linkage = self.linkage
        points = np.array([moved(linkage, one).points for one in angles]).reshape(len(angles), -1, 3)
        return PointPlaces(points * linkage.extent + linkage.middle, np.zeros(len(angles)))

    def at(self, angles: Floats, points: Floats | None = None) -> Sheet | Linkage:
        """Return the mechanism at joint angles float[J], radians: a linkage, or for a sheet the sheet."""
        return moved(self.linkage, angles)

    def passed(self, path: Path, points: Floats, driver: int) -> PassedPanels:
        """Return where panels pass through each other on a path, and how they lie at its end."""
        return PassedPanels(path)

    def collision(self) -> Event:
        """Return the event that ends a walk before panels cross; `UnsolvableError` without panels."""
        raise UnsolvableError("collisions require the panels of a sheet, and this mechanism has none")

    def to_json(self, branch: Branch | None = None, other_question: str | None = None) -> dict[str, Any]:
        """Return the key ``configuration`` of an answer: its branch, or `other_question`, why it has none."""
        branches = None if other_question else self.branches
        freedoms, immobile = (None, None) if branch is None else (branch.freedoms, branch.immobile)
        if branches is not None and branches.no_motion == "proved":
            freedoms, immobile = 0, tuple(range(len(self.joints)))
        return {
            "links": len(self.linkage.graph),
            "joints": [str(joint) for joint in self.joints],
            "loops": len(self.linkage.loops),
            **self.precision.to_json(),
            "flat": self.flat,
            "branches": None
            if branches is None
            else {"number": branches.numbered, "exhaustive": branches.exhaustive, **branches.count_to_json()},
            "branch": None if branch is None else branch.signs,
            "freedoms": freedoms,
            "immobile_joints": None if immobile is None else [str(self.joints[place]) for place in immobile],
            "other_question": other_question,
        }

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.linkage!r}>"


def _has_many_flexes(linkage: Linkage) -> bool:
    """Tell whether the equations of second order between the rates of a linkage are too large."""
    joints = len(linkage.angles)
    if joints <= _MOST_FLEXES:
        return False
    closure = ClosureEquations(linkage)
    flexes = rates_at(closure, linkage.angles).shape[1]
    return bool(flexes > _MOST_FLEXES and joints - flexes < closure.rows)


def listed(joints: Sequence[JointId]) -> str:
    """Return the ids of joints in a row, at most 12 of them."""
    more = f" and {len(joints) - _NAMED} more" if len(joints) > _NAMED else ""
    return ", ".join(map(shown, joints[:_NAMED])) + more
