"""Values from JSON checked one by one: a failure names file, place, what is wrong, what was expected."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from math import isfinite
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from graphs.errors import FileError, InvariantError, shown
from graphs.limits import how_to_raise, most

__all__ = ["Checker"]

T = TypeVar("T")


class Checker:
    """Checks JSON values; errors name the file and the place of what is wrong."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def fail(self, place: str, found: object, expected: str) -> NoReturn:
        """Raise the error for a value that is not what was expected."""
        raise FileError(self.path, place, _described(found), expected)

    def mapping(
        self, value: Any, place: str, required: Iterable[str] = (), optional: Iterable[str] = ()
    ) -> Mapping[str, Any]:
        """Return an object that has the required keys and no unknown ones."""
        if not isinstance(value, dict):
            self.fail(place, value, "an object")
        known = {*required, *optional}
        for key in value:
            if key not in known:
                raise FileError(self.path, place, f"unknown key {shown(key)}", "only " + ", ".join(sorted(known)))
        for key in required:
            if key not in value:
                raise FileError(self.path, place, f"key {key!r} is missing", "it to be there")
        return value

    def list(self, value: Any, place: str, length: int | None = None, what: str = "a list") -> list[Any]:
        """Return a list, of a given length if one is given."""
        if not isinstance(value, list):
            self.fail(place, value, what)
        if length is not None and len(value) != length:
            raise FileError(self.path, place, f"a list of {len(value)}", what)
        return value

    def integer(self, value: Any, place: str, least: int = 0, most: int | None = None) -> int:
        """Return an integer not below ``least`` and not above ``most``."""
        if isinstance(value, bool) or not isinstance(value, int):
            self.fail(place, value, "an integer")
        if value < least or (most is not None and value > most):
            limits = f"{least} or more" if most is None else f"{least} to {most}"
            raise FileError(self.path, place, shown(value), limits)
        return value

    def how_many(self, value: Any, place: str) -> int:
        """Return a number of links or vertices, not beyond the limit."""
        number = self.integer(value, place)
        if number > most("nodes"):
            raise FileError(self.path, place, shown(number), how_to_raise("nodes", number))
        return number

    def number(self, value: Any, place: str) -> float:
        """Return a finite number."""
        if isinstance(value, bool) or not isinstance(value, int | float):
            self.fail(place, value, "a number")
        try:
            real = float(value)
        except OverflowError:
            real = float("inf")
        if not isfinite(real):
            raise FileError(self.path, place, "a number too large", "a finite number")
        return real

    def name(self, value: Any, place: str, what: str = "a name (text or an integer)") -> str | int:
        """Return a name: text or an integer."""
        if isinstance(value, bool) or not isinstance(value, str | int):
            self.fail(place, value, what)
        if isinstance(value, str):
            self.text(value, place)
        return value

    def text(self, value: Any, place: str) -> str:
        """Return text that can be written again as UTF-8."""
        if not isinstance(value, str):
            self.fail(place, value, "text")
        if any("\ud800" <= letter <= "\udfff" for letter in value):
            raise FileError(self.path, place, "half of a surrogate pair", "text")
        return value

    def build(
        self,
        make: Callable[[], T],
        place_of: Callable[[tuple[str, object]], str] = lambda _: "",
        place: str = "",
    ) -> T:
        """Build an object; turn a breach of its invariants into an error with a place in the file.

        ``place_of`` gives the place of a part of the object, ``place`` that of the whole.
        """
        try:
            return make()
        except InvariantError as error:
            place = place if error.part is None else place_of(error.part)
            raise FileError(self.path, place, error.offender, error.expected) from None


def _described(value: object) -> str:
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return "a list"
    return shown(value)
