"""Mechanisms made smaller: ride-alongs and dyads taken off, Assur groups."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
