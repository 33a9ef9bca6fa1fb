"""A flat pattern folded so far as is asked. Theory: docs/theory/generators.md."""

from __future__ import annotations

from graphs.mechanism.sheet import Sheet
from synth.folding.alike import fold_to

__all__ = ["folded"]


def folded(sheet: Sheet, angle: float) -> Sheet:
    """Return a flat sheet folded on the branch of its assignment up to a largest fold angle, radians.

    Raise UnsolvableError if it does not fold, or not so far.

    >>> from synth.patterns.creases.tessellations import miura
    >>> folded(miura(2, 2, 1.0), 0.5)
    <Sheet: 4 faces, 4 creases, 9 vertices, in space>
    """
    last: Sheet = fold_to(sheet, angle).folding.frames()[-1]
    return last
