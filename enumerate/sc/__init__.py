"""All SC graphs of a size: planar chains drawn on the sphere with an outer face, and their centres."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
