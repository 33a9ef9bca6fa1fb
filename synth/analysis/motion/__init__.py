"""How a mechanism moves from a configuration: links rigid, all loops closed.

`linkage` holds links and axes and places them, `closure` the equations, their derivatives and Newton's method,
`walk` takes steps along a curve and records events, `path` drives joints, `branches` finds the motion branches
from a singular configuration such as a flat sheet, `singular` what these rest on and proofs of rigidity, `marked`
which of them agrees with a mountain-valley assignment, `driving` which is taken, `motion` is the answer;
`derivatives` says how a configuration changes with the dimensions of the mechanism. Theory:
docs/theory/folding.md, docs/theory/derivatives.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
