"""Conditions that a drawing is to meet exactly, as numbers that are to be 0 and their derivatives.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from graphs.types import Floats

__all__ = ["Condition", "together"]

Condition = Callable[[Floats], tuple[Floats, Floats]]
"""Of unknowns float[n, 2] (vertices, centres across holes, hubs): float[c] to be 0, derivatives float[c, 2 n]."""


def together(conditions: Sequence[Condition]) -> Condition:
    """Return several conditions as one.

    >>> at_rest = together([lambda unknowns: (unknowns.ravel(), np.eye(unknowns.size))] * 2)
    >>> off, by = at_rest(np.zeros((3, 2)))
    >>> off.shape, by.shape
    ((12,), (12, 6))
    """

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        parts = [one(unknowns) for one in conditions]
        return np.concatenate([off for off, _ in parts]), np.concatenate([by for _, by in parts])

    return condition
