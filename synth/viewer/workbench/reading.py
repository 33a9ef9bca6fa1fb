"""One file read and judged, in a process of its own: what hangs, or needs too much, is ended with it.

    python -m synth.viewer.workbench.reading NAME < file

prints JSON: what a page shows, or in what words the file is refused. Readers take files by their names, so what
comes is put into a private folder that goes with the process.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from graphs.errors import FileError, InvariantError, SynthedraError
from graphs.files.formats import read
from synth.viewer.shown import shown_of

__all__ = ["answered"]


def answered(name: str, content: bytes) -> dict[str, Any]:
    """Return what a page shows of a file, or why it shows nothing.

    Parameters
    ----------
    name : str
        Without folders.
    content : bytes

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
            return {"shown": shown_of(read(name), name).to_json()}
        except FileError as error:
            return {"error": str(error)}
        except InvariantError as error:
            return {"error": str(FileError(name, "", error.offender, error.expected))}
        except SynthedraError as error:
            return {"error": str(FileError(name, "", str(error)))}
        finally:
            os.chdir(before)


def main() -> None:
    """Answer about the file on standard input."""
    json.dump(answered(sys.argv[1], sys.stdin.buffer.read()), sys.stdout)


if __name__ == "__main__":
    main()
