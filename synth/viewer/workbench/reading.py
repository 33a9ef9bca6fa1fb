"""One file read and judged, in a process of its own: what hangs, or needs too much, is ended with it.

    python -m synth.viewer.workbench.reading NAME [EDIT...] < file

prints JSON: what a page shows, or in what words the file is refused. Readers take files by their names, so what
comes is put into a private folder that goes with the process.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from graphs.convert.table import Mechanism
from graphs.creasing.edits import lock_crease, remove_crease
from graphs.errors import FileError, InvariantError, SynthedraError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.viewer.shown import shown_of

__all__ = ["answered"]


_EDITS = {"lock": lock_crease, "remove": remove_crease}


def answered(name: str, content: bytes, edits: Sequence[str] = ()) -> dict[str, Any]:
    """Return what a page shows of a file, or why it shows nothing.

    Parameters
    ----------
    name : str
        Without folders.
    content : bytes
    edits : sequence of str
        ``lock:JOINT`` or ``remove:JOINT``, one after the other, each with the ids that the last one left.

    Returns
    -------
    dict
        ``shown``: the data of the page; or ``error``: a line, as commands print it.

    Examples
    --------
    >>> answered("a.fold", b"{")["error"][:14]
    'a.fold: line 1'
    """
    before = Path.cwd()
    with TemporaryDirectory() as folder:
        (Path(folder) / name).write_bytes(content)
        os.chdir(folder)  # so that messages name the file alone
        try:
            return {"shown": shown_of(_edited(read(name), edits), name).to_json()}
        except FileError as error:
            return {"error": str(error)}
        except InvariantError as error:
            return {"error": str(FileError(name, "", error.offender, error.expected))}
        except SynthedraError as error:
            return {"error": str(FileError(name, "", str(error)))}
        finally:
            os.chdir(before)


def _edited(thing: Mechanism, edits: Sequence[str]) -> Mechanism:
    if not edits:
        return thing
    if not isinstance(thing, Sheet):
        raise UnsolvableError("only crease patterns are edited here; other mechanisms by `synth edit`")
    sheet = thing if thing.frames is None else thing.frames.first_placed()
    for edit in edits:
        what, _, joint = edit.partition(":")
        sheet = _EDITS[what](sheet, int(joint)).sheet
    return sheet


def main() -> None:
    """Answer about the file on standard input."""
    json.dump(answered(sys.argv[1], sys.stdin.buffer.read(), sys.argv[2:]), sys.stdout)


if __name__ == "__main__":
    main()
