"""All loops of a chain: its simple cycles, not only an independent set.

Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.loops.loop import Loop, cyclic_order
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId
from synth.conformed.rates import ConformedChain

__all__ = ["loops_of_chain", "signed_cycles"]

_MOST_LOOPS = 8
"""More independent loops have too many cycles to look at them all."""


def signed_cycles(chain: ConformedChain) -> npt.NDArray[np.int64]:
    """Return all simple cycles of a chain as rows of +1, -1 and 0, short ones first.

    Rows of the int64[C, J] are +1 or -1 where a cycle passes a joint, by its direction, as in
    `ConformedChain.loops`; each cycle one way round. Raises `UnsolvableError` if there are more than eight
    independent loops.
    """
    independent = chain.loops
    if len(independent) > _MOST_LOOPS:
        raise UnsolvableError(
            f"the chain has {len(independent)} independent loops; expected {_MOST_LOOPS} at most"
        )
    cycles: dict[tuple[int, ...], npt.NDArray[np.int64]] = {}
    for factors in product((0, 1, -1), repeat=len(independent)):
        if next((factor for factor in factors if factor), -1) < 0:  # each cycle one way round
            continue
        row = np.array(factors) @ independent
        if np.abs(row).max() == 1 and _is_simple(chain, row):
            cycles[tuple(np.flatnonzero(row))] = row
    return np.array([cycles[key] for key in sorted(cycles, key=lambda key: (len(key), key))], np.int64).reshape(
        -1, len(chain.joints)
    )


def _is_simple(chain: ConformedChain, row: npt.NDArray[np.int64]) -> bool:
    """Tell whether joints with weights that add up to 0 at every link are one cycle: each link has two or none."""
    passed = [[joint for joint in joints if row[joint]] for joints in chain.joints_of]
    if any(len(joints) not in (0, 2) for joints in passed):
        return False
    pairs = [tuple(joints) for joints in passed if joints]
    reached, todo = {pairs[0][0]}, [pairs[0][0]]
    while todo:
        joint = todo.pop()
        for pair in pairs:
            if joint in pair:
                other = sum(pair) - joint
                if other not in reached:
                    reached.add(other)
                    todo.append(other)
    return len(reached) == int(np.abs(row).sum())


def loops_of_chain(chain: SCGraph) -> tuple[tuple[JointId, ...], ...]:
    """Return the joints of every loop of a chain, in loop order, short loops first."""
    joints = tuple(chain.joints)
    rows = signed_cycles(ConformedChain.of(chain))
    return tuple(
        cyclic_order(Loop(tuple(joints[i] for i in np.flatnonzero(row).tolist())), chain.joints) for row in rows
    )
