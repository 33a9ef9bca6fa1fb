"""Crease patterns of thick panels: hinges moved off the plane of the sheet, solids that are shown to move.

`heights` has the conditions of vertices and the linear programme for the heights of hinges, `plates` the solids of
panels, cut back where they meet, `collisions` their distances and the swept motion, `techniques` hinges in the plane,
`fittings` bores and the parts list, `thickened` the answer. Theory: docs/theory/thick-panels.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
