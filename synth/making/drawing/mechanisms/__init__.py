"""Pictures of mechanisms: crease patterns, folded sheets, chains, SC and SCD graphs, polyhedron models."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
