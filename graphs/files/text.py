"""Text and JSON: read from a file, checked value by value, and laid out to be written.

Every failure is a `FileError` that names the file, the place, the fault and the expected value.
"""

import json
import os
import stat
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from math import degrees, inf, isfinite, nextafter, radians
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from graphs.errors import FileError, InvariantError, OpenError, numbered, shown
from graphs.files.atomic import reason_of
from graphs.input_limits import how_to_raise, most


def read_text(path: Path) -> str:
    """Return the text of a regular file (UTF-8, with or without byte order mark), not empty and not too large."""
    try:
        raw = _bytes_of(path)
    except FileError:
        raise
    except FileNotFoundError:
        raise OpenError(path, "", "no such file", "a file") from None
    except PermissionError:
        raise OpenError(path, "", "no permission to read it") from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise OpenError(path, "", f"cannot be read: {reason_of(error)}") from None
    if not raw.strip():
        raise FileError(path, "", "the file is empty", "a mechanism")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(path, f"byte {error.start}", "not text", "UTF-8 text") from None
    if "\0" in text:
        raise FileError(path, f"byte {raw.index(0)}", "a zero byte: a binary file?", "text")
    return text


_KINDS = {stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket", stat.S_IFCHR: "a device", stat.S_IFBLK: "a device"}
_MEGABYTE = 10**6  # as disks and file managers count, so that the limit is the number a user sees there


def _bytes_of(path: Path) -> bytes:
    """Return the bytes of a regular file; others may never end, or never begin."""
    _check_regular(path, path.stat())
    at_once = getattr(os, "O_NONBLOCK", 0)  # a pipe would wait for somebody who writes to it
    with os.fdopen(os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0) | at_once), "rb") as file:
        _check_regular(path, os.fstat(file.fileno()))  # it may be another by now
        return file.read()


def _check_regular(path: Path, entry: os.stat_result) -> None:
    kind = stat.S_IFMT(entry.st_mode)
    if kind == stat.S_IFDIR:
        raise OpenError(path, "", "a directory", "a file")
    if kind in _KINDS:
        raise OpenError(path, "", _KINDS[kind], "a regular file")
    if entry.st_size > most("megabytes") * _MEGABYTE:
        needed = -(-entry.st_size // _MEGABYTE)
        raise FileError(path, "", f"{needed} megabytes", how_to_raise("megabytes", needed))


def load_json(path: Path) -> Any:
    """Return the JSON value in a file; refuse what strict JSON refuses: NaN, infinity, repeated keys."""
    text = read_text(path)

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        value = dict(pairs)
        if len(value) < len(pairs):
            (again, _), *_ = Counter(key for key, _ in pairs).most_common(1)
            raise FileError(path, again, "the key occurs twice", "once")
        return value

    def no_constant(name: str) -> NoReturn:
        raise FileError(path, "", f"the number {name}", "finite numbers")

    try:
        return json.loads(text, object_pairs_hook=once, parse_constant=no_constant)
    except FileError:
        raise
    except json.JSONDecodeError as error:
        raise FileError(
            path, f"line {error.lineno} column {error.colno}", f"not JSON: {error.msg}", "a JSON document"
        ) from None
    except RecursionError:
        raise FileError(path, "", "the JSON is nested too deeply", "a mechanism") from None
    except ValueError as error:  # an integer of more digits than Python converts
        raise FileError(path, "", f"not JSON: {error}", "a JSON document") from None


_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)


def json_text(document: Mapping[str, Any]) -> str:
    """Return the text of a JSON document: one line per key, and per item of lists of lists or objects."""
    compact = _ENCODER.encode
    rows = []
    for key, value in document.items():
        if isinstance(value, list) and value and isinstance(value[0], list | dict):
            inner, brackets = _lines_of_items(value), "[]"
        elif isinstance(value, dict) and value and isinstance(next(iter(value.values())), list):
            items, brackets = [f"{compact(k)}: {compact(v)}" for k, v in value.items()], "{}"
            inner = ",\n".join("    " + item for item in items)
        else:
            rows.append(f"  {compact(key)}: {compact(value)}")
            continue
        rows.append(f"  {compact(key)}: {brackets[0]}\n{inner}\n  {brackets[1]}")
    return "{\n" + ",\n".join(rows) + "\n}\n"


def _lines_of_items(items: list[Any]) -> str:
    """Return the items of a list, one per line; if all are lists of numbers they are written in one go."""
    whole = _ENCODER.encode(items)
    if whole.count("[") == len(items) + 1 and not set('"{') & set(whole) and all(isinstance(x, list) for x in items):
        return "    " + whole[1:-1].replace("], [", "],\n    [")
    return ",\n".join("    " + _ENCODER.encode(item) for item in items)


def in_degrees(angle: float) -> float:
    """Return an angle in degrees, for a file: the number that reading makes this angle of, where there is one.

    ``degrees(radians(x))`` differs from x in the last bit for one number in nine. Of two numbers that give the
    same angle, the one with at most 15 digits is taken: it is what a file had.

    >>> from math import degrees, radians
    >>> degrees(radians(29.0)), in_degrees(radians(29.0))
    (29.000000000000004, 29.0)
    """
    near = degrees(angle)
    candidates = (float(f"{near:.15g}"), near, nextafter(near, -inf), nextafter(near, inf))
    return next((number for number in candidates if radians(number) == angle), near)


T = TypeVar("T")

_SIMILAR = 0.75  # of difflib: lower it suggests format for colour, higher it misses center for centre
_MISSING = {
    "loops": 'a list of loops; a tree has none, "loops": []',
    "centre": '"centre": "finite", "infinite" (planar) or "none" (spatial)',
    "version": '"version": 1',
}
"""What is expected where a key is missing, if its name does not say it."""

_PLURALS = {"vertex": "vertices"}


class Checker:
    """Checks of JSON values; errors name the file and the place."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def fail(self, place: str, found: object, expected: str) -> NoReturn:
        """Raise the error for a value of another kind than expected."""
        raise FileError(self.path, place, _described(found), expected)

    def mapping(
        self, value: Any, place: str, required: Iterable[str] = (), optional: Iterable[str] = ()
    ) -> Mapping[str, Any]:
        """Return an object that has the required keys and no unknown ones; an error names the nearest known one."""
        if not isinstance(value, dict):
            self.fail(place, value, "an object")
        known = {*required, *optional}
        for key in value:
            if key not in known:
                near = get_close_matches(key[:100], known - value.keys(), 1, _SIMILAR)
                meant = f" (did you mean {near[0]!r}?)" if near else ""
                raise FileError(
                    self.path, place, f"unknown key {shown(key)}{meant}", "only " + ", ".join(sorted(known))
                )
        for key in required:
            if key not in value:
                raise FileError(self.path, place, f"key {key!r} is missing", _MISSING.get(key, ""))
        return value

    def counted(self, value: object, place: str, names: Sequence[object], what: str) -> None:
        """Refuse a number beyond those of names that are 0, 1, 2, ..., as of a file that counts them from 1."""
        numbers = all(type(name) is int and name == i for i, name in enumerate(names))
        if numbers and isinstance(value, int) and not 0 <= value < len(names):
            several = _PLURALS.get(what, f"{what}s")
            offender = f"{what} {shown(value)} of {numbered(len(names), what, several)}"
            expected = f"a {what} from 0 to {len(names) - 1}: {several} count from 0" if names else f"no {what}"
            raise FileError(self.path, place, offender, expected)

    def list(self, value: Any, place: str, length: int | None = None, what: str = "a list") -> list[Any]:
        """Return a list; of any length unless it is stated."""
        if not isinstance(value, list):
            self.fail(place, value, what)
        if length is not None and len(value) != length:
            raise FileError(self.path, place, f"a list of {len(value)}", what)
        return value

    def items(self, value: Any, place: str, what: str = "a list") -> Iterator[tuple[str, Any]]:
        """Yield the items of a list, each with its place."""
        yield from ((f"{place}[{i}]", item) for i, item in enumerate(self.list(value, place, what=what)))

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
        self, make: Callable[[], T], place_of: Callable[[tuple[str, object]], str] = lambda _: "", place: str = ""
    ) -> T:
        """Build an object; a broken invariant becomes an error at the place of a part, or of the whole."""
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
