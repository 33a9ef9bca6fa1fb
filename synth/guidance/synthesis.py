"""The dyads of orientations, by the method that their number asks for.

Theory: docs/theory/dyads.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import Any

from graphs.errors import InvariantError, numbered
from graphs.printing import Block, Printed, TableBlock
from synth.guidance.dyads import Dyad, dyads_of_three
from synth.guidance.five import DyadsOfFive, dyads_of_five
from synth.guidance.four import dyads_of_four
from synth.guidance.hoop_method import direction_words
from synth.guidance.many import dyads_by_least_squares
from synth.guidance.orientations import Orientations

__all__ = ["GuidingDyads", "guiding_dyads"]


@dataclass(frozen=True, slots=True, eq=False)
class GuidingDyads(Printed):
    """The dyads that guide a body through orientations.

    Attributes
    ----------
    orientations : Orientations
    dyads : tuple of Dyad
    all_found : DyadsOfFive or None
        Of five orientations: what shows that none is missing.
    """

    orientations: Orientations
    dyads: tuple[Dyad, ...]
    all_found: DyadsOfFive | None = None

    def blocks(self) -> list[Block]:
        """Return the table, and what shows that no dyad is missing."""
        heads = ("dyad", "G", "W (body)", "link", "residual", "misfit", "in order")
        rows = [
            (
                str(number),
                *(" ".join(f"{x:9.6f}" for x in axis) for axis in (one.fixed, one.moving)),
                f"{degrees(one.link_angle):.3f}",
                f"{one.residual:.0e}",
                f"{degrees(one.misfit):.4f}",
                direction_words(one.direction),
            )
            for number, one in enumerate(self.dyads, start=1)
        ]
        blocks: list[Block] = [
            f"{len(self.orientations)} orientations: {len(self.dyads)} dyad(s)",
            TableBlock(heads, rows, ["dyad", "link", "misfit"]),
        ]
        if self.all_found is not None:
            largest = f"largest residual {self.all_found.residual:.0e}"
            blocks.append(
                f"all six solutions found, {self.all_found.complex_solutions} of them complex; {largest}"
            )
        return blocks

    def __repr__(self) -> str:
        return f"<GuidingDyads: {len(self.orientations)} orientations, {numbered(len(self.dyads), 'dyad')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the dyads as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        told: dict[str, Any] = {
            "orientations": len(self.orientations),
            "dyads": [dyad.to_json() for dyad in self.dyads],
        }
        if self.all_found is not None:
            told |= {
                "complex": self.all_found.complex_solutions,
                "residual": self.all_found.residual,
                "smallest_singular_value": self.all_found.smallest_singular_value,
            }
        return told


def guiding_dyads(
    orientations: Orientations, axes: Sequence[Sequence[float]] = (), samples: int = 36
) -> GuidingDyads:
    """Return the RR dyads that guide a body through orientations.

    Parameters
    ----------
    orientations : Orientations
        Three or more.
    axes : sequence of (x, y, z), optional
        Fixed axes to take, for three orientations, and for no other number.
    samples : int, optional
        Dyads on each curve, for four orientations.

    Returns
    -------
    GuidingDyads
        Of five orientations all there are, of more those that fit best.

    Raises
    ------
    InvariantError
        If axes are missing for three orientations, or named for more.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> angles = [(0, 0), (40, 10), (70, 60), (120, 100), (200, 170)]
    >>> five = Orientations.from_rotation(Rotation.from_euler("ZX", angles, degrees=True))
    >>> found = guiding_dyads(five)
    >>> len(found.dyads) + found.all_found.complex_solutions
    6
    """
    if axes and len(orientations) != 3:
        raise InvariantError("axes", f"axes are for three orientations; here are {len(orientations)}")
    if len(orientations) == 3:
        if not axes:
            raise InvariantError("axes", "three orientations leave the fixed axis to be chosen", "an axis")
        return GuidingDyads(orientations, dyads_of_three(orientations, axes))
    if len(orientations) == 4:
        return GuidingDyads(orientations, dyads_of_four(orientations, samples))
    if len(orientations) == 5:
        every = dyads_of_five(orientations)
        return GuidingDyads(orientations, every.dyads, every)
    return GuidingDyads(orientations, dyads_by_least_squares(orientations))
