"""What a sheet keeps of the file it was read from: repairs with their places, what was left out, its precision."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Any, Literal, TypeAlias

from graphs.errors import InvariantError

__all__ = ["Place", "Reading", "Repair", "RepairKind", "WrittenPrecision"]

Place: TypeAlias = tuple[tuple[float, ...], ...]
"""A point, both ends of a line, or the corners of a face, in the coordinates of the sheet."""

RepairKind: TypeAlias = Literal[
    "crossing split",
    "line split at an end",
    "ends welded",
    "line drawn twice",
    "line of no length",
    "line pruned",
    "vertex taken out",
    "hole",
]

_FIRST = 3
"""So many places are told in a line."""


@dataclass(frozen=True, slots=True)
class Repair:
    """Repairs of one kind.

    `what` says them with their number, as `Sheet.repairs` does. The places are those of all.
    """

    kind: RepairKind
    what: str
    places: tuple[Place, ...]

    def to_json(self) -> dict[str, Any]:
        """Return plain data; a place is a list of one point, two ends, or the corners of a face."""
        places = [[list(point) for point in place] for place in self.places]
        return {"kind": self.kind, "what": self.what, "places": places}

    def __str__(self) -> str:
        """Say them with the first places.

        >>> print(Repair("line pruned", "1 line that ends nowhere pruned", (((0.0, 0.25), (1.0, 0.5)),)))
        1 line that ends nowhere pruned: from (0, 0.25) to (1, 0.5)
        """
        first = ", ".join(_told(place) for place in self.places[:_FIRST])
        more = f" and {len(self.places) - _FIRST} more" if len(self.places) > _FIRST else ""
        return f"{self.what}: {first}{more}" if first else self.what


@dataclass(frozen=True, slots=True)
class Reading:
    """What was done to a drawing when it was read.

    `left_out` says which strokes were not understood; empty if all were.
    """

    repairs: tuple[Repair, ...] = ()
    left_out: str = ""

    @property
    def warning(self) -> str:
        """What whoever asks should read first: that the pattern is not the whole drawing; empty if it is."""
        return f"{self.left_out}; state what they are by --colour or --layer" if self.left_out else ""

    def told(self, note: str) -> str:
        """Return a repair as it is noted, with its first places where they are known.

        >>> crossing = Repair("crossing split", "1 crossing split", (((0.5, 0.25),),))
        >>> Reading((crossing,)).told("1 crossing split")
        '1 crossing split: at (0.5, 0.25)'
        """
        return next((str(repair) for repair in self.repairs if repair.what == note), note)

    def to_json(self) -> dict[str, Any]:
        """Return the key ``reading`` of an answer (docs/command-json.md)."""
        return {"left_out": self.left_out or None, "repairs": [repair.to_json() for repair in self.repairs]}


@dataclass(frozen=True, slots=True)
class WrittenPrecision:
    """The error that a coordinate may have, as it is written.

    Parameters
    ----------
    length : float
        In the unit of the coordinates.
    source : str
        How it is known: ``2 decimals``, ``stated``.
    stated : bool, optional
        Whether somebody said so; what is stated is not judged by the geometry.

    Raises
    ------
    InvariantError
        If the length is negative, or not finite.

    Examples
    --------
    >>> WrittenPrecision(0.005, "2 decimals").stated
    False
    """

    length: float
    source: str
    stated: bool = False

    def __post_init__(self) -> None:
        if not (isfinite(self.length) and self.length >= 0.0):
            raise InvariantError("precision", f"the precision is {self.length:g}", "a length, zero or more")


def _told(place: Place) -> str:
    points = ["({})".format(", ".join(f"{x + 0.0:.6g}" for x in point)) for point in place]
    if len(points) == 2:
        return f"from {points[0]} to {points[1]}"
    return f"at {points[0]}" if len(points) == 1 else f"round {points[0]}"
