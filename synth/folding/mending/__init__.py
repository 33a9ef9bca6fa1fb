"""Rounded coordinates moved, within their precision, to ones that fold.

`nearest` finds the nearest mechanisms that move, with the branches that a pattern nearly has (`near`); `places`
says how a linkage depends on its vertices, `angles` which angles are meant to be alike, `fitting` moves the
vertices. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
