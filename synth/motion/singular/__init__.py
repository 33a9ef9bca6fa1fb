"""What is known of a singular pose: the equations of second order, proofs that nothing moves, branches followed.

`quadrics` makes an equation of each self-stress, `definite` finds sums of them that are positive, `rigidity`
proves by these that nothing moves; `flat_vertices` knows the modes of four creases, `sampling` goes along a
branch, `nearest` finds one way of linkages that are too large for all. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.motion.singular.rigidity import Rigidity as Rigidity
    from synth.motion.singular.rigidity import rigidity_of as rigidity_of
    from synth.motion.singular.sampling import freedoms_at as freedoms_at
else:
    __getattr__, __dir__, __all__ = offered(
        __name__, {"sampling": "freedoms_at", "rigidity": "Rigidity rigidity_of"}
    )
