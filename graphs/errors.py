"""One rooted family of exceptions, and the check of arguments.

Every error that synthedra raises on purpose is a :class:`SynthedraError`; its message is one line that
names the place, what is wrong and what was expected.
"""

from pathlib import Path
from types import UnionType

from graphs.printing import plain, shown

__all__ = [
    "ArgumentError",
    "FileError",
    "InvariantError",
    "NumericalError",
    "OpenError",
    "StoreError",
    "SynthedraError",
    "UnsolvableError",
    "check_argument",
    "numbered",
    "shown",
]

_LONGEST_MESSAGE = 4_000  # letters: a screen; a message may quote a file, and a file can be one line of megabytes
_LONGEST_FILE = 4_096  # letters of a path: the longest that Linux opens (PATH_MAX)
_LONGEST_PLACE = 120  # letters: a place is a key or a line number, or names that a file made up, longer than a line


def numbered(number: int, word: str, more: str = "") -> str:
    """Return a number and its noun, whose plural is ``more``, or the word with an s: "1 link", "2 vertices"."""
    return f"{number} {word if number == 1 else more or word + 's'}"


class SynthedraError(Exception):
    r"""Root of every error raised on purpose; its text is one printable line, whatever names are in it.

    Parameters
    ----------
    *args : object
        The first is the message.

    Examples
    --------
    >>> print(SynthedraError("a name of\ttwo words"))
    a name of\ttwo words
    """

    def __str__(self) -> str:
        return plain(super().__str__(), _LONGEST_MESSAGE)


class FileError(SynthedraError, ValueError):
    """A file cannot be read or written.

    Parameters
    ----------
    file : str or Path
    place : str
        Where in the file: a JSON path such as ``joints[3][0]``, ``line 7``, or empty for the file as a whole.
    found, expected : str
        What is there, and what should have been there.

    Examples
    --------
    >>> print(FileError("a.json", "joints[0]", "a string", "two links"))
    a.json: joints[0]: a string; expected two links
    """

    def __init__(self, file: str | Path, place: str, found: str, expected: str = "") -> None:
        super().__init__(file, place, found, expected)
        self.file, self.place, self.found, self.expected = str(file), place, found, expected

    def __str__(self) -> str:
        name = plain(self.file, _LONGEST_FILE)
        where = f"{name}: {plain(self.place, _LONGEST_PLACE)}: " if self.place else f"{name}: "
        wrong = self.found + (f"; expected {self.expected}" if self.expected else "")
        return where + plain(wrong, _LONGEST_MESSAGE)


class OpenError(FileError, OSError):
    """A file could not be opened, or the system refused to read or write it."""


class InvariantError(SynthedraError, ValueError):
    """An object would break one of its invariants.

    Parameters
    ----------
    rule, offender : str
        Short name of the rule that is broken, such as ``"loop is a cycle"`` or ``"S1"``; what breaks it, named as
        in the input.
    expected : str, optional
        What would satisfy the rule.
    part : (str, object), optional
        Which part of the object: ``("joints", id)``, ``("loops", index)``, ... A reader of files turns it into the
        place in the file.

    Examples
    --------
    >>> print(InvariantError("no self-joint", "joint 'a' joins link 1 to itself", "two different links"))
    joint 'a' joins link 1 to itself; expected two different links [no self-joint]
    """

    def __init__(self, rule: str, offender: str, expected: str = "", part: tuple[str, object] | None = None) -> None:
        super().__init__(rule, offender, expected, part)
        self.rule, self.offender, self.expected, self.part = rule, offender, expected, part

    def __str__(self) -> str:
        tail = f"; expected {self.expected}" if self.expected else ""
        return plain(f"{self.offender}{tail} [{self.rule}]", _LONGEST_MESSAGE)


class UnsolvableError(SynthedraError):
    """The question is well posed and has no answer, for example a conversion that loses what it needs.

    Parameters
    ----------
    message : str

    Examples
    --------
    >>> print(UnsolvableError("a tree has no loop"))
    a tree has no loop
    """


class ArgumentError(SynthedraError, TypeError):
    """A function got an argument of another kind than it takes."""


class NumericalError(SynthedraError):
    """A numerical method cannot decide, or did not converge."""


class StoreError(SynthedraError):
    """A store of results cannot be used for this command."""


def check_argument(verb: str, value: object, kinds: type | UnionType) -> None:
    """Refuse an argument of a function of ``synth`` that is not of the kinds it takes, and say how to make one.

    The functions of the face read paths themselves (`graphs.files.mechanism_like`); others say that they do not.

    >>> from graphs.mechanism.sheet import Sheet
    >>> check_argument("fold", "a.fold", Sheet)
    Traceback (most recent call last):
    ...
    graphs.errors.ArgumentError: fold: the text 'a.fold'; expected a Sheet; try synth.fold(synth.read('a.fold'))
    """
    if isinstance(value, kinds):
        return
    expected = f"a {kinds.__name__}" if isinstance(kinds, type) else "a mechanism"
    if isinstance(value, str | Path):
        name = shown(str(value))
        what = "text" if isinstance(value, str) else "path"
        raise ArgumentError(f"{verb}: the {what} {name}; expected {expected}; try synth.{verb}(synth.read({name}))")
    if value is None or isinstance(value, int | float):
        received = shown(value)
    else:
        received = f"an object of type {type(value).__name__}"
    raise ArgumentError(f"{verb}: {received}; expected {expected}, as synth.read returns it")
