"""Proofs that nothing moves at a pose.

If no rates close to first order, nothing moves. If some do, suppose that a motion begins as t^k r: what is of
order 2 k in the closure equations says that each self-stress's form vanishes at r. So nothing moves if no rates
but zero satisfy all these equations: a sum of them that is positive on all rates is the shortest proof, and where
there is none the rates may be used up case by case. R. Connelly and W. Whiteley, Second-order rigidity and
prestress stability, SIAM Journal on Discrete Mathematics 9 (1996). Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphs.rank.singular_values import spectrum
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.second_order import rates_at, spaces_within
from synth.motion.singular.definite import definite_weights
from synth.motion.singular.quadrics import Quadric, all_quadrics, local_forms

__all__ = ["Rigidity", "rigidity_of"]

Proof = Literal["no rates", "definite stress", "cases"]


@dataclass(frozen=True, slots=True)
class Rigidity:
    """Whether a linkage is proved to be rigid at its pose, and how.

    Attributes
    ----------
    proof : {"no rates", "definite stress", "cases"} or None
        None where there is none: it may move or not.
    flexes : int
        Independent rates that close to first order.
    margin : float or None
        What the proof rests on: the smallest singular value of the closure equations (no rates) or eigenvalue of
        the form (definite stress), as part of the largest. Of a proof by cases, None: each stands on values above
        1e-9 of the largest.
    stress : float[n]
        Multiples of the equations whose sum is positive on all flexes; of other proofs none.
    equations : tuple of Quadric
        Those that second order adds.
    """

    proof: Proof | None
    flexes: int
    margin: float | None
    stress: Floats | None
    equations: tuple[Quadric, ...]

    @property
    def certainty(self) -> Literal["proved", "not known"]:
        """Whether it is proved that nothing moves."""
        return "proved" if self.proof else "not known"


def rigidity_of(
    linkage: PosedLinkage, closure: ClosureEquations | None = None, zero: float = DOUBLE.zero
) -> Rigidity:
    """Look for a proof that a linkage cannot move from its pose.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose.
    closure : ClosureEquations, optional
        Of this linkage, where they are at hand.
    zero : float, optional
        Singular values and eigenvalues below this part of the largest are zero.

    Examples
    --------
    A flat vertex with a sector of more than half a turn has two flexes, and does not fold:

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (.8, .6), (.4, .9), (-.1, 1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> found = rigidity_of(linkage_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> found.flexes, found.proof, found.margin > .01
    (2, 'definite stress', True)
    """
    closure = closure or ClosureEquations(linkage)
    tangent = rates_at(closure, linkage.angles, zero)
    flexes = tangent.shape[1]
    if not flexes:
        values = spectrum(closure.at(linkage.angles)[1].toarray(), DOUBLE.derivative)
        proved = values.rank == closure.joints
        return Rigidity("no rates" if proved else None, 0, values.smallest if closure.joints else None, None, ())
    quadrics = tuple(all_quadrics(linkage, tangent, zero))
    definite = definite_weights(local_forms(tangent, quadrics), max(zero, DOUBLE.clear))
    if definite is not None:
        stress = definite[0] / [np.abs(quadric.form).max() for quadric in quadrics]
        return Rigidity("definite stress", flexes, definite[1], stress, quadrics)
    proof: Proof | None = None if next(spaces_within(tangent, quadrics, zero), None) else "cases"
    return Rigidity(proof, flexes, None, None, quadrics)
