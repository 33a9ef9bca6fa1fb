"""Layer orders at a configuration at which some panels lie on each other. Theory: docs/theory/layer-orders.md."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import pi, prod
from pathlib import Path
from typing import Any

import numpy as np

from graphs.errors import UnsolvableError, check_argument, numbered
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, TableBlock
from graphs.types import Floats
from synth.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.layering.constraints import LayerConstraints, layer_constraints
from synth.layering.counting.job import Counter
from synth.layering.counting.settling import counted
from synth.layering.orders import CONTRADICTION, FlatFolding, components_of
from synth.layering.planes import StackedPanels, stacked_panels
from synth.layering.reduction import reduced

Height = tuple[int, int]
"""Two panels, the first above the second, as seen from the side that the normal of their plane points to."""


@dataclass(frozen=True, eq=False, repr=False)
class LayersInSpace(FlatFolding):
    """The layer orders of a crease pattern at a configuration. It prints as ``synth layers`` does.

    Attributes
    ----------
    configuration : SheetConfiguration
    points : float[V, 3]
        The places of the vertices.
    stacked : StackedPanels, optional
        The planes in which panels lie on each other; None if none do: then there is one order.
    signs : mapping of joint id to bool
        Whether each crease at which panels lie on each other is a valley, where that is known.

    Panels that are joined by unfolded creases count as one, by the lowest of their numbers. All else is as in
    `FlatFolding`.
    """

    configuration: SheetConfiguration = field(kw_only=True)
    points: Floats = field(kw_only=True)
    stacked: StackedPanels | None = field(kw_only=True)
    signs: Mapping[int, bool] = field(kw_only=True)

    @cached_property
    def valleys(self) -> dict[int, bool]:
        """Whether each crease at which panels lie on each other is a valley, by its joint."""
        return dict(self.signs)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        planes = () if self.stacked is None else self.stacked.planes
        return {
            "foldable": self.foldable,
            "orders": self.orders,
            "components": [component.to_json() for component in self.components],
            "fault": self.fault or None,
            "planes": [{"normal": plane.frame[2].tolist(), "panels": list(plane.plates)} for plane in planes],
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        if self.stacked is None:
            return ["No panels lie on each other at this configuration: one layer order."]
        planes = self.stacked.planes
        if not self.foldable:
            blocks: list[Block] = [f"Panels pass through each other at this configuration: {self.fault}."]
        else:
            orders = numbered(self.orders, "layer order")
            blocks = [f"Panels lie on each other at this configuration, in {orders} (proved: every order is counted)."]
        rows = [
            (
                str(number),
                ", ".join(f"{x + 0.0:.4g}" for x in plane.frame[2].round(12)),
                " ".join(map(str, plane.plates)),
            )
            for number, plane in enumerate(planes)
        ]
        blocks.append(TableBlock(("plane", "normal", "panels"), rows, ("plane",)))
        if self.components:
            several = [
                (str(number), str(component.orders), " ".join(map(str, component.panels)))
                for number, component in enumerate(self.components)
            ]
            blocks.append(TableBlock(("component", "orders", "panels"), several, ("component", "orders")))
        return blocks

    def __repr__(self) -> str:
        return f"<LayersInSpace: {numbered(self.orders, 'layer order')}>"


def layers_at(
    mechanism: Sheet | SheetConfiguration | str | Path, *, frame: int | None = None, precision: float | None = None
) -> LayersInSpace:
    """Return the layer orders of a crease pattern at the configuration of its coordinates.

    Where panels lie on each other, a layer order says which one is on top; elsewhere there is nothing to order. Seen
    along a segment, the paper goes from one plane to another without passing through itself.

    Parameters
    ----------
    mechanism : Sheet, SheetConfiguration, or the path of a file
    frame : int, optional
        The frame of the file; 0 is the key frame.
    precision : float, optional
        The error of a coordinate, in its unit, as for `synth.mobility`.

    Returns
    -------
    LayersInSpace
        `orders` is their number: 1 where no panels lie on each other, 0 where every order has the paper pass through
        itself.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or its loops are not closed.

    Examples
    --------
    A strip of three squares, both creases folded by 180 degrees as valleys: the outer squares are in one place.

    >>> from math import pi
    >>> corners = ((0, 0, 0), (1, 0, 0), (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 1, 0), (1, 1, 0))
    >>> faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6))
    >>> strip = Sheet(8, ((1, 5), (2, 6)), "VV", faces, corners, fold_angles=(pi, pi))
    >>> layers_at(strip).orders
    2
    """
    if isinstance(mechanism, SheetConfiguration):
        at = mechanism
    else:
        from graphs.files.accepted import mechanism_for

        sheet = mechanism_for("layers_at", mechanism, Sheet)
        assert isinstance(sheet, Sheet)
        at = configuration_of_sheet(sheet, frame=frame, precision=precision, mend=False)
    check_argument("layers_at", at, SheetConfiguration)
    return layers_in_space(at, lambda problems: list(map(counted, problems)))


def layers_in_space(
    at: SheetConfiguration, count: Counter, angles: Floats | None = None, above: Sequence[Height] = ()
) -> LayersInSpace:
    """Return the layer orders of a configuration, or of others of the same sheet.

    Parameters
    ----------
    at : SheetConfiguration
    count : callable
        Takes problems, and returns how many solutions each has.
    angles : float[J], optional
        Fold angles, radians, by default those of the configuration.
    above : sequence of (int, int), optional
        Panels of which the first is known to be above the second.

    Examples
    --------
    >>> import synth
    >>> from synth.layering.counting.settling import counted
    >>> at = synth.moving.configuration_of(synth.read("data/patterns/bird-base.fold"))
    >>> layers_in_space(at, lambda problems: list(map(counted, problems)))
    <LayersInSpace: 1 layer order>
    """
    angles = at.linkage.angles if angles is None else angles
    points = at.placed(angles[None]).points[0]
    stacked = stacked_panels(at.sheet, at.mechanism, points, angles, at.tolerances)
    about = (at.sheet, at.mechanism, at.precision, 0.0, ())
    if stacked is None:
        return LayersInSpace(*about, None, 0.0, (), 1, "", configuration=at, points=points, stacked=None, signs={})
    signs = _signs(at, angles, stacked)
    image = stacked.image
    constraints = layer_constraints(image)
    known, _ = constraints.creases(signs)
    more = [literal for upper, lower in above for literal in literals_of(constraints, upper, lower)]
    left = reduced(constraints, np.concatenate([known, np.array(more, dtype=np.int64)]))
    parts = () if left is None else components_of(constraints, left, count)
    orders = 0 if left is None else prod(part.orders for part in parts)
    return LayersInSpace(
        *about, image, 0.0, parts if orders else (), orders, "" if orders else CONTRADICTION, None, constraints, left,
        configuration=at, points=points, stacked=stacked, signs=signs,
    )  # fmt: skip


def _signs(at: SheetConfiguration, angles: Floats, stacked: StackedPanels) -> dict[int, bool]:
    """Return whether creases at which panels lie on each other are valleys, where that is known.

    It is if the crease was open where the sheet began to move, or the file says so.
    """
    column = {joint: place for place, joint in enumerate(at.joints)}
    given = at.sheet.fold_angles
    signs = {}
    for joint in stacked.creases:
        place = column[joint]
        opened = abs(float(at.linkage.angles[place])) < pi - at.tolerances.same_configuration
        if opened or at.sheet.assignments[joint] in "MV" or (given is not None and given[joint]):
            signs[joint] = bool(angles[place] > 0.0)
    return signs


def literals_of(constraints: LayerConstraints, upper: int, lower: int) -> list[int]:
    """Return the literals that say that a plate is above another, one for each variable."""
    table = constraints.table
    rows = (table.panels == (min(upper, lower), max(upper, lower))).all(axis=1)
    return [2 * variable + (upper > lower) for variable in np.unique(table.variable[rows]).tolist()]
