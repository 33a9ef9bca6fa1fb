"""Signs of rates that follow from other signs.

Unknowns are the outward rates rho(n, x) that link n, thought of as all round the circle, has at the azimuth of
joint x, and the rates q_i of the joints. They obey

    rho(n, x) sin(y - z) + rho(n, y) sin(z - x) + rho(n, z) sin(x - y) = 0     for any joints x, y, z,
    rho(n, x) - rho(m, x) = +-q_i sin(x - i)                                  for links m, n that joint i joins,

and an order with opposites knows the sign of every sine. Where two terms of such a sum have one sign the third
has the other. Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt

from enumerate.kernel.compiled import compiled
from graphs.rank.singular_values import rank_of
from graphs.types import Ints, Signs
from synth.conformed.rates import ConformedChain

__all__ = ["SignRelations"]

_ZERO = 2
"""Stands for the sign of what is always zero."""


@compiled
def _follow(known: Signs, unknowns: Ints, sines: Ints, factors: Ints, sine_signs: Signs) -> bool:
    """Add what follows to the known signs of one linkage; return whether they contradict each other."""
    changed = True
    while changed:
        changed = False
        for r in range(len(unknowns)):
            plus = minus = missing = 0
            where = sign_there = 0
            for k in range(3):
                sign = factors[r, k]
                if sines[r, k, 0] >= 0:
                    sign *= sine_signs[sines[r, k, 0], sines[r, k, 1]]
                value = known[unknowns[r, k]]
                if sign == 0 or value == 2:
                    continue
                if value == 0:
                    missing += 1
                    where, sign_there = unknowns[r, k], sign
                elif value * sign > 0:
                    plus += 1
                else:
                    minus += 1
            if missing == 0 and (plus > 0) != (minus > 0):
                return True
            if missing == 1 and (plus > 0) != (minus > 0):
                known[where] = -sign_there if plus else sign_there
                changed = True
    return False


@compiled
def _follow_all(
    known: Signs, unknowns: Ints, sines: Ints, factors: Ints, sine_signs: Signs
) -> npt.NDArray[np.bool_]:
    wrong = np.zeros(len(known), np.bool_)
    for i in range(len(known)):
        wrong[i] = _follow(known[i], unknowns, sines, factors, sine_signs[i])
    return wrong


@dataclass(frozen=True, slots=True)
class SignRelations:
    """What the rates of a chain obey: R relations of three unknowns each.

    An unknown is multiplied by a factor and the sine of two joints, none where these are -1. `zero` marks unknowns
    that are always zero; rho(n, x) has number n J + x, q_i has N J + i.
    """

    links: int
    joints: int
    zero: npt.NDArray[np.bool_]
    unknowns: Ints
    sines: Ints
    factors: Ints

    @classmethod
    def of(cls, chain: ConformedChain) -> SignRelations:
        """Set up the relations of a chain.

        >>> from graphs.mechanism.sc import SCGraph
        >>> len(SignRelations.of(ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))).unknowns)
        26
        """
        links, joints = len(chain.links), len(chain.joints)
        zero = np.zeros(links * joints + joints, bool)
        zero[:joints] = True
        for n in range(1, links):
            for i in set(chain.joints_of[n]) & set(chain.joints_of[0]):
                zero[n * joints + i] = True
        unknowns, sines, factors = [], [], []
        for n in range(links):
            for x, y, z in combinations(range(joints), 3):
                unknowns.append([n * joints + x, n * joints + y, n * joints + z])
                sines.append([[y, z], [z, x], [x, y]])
                factors.append([1, 1, 1])
        for i in range(joints):
            m, n = (link for link in range(links) if i in chain.joints_of[link])
            # w of n less w of m is +-q_i e_i, by the direction of the joint: as paths and loops have it
            sign = _direction(chain, i, m, n)
            for x in range(joints):
                if x == i:
                    continue
                unknowns.append([n * joints + x, m * joints + x, links * joints + i])
                sines.append([[-1, -1], [-1, -1], [x, i]])
                factors.append([1, -1, -sign])
            unknowns.append([n * joints + i, m * joints + i, m * joints + i])
            sines.append([[-1, -1]] * 3)
            factors.append([1, -1, 0])
        kept = [k for k in range(len(unknowns)) if not zero[unknowns[k]].all()]
        return cls(
            links,
            joints,
            zero,
            np.array(unknowns, np.int64)[kept],
            np.array(sines, np.int64)[kept],
            np.array(factors, np.int64)[kept],
        )

    def start(self, count: int) -> Signs:
        """Return signs of which nothing is known but what is zero: int8[count, N J + J]."""
        known = np.zeros((count, len(self.zero)), np.int8)
        known[:, self.zero] = _ZERO
        return known

    def rho(self, link: int, joint: int) -> int:
        """Return the number of an outward rate."""
        return link * self.joints + joint

    def rate(self, joint: int) -> int:
        """Return the number of the rate of a joint."""
        return self.links * self.joints + joint

    def follow(self, known: Signs, sine_signs: Signs) -> npt.NDArray[np.bool_]:
        """Add all that follows to known signs, int8[r, N J + J]; return which sets contradict themselves, bool[r].

        The signs of sin(t_x - t_y) are int8[r, J, J].
        """
        return np.asarray(_follow_all(known, self.unknowns, self.sines, self.factors, sine_signs))


def _direction(chain: ConformedChain, joint: int, m: int, n: int) -> int:
    """Return the sign of q_i e_i in w of link n less w of link m: paths, closed by loops, say it."""
    step = chain.paths[n] - chain.paths[m]
    step[joint] -= 1
    # +1 if the rest is a sum of loops, that is, rates that close leave nothing over
    basis = chain.loops
    return 1 if rank_of(np.vstack([basis, step])) == len(basis) else -1
