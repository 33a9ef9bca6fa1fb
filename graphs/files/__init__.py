"""Mechanisms as files: `formats` has a reader and a writer for each extension.

Crease patterns are in `patterns`, the project's own JSON in `native`, link-joint graphs without loops in `bare`.
Every failure is a `FileError` with its place; a file is written whole or not at all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.files.formats import Entry as Entry
    from graphs.files.formats import read as read
    from graphs.files.formats import read_all as read_all
    from graphs.files.formats import write as write
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "formats": "Entry read read_all write",
        },
    )
