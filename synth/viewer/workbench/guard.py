"""Who may ask the workbench: a page of its own, on this machine, that knows the token.

Any page in a browser can send requests to this machine, and a name of another's can be made to lead here. So a
request is answered only if it names this host and port, comes from no other origin, has the token in its path, and
is not too large. Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from hmac import compare_digest
from typing import Any

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send

__all__ = ["MOST_BYTES", "Guard", "Place"]

MOST_BYTES = 50_000_000
"""Of a file that is dropped."""
_METHODS = ("GET", "POST")
_OWN_SITE = (b"same-origin", b"none")
HEADERS = {
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
}


@dataclass(frozen=True, slots=True)
class Place:
    """The port of a workbench, and its token, known to its own page alone."""

    port: int
    token: str

    @property
    def host(self) -> str:
        """As browsers name it."""
        return f"127.0.0.1:{self.port}"

    @property
    def address(self) -> str:
        """The address that a browser opens.

        >>> Place(8000, "secret").address
        'http://127.0.0.1:8000/secret/'
        """
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
            refused = self._refusal(scope)
            if refused is None:
                inside = {**scope, "path": scope["path"][len(self._place.token) + 1 :]}
                await self._app(inside, receive, send)
            else:
                await refused(scope, receive, send)

    def _refusal(self, scope: Scope) -> PlainTextResponse | None:
        """Return why a request is not answered, or None."""
        if self._foreign(scope["headers"]):
            return _refused("this page is for itself alone", 403)
        given = scope["path"].encode("utf-8", "surrogateescape")
        own = f"/{self._place.token}/".encode()
        if not compare_digest(given[: len(own)], own):
            return _refused("there is nothing here", 404)
        if scope["method"] not in _METHODS:
            return _refused("there is nothing to do so", 405)
        if scope["method"] == "POST":
            return _too_large(scope["headers"])
        return None

    def _foreign(self, headers: list[tuple[bytes, bytes]]) -> bool:
        host, origin = _all(headers, b"host"), _all(headers, b"origin")
        site = _all(headers, b"sec-fetch-site")
        own = self._place.host.encode()
        return (
            host != [own]
            or any(one != b"http://" + own for one in origin)
            or any(one not in _OWN_SITE for one in site)
        )


def _too_large(headers: list[tuple[bytes, bytes]]) -> PlainTextResponse | None:
    lengths = _all(headers, b"content-length")
    if len(lengths) != 1 or not lengths[0].isdigit() or len(lengths[0]) > len(str(MOST_BYTES)) + 1:
        return _refused("expected a length of at most 50 megabytes", 411)
    return _refused("the file is larger than 50 megabytes", 413) if int(lengths[0]) > MOST_BYTES else None


def _all(headers: list[tuple[bytes, bytes]], name: bytes) -> list[bytes]:
    return [value for key, value in headers if key.lower() == name]


def _refused(why: str, status: int, **more: Any) -> PlainTextResponse:
    return PlainTextResponse(why, status, headers=HEADERS, **more)
