"""Panels and solids in space: views, hidden panels, light and sides; strips and moving pictures."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
