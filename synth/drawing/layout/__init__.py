"""Layouts: where links and joints are drawn, without crossings if that can be, mirrored if that can be too."""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
