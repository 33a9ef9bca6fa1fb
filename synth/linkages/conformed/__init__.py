"""Linkages in the conformed position: rates there, which way links can go, and what holds over all angles."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
