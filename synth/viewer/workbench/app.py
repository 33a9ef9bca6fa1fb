"""What the workbench serves: its page, answers about files, and a line that stays open while the page is.

Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from math import isfinite

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp

from synth.viewer.workbench.asking import Engine, file_name
from synth.viewer.workbench.editing import are_edits
from synth.viewer.workbench.guard import HEADERS, MOST_BYTES, Guard, Place
from synth.viewer.workbench.printing import KINDS, REFUSED
from synth.viewer.workbench.reading import MOTION

__all__ = ["Presence", "application"]

_BEAT = 1.0
_AFTER = 10.0
"""Seconds after which a workbench without pages ends: a reload takes less."""
_TYPES = {"pdf": "application/pdf", "svg": "image/svg+xml", "dxf": "image/vnd.dxf", "zip": "application/zip"}
_LARGEST = 10_000.0
"""Millimetres of a template."""


class Presence:
    """How many pages are open, and what is done when the last one is closed for good."""

    def __init__(self, ended: Callable[[], None], after: float = _AFTER) -> None:
        self._ended, self._after = ended, after
        self._open = 0
        self._timer: asyncio.TimerHandle | None = None

    async def line(self) -> AsyncIterator[bytes]:
        """Yield something now and then, as long as somebody listens."""
        self._open += 1
        if self._timer is not None:
            self._timer.cancel()
        try:
            while True:
                yield b"."
                await asyncio.sleep(_BEAT)
        finally:
            self._open -= 1
            if not self._open:
                self._timer = asyncio.get_running_loop().call_later(self._after, self._ended)


def application(place: Place, text: str, presence: Presence, sources: Sequence[bytes | None] = ()) -> ASGIApp:
    """Return the workbench as an ASGI application; `text` is its page.

    `sources` are the files, if any, of what it shows at first; the page requests them to have them edited.
    """
    engine = Engine()

    async def opened(_: Request) -> Response:
        return HTMLResponse(text, headers=HEADERS)

    async def asked(request: Request) -> Response:
        content = await _body(request)
        words = _words(request)
        if content is None or words is None:
            return _refused(content)
        if request.query_params.get("motion") == "yes":
            words.append(MOTION)
        lines = engine.lines("reading", words, content)
        return StreamingResponse(lines, media_type="application/x-ndjson", headers=HEADERS)

    async def printed(request: Request) -> Response:
        content = await _body(request)
        words = _words(request)
        if content is None or words is None:
            return _refused(content)
        kind, size = request.query_params.get("kind", ""), _size(request.query_params.get("size", ""))
        if kind not in KINDS or size is None:
            expected = f"expected a kind, one of {', '.join(KINDS)}, and a size up to {_LARGEST:g} millimetres"
            return PlainTextResponse(expected, 400, headers=HEADERS)
        name, *edits = words
        status, made = await engine.whole("printing", [name, f"{size}", kind, *edits], content)
        if status == REFUSED:
            return Response(made, 422, media_type="application/json", headers=HEADERS)
        if status:
            return PlainTextResponse("the template could not be made: the engine failed", 500, headers=HEADERS)
        kind = "zip" if made.startswith(b"PK") else kind
        return Response(made, media_type=_TYPES[kind], headers=HEADERS)

    async def given(request: Request) -> Response:
        number = request.query_params.get("number", "")
        known = number.isascii() and number.isdigit() and len(number) < 6 and int(number) < len(sources)
        source = sources[int(number)] if known else None
        if source is None:
            return PlainTextResponse("there is no such file", 404, headers=HEADERS)
        return Response(source, media_type="application/octet-stream", headers=HEADERS)

    async def line(_: Request) -> Response:
        return StreamingResponse(presence.line(), media_type="text/plain", headers=HEADERS)

    routes = [
        Route("/", opened, methods=["GET"]),
        Route("/shown", asked, methods=["POST"]),
        Route("/template", printed, methods=["POST"]),
        Route("/given", given, methods=["GET"]),
        Route("/open", line, methods=["GET"]),
    ]
    app = Starlette(routes=routes)
    app.router.redirect_slashes = False  # to addresses without the token, which lead nowhere
    return Guard(app, place)


async def _body(request: Request) -> bytes | None:
    """Return what was sent; None if it is larger than it may be."""
    pieces, size = [], 0
    async for chunk in request.stream():
        pieces.append(chunk)
        size += len(chunk)
        if size > MOST_BYTES:
            return None
    return b"".join(pieces)


def _words(request: Request) -> list[str] | None:
    """Return a safe name of a file, and edits; None if there are none of the kinds that are known."""
    edits = request.query_params.getlist("edit")
    return [file_name(request.query_params.get("name", "")), *edits] if are_edits(edits) else None


def _refused(content: bytes | None) -> Response:
    if content is None:
        return PlainTextResponse("the file is larger than it said", 413, headers=HEADERS)
    return PlainTextResponse("expected edits such as lock:3 or crease:0~12", 400, headers=HEADERS)


def _size(given: str) -> float | None:
    """Return a number of millimetres; None if it is none that a template can have."""
    try:
        size = float(given)
    except ValueError:
        return None
    return size if isfinite(size) and 0.0 < size <= _LARGEST else None
