"""Crease patterns edited: creases locked, added along a line, removed, panels taken off; patterns again."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
