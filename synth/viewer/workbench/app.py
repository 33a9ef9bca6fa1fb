"""What the workbench serves: its page, answers about files, and a line that stays open while the page is.

Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp

from synth.viewer.pages import page
from synth.viewer.shown import Shown
from synth.viewer.workbench.asking import Judging, are_edits, file_name
from synth.viewer.workbench.guard import HEADERS, MOST_BYTES, Guard, Place

__all__ = ["Presence", "application"]

_BEAT = 1.0
_AFTER = 10.0
"""Seconds after which a workbench without pages ends: a reload takes less."""


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


def application(
    place: Place, shown: Sequence[Shown], presence: Presence, sources: Sequence[bytes | None] = ()
) -> ASGIApp:
    """Return the workbench as an ASGI application.

    Parameters
    ----------
    place : Place
    shown : sequence of Shown
        What is there when it is opened.
    presence : Presence
    sources : sequence of bytes or None
        The files that these were read from, where they were files; the page asks for them to have them edited.
    """
    text = page(shown, "workbench", workbench=True)
    judging = Judging()

    async def opened(_: Request) -> Response:
        return HTMLResponse(text, headers=HEADERS)

    async def asked(request: Request) -> Response:
        content = b""
        async for chunk in request.stream():
            content += chunk
            if len(content) > MOST_BYTES:
                return PlainTextResponse("the file is larger than it said", 413, headers=HEADERS)
        name = file_name(request.query_params.get("name", ""))
        edits = request.query_params.getlist("edit")
        if not are_edits(edits):
            return PlainTextResponse("expected edits such as lock:3 or remove:3", 400, headers=HEADERS)
        answer = await judging.of([name, *edits], content, request.is_disconnected)
        return Response(answer, media_type="application/json", headers=HEADERS)

    async def given(request: Request) -> Response:
        number = request.query_params.get("number", "")
        source = sources[int(number)] if number.isdecimal() and int(number) < len(sources) else None
        if source is None:
            return PlainTextResponse("there is no such file", 404, headers=HEADERS)
        return Response(source, media_type="application/octet-stream", headers=HEADERS)

    async def line(_: Request) -> Response:
        return StreamingResponse(presence.line(), media_type="text/plain", headers=HEADERS)

    routes = [
        Route("/", opened, methods=["GET"]),
        Route("/shown", asked, methods=["POST"]),
        Route("/given", given, methods=["GET"]),
        Route("/open", line, methods=["GET"]),
    ]
    return Guard(Starlette(routes=routes), place)
