"""What linkages do in the conformed position, as the command line asks: of angles, of steps, or of a file.

Theory: docs/theory/behaviour.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, pi
from typing import Any

import numpy as np

from graphs.arrays import Floats
from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.ids import LinkId
from graphs.mechanism.conical import ConicalLinkage, ring
from graphs.mechanism.sc import SCGraph
from graphs.printing import Block, Printed, TableBlock, plain
from synth.conformed.behaviours import Behaviour, Way, behaviour, icrl, instant_centres
from synth.conformed.rates import ConformedChain
from synth.conformed.twelve_cases import TableRow, table_row
from synth.surfaces.circuit import azimuths, closing_step
from synth.surfaces.cone import map_to_cones
from synth.surfaces.linkages import map_linkage
from synth.surfaces.mapping import in_degrees, joints_text

__all__ = ["LinkageBehaviour", "OnCone", "cone_of_number", "linkage_on_cones", "loop_of_steps", "loop_on_cones"]

_FAR = 1e12


@dataclass(frozen=True, slots=True)
class OnCone:
    """A linkage at its conformed position; without a cone angle, on any cone.

    Attributes
    ----------
    chain : SCGraph
    places : float[J]
        Azimuths of the joints, radians, in the order of the chain's joints.
    cone_angle : float or None
        lambda, radians; None: any.

    Examples
    --------
    >>> loop_of_steps(np.radians([40, 50, 50])).behaviour().way_of(2)
    'outward'
    """

    chain: SCGraph
    places: Sequence[float]
    cone_angle: float | None

    def linkage(self) -> ConicalLinkage:
        """Return the linkage as it lies here, by steps and lambda, as it can be written."""
        return ConicalLinkage.placed(self.chain, self.places, self.cone_angle)

    def behaviour(self, ground: LinkId | None = None) -> LinkageBehaviour:
        """Return what the linkage does, one link fixed: its own ground link, or the first, if none is named."""
        chain = ConformedChain.of(self.chain, ground)
        places = np.array(self.places)
        return LinkageBehaviour(chain, places, self.cone_angle, behaviour(chain, places))


@dataclass(frozen=True, slots=True)
class LinkageBehaviour(Printed):
    """What a linkage does in the conformed position, one link fixed.

    Attributes
    ----------
    chain : ConformedChain
        Its first link is fixed.
    places : float[J]
        Azimuths of the joints, radians.
    cone_angle : float or None
        lambda, radians; None for any cone.
    behaviour : Behaviour
    """

    chain: ConformedChain
    places: Floats
    cone_angle: float | None
    behaviour: Behaviour

    def table_row(self) -> TableRow | None:
        """Return the row of Table 4 (Hyatt et al. 2021) of a four-bar that has one."""
        around = self._around()
        if around is None:
            return None
        try:
            return table_row(self.places[around])
        except InvariantError:  # two joints on one ruling line have no row
            return None

    def mobile(self) -> tuple[bool, bool]:
        """Return whether the linkage can be intramobile, and extramobile."""
        row = self.table_row()
        both = bool(self.behaviour.one_way)
        return (both, both) if row is None else (row.intramobile, row.extramobile)

    def _around(self) -> list[int] | None:
        """Return the joints O, A, B, C of a four-bar whose ground link is C O."""
        chain = self.chain
        if len(chain.links) != 4 or len(chain.joints) != 4 or any(len(joints) != 2 for joints in chain.joints_of):
            return None
        c, o = chain.joints_of[0]
        a = next(sum(joints) - o for joints in chain.joints_of[1:] if o in joints)
        return [o, a, 6 - o - a - c, c]

    def way_of(self, link: int) -> str:
        """Return which way a link, by its number, can go: ``inward``, ``outward``, ..."""
        return Way(int(self.behaviour.ways[link])).name.lower()

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        row, chain = self.table_row(), self.chain
        blocks: list[Block] = [self._verdict()]
        if row is not None:
            special = ", a chord is a diameter" if row.special else ""
            blocks.append(f"Table 4: case {row.case}, {row.configuration}, {row.column}{special}")
        lines = icrl(self.behaviour.motion.motions) + 0.0  # no minus before a zero
        rows = [
            (
                plain(link),
                joints_text([chain.joints[joint] for joint in joints]),
                "fixed" if number == 0 else self.way_of(number),
                "" if np.isnan(lines[number]) else f"{degrees(lines[number]):.6g}",
            )
            for number, (link, joints) in enumerate(zip(chain.links, chain.joints_of, strict=True))
        ]
        return [*blocks, TableBlock(("link", "joints", "moves", "ICRL (deg)"), rows, ["ICRL (deg)"])]

    def _verdict(self) -> str:
        """Say in a line which way the linkage can go."""
        where = "any cone" if self.cone_angle is None else f"lambda {degrees(self.cone_angle):.10g} degrees"
        motion = self.behaviour.motion
        freedoms = int(motion.freedoms)
        if motion.undecided:
            verdict = "indeterminate: a singular value is near the noise"
        elif freedoms == 1:
            words = [word for word, so in zip(("intramobile", "extramobile"), self.mobile(), strict=True) if so]
            verdict = "can be " + " or ".join(words) if words else "transmobile"
        else:
            verdict = f"{freedoms} infinitesimal freedoms: no one way"
        if motion.nearly:
            verdict += f"; nearly mobile: {int(motion.nearly)} more freedom(s) but for small errors"
        return f"{where}, link {plain(self.chain.links[0])} fixed: {verdict}"

    def to_json(self) -> dict[str, Any]:
        """Return the behaviour as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        motion, chain = self.behaviour.motion, self.chain
        lines, row = icrl(motion.motions), self.table_row()
        intra, extra = self.mobile()
        return {
            "lambda_deg": None if self.cone_angle is None else degrees(self.cone_angle),
            "azimuths_deg": dict(zip(map(str, chain.joints), in_degrees(self.places.tolist()), strict=True)),
            "ground": chain.links[0],
            "freedoms": None if motion.undecided else int(motion.freedoms),
            "rank": None if motion.undecided else int(motion.rank()),
            "nearly_mobile": int(motion.nearly),
            "singular_values": motion.singular_values.tolist(),
            "intramobile": intra,
            "extramobile": extra,
            "links": [
                {
                    "link": link,
                    "joints": [chain.joints[joint] for joint in joints],
                    "way": self.way_of(number),
                    "icrl_deg": _finite(degrees(lines[number])),
                    "instant_centre": _centre(motion.motions[number]),
                }
                for number, (link, joints) in enumerate(zip(chain.links, chain.joints_of, strict=True))
            ],
            "tangent": [joint for joint, is_so in zip(chain.joints, self.behaviour.tangent, strict=True) if is_so],
            "table4": None
            if row is None
            else {
                "case": row.case,
                "configuration": row.configuration,
                "column": row.column,
                "diameter": row.special,
            },
        }


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


def _centre(motion: Floats) -> list[float] | None:
    x, y = instant_centres(motion).tolist()
    return [x, y] if abs(x) < _FAR and abs(y) < _FAR else None


def linkage_on_cones(
    linkage: ConicalLinkage, cone_angle: float | None = None, *, tolerance: float = 1e-7
) -> list[OnCone]:
    """Return a linkage on each of its cones, from link angles or from steps.

    Parameters
    ----------
    linkage : ConicalLinkage
    cone_angle : float, optional
        lambda, radians, for steps; by default that of the linkage, or any.
    tolerance : float, optional
        How well loops of link angles must close together, radians.

    Returns
    -------
    list of OnCone
        One, if the linkage is given by steps.

    Raises
    ------
    UnsolvableError
        If a cone angle is named for link angles, which tell it themselves.

    Examples
    --------
    Steps close on any cone; link angles tell on which:

    >>> from graphs.loops.loop import Loop
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> pairs = [(0, 1), (1, 2), (2, 3), (3, 0)]
    >>> [one] = linkage_on_cones(ConicalLinkage(chain, steps=dict.fromkeys(pairs[:3], np.pi / 2)))
    >>> np.degrees(one.places).round(9).tolist(), one.cone_angle
    ([0.0, 90.0, 180.0, 270.0], None)
    >>> angles = dict(zip(pairs, np.radians([120, 95, 45, 85])))
    >>> [round(degrees(one.cone_angle), 3) for one in linkage_on_cones(ConicalLinkage(chain, angles=angles))]
    [13.998, 29.044]
    """
    if linkage.steps is not None:
        return [OnCone(linkage.chain, linkage.places(), cone_angle or linkage.cone_angle)]
    if cone_angle is not None:
        raise UnsolvableError("link angles tell the cone themselves: leave --lambda out")
    return [
        OnCone(linkage.chain, [cone.places[joint] for joint in linkage.chain.joints], cone.cone_angle)
        for cone in map_linkage(linkage, tolerance).cones
    ]


def cone_of_number(cones: Sequence[OnCone], number: int | None) -> OnCone:
    """Return the cone of a number, from 1, of the cones of a linkage; it is needed where there are several.

    Raises `UnsolvableError` if there is no cone, or several and no number, or none of this number.

    >>> cone_of_number(loop_on_cones(np.radians([120, 95, 45, 85])), None)
    Traceback (most recent call last):
    ...
    graphs.errors.UnsolvableError: the linkage lies on 2 cones, of 13.9984, 29.0445 degrees: expected --cone
    """
    if not cones:
        raise UnsolvableError("the linkage lies on no cone")
    if number is None and len(cones) > 1:
        told = ", ".join(f"{degrees(one.cone_angle or 0.0):.6g}" for one in cones)
        raise UnsolvableError(f"the linkage lies on {len(cones)} cones, of {told} degrees: expected --cone")
    if number is not None and number > len(cones):
        raise UnsolvableError(
            f"the linkage lies on {numbered(len(cones), 'cone')}: there is none of number {number}"
        )
    return cones[(number or 1) - 1]


def loop_on_cones(angles: Sequence[float]) -> list[OnCone]:
    """Return a loop of link angles (radians) on each of its cones.

    Parameters
    ----------
    angles : float[n]
        Link angles, radians.

    Returns
    -------
    list of OnCone

    Examples
    --------
    >>> [loop.behaviour().way_of(2) for loop in loop_on_cones(np.radians([120, 95, 45, 85]))]
    ['both', 'both']
    """
    return [
        OnCone(ring(len(angles)), azimuths(cone.steps).tolist(), cone.size) for cone in map_to_cones(angles).cones
    ]


def loop_of_steps(steps: Sequence[float], cone_angle: float | None = None) -> OnCone:
    """Return a loop from its steps round the cone (radians); the last is added if the rest do not close.

    Parameters
    ----------
    steps : float[n]
        Signed, radians, in [-pi, pi], none 0.
    cone_angle : float, optional
        lambda, radians; any cone without it.

    Returns
    -------
    OnCone

    Raises
    ------
    InvariantError
        If a step is none, or there are too few.

    Examples
    --------
    >>> loop = loop_of_steps(np.radians([120, 95, 45]))
    >>> np.degrees(loop.places).round(9).tolist()
    [0.0, 120.0, 215.0, 260.0]
    """
    given = list(steps)
    for place, step in enumerate(given):
        if not 0.0 < abs(step) <= pi + 1e-12:
            told = f"step {place + 1} is {degrees(step):.12g} degrees"
            raise InvariantError("step", told, "between -180 and 180, and not 0")
    last = float(closing_step(given))
    if abs(last) > 1e-9:
        given.append(last)
    if len(given) < 3:
        raise InvariantError("step", f"{len(given)} steps", "three or more")
    return OnCone(ring(len(given)), azimuths(given).tolist(), cone_angle)
