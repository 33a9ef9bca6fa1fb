"""Loops of a mechanism: what a loop is, the space of cycles, and which loops share a centre."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
