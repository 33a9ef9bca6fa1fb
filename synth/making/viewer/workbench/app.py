"""The workbench served on this machine: its page, answers about files, and the checks of who may ask.

Any page in a browser can send requests to this machine, and a name of another's can be made to lead here. So a
request is answered only if it names this host and port, comes from no other origin, has the token in its path, and
is not too large. Theory: docs/theory/viewer.md.
"""

import asyncio
import secrets
import socket
from collections.abc import AsyncIterator, Callable, Sequence
from dataclasses import dataclass
from hmac import compare_digest
from math import isfinite

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp, Receive, Scope, Send

from enumerate.runner.stopping import interruptible
from graphs.files.formats import READERS
from synth.making.viewer.page_data import Shown
from synth.making.viewer.pages import page
from synth.making.viewer.workbench.asking import Engine, file_name
from synth.making.viewer.workbench.reading import KINDS, MOTION, REFUSED, are_edits
from synth.making.viewer.workbench.samples import SAMPLES, sample_bytes

MOST_BYTES = 50_000_000
"""Largest size of a file."""
_OWN_SITE = (b"same-origin", b"none")
_HEADERS = {
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_BEAT = 1.0
_AFTER = 10.0
"""Seconds after which a workbench without pages ends: a reload takes less."""
_LINGER = 1
"""Seconds for answers that are on their way when it ends."""
_TYPES = {"pdf": "application/pdf", "svg": "image/svg+xml", "dxf": "image/vnd.dxf", "zip": "application/zip"}
_LARGEST = 10_000.0
"""Largest size of a template, millimetres."""


@dataclass(frozen=True, slots=True)
class Place:
    """The port of a workbench, and its token, known to its own page alone."""

    port: int
    token: str

    @property
    def host(self) -> str:
        """Host and port as browsers name them."""
        return f"127.0.0.1:{self.port}"

    @property
    def address(self) -> str:
        """The address that a browser opens."""
        return f"http://{self.host}/{self.token}/"


class Guard:
    """An ASGI application behind checks of who asks; it sees paths after the token."""

    def __init__(self, app: ASGIApp, place: Place) -> None:
        self._app, self._place = app, place

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request, or refuse it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
        elif scope["type"] == "http":
            refusal = self._refusal(scope)
            if refusal is None:
                inside = {**scope, "path": scope["path"][len(self._place.token) + 1 :]}
                await self._app(inside, receive, send)
            else:
                await refusal(scope, receive, send)

    def _refusal(self, scope: Scope) -> PlainTextResponse | None:
        """Return why a request is not answered, or None."""
        if self._is_foreign(scope["headers"]):
            return _error("only the page of this workbench may send requests", 403)
        path = scope["path"].encode("utf-8", "surrogateescape")
        own = f"/{self._place.token}/".encode()
        if not compare_digest(path[: len(own)], own):
            return _error("no such page", 404)
        if scope["method"] not in ("GET", "POST"):
            return _error("unknown method; expected GET or POST", 405)
        if scope["method"] == "GET":
            return None
        lengths = _values(scope["headers"], b"content-length")
        # digits are counted first: a number of millions of digits would take long to read
        if len(lengths) != 1 or not lengths[0].isdigit() or len(lengths[0]) > len(str(MOST_BYTES)) + 1:
            return _error("expected a length of at most 50 megabytes", 411)
        return _error("the file is larger than 50 megabytes", 413) if int(lengths[0]) > MOST_BYTES else None

    def _is_foreign(self, headers: list[tuple[bytes, bytes]]) -> bool:
        own = self._place.host.encode()
        return (
            _values(headers, b"host") != [own]
            or any(origin != b"http://" + own for origin in _values(headers, b"origin"))
            or any(site not in _OWN_SITE for site in _values(headers, b"sec-fetch-site"))
        )


def _values(headers: list[tuple[bytes, bytes]], name: bytes) -> list[bytes]:
    return [value for key, value in headers if key.lower() == name]


def _error(text: str, status: int) -> PlainTextResponse:
    return PlainTextResponse(text, status, headers=_HEADERS)


class Presence:
    """The number of open pages, and a call when the last one is closed for good."""

    def __init__(self, ended: Callable[[], None], after: float = _AFTER) -> None:
        self._ended, self._after = ended, after
        self._open = 0
        self._timer: asyncio.TimerHandle | None = None

    async def line(self) -> AsyncIterator[bytes]:
        """Yield a byte every second while a page is open."""
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

    `sources` are the files, if any, of the mechanisms that it shows at first; the page requests them for edits.
    """
    engine = Engine()

    async def opened(_: Request) -> Response:
        return HTMLResponse(text, headers=_HEADERS)

    async def shown(request: Request) -> Response:
        content, words = await _file_and_edits(request)
        if request.query_params.get("motion") == "yes":
            words.append(MOTION)
        lines = engine.lines("show", words, content)
        return StreamingResponse(lines, media_type="application/x-ndjson", headers=_HEADERS)

    async def template(request: Request) -> Response:
        content, words = await _file_and_edits(request)
        kind, size = request.query_params.get("kind", ""), _size(request.query_params.get("size", ""))
        if kind not in KINDS or size is None:
            return _error(f"expected a kind, one of {', '.join(KINDS)}, and a size up to {_LARGEST:g} millimetres", 400)
        name, *edits = words
        status, output = await engine.whole("template", [name, f"{size}", kind, *edits], content)
        if status == REFUSED:
            return Response(output, 422, media_type="application/json", headers=_HEADERS)
        if status:
            return _error("the template could not be made: the engine failed", 500)
        kind = "zip" if output.startswith(b"PK") else kind
        return Response(output, media_type=_TYPES[kind], headers=_HEADERS)

    async def source(request: Request) -> Response:
        number = request.query_params.get("number", "")
        exists = number.isascii() and number.isdigit() and len(number) < 6 and int(number) < len(sources)
        content = sources[int(number)] if exists else None
        if content is None:
            return _error("no such file", 404)
        return Response(content, media_type="application/octet-stream", headers=_HEADERS)

    async def samples(_: Request) -> Response:
        listed = [{"name": name, "title": title} for name, title, _ in SAMPLES]
        return JSONResponse({"samples": listed, "formats": sorted(READERS)}, headers=_HEADERS)

    async def sample(request: Request) -> Response:
        number = request.query_params.get("number", "")
        if not (number.isascii() and number.isdigit() and len(number) < 3 and int(number) < len(SAMPLES)):
            return _error("no such sample", 404)
        content = await run_in_threadpool(sample_bytes, int(number))
        return Response(content, media_type="application/octet-stream", headers=_HEADERS)

    async def line(_: Request) -> Response:
        return StreamingResponse(presence.line(), media_type="text/plain", headers=_HEADERS)

    routes = [
        Route("/", opened, methods=["GET"]),
        Route("/shown", shown, methods=["POST"]),
        Route("/template", template, methods=["POST"]),
        Route("/given", source, methods=["GET"]),
        Route("/samples", samples, methods=["GET"]),
        Route("/sample", sample, methods=["GET"]),
        Route("/open", line, methods=["GET"]),
    ]
    app = Starlette(routes=routes)
    app.router.redirect_slashes = False  # redirects go to addresses without the token, which lead nowhere
    return Guard(app, place)


async def _file_and_edits(request: Request) -> tuple[bytes, list[str]]:
    """Return the content of a file, and a safe name followed by edits; HTTPException if they are too large."""
    pieces, size = [], 0
    async for chunk in request.stream():
        pieces.append(chunk)
        size += len(chunk)
        if size > MOST_BYTES:
            raise HTTPException(413, "the file is larger than its stated length", _HEADERS)
    edits = request.query_params.getlist("edit")
    if not are_edits(edits):
        raise HTTPException(400, "expected edits such as lock:3 or crease:0~12", _HEADERS)
    return b"".join(pieces), [file_name(request.query_params.get("name", "")), *edits]


def _size(text: str) -> float | None:
    """Return a number of millimetres; None if no template can have this size."""
    try:
        size = float(text)
    except ValueError:
        return None
    return size if isfinite(size) and 0.0 < size <= _LARGEST else None


def serve(shown: Sequence[Shown], sources: Sequence[bytes | None], opened: Callable[[str], object]) -> None:
    """Serve a workbench on this machine, until it is stopped (KeyboardInterrupt) or its last page is closed.

    `shown` are the mechanisms that it shows at first, read from the files `sources`, if any; `opened` is called
    with its address when it answers. Raise UnsolvableError if the script of the page was not built.
    """
    text = page(shown, "workbench", workbench=True)
    with interruptible() as look, socket.create_server(("127.0.0.1", 0)) as listening:
        place = Place(listening.getsockname()[1], secrets.token_urlsafe(24))
        presence = Presence(lambda: setattr(server, "should_exit", True))
        app = application(place, text, presence, sources)
        config = uvicorn.Config(
            app, log_level="critical", lifespan="off", server_header=False, timeout_graceful_shutdown=_LINGER
        )
        server = uvicorn.Server(config)
        opened(place.address)  # the socket listens already
        server.run(sockets=[listening])
        look()  # uvicorn ends in good order on a signal, without raising KeyboardInterrupt
