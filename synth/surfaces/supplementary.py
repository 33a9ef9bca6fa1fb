"""The linkages on the joint lines of a spherical four-bar, each with its cones (Hyatt et al. 2020, section 2.3).

Theory: docs/theory/four-bars.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import degrees
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, numbered
from graphs.printing import Block, Printed, TableBlock
from synth.fourbar.closing import checked_link_angles, spherical_differences
from synth.fourbar.joint_lines import supplementary
from synth.surfaces.cone import ConeMap, map_to_cones
from synth.surfaces.mapping import in_degrees

__all__ = ["SupplementaryLinkages", "supplementary_linkages"]


@dataclass(frozen=True, slots=True)
class SupplementaryLinkages(Printed):
    """The 16 linkages that share the joint lines of a four-bar: itself, and 15 others.

    Attributes
    ----------
    turned : tuple of tuples of int
        The joints, from 1, whose other end is taken; of the first linkage none. Link i lies between joints i and
        i + 1.
    maps : tuple of ConeMap
        The link angles and the cones of each.

    Examples
    --------
    >>> supplementary_linkages(np.radians([85, 120, 95, 45])).turned[3]
    (3, 4)
    """

    turned: tuple[tuple[int, ...], ...]
    maps: tuple[ConeMap, ...]

    @property
    def distinct(self) -> int:
        """How many have angles of their own: those with all joints turned, or none, are alike."""
        return len({tuple(np.round(one.angles, 12)) for one in self.maps})

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        rows = [
            (
                " ".join(map(str, turned)) or "none",
                ", ".join(f"{angle:.6g}" for angle in in_degrees(one.angles)),
                f"{_fourth(one):.6g}",
                _cones(one),
            )
            for turned, one in zip(self.turned, self.maps, strict=True)
        ]
        heads = ("joints turned", "link angles (deg)", "T4 (deg)", "cones: lambda (deg)")
        return [
            f"{len(self.maps)} linkages on the same joint lines, {self.distinct} with different link angles",
            TableBlock(heads, rows, ["T4 (deg)"]),
        ]

    def __repr__(self) -> str:
        return f"<SupplementaryLinkages: {numbered(len(self.maps), 'linkage')}, {self.distinct} different>"

    def to_json(self) -> dict[str, Any]:
        """Return the linkages as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "linkages": [
                {
                    "joints_turned": list(turned),
                    "angles_deg": in_degrees(one.angles),
                    "T4_deg": _fourth(one),
                    "cones": one.to_json()["cones"],
                    "families": one.to_json()["families"],
                }
                for turned, one in zip(self.turned, self.maps, strict=True)
            ],
            "different": self.distinct,
        }


def _fourth(one: ConeMap) -> float:
    return in_degrees([float(spherical_differences(np.array(one.angles))[3])])[0]


def _cones(one: ConeMap) -> str:
    told = [f"{degrees(cone.size):.8g} {cone.circuit}" for cone in one.cones]
    told += [
        f"{degrees(low):.6g} to {degrees(high):.6g} {family.circuit}"
        for family in one.families
        for low, high in [family.interval]
    ]
    return ", ".join(told) or "none"


def supplementary_linkages(angles: npt.ArrayLike) -> SupplementaryLinkages:
    """Return the linkages on the joint lines of a spherical four-bar, and the cones on which each lies.

    Parameters
    ----------
    angles : float[4]
        Link angles in loop order, radians.

    Raises
    ------
    InvariantError
        If there are not four, or they are out of range or cannot close.

    Examples
    --------
    >>> found = supplementary_linkages(np.radians([85, 120, 95, 45]))
    >>> len(found.maps), found.distinct, [len(one.cones) for one in found.maps[:4]]
    (16, 8, [2, 0, 2, 0])
    """
    given = checked_link_angles(angles)
    if len(given) != 4:
        raise InvariantError("four-bar", f"{len(given)} link angles", "the four of a four-bar")
    turned = [tuple(joint + 1 for joint in range(4) if ends[joint]) for ends in product((0, 1), repeat=4)]
    return SupplementaryLinkages(tuple(turned), tuple(map_to_cones(one) for one in supplementary(given)))
