"""Whether a four-bar that guides a body can be made of a cone: the link from synthesis to developable mechanisms.

A dyad fixes the lines of its two axes, not which end of an axis a link reaches. With the other end of an axis the
two links there have the supplements of their angles: up to eight linkages with the same joint lines, and the same
motion of the body (Hyatt et al. 2020, section 2.3). Each is mapped to cones apart.
Theory: docs/theory/guidance.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np

from synth.fourbar.joint_lines import supplementary
from synth.guidance.fourbars import GuidedFourBar
from synth.surfaces.loop_maps import map_to_cones
from synth.surfaces.mapping import FamilyOfCircles, MappedLoop

__all__ = ["ConicalForm", "conical_forms"]


@dataclass(frozen=True, slots=True)
class ConicalForm:
    """A linkage with the joint lines of a four-bar, and the cones that its four axes are rulings of.

    Attributes
    ----------
    link_angles : tuple of float
        gamma, alpha, eta, beta, radians.
    cones : tuple of MappedLoop
        With lambda, circuit, signs of the projected angles.
    families : tuple of FamilyOfCircles
        Intervals of cones.
    """

    link_angles: tuple[float, ...]
    cones: tuple[MappedLoop, ...]
    families: tuple[FamilyOfCircles, ...]

    def cones_json(self) -> list[dict[str, Any]]:
        """Return the cones as plain data."""
        links = [degrees(angle) for angle in self.link_angles]
        return [
            {
                "link_angles_deg": links,
                "lambda_deg": degrees(cone.size),
                "circuit": cone.circuit,
                "signs": list(cone.signs),
                "k": cone.turns,
                **({"caution": cone.caution} if cone.caution else {}),
            }
            for cone in self.cones
        ]

    def families_json(self) -> list[dict[str, Any]]:
        """Return the intervals of cones as plain data."""
        links = [degrees(angle) for angle in self.link_angles]
        return [
            {
                "link_angles_deg": links,
                "interval_deg": [degrees(end) for end in family.interval],
                "circuit": family.circuit,
                "signs": list(family.signs),
                **({"caution": family.caution} if family.caution else {}),
            }
            for family in self.families
        ]


def conical_forms(four_bar: GuidedFourBar) -> tuple[ConicalForm, ...]:
    """Return the linkages on the joint lines of a four-bar that lie on a cone; none if it is not developable.

    Those with the least sum of link angles come first.

    Parameters
    ----------
    four_bar : GuidedFourBar

    Returns
    -------
    tuple of ConicalForm

    Examples
    --------
    >>> from synth.guidance.five import dyads_of_five
    >>> from synth.guidance.fourbars import four_bars
    >>> from synth.guidance.orientations import Orientations
    >>> from scipy.spatial.transform import Rotation
    >>> angles = [(0, 0), (40, 10), (70, 60), (120, 100), (200, 170)]
    >>> orientations = Orientations.from_rotation(Rotation.from_euler("ZX", angles, degrees=True))
    >>> best = four_bars(orientations, dyads_of_five(orientations).dyads)[0]
    >>> all(form.cones or form.families for form in conical_forms(best))
    True
    """
    every = supplementary(four_bar.link_angles)
    _, first = np.unique(every.round(9), axis=0, return_index=True)
    forms = []
    for angles in sorted((every[k] for k in first), key=lambda one: float(one.sum())):
        found = map_to_cones(angles)
        if found.cones or found.families:
            forms.append(ConicalForm(found.angles, found.cones, found.families))
    return tuple(forms)
