"""Crease patterns folded: what only sheets have, panels above all.

`motion` folds a crease pattern along one of its branches, or gives it the assignment of one. `configuration` makes
coordinates ready: opened along cuts, mended where rounding stopped them (`mending`); it asks for layer orders there.
`derivatives` says where vertices are and how a folded sheet changes with its vertices, `collisions` which panels pass
through each other, `alike` keeps a symmetry. How anything moves is in `synth.analysis.motion`. Theory:
docs/theory/folding.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
