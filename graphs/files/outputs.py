"""Formats of files that are written: a record for each, a table of records for each kind of content.

Content is a mechanism, pages of a picture, a template, frames of a motion, solids, or rows of an atlas.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Generic, TypeAlias, TypeVar

from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import check_place, write_chunks

Content = TypeVar("Content")
Lost: TypeAlias = tuple[str, ...]
"""Parts that a file does not hold, each with its number."""

_EXTRAS = {
    "contourpy": "draw",
    "matplotlib": "draw",
    "reportlab": "draw",
    "pyarrow": "parquet",
    "anywidget": "notebook",
}
"""Package to the extra that installs it."""


@dataclass(frozen=True, slots=True)
class Format(Generic[Content]):
    """A format in which content of one kind is written.

    `name` is for messages and help; `needs` is the module that writes it, if it comes with an extra.
    """

    suffix: str
    name: str
    to_bytes: Callable[[Content], bytes]
    lost: Callable[[Content], Lost] = lambda _content: ()
    needs: str = ""


Formats: TypeAlias = Mapping[str, Format[Content]]
"""Suffix to the format."""


def formats_by_suffix(*formats: Format[Content]) -> dict[str, Format[Content]]:
    """Return the table of some formats."""
    return {format_.suffix: format_ for format_ in formats}


def listed(formats: Formats[Content]) -> str:
    """Return the suffixes of a table as help shows them: ".pdf, .svg or .dxf"."""
    *first, last = formats
    return f"{', '.join(first)} or {last}" if first else last


def unknown_extension(path: str | Path, known: Iterable[str], rest: str = "") -> FileError:
    """Return the error of a file whose extension no table has; `rest` is added to the known ones."""
    suffix = Path(path).suffix
    wrong = f"files ending in {suffix!r} are not known" if suffix else "the name has no extension"
    first, *more = known
    expected = f"one of {' '.join((first, *more))}" if more else first
    return FileError(path, "", wrong, expected + rest)


def format_of(path: str | Path, formats: Formats[Content], rest: str = "") -> Format[Content]:
    """Return the format that the suffix of a path names; FileError if there is none, which adds `rest` to the known."""
    suffix = Path(path).suffix.lower()
    if suffix not in formats:
        raise unknown_extension(path, formats, rest)
    return formats[suffix]


def check_installed(module: str, name: str) -> None:
    """Raise UnsolvableError if the module of an extra is missing, which a format (its name) needs."""
    package = module.partition(".")[0]
    try:
        import_module(package)
        import_module(module)
    except ImportError:
        extra = _EXTRAS[package]
        raise UnsolvableError(f"{name} requires {package}; try pip install 'synthedra[{extra}]'") from None
    except OSError:  # matplotlib found neither a home nor a temporary folder
        raise UnsolvableError(f"{package} requires a folder to write to; try to name one in MPLCONFIGDIR") from None


def check_writable(path: str | Path, formats: Formats[Content], *, force: bool = False) -> None:
    """Refuse a path that cannot be written to, before its content is computed.

    Raise FileError if the extension is unknown, or the file exists and must not be overwritten; UnsolvableError if
    the module that writes the format is not installed.
    """
    format_ = format_of(path, formats)
    check_place(Path(path), force=force)
    if format_.needs:
        check_installed(format_.needs, format_.name)


def write_as(content: Content, path: str | Path, formats: Formats[Content], *, force: bool = False) -> Lost:
    """Write content in the format of the suffix, whole or not at all; return what the file does not hold."""
    check_writable(path, formats, force=force)
    format_ = format_of(path, formats)
    write_chunks(Path(path), [format_.to_bytes(content)], force=force)
    return format_.lost(content)
