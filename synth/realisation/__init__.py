"""Types as things: panels with coordinates, as a flat sheet or as a pose in space; linkages on cones.

`realise` takes a type, draws its panels, and says what they look like. Below it: `pattern` (what is to be drawn),
`starting` (a barycentric drawing), `improving` (its shape, creases to their centres), `drawing` (one try after the
other), `space` (to a pose in space), `figures`, `refusing` (what no flat sheet has), `simplest` (the drawn type of
an SC graph), `many` (stores and folders at once). `wanted`: drawings that are flat-foldable, or symmetric;
`special`: members that move although counts say no.
`forms`: strips of R/- strings; `realise_on_cone` lays a type with one centre round a cone. Theory:
docs/theory/realisation.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
