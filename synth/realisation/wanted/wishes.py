"""What a flat drawing is to be besides: flat-foldable, symmetric; and how well it is, told of its coordinates.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from graphs.errors import UnsolvableError
from graphs.types import Floats
from synth.realisation.pattern import Pattern
from synth.realisation.wanted.conditions import Condition
from synth.realisation.wanted.flat_folding import flat_folding, off_flat
from synth.realisation.wanted.symmetry import Symmetry, off_symmetry, symmetries

__all__ = ["Kept", "Wishes", "wishes_for"]


@dataclass(frozen=True, slots=True)
class Wishes:
    """What drawings are to be besides: flat-foldable, symmetric under a group, or both.

    Flat-foldable: reflected in the creases round a vertex or a hole in turn, the sheet closes. Other conditions
    may be added.
    """

    flat_foldable: bool = False
    symmetry: Symmetry | None = None
    others: tuple[Condition, ...] = ()

    def conditions(self, pattern: Pattern) -> list[Condition]:
        """Return what drawings meet exactly."""
        flat = [flat_folding(pattern)] if self.flat_foldable else []
        return [*flat, *([self.symmetry.condition] if self.symmetry is not None else []), *self.others]

    def kept(self, pattern: Pattern, places: Floats) -> Kept:
        """Return how well a drawing meets them."""
        return Kept(
            off_flat(pattern, places) if self.flat_foldable else None,
            off_symmetry(self.symmetry, places) if self.symmetry is not None else None,
            "" if self.symmetry is None else str(self.symmetry),
        )


@dataclass(frozen=True, slots=True)
class Kept:
    """How well a drawing meets the wishes; None for what was not among them.

    `off_flat` is by how much reflections in creases miss to close at most, radians, and units of length round
    holes; `off_symmetry` how far a vertex is at most from where it is mapped to, in units of the extent.
    """

    off_flat: float | None = None
    off_symmetry: float | None = None
    symmetry: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on, of what was asked for."""
        flat = {} if self.off_flat is None else {"off_flat_folding": self.off_flat}
        if self.off_symmetry is None:
            return flat
        return flat | {"symmetry": self.symmetry, "off_symmetry": self.off_symmetry}

    def lines(self) -> list[str]:
        """Return the lines that are printed."""
        told = []
        if self.off_flat is not None:
            told.append(
                "flat-foldable: alternate sectors sum to 180 degrees, and reflections round holes close, to "
                f"{self.off_flat:.0e}; the order of layers was not looked for"
            )
        if self.off_symmetry is not None:
            told.append(f"symmetric: {self.symmetry}, to {self.off_symmetry:.0e} of the extent")
        return told


def wishes_for(pattern: Pattern, *, flat_foldable: bool, symmetric: bool) -> tuple[Wishes, ...]:
    """Return what to ask of drawings, in the order in which to try: the largest group of symmetries first.

    Raises `UnsolvableError` if it cannot be flat-foldable, or has no symmetry that keeps its border.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> [str(one.symmetry) for one in wishes_for(fan, flat_foldable=True, symmetric=True)][:1]
    ['turns by 90 degrees, 4 mirror(s)']
    """
    if flat_foldable:
        flat_folding(pattern)  # which says what stands in the way
    if not symmetric:
        return (Wishes(flat_foldable),)
    groups = symmetries(pattern)
    if not groups:
        raise UnsolvableError("the type has no symmetry that a drawing with its border could have")
    return tuple(Wishes(flat_foldable, group) for group in groups)
