"""All kinematic chains of a size, listed and counted in two ways."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
