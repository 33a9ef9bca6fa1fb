"""A linkage of several loops, as a file gives it, on its cones.

Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.given import check_given
from graphs.mechanism.conical import ConicalLinkage, Pair
from graphs.printing import Block, Printed, TableBlock, plain
from synth.surfaces.cone import link_angles
from synth.surfaces.linkage_cones import CommonCone, CommonFamily, common_cones
from synth.surfaces.mapping import in_degrees, joints_text, signs_text
from synth.surfaces.several_loops import link_pairs, loop_steps

__all__ = ["LinkageMap", "angles_on", "by_angles", "map_linkage"]


@dataclass(frozen=True, slots=True)
class LinkageMap(Printed):
    """The cones on which a linkage of several loops lies.

    Attributes
    ----------
    linkage : ConicalLinkage
    cones : tuple of CommonCone
    families : tuple of CommonFamily
        Intervals of cones.
    """

    linkage: ConicalLinkage
    cones: tuple[CommonCone, ...]
    families: tuple[CommonFamily, ...]

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        blocks = [block for cone in self.cones for block in self._of_cone(cone)]
        for family in self.families:
            low, high = (degrees(x) for x in family.interval)
            told = "; ".join(
                f"{joints_text(loop.joints)}: {signs_text(signs)}, k {turns}"
                for loop, signs, turns in zip(self.linkage.chain.loops, family.signs, family.turns, strict=True)
            )
            blocks.append(f"every lambda between {low:.10g} and {high:.10g} degrees   ({told})")
            blocks += [family.caution] if family.caution else []
        return blocks or ["no cone is common to all loops"]

    def _of_cone(self, cone: CommonCone) -> list[Block]:
        chain = self.linkage.chain
        link_of = link_pairs(chain)
        loops = [
            (joints_text(loop.joints), circuit, signs_text(signs), str(turns))
            for loop, circuit, signs, turns in zip(chain.loops, cone.circuits, cone.signs, cone.turns, strict=True)
        ]
        angles = [
            (plain(link_of[a, b]), joints_text((a, b)), f"{angle:.8g}")
            for (a, b), angle in angles_on(self.linkage, cone).items()
        ]
        return [
            f"lambda {degrees(cone.cone_angle):.10g} degrees",
            *([cone.caution] if cone.caution else []),
            TableBlock(("loop", "circuit", "signs", "k"), loops, ["k"]),
            TableBlock(("link", "joints", "angle (deg)"), angles, ["angle (deg)"]),
        ]

    def __repr__(self) -> str:
        return f"<LinkageMap: {self.linkage!r}, {numbered(len(self.cones), 'cone')}>"

    def to_json(self) -> dict[str, Any]:
        """Return what scripts rely on (docs/command-json.md): circuit, signs and k are lists, an item a loop."""
        return {
            "loops": [list(map(str, loop.joints)) for loop in self.linkage.chain.loops],
            "cones": [
                {
                    "lambda_deg": degrees(cone.cone_angle),
                    "circuit": list(cone.circuits),
                    "signs": [list(signs) for signs in cone.signs],
                    "k": list(cone.turns),
                    "azimuths_deg": dict(
                        zip(map(str, cone.places), in_degrees(cone.places.values()), strict=True)
                    ),
                    "link_angles_deg": [
                        [str(a), str(b), angle] for (a, b), angle in angles_on(self.linkage, cone).items()
                    ],
                    "residual_deg": degrees(cone.residual),
                    "caution": cone.caution or None,
                }
                for cone in self.cones
            ],
            "families": [
                {
                    "lambda_deg": [degrees(x) for x in family.interval],
                    "signs": [list(signs) for signs in family.signs],
                    "k": list(family.turns),
                    "caution": family.caution or None,
                }
                for family in self.families
            ],
        }


def angles_on(linkage: ConicalLinkage, cone: CommonCone) -> dict[Pair, float]:
    """Return the link angles between all joints of each link on a cone, degrees."""
    places = cone.places
    return {
        (a, b): in_degrees([float(link_angles(places[b] - places[a], cone.cone_angle))])[0]
        for a, b in link_pairs(linkage.chain)
        if a in places and b in places
    }


def by_angles(linkage: ConicalLinkage) -> ConicalLinkage:
    """Return a linkage given by steps and lambda as one that is given by all its link angles.

    Parameters
    ----------
    linkage : ConicalLinkage
        One that is given by link angles is returned as it is.

    Returns
    -------
    ConicalLinkage

    Raises
    ------
    UnsolvableError
        If lambda is not given.

    Examples
    --------
    Four quarter turns round a cone of lambda 45 degrees are links of 60 degrees:

    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> steps = {(0, 1): np.pi / 2, (1, 2): np.pi / 2, (2, 3): np.pi / 2}
    >>> given = by_angles(ConicalLinkage(chain, steps=steps, cone_angle=np.pi / 4))
    >>> {pair: round(degrees(angle), 9) for pair, angle in given.angles.items()}
    {(0, 3): 60.0, (0, 1): 60.0, (1, 2): 60.0, (2, 3): 60.0}
    """
    if linkage.steps is None:
        return linkage
    if linkage.cone_angle is None:
        raise UnsolvableError("steps without a cone angle have no link angles: expected 'lambda_deg'")
    at = dict(zip(linkage.chain.joints, linkage.places(), strict=True))
    angles = {(a, b): float(link_angles(at[b] - at[a], linkage.cone_angle)) for a, b in link_pairs(linkage.chain)}
    return ConicalLinkage(linkage.chain, angles=angles)


def map_linkage(linkage: ConicalLinkage, tolerance: float = 1e-7) -> LinkageMap:
    """Return the cones of a linkage: from its link angles, or, given steps, the one named or every one.

    Parameters
    ----------
    linkage : ConicalLinkage
    tolerance : float, optional
        How well its loops must close together, radians; a loop of less than a turn in proportion.

    Returns
    -------
    LinkageMap

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> steps = {(i, i + 1): np.pi / 2 for i in range(3)}
    >>> [family.interval[0] for family in map_linkage(ConicalLinkage(chain, steps=steps)).families]
    [0.0]
    """
    check_given("map_linkage", linkage, ConicalLinkage)
    if linkage.angles is not None:
        return LinkageMap(linkage, *common_cones(linkage.chain, linkage.angles, tolerance))
    places = np.array(linkage.places())
    loops = loop_steps(linkage.chain, places)
    mirror = -1 if loops[0].steps[0] < 0 else 1
    signs = tuple(tuple((mirror * np.sign(loop.steps)).astype(int).tolist()) for loop in loops)
    turns = tuple(int(mirror * loop.circuits.turns) for loop in loops)
    if linkage.cone_angle is None:
        return LinkageMap(linkage, (), (CommonFamily((0.0, np.pi / 2), signs, turns),))
    circuits = tuple(str(loop.circuits.names()) for loop in loops)
    residual = max(abs(float(loop.circuits.residual)) for loop in loops)
    named = dict(zip(linkage.chain.joints, places.tolist(), strict=True))
    return LinkageMap(linkage, (CommonCone(linkage.cone_angle, signs, turns, circuits, named, residual),), ())
