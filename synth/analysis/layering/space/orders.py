"""Layer orders at a configuration at which some panels lie on each other. Theory: docs/theory/layer-orders.md."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import Any

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.errors import numbered
from graphs.mechanism.precision import Precision
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, TableBlock
from graphs.types import Ints
from synth.analysis.layering.constraints import FALSE, TRUE, layer_constraints
from synth.analysis.layering.cores import core_lines, core_of
from synth.analysis.layering.counting.problem import Counter
from synth.analysis.layering.local import FlatVertex
from synth.analysis.layering.orders import CONTRADICTION, FlatFolding, components_of
from synth.analysis.layering.reduction import reduced
from synth.analysis.layering.space.planes import FoldedState, StackedPanels, stacked_panels

Height = tuple[int, int, int]
"""A cell and two panels, the first above the second: on the side that the normal of their plane points to."""


_LISTED = 12
"""Conditions that are printed; data has all."""


@dataclass(frozen=True, eq=False, repr=False)
class LayersInSpace(FlatFolding):
    """The layer orders of a crease pattern at a configuration. It prints as ``synth layers`` does.

    Attributes
    ----------
    state : FoldedState
    stacked : StackedPanels, optional
        The planes in which panels lie on each other; None if none do: then there is one order.

    Panels that are joined by unfolded creases count as one, by the lowest of their numbers. All else is as in
    `FlatFolding`.
    """

    state: FoldedState = field(kw_only=True)
    stacked: StackedPanels | None = field(kw_only=True)

    @cached_property
    def valleys(self) -> dict[int, bool]:
        """Whether each crease at which panels lie on each other is a valley, by its joint."""
        creases = () if self.stacked is None else self.stacked.creases
        return {joint: self.state.signs[joint] for joint in creases if joint in self.state.signs}

    def decided(self, variables: Ints) -> list[bool | None]:
        """Return whether the lower number is on top for each of some pairs; None where that is open."""
        if self._reduced is None:
            return [None] * len(variables)
        literals = self._reduced.literal[2 * variables]
        return [None if literal > FALSE else literal == TRUE for literal in literals.tolist()]

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        planes = () if self.stacked is None else self.stacked.planes
        return {
            "foldable": self.foldable,
            "orders": self.orders,
            "components": [component.to_json() for component in self.components],
            "fault": self.fault or None,
            "core": None if self.core is None else self.core.to_json(),
            "planes": [{"normal": plane.frame[2].tolist(), "panels": list(plane.plates)} for plane in planes],
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        if self.stacked is None:
            return ["No panels lie on each other at this configuration: one layer order."]
        planes = self.stacked.planes
        if not self.foldable:
            blocks: list[Block] = [f"Panels pass through each other at this configuration: {self.fault}."]
            blocks += [] if self.core is None else core_lines(self.core, _LISTED, flat=False)
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


def layers_in_space(state: FoldedState, count: Counter, above: Sequence[Height] = ()) -> LayersInSpace:
    """Return the layer orders of a sheet at a configuration.

    Parameters
    ----------
    state : FoldedState
    count : callable
        Takes problems, and returns how many solutions each has.
    above : sequence of (int, int, int), optional
        Cells, and two panels over each of which the first is known to be above the second.

    Examples
    --------
    >>> import synth
    >>> import synth.analysis.moving
    >>> from synth.analysis.layering.counting.propagation import counted
    >>> at = synth.analysis.moving.configuration_of(synth.read("data/patterns/bird-base.fold"))
    >>> layers_in_space(at.folded_state(), lambda problems: list(map(counted, problems)))
    <LayersInSpace: 1 layer order>
    """
    stacked = stacked_panels(state)
    if stacked is None:
        return LayersInSpace(*_about(state), None, 0.0, (), 1, "", state=state, stacked=None)
    return layers_of_stacked(state, stacked, count, above)


def layers_of_stacked(
    state: FoldedState, stacked: StackedPanels, count: Counter, above: Sequence[Height] = (), *, explain: bool = True
) -> LayersInSpace:
    """Return the layer orders of panels that lie on each other; `layers_in_space` finds them first."""
    constraints = layer_constraints(stacked.image)
    signs = {joint: state.signs[joint] for joint in stacked.creases if joint in state.signs}
    known, _ = constraints.creases(signs)
    more = [int(constraints.table.literals(*height)) for height in above]
    left = reduced(constraints, np.concatenate([known, np.array(more, dtype=np.int64)]))
    parts = () if left is None else components_of(constraints, left, count)
    orders = 0 if left is None else prod(part.orders for part in parts)
    core = core_of(stacked.image, signs, above) if explain and not orders else None
    fault = "" if orders else CONTRADICTION
    return LayersInSpace(
        *_about(state), stacked.image, 0.0, parts if orders else (), orders, fault, core,
        _constraints=constraints, _reduced=left, state=state, stacked=stacked,
    )  # fmt: skip


def _about(state: FoldedState) -> tuple[Sheet, SheetMechanism, Precision, float, tuple[FlatVertex, ...]]:
    return state.sheet, state.mechanism, state.precision, 0.0, ()
