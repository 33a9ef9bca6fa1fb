"""Four-bars, spherical and planar: which lengths close, and the positions they take."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
