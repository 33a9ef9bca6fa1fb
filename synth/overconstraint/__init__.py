"""Why mechanisms move although counts say no: idle equations, the geometry behind them, errors that lock.

`explain` answers. Below it: `idle` (smallest sets of loops with idle equations, first and second order), `reasons`
(special geometry by name), `tolerances`. Theory: docs/theory/overconstraint.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
