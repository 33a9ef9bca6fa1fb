"""The end of each count by Burnside's lemma: a mean that must be a whole number."""

from __future__ import annotations

from enumerate.kernel.compiled import compiled

__all__ = ["number_of_orbits"]


@compiled
def number_of_orbits(fixed: int, symmetries: int) -> int:
    """Return the number of orbits: the mean number of things that a symmetry leaves as they are.

    `fixed` is the sum over all symmetries of what each leaves as it is. Raises `ArithmeticError` if the mean is no
    whole number: the symmetries are no group, or something was counted wrongly. That is a fault of the program.
    """
    if fixed % symmetries:
        raise ArithmeticError("Burnside's lemma gives no whole number of orbits")
    return fixed // symmetries
