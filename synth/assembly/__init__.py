"""All positions of a spherical or planar linkage at given inputs, and the circuits and branches they belong to.

`positions` answers. Below it: `kernel` (compiled: closure equations, solutions followed along curves), `family`
(linkages of a type with complex axes and inputs, and all positions of a general one), `modes` (those of one
member, their circuits). Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
