"""How a mechanism moves from a configuration: links rigid, all loops closed.

`linkage` holds links and axes, `closure` the equations and their derivatives, `newton` corrects,
`walk` takes steps along a path and says what it meets, `path` drives joints, `second_order` and `branches` find
the ways to move from a singular configuration such as a flat sheet, `singular` what these rest on and proofs that
nothing moves, `beginning` which way is taken, `placement` where links are; `derivatives` and `bodies` say how a
configuration changes with what the mechanism is made of. Theory: docs/theory/folding.md,
docs/theory/derivatives.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
