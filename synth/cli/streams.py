"""Standard output that cannot be written: full, or closed by whoever should read it."""

from __future__ import annotations

import io
import os
import sys
from typing import Any

from graphs.errors import SynthedraError

__all__ = ["OutputError", "ReaderGoneError", "guard_output"]


class OutputError(SynthedraError):
    """Standard output cannot be written."""


class ReaderGoneError(OutputError):
    """Who should read standard output has stopped reading, as ``head`` does: no reason to complain."""

    status = 128 + 13
    """The exit status of what the signal SIGPIPE stops."""


class _Guarded(io.RawIOBase):
    """The bytes of standard output (a descriptor, None if there is none).

    Its failures are told from those of files, and reported once.
    """

    def __init__(self, descriptor: int | None) -> None:
        super().__init__()
        self._descriptor = descriptor
        self._failed = False

    def writable(self) -> bool:
        """Yes."""
        return True

    def isatty(self) -> bool:
        """Return whether it is a terminal."""
        return self._descriptor is not None and os.isatty(self._descriptor)

    def fileno(self) -> int:
        """Return the descriptor."""
        if self._descriptor is None:
            raise io.UnsupportedOperation("standard output is closed")
        return self._descriptor

    def write(self, data: Any) -> int:
        """Write; what is left after a failure is dropped.

        Raise OutputError at the first failure, ReaderGoneError if there is no reader any more.
        """
        if self._failed:
            return len(data)
        try:
            if self._descriptor is None:
                raise OSError(0, "it is closed")
            return os.write(self._descriptor, data)
        except OSError as error:
            self._failed = True
            if isinstance(error, BrokenPipeError):
                raise ReaderGoneError("standard output: nobody reads it any more") from None
            raise OutputError(f"standard output: cannot be written: {error.strerror}") from None


def guard_output() -> None:
    """Let standard output raise `OutputError` where it cannot be written; consoles of Windows stay as they are."""
    if sys.platform == "win32":
        return
    if sys.stdout is None:  # closed before we began: no file may get its descriptor
        while (low := os.open(os.devnull, os.O_RDWR)) <= 2:
            pass
        os.close(low)
        descriptor, encoding, errors = None, "utf-8", "strict"
    else:
        descriptor, encoding, errors = sys.stdout.fileno(), sys.stdout.encoding, sys.stdout.errors or "strict"
    raw = _Guarded(descriptor)
    buffered = io.BufferedWriter(raw)
    sys.stdout = io.TextIOWrapper(buffered, encoding, errors, line_buffering=raw.isatty())
