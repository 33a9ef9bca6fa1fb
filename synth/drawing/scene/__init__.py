"""Scenes: what a picture shows, in layers, apart from how it is written; writers for SVG, PNG and PDF.

A scene is lines, polygons, discs and labels in typographic points, in colours that have names; the palette of the
paper, light or dark, says what they are when the scene is written.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
