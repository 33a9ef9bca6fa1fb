"""Linkages mapped to right cones and cylinders, all joint axes being ruling lines.

A loop is told by its steps: projected angles round the axis (`circuit`). Which cones there are, `cone` says for
one loop, `linkage_cones` for several, and `cyclic` in closed form for a million four-bars at a time.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
