"""Conical candidates evaluated: a job for the runner, with rows of circuits, layers, ranks, senses of rotation.

Theory: docs/theory/conical-candidates.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
