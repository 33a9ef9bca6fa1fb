"""Reading text and JSON from a file, and writing it whole or not at all.

Every failure is a :class:`graphs.errors.FileError` with the file, the place, what is wrong and what was
expected.
"""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from math import isfinite
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from graphs.errors import FileError, InvariantError, shown

__all__ = [
    "MOST_NODES",
    "Beside",
    "Checker",
    "FolderBeside",
    "json_text",
    "load_json",
    "read_text",
    "write_chunks",
    "write_text",
]

MOST_NODES = 2_000_000
"""Most links or vertices that a bare number in a file may call for."""

T = TypeVar("T")


def read_text(path: Path) -> str:
    """Return the text of a file (UTF-8, with or without byte order mark).

    Raises
    ------
    FileError
        If the file is missing, a directory, not readable, empty or not text.
    """
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise FileError(path, "", "no such file", "a file") from None
    except IsADirectoryError:
        raise FileError(path, "", "a directory", "a file") from None
    except PermissionError:
        raise FileError(path, "", "no permission to read it") from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise FileError(path, "", f"cannot be read: {_reason(error)}") from None
    if not raw.strip():
        raise FileError(path, "", "the file is empty", "a mechanism")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(path, f"byte {error.start}", "not text", "UTF-8 text") from None
    if "\0" in text:
        raise FileError(path, f"byte {raw.index(0)}", "a zero byte: a binary file?", "text")
    return text


def write_text(path: Path, text: str) -> None:
    """Write a file beside its place and move it there, so that it is never half written.

    Raises
    ------
    FileError
        If it cannot be written; what was there is kept.
    """
    write_chunks(path, [text])


def write_chunks(path: Path, chunks: Iterable[str]) -> None:
    """Write text that comes piece by piece, as :func:`write_text` writes one piece."""
    beside = Beside(path)
    try:
        for chunk in chunks:
            beside.write(chunk.encode("utf-8"))
        beside.commit()
    finally:
        beside.discard()


class FolderBeside:
    """A new folder, made beside its place and moved there when it is complete.

    Parameters
    ----------
    path : Path

    Raises
    ------
    FileError
        If there is something at its place, or it cannot be made.
    """

    def __init__(self, path: Path) -> None:
        if path.exists():
            raise FileError(path, "", "exists already", "a new folder")
        self._place = path
        try:
            self.path = Path(tempfile.mkdtemp(prefix=f".{path.name[:32]}.", dir=path.parent))
        except OSError as error:
            raise FileError(path, "", f"cannot be made: {error.strerror}", "a writable folder") from None

    def commit(self) -> None:
        """Move the folder to its place."""
        self.path.chmod(0o755)
        self.path.rename(self._place)

    def discard(self) -> None:
        """Remove the folder, unless it was moved."""
        shutil.rmtree(self.path, ignore_errors=True)


class Beside:
    """A file that is written beside its place and moved there when it is whole.

    Parameters
    ----------
    path : Path
        Its place; a file that is there is kept until :meth:`commit`.

    Raises
    ------
    FileError
        If the folder cannot be written to.
    """

    def __init__(self, path: Path) -> None:
        if path.is_dir():
            raise FileError(path, "", "a directory", "a file to write")
        try:
            self._mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
            handle, name = tempfile.mkstemp(prefix=f".{path.name[:32]}.", dir=path.parent)
        except (OSError, ValueError) as error:
            raise FileError(path, "", f"cannot be written: {_reason(error)}", "a writable folder") from None
        self._path, self._beside = path, Path(name)
        self.stream = os.fdopen(handle, "wb")

    def write(self, data: bytes) -> None:
        """Append bytes.

        Raises
        ------
        FileError
            If the disk is full, or otherwise broken.
        """
        with self._named():
            self.stream.write(data)

    def commit(self) -> None:
        """Move the file to its place."""
        with self._named():
            self.stream.close()
            self._beside.chmod(self._mode)
            self._beside.replace(self._path)

    def discard(self) -> None:
        """Remove the file, unless it was committed."""
        with suppress(OSError):  # closing writes what is left, to a disk that may be full
            self.stream.close()
        self._beside.unlink(missing_ok=True)

    @contextmanager
    def _named(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise FileError(self._path, "", f"cannot be written: {_reason(error)}") from None


def load_json(path: Path) -> Any:
    """Return the JSON value in a file; refuse what strict JSON refuses: NaN, infinity, repeated keys.

    Raises
    ------
    FileError
        With line and column of a syntax error.
    """
    text = read_text(path)

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        value = dict(pairs)
        if len(value) < len(pairs):
            keys = [key for key, _ in pairs]
            again = next(key for key in keys if keys.count(key) > 1)
            raise FileError(path, again if again.isprintable() else ascii(again), "the key occurs twice", "once")
        return value

    def no_constant(name: str) -> NoReturn:
        raise FileError(path, "", f"the number {name}", "finite numbers")

    try:
        return json.loads(text, object_pairs_hook=once, parse_constant=no_constant)
    except json.JSONDecodeError as error:
        raise FileError(
            path, f"line {error.lineno} column {error.colno}", f"not JSON: {error.msg}", "a JSON document"
        ) from None
    except RecursionError:
        raise FileError(path, "", "the JSON is nested too deeply", "a mechanism") from None
    except ValueError as error:  # an integer of more digits than Python converts
        raise FileError(path, "", f"not JSON: {error}", "a JSON document") from None


def json_text(document: Mapping[str, Any]) -> str:
    r"""Return the text of a JSON document: a key a line, and a line for each item of lists of lists or objects.

    Examples
    --------
    >>> print(json_text({"version": 1, "joints": [[0, 1], [1, 2]]}), end="")
    {
      "version": 1,
      "joints": [
        [0, 1],
        [1, 2]
      ]
    }
    """

    def compact(value: Any) -> str:
        return json.dumps(value, ensure_ascii=False, allow_nan=False)

    rows = []
    for key, value in document.items():
        if isinstance(value, list) and value and isinstance(value[0], list | dict):
            items, brackets = [compact(item) for item in value], "[]"
        elif isinstance(value, dict) and value and isinstance(next(iter(value.values())), list):
            items, brackets = [f"{compact(k)}: {compact(v)}" for k, v in value.items()], "{}"
        else:
            rows.append(f"  {compact(key)}: {compact(value)}")
            continue
        inner = ",\n".join("    " + item for item in items)
        rows.append(f"  {compact(key)}: {brackets[0]}\n{inner}\n  {brackets[1]}")
    return "{\n" + ",\n".join(rows) + "\n}\n"


class Checker:
    """Checks JSON values and names the place of what is wrong.

    Parameters
    ----------
    path : Path
        The file, for messages.

    Examples
    --------
    >>> Checker(Path("a.json")).integer("three", "joints[0][1]")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.json: joints[0][1]: 'three'; expected an integer
    """

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


def _reason(error: OSError | ValueError) -> str:
    return error.strerror or "" if isinstance(error, OSError) else str(error)


def _umask() -> int:
    """Return the umask; it can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
