"""All R/- strings: chains of panels between two bodies, and the mechanisms they are."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
