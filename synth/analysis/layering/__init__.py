"""Layers of a crease pattern folded flat: whether it can be, in how many orders of its panels, and each of them.

Local conditions first (`local`), then the folded image and its cells (`image`), what the order of two panels over a
cell has to do with others (`constraints`), and the number of orders that keep all of that (`counting`).

Theory: docs/theory/layer-orders.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
