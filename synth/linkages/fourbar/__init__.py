"""Four-bars, spherical and planar: which lengths close, and the positions they take.

Theory: docs/theory/four-bars.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
