"""All SCD graphs of a size: every placement of open edges on SC graphs that obeys the rules.

A *pattern* says which points of a face are one; *choices* lay the open edges of a link in the corners that are
left.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
