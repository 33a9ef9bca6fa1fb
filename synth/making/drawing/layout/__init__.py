"""Layouts: places of links and joints in pictures, without crossings and mirrored where possible."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
