"""One file read, edited and answered about, in a process of its own, which ends with it if it takes too long.

    python -m synth.making.viewer.workbench.reading show NAME [--motion] [EDIT...] < file

prints lines of JSON: the steps, and last what a page shows, or why the file is refused.

    python -m synth.making.viewer.workbench.reading template NAME SIZE KIND [EDIT...] < file

writes the template, its longer side SIZE millimetres, as ``pdf``, ``svg`` or ``dxf``; several SVG pages in a
``zip``. If the file is refused it prints why, as a line of JSON, and ends with status 2.

An EDIT is ``lock:JOINT``, ``remove:JOINT``, ``ride-alongs``, or ``crease:END~END``, where an END is the number of
a vertex, or ``x,y`` or ``x,y,z``. Theory: docs/theory/viewer.md, docs/theory/edits.md.
"""

import json
import re
import sys
from collections.abc import Sequence
from contextlib import chdir
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from zipfile import ZipFile

from graphs.convert.conversions import Mechanism
from graphs.creasing.edits import crease_sheet, lock_crease, remove_crease, take_off_panels
from graphs.errors import FileError, InvariantError, SynthedraError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.reduce.ride_alongs import reduce
from synth.analysis.moving._configuration_of import sheet_of
from synth.making.viewer.page_data import Report, shown_of

KINDS = ("pdf", "svg", "dxf")
MOTION = "--motion"
"""Option that asks for the motion of a mechanism so large that it is looked for on request only."""
REFUSED = 2
"""Status of the process if the file is refused."""

_MOST_EDITS = 200
_NUMBER = r"-?[0-9]{1,20}(?:\.[0-9]{0,20})?(?:e[+-]?[0-9]{1,2})?"
_END = rf"(?:[0-9]{{1,9}}|{_NUMBER},{_NUMBER}(?:,{_NUMBER})?)"
_EDIT = re.compile(rf"(?:lock|remove):[0-9]{{1,9}}|crease:{_END}~{_END}|ride-alongs")


def are_edits(words: Sequence[str]) -> bool:
    """Check that edits are of known kinds, and not too many."""
    return len(words) <= _MOST_EDITS and all(_EDIT.fullmatch(word) for word in words)


def edited(mechanism: Mechanism, edits: Sequence[str]) -> Mechanism:
    """Return a mechanism after edits, one after the other, each with the ids that the last one left.

    The edits pass `are_edits`. Of a sheet with several frames the first that has coordinates is edited. Raise
    InvariantError if there is no such joint, vertex or point; UnsolvableError if an edit is impossible, also for
    mechanisms of this kind.
    """
    for edit in edits:
        if isinstance(mechanism, Sheet) and mechanism.frames is not None:
            mechanism = mechanism.frames.first_placed()
        if edit == "ride-alongs":
            mechanism = _without_ride_alongs(mechanism)
            continue
        if not isinstance(mechanism, Sheet):
            raise UnsolvableError("only crease patterns can be edited here; try `synth edit`")
        kind, _, place = edit.partition(":")
        if kind == "crease":
            start, end = map(_end, place.split("~"))
            mechanism = crease_sheet(mechanism, start, end).sheet
        else:
            mechanism = (lock_crease if kind == "lock" else remove_crease)(mechanism, int(place)).sheet
    return mechanism


def _end(text: str) -> int | tuple[float, ...]:
    return tuple(map(float, text.split(","))) if "," in text else int(text)


def _without_ride_alongs(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without ride-alongs: a sheet without their panels, solids, or else a graph."""
    reduction = reduce(mechanism)
    if not reduction.steps:
        raise UnsolvableError("the mechanism has no ride-alongs that can be removed")
    if isinstance(mechanism, Sheet):
        panels = {int(str(link)) for step in reduction.steps for link in step.removed}
        return take_off_panels(mechanism, panels).sheet
    if isinstance(mechanism, HingedSolids):
        axes = {joint: mechanism.axes[joint] for joint in reduction.graph.joints}
        return HingedSolids(reduction.graph, axes)
    return reduction.graph


def answered(
    name: str,
    content: bytes,
    edits: Sequence[str] = (),
    *,
    motion: bool | None = None,
    report: Report = lambda _what, _step, _of: None,
) -> dict[str, Any]:
    """Return what a page shows of a file after edits: ``shown``, or ``error``, a line as commands print it.

    The name is without folders. With `motion` the motion is computed however large the mechanism is; `report` is
    called before each step.
    """
    report("reading", 0, 4)
    try:
        mechanism = _mechanism(name, content, edits)
        return {"shown": shown_of(mechanism, name, motion=motion, report=report).to_json()}
    except SynthedraError as error:
        return _refusal(name, error)


def printed(name: str, content: bytes, size: float, kind: str, edits: Sequence[str] = ()) -> tuple[str, bytes]:
    """Return the template of a file after edits: its extension, and its content.

    The name is without folders; `size` is the longer side in millimetres. Raise SynthedraError if the file cannot
    be read or edited, has no panels, or would need too many pages.
    """
    from synth.making.templates.template import template_of
    from synth.making.templates.writing import write_template

    sheet = sheet_of(_mechanism(name, content, edits))
    if sheet is not None and sheet.frames is not None:
        sheet = sheet.frames.first_placed()
    if sheet is None or sheet.coordinates is None:
        raise UnsolvableError("a template requires panels with coordinates; for a type, try `synth realise`")
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


def _mechanism(name: str, content: bytes, edits: Sequence[str]) -> Mechanism:
    """Return the mechanism of a file after edits.

    Readers take files by their names: it is put into a private folder, so that errors name the file alone.
    """
    with TemporaryDirectory() as folder, chdir(folder):
        Path(name).write_bytes(content)
        return edited(read(name), edits)


def _refusal(name: str, error: SynthedraError) -> dict[str, Any]:
    """Return ``error``: why the file was refused, in one line that names it."""
    if isinstance(error, InvariantError):
        error = FileError(name, "", error.offender, error.expected)
    return {"error": str(error if isinstance(error, FileError) else FileError(name, "", str(error)))}


def _show(name: str, *words: str) -> None:
    """Print what a page shows of the file on standard input."""

    def report(doing: str, step: int, of: int) -> None:
        print(json.dumps({"doing": doing, "step": step, "of": of}), flush=True)

    motion = True if MOTION in words else None
    edits = [word for word in words if word != MOTION]
    print(json.dumps(answered(name, sys.stdin.buffer.read(), edits, motion=motion, report=report), allow_nan=False))


def _print_template(name: str, size: str, kind: str, *edits: str) -> None:
    """Write the template of the file on standard input."""
    try:
        _, output = printed(name, sys.stdin.buffer.read(), float(size), kind, edits)
        status = 0
    except SynthedraError as error:
        output, status = json.dumps(_refusal(name, error)).encode(), REFUSED
    sys.stdout.buffer.write(output)
    sys.stdout.buffer.flush()
    raise SystemExit(status)


if __name__ == "__main__":
    if sys.argv[1] == "show":
        _show(*sys.argv[2:])
    else:
        _print_template(*sys.argv[2:])
