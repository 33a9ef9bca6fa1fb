"""The workbench begun and ended: a port nobody else has, a new token; Ctrl-C, or its last page closed."""

from __future__ import annotations

import secrets
import socket
from collections.abc import Callable, Sequence

import uvicorn

from enumerate.runner.stopping import interruptible
from synth.viewer.pages import page
from synth.viewer.shown import Shown
from synth.viewer.workbench.app import Presence, application
from synth.viewer.workbench.guard import Place

__all__ = ["serve"]

_LINGER = 1
"""Seconds for answers that are on their way when it ends."""


def serve(shown: Sequence[Shown], sources: Sequence[bytes | None], opened: Callable[[str], object]) -> None:
    """Serve a workbench on this machine, until it is stopped (KeyboardInterrupt) or its last page is closed.

    `shown` is there when it is opened, read from the files `sources`, if there were any; `opened` is called with
    its address when it answers. Raise UnsolvableError if the script of the page was not built.
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
        look()  # uvicorn ends in good order when a signal asks for it, and says so no more
