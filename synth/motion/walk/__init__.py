"""One walk along a curve of closed configurations, for all that moves.

`walking` takes the steps, `step` finds configurations within one; `events` are objects that are given to a walk:
turning points, panels on each other, rank deficiencies (`rank` watches, `parting` counts the branches), the return
to where it began; others bring their own. `event` is the record of what was met, `allowance` counts the work.
`freedoms`: which joints drive a configuration. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
