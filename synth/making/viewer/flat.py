"""A crease pattern folded flat as a page shows it: the cells of its image, and layer orders to choose from."""

from dataclasses import dataclass
from itertools import islice

from graphs.errors import numbered
from graphs.types import Floats
from synth.analysis.layering.orders import FlatFolding, LayerOrder

_LISTED = 24
"""Orders of a component that are listed, at most."""
_PAIRS = 250_000
"""Pairs of panels over cells in all orders of a component that are listed, at most; two orders always are."""


@dataclass(frozen=True, slots=True)
class ShownComponent:
    """Panels whose order does not depend on that of others.

    `listed` are its first orders, each with the cells in which it differs from the first; `orders` is how many there
    are, as text, since numbers of a page have 53 bits only.
    """

    panels: tuple[int, ...]
    orders: str
    listed: tuple[dict[int, tuple[int, ...]], ...]

    def to_json(self) -> dict[str, object]:
        """Return plain data: `FlatComponentData` of web/src/page/types.js."""
        listed = [{str(cell): list(stack) for cell, stack in changed.items()} for changed in self.listed]
        return {"panels": list(self.panels), "orders": self.orders, "listed": listed}


@dataclass(frozen=True, slots=True)
class ShownFlat:
    """A sheet folded flat: `FlatData` of web/src/page/types.js.

    `nodes`, float[N, 2], are in units of the extent, `cells` the nodes round each, `flipped` says which panels show
    their back, and `stacks` are the panels over each cell in the first order, from the lowest up.
    """

    told: str
    nodes: Floats
    cells: tuple[tuple[int, ...], ...]
    flipped: list[bool]
    stacks: tuple[tuple[int, ...], ...]
    components: tuple[ShownComponent, ...]


def flat_shown(answer: FlatFolding) -> ShownFlat:
    """Return what a page shows of a sheet that folds flat.

    Examples
    --------
    >>> import synth
    >>> shown = flat_shown(synth.layers("data/patterns/bird-base.fold"))
    >>> shown.told, len(shown.cells), [len(component.listed) for component in shown.components]
    ('Folds flat, in 2 layer orders.', 2, [2])
    """
    image, first = answer.image, answer.order()
    assert image is not None
    pairs = sum(len(stack) * (len(stack) - 1) // 2 for stack in first.stacks)
    most = max(2, min(_LISTED, _PAIRS // max(pairs, 1)))
    components = tuple(
        ShownComponent(
            component.panels,
            str(component.orders),
            tuple(_changed(first, order) for order in islice(answer.orders_of(place), most)),
        )
        for place, component in enumerate(answer.components)
    )
    told = f"Folds flat, in {numbered(answer.orders, 'layer order')}."
    extent = float((image.nodes.max(axis=0) - image.nodes.min(axis=0)).max())
    return ShownFlat(told, image.nodes / extent, image.cells, image.panels.flipped.tolist(), first.stacks, components)


def _changed(first: LayerOrder, order: LayerOrder) -> dict[int, tuple[int, ...]]:
    pairs = zip(first.stacks, order.stacks, strict=True)
    return {cell: stack for cell, (before, stack) in enumerate(pairs) if stack != before}
