"""A pose at which motions to first order are finite ones: where it is told what to lock and what to crease.

At a singular pose, such as a flat sheet, ranks say little of what moves. Advice is given at another then, on the
way to move that is asked for, or that marks of creases choose. Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.errors import NumericalError, UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.folding.configuration import SheetConfiguration
from synth.motion.beginning import Wanted, beginning
from synth.motion.branches import Branches
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage, linkage_of_sheet
from synth.motion.placement import moved
from synth.motion.second_order import rates_at
from synth.verdict.words import flaps_of

__all__ = ["GeneralPose", "general_pose"]


@dataclass(frozen=True, slots=True)
class GeneralPose:
    """A linkage at a pose that is like those beside it.

    Attributes
    ----------
    linkage : PosedLinkage
        Its pose is this one.
    rates : float[J, M]
        Orthonormal columns span the rates of its motions.
    branch : int or None
        The way by which it was reached; None where the pose given is a general one.
    sheet : Sheet or None
        Placed so; None of what is no sheet.
    mechanism : SheetMechanism or None
        Of the sheet.
    rigid : bool
        Whether it is proved that nothing moves from the pose given, whatever rates there are.
    """

    linkage: PosedLinkage
    rates: Floats
    branch: int | None
    sheet: Sheet | None = None
    mechanism: SheetMechanism | None = None
    rigid: bool = False

    @property
    def freedoms(self) -> int:
        """Finite ones, M."""
        return 0 if self.rigid else int(self.rates.shape[1])

    @property
    def flaps(self) -> tuple[int, ...]:
        """Places of the joints in no loop: of flaps, and of what hangs on them."""
        loose = set(flaps_of(self.linkage.graph))
        return tuple(place for place, joint in enumerate(self.linkage.graph.joints) if joint in loose)

    def __repr__(self) -> str:
        return f"<GeneralPose: {self.freedoms} freedoms of {self.linkage!r}>"


def general_pose(configuration: Configuration, branch: int | str | None = None) -> GeneralPose:
    """Return a mechanism at a regular configuration near its own, which may be singular.

    The branch is given by its number or signs; by default the assignment chooses it. Raises `UnsolvableError` if
    no motion was found though that is not proved, or if there are too many joints or none, `NumericalError` if the
    configuration reached is singular too.
    """
    linkage, found = configuration.linkage, configuration.branches
    if not configuration.joints:
        raise UnsolvableError("there is nothing to advise: no joints between links")
    if found is None:
        raise UnsolvableError(
            "advice requires the motion branches, and for so large a mechanism not all are looked for"
        )
    sheet = configuration if isinstance(configuration, SheetConfiguration) else None
    here: tuple[Sheet | None, SheetMechanism | None] = (None, None)
    if sheet is not None:
        here = sheet.sheet, sheet.mechanism
    if found.no_motion == "proved":
        rates = rates_at(configuration.closure, linkage.angles)
        return GeneralPose(linkage, rates, None, sheet=here[0], mechanism=here[1], rigid=True)
    number, _ = beginning(configuration, Wanted(branch))
    if number is None:
        return GeneralPose(linkage, _rates(linkage, found, number), None, *here)
    angles = found.branches[number].sample
    if sheet is None:
        posed = moved(linkage, angles)
    else:
        here = (sheet.at(angles), sheet.mechanism)
        posed = linkage_of_sheet(here[0], sheet.mechanism)
    return GeneralPose(posed, _rates(posed, found, number), number, *here)


def _rates(linkage: PosedLinkage, found: Branches, number: int | None) -> Floats:
    """Return the rates at a pose, if there are as many as freedoms."""
    rates = rates_at(ClosureEquations(linkage), linkage.angles)
    freedoms = found.branches[number or 0].freedoms
    if freedoms != rates.shape[1]:
        first = numbered(rates.shape[1], "infinitesimal degree of freedom", "infinitesimal degrees of freedom")
        finite = "an unknown number" if freedoms is None else str(freedoms)
        raise NumericalError(
            f"no regular configuration was found: {first} beside {finite} of finite motion, "
            f"at fold angles up to {degrees(float(np.abs(linkage.angles).max())):.3g}°"
        )
    return rates
