"""Conical candidates evaluated: a job for the runner, whose rows tell circuits, layers, ranks, ways to go."""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
