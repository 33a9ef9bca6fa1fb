"""Why mechanisms move although counts say no: idle equations, the geometry behind them, errors that lock.

`explain` answers. Below it: `idle` (smallest sets of loops with idle equations, first and second order), `reasons`
(special geometry by name), `tolerances`. Theory: docs/theory/overconstraint.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.overconstraint.answer import Explanation as Explanation
    from synth.overconstraint.answer import IdleSet as IdleSet
    from synth.overconstraint.explained import explain as explain
    from synth.overconstraint.tolerances import Tolerance as Tolerance
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "answer": "Explanation IdleSet",
            "explained": "explain",
            "tolerances": "Tolerance",
        },
    )
