"""Linkages mapped to right cones and cylinders, all joint axes being ruling lines.

A loop is described by its steps: projected angles round the axis (`circuit`). `loop_maps` finds the cones and
cylinders of one loop, `linkages` those of several; `loop_sums` has closed forms for a million four-bars at a time.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
