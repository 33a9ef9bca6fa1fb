"""A body guided through orientations: the order a crank takes them in, dyads, and four-bars of two dyads.

Of three orientations any axis has its dyad, four leave a curve (`dyads`), five at most six dyads, more are met by
least squares (`synthesis`).
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
