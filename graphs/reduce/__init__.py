"""Mechanisms made smaller: ride-alongs and dyads taken off, Assur groups."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.reduce.assur import AssurGroup as AssurGroup
    from graphs.reduce.assur import AssurReduction as AssurReduction
    from graphs.reduce.assur import assur_groups as assur_groups
    from graphs.reduce.assur import reduce_assur as reduce_assur
    from graphs.reduce.ride_alongs import Reduction as Reduction
    from graphs.reduce.ride_alongs import ReductionStep as ReductionStep
    from graphs.reduce.ride_alongs import reduce as reduce
    from graphs.reduce.taking import RULES as RULES
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "assur": "AssurGroup AssurReduction assur_groups reduce_assur",
            "ride_alongs": "Reduction ReductionStep reduce",
            "taking": "RULES",
        },
    )
