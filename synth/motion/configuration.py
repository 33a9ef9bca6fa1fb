"""A mechanism at a configuration: what every question about motion is asked of.

It is made once, by `synth.moving.made.configuration_of`, from anything that has coordinates, and handed to
whatever asks: closure equations, tolerances and branches are found when they are first needed, and kept. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import pi, radians, tau
from typing import Any, NamedTuple

import numpy as np

from graphs.arrays import Floats
from graphs.convert.table import Mechanism
from graphs.errors import UnsolvableError
from graphs.ids import JointId
from graphs.mechanism.precision import Precision
from graphs.tolerances import Tolerances
from synth.motion.branches import MOST_JOINTS, Branch, Branches, branches_of, search_for
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.marked import MarkedWay, agreeing_best, marked_way
from synth.motion.placement import moved
from synth.motion.second_order import rates_at
from synth.motion.walk.walking import Event

__all__ = ["Configuration", "Placed"]

_MOST_FLEXES = 100
"""Where closure equations depend on each other at a configuration of more flexes, one way to move is enough."""
_WHOLE = radians(179.0)
"""How far a joint is driven that ends at 180 degrees, where panels lie on each other."""


class Placed(NamedTuple):
    """Where the points of a mechanism are at joint angles.

    Attributes
    ----------
    points : float[F, n, 3]
        Vertices of a sheet, else a point on each axis, in the unit of the coordinates.
    apart : float[F]
        By how much bodies disagree on a point that they share, in units of the extent.
    """

    points: Floats
    apart: Floats


@dataclass(frozen=True, eq=False)
class Configuration:
    """A mechanism at a configuration.

    Attributes
    ----------
    linkage : PosedLinkage
        Links, axes and joint angles.
    precision : Precision
        Of the coordinates that were given.
    exact : bool, optional
        Whether the axes are exact but for the rounding of double precision: the coordinates were, or were mended.
    given : Sheet, HingedSolids, PolyhedronModel, ..., optional
        What it was made from.

    Examples
    --------
    >>> from synth.moving.made import configuration_of
    >>> from synth.patterns import generate
    >>> at = configuration_of(generate("bennett").mechanism)
    >>> at.linkage, at.branches.regular, at.verb
    (<PosedLinkage: 4 links, 4 joints, 1 loops>, True, 'Moves')
    """

    linkage: PosedLinkage
    precision: Precision
    exact: bool = True
    given: Mechanism | None = None

    @property
    def joints(self) -> tuple[JointId, ...]:
        """The joints, in the order of all arrays."""
        return tuple(self.linkage.graph.joints)

    @property
    def verb(self) -> str:
        """What it does: panels fold, other links move."""
        return "Moves"

    @property
    def flat(self) -> bool:
        """Whether it is a sheet that lies flat."""
        return False

    @property
    def limited(self) -> bool:
        """Whether joints end at 180 degrees, where panels lie on each other."""
        return False

    @property
    def marks(self) -> Floats:
        """The assignment: 1 for valleys and -1 for mountains, 0 for joints without one."""
        return np.zeros(len(self.linkage.angles))

    @property
    def wanted(self) -> Floats:
        """Which way joints are to go, 1 or -1: as they are assigned, or all alike where nothing is."""
        marks = self.marks
        return marks if marks.any() else np.ones(len(marks))

    @property
    def doubt(self) -> str:
        """What rounded coordinates leave open where nothing moves; empty if they are exact."""
        return ""

    @property
    def mended(self) -> tuple[str, ...]:
        """What was done to rounded coordinates."""
        return ()

    @property
    def most(self) -> float:
        """The largest angle a joint can have, radians."""
        return pi if self.limited else float(np.finfo(float).max)

    @property
    def whole(self) -> float:
        """How far a joint is driven where nothing else is asked for, radians."""
        return _WHOLE if self.limited else tau

    @cached_property
    def tolerances(self) -> Tolerances:
        """What is zero at its coordinates."""
        return Tolerances.of(0.0 if self.exact else self.precision.size, len(self.linkage.angles))

    @cached_property
    def closure(self) -> ClosureEquations:
        """The closure equations of the linkage."""
        return ClosureEquations(self.linkage)

    @cached_property
    def branches(self) -> Branches | None:
        """The ways to move from here; None for a linkage that is too large to look for all."""
        joints = len(self.linkage.angles)
        if joints > MOST_JOINTS or (joints > _MOST_FLEXES and self._many_flexes()):
            return None
        return branches_of(self.linkage, self.closure, search_for(joints, self.wanted))

    @cached_property
    def marked(self) -> MarkedWay:
        """The branch that begins as a flat sheet is assigned, if there is one."""
        if self.branches is None or not self.flat:
            return MarkedWay(None, None)
        return marked_way(self.branches, self.linkage, self.marks)

    @cached_property
    def chosen(self) -> int | None:
        """Number of the branch that is taken where none is asked for; None where there is none.

        That which begins as assigned, or else that on which most joints do.
        """
        if self.branches is None or not self.branches.branches:
            return None
        return agreeing_best(self.branches, self.wanted) if self.marked.number is None else self.marked.number

    def branch(self, number: int | None) -> Branch | None:
        """Return a branch by its number; of a regular configuration there is one."""
        if number is None or self.branches is None or not self.branches.branches:
            return None
        return self.branches.branches[number]

    def _many_flexes(self) -> bool:
        """Tell whether the equations of second order between its rates are too large."""
        flexes = rates_at(self.closure, self.linkage.angles).shape[1]
        return bool(flexes > _MOST_FLEXES and len(self.linkage.angles) - flexes < self.closure.rows)

    def placed(self, angles: Floats) -> Placed:
        """Return where its points are at joint angles float[F, J], radians."""
        linkage = self.linkage
        points = np.array([moved(linkage, one).points for one in angles]).reshape(len(angles), -1, 3)
        return Placed(points * linkage.extent + linkage.middle, np.zeros(len(angles)))

    def ends_of(self, joints: Sequence[JointId]) -> dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return the two ends of joints that are creases, in the unit of the coordinates; of others nothing."""
        return {}

    def at(self, angles: Floats, points: Floats | None = None) -> Any:
        """Return the mechanism at joint angles float[J], radians: a linkage, or where it is one a sheet."""
        return moved(self.linkage, angles)

    def collision(self) -> Event:
        """Return what ends a walk before panels pass through each other.

        Raises
        ------
        UnsolvableError
            If there are no panels.
        """
        raise UnsolvableError("collisions are looked for between the panels of a sheet, and there are none")

    def to_json(self, branch: Branch | None = None, other_question: str | None = None) -> dict[str, Any]:
        """Return the key ``configuration`` of an answer (docs/command-json.md).

        Parameters
        ----------
        branch : Branch, optional
            The one that the answer is about.
        other_question : str, optional
            Why the answer is not about a branch.
        """
        found = None if other_question else self.branches
        freedoms, still = (None, None) if branch is None else (branch.freedoms, branch.still)
        if found is not None and found.no_motion == "proved":
            freedoms, still = 0, tuple(range(len(self.joints)))
        return {
            "links": len(self.linkage.graph),
            "joints": [str(joint) for joint in self.joints],
            "loops": len(self.linkage.loops),
            "precision": self.precision.size,
            "precision_source": self.precision.source,
            "flat": self.flat,
            "branches": None if found is None else {"number": len(found.branches), "exhaustive": found.exhaustive},
            "branch": None if branch is None else branch.signs,
            "freedoms": freedoms,
            "immobile_joints": None if still is None else [str(self.joints[place]) for place in still],
            "other_question": other_question,
        }

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.linkage!r}>"
