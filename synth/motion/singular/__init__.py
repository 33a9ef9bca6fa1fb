"""What is known of a singular pose: the equations of second order, proofs that nothing moves, branches followed.

`quadrics` makes an equation of each self-stress, `definite` finds sums of them that are positive, `rigidity`
proves by these that nothing moves; `flat_vertices` knows the modes of four creases, `sampling` goes along a
branch, `located` takes its end to where it is singular to all digits, `nearest` finds one way of linkages that are
too large for all. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
