"""Scenes: shapes of a picture in layers, apart from how it is written; writers for SVG, PNG and PDF."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
