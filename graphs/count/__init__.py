"""Mobility by count: the equations, their differences, and which of them apply to a mechanism."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
