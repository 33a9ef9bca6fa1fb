"""All positions of a spherical or planar linkage at given inputs, and the circuits and branches they belong to.

`positions` (in `modes`) follows those of a general linkage of the type (`family`) to the one in question; the
steps are compiled (`kernel`). Theory: docs/theory/positions.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
