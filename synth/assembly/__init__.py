"""All positions of a spherical or planar linkage at given inputs, and the circuits and branches they belong to.

`positions` answers. Below it: `family` (linkages of a type with complex axes and inputs), `kernel` (compiled:
closure equations, solutions followed along curves), `general` (all positions of a general member), `found` (of one
member), `circuits`. Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
