"""Edits of mechanisms: each makes a new graph, and predicts its change of mobility."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
