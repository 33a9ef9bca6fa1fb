"""Contracted graphs and maps, and binary links placed on their joints: what chains and drawings are made of."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
