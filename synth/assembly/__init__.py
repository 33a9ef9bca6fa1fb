"""All positions of a spherical linkage at given inputs, and the circuits and branches they belong to.

`positions` answers. Below it: `family` (linkages of a type with complex axes and inputs), `kernel` (compiled:
closure equations, solutions followed along curves), `general` (all positions of a general member), `found` (of one
member), `circuits`. Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.assembly.answer import Position as Position
    from synth.assembly.answer import Positions as Positions
    from synth.assembly.found import positions as positions
    from synth.assembly.general import general_positions as general_positions
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "answer": "Position Positions",
            "found": "positions",
            "general": "general_positions",
        },
    )
