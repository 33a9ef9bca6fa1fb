"""Linkages of any kind moved: solids hinged at edges, polyhedron models, conical linkages, guided four-bars.

`configuration_of` makes a mechanism at a configuration of anything that has coordinates, `move` drives its joints,
`circuit_through` goes round past dead points, `move_on_surface` says what conical linkages do all along. What it
stands on is in `synth.folding`. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
