"""Known patterns and linkages made by their parameters: crease patterns, rings of solids, pop-ups, cartons, ...

`generate` makes one by name, `GENERATORS` has them all: parameters with units and ranges, the freedoms that the
source gives, its conditions. Files: `creases`, `hinged_rings`, `goods`, `platforms`, `scissors`.
Theory: docs/theory/generators.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
