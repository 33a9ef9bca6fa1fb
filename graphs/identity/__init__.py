"""Canonical ids: of chains (``k1:``), of drawn mechanisms (``m1:``), and codes of centre classes."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
