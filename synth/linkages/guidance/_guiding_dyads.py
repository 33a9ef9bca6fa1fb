"""The dyads that guide a body through orientations, by what their number requires.

Three with chosen fixed axes, four on curves (`dyads`), five all, more by least squares (`synthesis`), many sets of
five at once (`many`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import Any, overload

from graphs.errors import InvariantError, numbered
from graphs.printing import Block, Printed, TableBlock
from graphs.types import Floats
from synth.linkages.guidance.dyad_tables import DyadTable, dyads_of_sets
from synth.linkages.guidance.dyads import Dyad, dyads_of_four, dyads_of_three
from synth.linkages.guidance.order import direction_words
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.guidance.synthesis import DyadsOfFive, dyads_by_least_squares, dyads_of_five


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
            f"{len(self.orientations)} orientations: {numbered(len(self.dyads), 'dyad')}",
            TableBlock(heads, rows, ["dyad", "link", "misfit"]),
        ]
        if self.all_found is not None:
            largest = f"largest residual {self.all_found.residual:.0e}"
            blocks.append(f"all six solutions found, {self.all_found.complex_solutions} of them complex; {largest}")
        return blocks

    def __repr__(self) -> str:
        return f"<GuidingDyads: {len(self.orientations)} orientations, {numbered(len(self.dyads), 'dyad')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the dyads as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        document: dict[str, Any] = {
            "orientations": len(self.orientations),
            "dyads": [dyad.to_json() for dyad in self.dyads],
        }
        if self.all_found is not None:
            document |= {
                "complex": self.all_found.complex_solutions,
                "residual": self.all_found.residual,
                "smallest_singular_value": self.all_found.smallest_singular_value,
            }
        return document


@overload
def guiding_dyads(
    orientations: Orientations, axes: Sequence[Sequence[float]] = (), samples: int = 36
) -> GuidingDyads: ...


@overload
def guiding_dyads(orientations: Floats, axes: Sequence[Sequence[float]] = (), samples: int = 36) -> DyadTable: ...


def guiding_dyads(
    orientations: Orientations | Floats, axes: Sequence[Sequence[float]] = (), samples: int = 36
) -> GuidingDyads | DyadTable:
    """Return the RR dyads that guide a body through orientations: of five all, of more those that fit best.

    Parameters
    ----------
    orientations : Orientations, or float[N, 5, 3, 3]
        Three or more; or the rotation matrices of many sets of five, of which `dyads_of_sets` returns all dyads.
    axes : sequence of (x, y, z), optional
        Fixed axes to take, for three orientations, and for no other number, else `InvariantError`.
    samples : int, optional
        Dyads on each curve, for four orientations.

    Examples
    --------
    >>> import numpy as np
    >>> guiding_dyads(Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7]), [(3, 1, 2)])
    <GuidingDyads: 3 orientations, 1 dyad>
    """
    if not isinstance(orientations, Orientations):
        return dyads_of_sets(orientations)
    if axes and len(orientations) != 3:
        raise InvariantError("axes", f"fixed axes require 3 orientations, got {len(orientations)}")
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
