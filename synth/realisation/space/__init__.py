"""Drawings taken into space: lifts above them, and projective maps by which centres recede to infinity."""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
