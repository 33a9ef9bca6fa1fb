"""Rounded coordinates moved, within their precision, to ones that fold.

`nearest` finds the branches that a pattern nearly has and the nearest mechanisms that move, `fitting` moves the
vertices. Theory: docs/theory/mending.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
