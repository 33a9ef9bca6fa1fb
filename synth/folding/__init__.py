"""Crease patterns folded: what only sheets have, panels above all.

`fold` takes a crease pattern along one of its branches. `configuration` makes coordinates ready: opened along
cuts (`opened`), mended where rounding stopped them (`mending`). `vertices` says where vertices are, `collisions`
which panels pass through each other, `alike` keeps a symmetry, `derivatives` says how a folded sheet changes with
its vertices, `assigned` gives a pattern the assignment of a branch. How anything moves is in `synth.motion`.
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
