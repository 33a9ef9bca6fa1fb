"""The mark of special geometry on a type: members of it move that counts say are rigid.

Source: Wiener 2016, 6.1.4. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from graphs.errors import InvariantError, numbered, shown

__all__ = ["SpecialGeometry"]


@dataclass(frozen=True, slots=True)
class SpecialGeometry:
    """Finite freedoms of the members of a type whose dimensions obey conditions that the type does not state.

    It is a remark on the type, which stays the same: ids, mobility and tests of equality do not depend on it.

    Parameters
    ----------
    freedoms : int
        Of finite motion, of a member that obeys the conditions.
    conditions : sequence of str
        What is special, such as ``flat-foldable`` or ``two triples of parallel axes (Sarrus)``.

    Raises
    ------
    InvariantError
        If there are no freedoms, or no conditions.

    Examples
    --------
    >>> str(SpecialGeometry(1, ["line symmetry"]))
    '1 freedom by special geometry: line symmetry'
    """

    freedoms: int
    conditions: tuple[str, ...]

    def __init__(self, freedoms: int, conditions: Sequence[str]) -> None:
        if freedoms < 1:
            raise InvariantError("special", f"special geometry with {freedoms} freedoms", "1 or more")
        texts = tuple(conditions)
        if not texts or not all(isinstance(text, str) and text for text in texts):
            raise InvariantError("special", f"the conditions are {shown(list(texts))}", "one text or more")
        object.__setattr__(self, "freedoms", freedoms)
        object.__setattr__(self, "conditions", texts)

    def __str__(self) -> str:
        return f"{numbered(self.freedoms, 'freedom')} by special geometry: {', '.join(self.conditions)}"
