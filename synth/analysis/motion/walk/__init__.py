"""One walk along a curve of closed configurations, for all motions.

`walking` takes the steps and keeps the signs of fold angles, `step` finds configurations within one and watches
the rank; `events` has the events that a walk is given: turning points, panels on each other, rank deficiencies,
the return to where it began; others bring their own. Theory: docs/theory/folding.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
