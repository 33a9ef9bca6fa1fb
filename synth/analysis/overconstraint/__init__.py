"""Why mechanisms move although counts say no: redundant equations, the geometry behind them, errors that lock.

`explain` answers (`explanation`). Below it: `redundancy` (smallest sets of loops with redundant equations, first
and second order, errors of axes), `reasons` (special geometry by name). Theory: docs/theory/overconstraint.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
