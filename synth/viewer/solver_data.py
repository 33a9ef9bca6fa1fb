"""What the solver of the page is told of a linkage: numbers alone, ready for JSON.

Loops come as the equations have them, those of one kind and length together, so that residuals of both solvers
have the same rows. The order of joints in sparse factors is found here: minimum degree is not ported. Theory:
docs/theory/viewer.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import chain
from typing import Any

import numpy as np
import scipy.sparse
from scipy.sparse.linalg import splu

from graphs.loops.loop import Centre
from graphs.tolerances import EPSILON, Tolerances
from graphs.types import Ints, LinkId
from synth.motion.closure import frames_of
from synth.motion.linkage import PosedLinkage, PosedLoop
from synth.motion.placement import joints_outwards

__all__ = ["factor_order", "solver_data"]


def solver_data(linkage: PosedLinkage, *, limited: bool, ground: LinkId | None = None) -> dict[str, Any]:
    """Return what the page's solver needs to move a closed linkage.

    It is plain data, `LinkageData` of web/src/solver/types.js. `limited`: joints end at 180 degrees, where panels
    lie on each other; `ground` is the fixed link, by default the first. Angles are in radians, lengths in units of
    the extent. The tolerances are those of closed configurations, which are solved for in double precision
    whatever the file says.
    """
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    tree = [
        (number[near], number[far], place, int(sign))
        for near, far, place, sign in joints_outwards(linkage, ground)
    ]
    return {
        "points": linkage.points.tolist(),
        "directions": linkage.directions.tolist(),
        "angles": linkage.angles.tolist(),
        "loops": [_loop(linkage, loop) for loop in _as_the_equations(linkage.loops)],
        "order": factor_order(len(linkage.angles), [loop.joints for loop in linkage.loops]).tolist(),
        "limited": limited,
        "tree": tree,
        "links": len(number),
        "tolerances": asdict(Tolerances.of(EPSILON, len(linkage.angles))),
    }


def factor_order(joints: int, loops: Sequence[Sequence[int]]) -> Ints:
    """Return the index of each joint, int[J], in factors of normal equations.

    The factors stay sparse: the order is by minimum degree. The joints of a loop, given by their indices, are
    neighbours. A hub of a star goes last, so that nothing is filled in:

    A hub of a star goes last, so that nothing is filled in:

    >>> int(factor_order(5, [(0, 1), (0, 2), (0, 3), (0, 4)])[0]) >= 3
    True
    """
    if not joints:
        return np.zeros(0, dtype=np.int64)
    columns = np.fromiter(chain.from_iterable(loops), dtype=np.int64)
    rows = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
    seen = scipy.sparse.csr_matrix((np.ones(len(columns)), (rows, columns)), shape=(len(loops), joints))
    pattern = (seen.T @ seen + scipy.sparse.identity(joints)).tocsc()
    options = {"SymmetricMode": True}
    factors = splu(pattern, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    return np.asarray(factors.perm_c, dtype=np.int64)


def _as_the_equations(loops: Sequence[PosedLoop]) -> list[PosedLoop]:
    kinds: dict[tuple[Centre, int], list[PosedLoop]] = {}
    for loop in loops:
        kinds.setdefault((loop.centre, len(loop.joints)), []).append(loop)
    return list(chain.from_iterable(kinds.values()))


def _loop(linkage: PosedLinkage, loop: PosedLoop) -> dict[str, Any]:
    parallel = loop.centre is Centre.INFINITE
    return {
        "joints": list(loop.joints),
        "signs": list(loop.signs),
        "centre": str(loop.centre.value),
        "frame": frames_of(linkage.directions[None, list(loop.joints)])[0].tolist() if parallel else None,
    }
