"""The template of one file, in a process of its own.

    python -m synth.viewer.workbench.printing NAME SIZE KIND [EDIT...] < file

writes the template, its longer side SIZE millimetres, as ``pdf``, ``svg`` or ``dxf``; pictures of several pages
in a ``zip``. Where the file is refused it prints why, as a line of JSON, and ends with status 2.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

from graphs.errors import UnsolvableError
from synth.moving.made import sheet_of
from synth.templates.template import template_of
from synth.templates.writing import write_template
from synth.viewer.workbench.reading import read_and_edited, refusal

__all__ = ["KINDS", "printed"]

KINDS = ("pdf", "svg", "dxf")
REFUSED = 2
"""Status of the process where the file is refused."""


def printed(name: str, content: bytes, size: float, kind: str, edits: Sequence[str] = ()) -> tuple[str, bytes]:
    """Return the template of a file after edits: its extension, and its content.

    The name is without folders; `size` is the longer side in millimetres. Raise SynthedraError if it cannot be
    read or edited, has no panels, or would need too many pages.
    """
    sheet = sheet_of(read_and_edited(name, content, edits))
    if sheet is not None and sheet.frames is not None:
        sheet = sheet.frames.first_placed()
    if sheet is None or sheet.coordinates is None:
        raise UnsolvableError("a template needs panels with coordinates; a type gets them by `synth realise`")
    template = template_of(sheet, size=size, title=sheet.title or name)
    if kind == "svg":
        template = replace(template, steps=())  # a page of assembly would be a second file
    with TemporaryDirectory() as folder:
        places = write_template(template, Path(folder) / f"template.{kind}")
        if len(places) == 1:
            return kind, places[0].read_bytes()
        packed = BytesIO()
        with ZipFile(packed, "w") as archive:
            for place in places:
                archive.write(place, place.name)
    return "zip", packed.getvalue()


def main() -> None:
    """Print the template of the file on standard input."""
    name, size, kind, *edits = sys.argv[1:]
    made = b""

    def found() -> dict[str, str]:
        nonlocal made
        _, made = printed(name, sys.stdin.buffer.read(), float(size), kind, edits)
        return {}

    refused = refusal(name, found)
    sys.stdout.buffer.write(json.dumps(refused).encode() if refused else made)
    sys.stdout.buffer.flush()
    raise SystemExit(REFUSED if refused else 0)


if __name__ == "__main__":
    main()
