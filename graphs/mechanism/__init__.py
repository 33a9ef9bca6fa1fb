"""What a mechanism is: SC and SCD graphs, polyhedron models, vertex-edge graphs, sheets, linkages on cones.

An SCD graph is an SC graph with a drawing; the rules say which drawings are valid. Nothing here counts or ranks.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
