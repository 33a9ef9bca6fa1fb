"""Catalogues: every mechanism of a store, a list or a folder, numbered, on pages."""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
