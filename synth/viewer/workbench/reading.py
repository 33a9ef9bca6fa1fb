"""One file read and judged, in a process of its own: what hangs, or needs too much, is ended with it.

    python -m synth.viewer.workbench.reading NAME [--motion] [EDIT...] < file

prints lines of JSON: how far it is, and last what a page shows, or in what words the file is refused.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from graphs.convert.table import Mechanism
from graphs.errors import FileError, InvariantError, SynthedraError
from graphs.files.formats import read
from synth.viewer.shown import Report, shown_of
from synth.viewer.workbench.editing import edited

__all__ = ["MOTION", "answered", "read_and_edited", "refusal"]

MOTION = "--motion"
"""The word that asks for the motion of what is so large that it is looked for on request only."""


def answered(
    name: str,
    content: bytes,
    edits: Sequence[str] = (),
    *,
    motion: bool | None = None,
    report: Report = lambda _what, _step, _of: None,
) -> dict[str, Any]:
    """Return what a page shows of a file after edits.

    It is ``shown``, the data of the page, or ``error``, a line as commands print it. The name is without folders.
    With `motion` the motion is computed however large the mechanism is; `report` is called before each step.
    """
    report("reading", 0, 4)
    return refusal(
        name,
        lambda: {
            "shown": shown_of(read_and_edited(name, content, edits), name, motion=motion, report=report).to_json()
        },
    )


def read_and_edited(name: str, content: bytes, edits: Sequence[str]) -> Mechanism:
    """Return the mechanism of a file after edits.

    Readers take files by their names: it is put into a private folder. The SynthedraErrors of readers and edits
    name the file alone.
    """
    with _private_folder():
        Path(name).write_bytes(content)
        return edited(read(name), edits)


def refusal(name: str, made: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Return what is made, or ``error``: why it was refused, in one line that names the file."""
    try:
        return made()
    except FileError as error:
        return {"error": str(error)}
    except InvariantError as error:
        return {"error": str(FileError(name, "", error.offender, error.expected))}
    except SynthedraError as error:
        return {"error": str(FileError(name, "", str(error)))}


@contextmanager
def _private_folder() -> Iterator[None]:
    """Work in a folder of one's own, which goes again."""
    before = Path.cwd()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(before)


def _report(what: str, step: int, of: int) -> None:
    print(json.dumps({"doing": what, "step": step, "of": of}), flush=True)


def main() -> None:
    """Answer about the file on standard input."""
    name, *words = sys.argv[1:]
    motion = True if MOTION in words else None
    edits = [word for word in words if word != MOTION]
    told = answered(name, sys.stdin.buffer.read(), edits, motion=motion, report=_report)
    print(json.dumps(told, allow_nan=False))


if __name__ == "__main__":
    main()
