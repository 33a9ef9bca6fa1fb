"""Linkages of any kind moved: solids hinged at edges, polyhedron models, conical linkages, guided four-bars.

`made` makes a configuration of any mechanism that has coordinates, `motion` drives its joints, brings it into
other configurations and writes tables, `on_surface` follows conical linkages all along their circuits. Theory:
docs/theory/moving.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
