"""Files and folders written whole or not at all: made beside their place, moved there when they are complete."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from graphs.errors import OpenError

__all__ = ["Beside", "FolderBeside", "reason_of", "write_chunks", "write_text"]

_PATIENCE = 1.0
"""Seconds in which whoever stops a run may wait for files to be removed."""

_removers: list[subprocess.Popen[bytes]] = []
"""Processes that remove folders, kept until this one ends."""


def write_text(path: Path, text: str) -> None:
    """Write a file beside its place and move it there, so that it is never half written.

    Raises
    ------
    OpenError
        If it cannot be written; what was there is kept.
    """
    write_chunks(path, [text])


def write_chunks(path: Path, chunks: Iterable[str]) -> None:
    """Write text that comes piece by piece, as :func:`write_text` writes one piece."""
    beside = Beside(path)
    try:
        for chunk in chunks:
            beside.write(chunk.encode("utf-8"))
        beside.commit()
    finally:
        beside.discard()


class FolderBeside:
    """A new folder, made beside its place and moved there when it is complete.

    Parameters
    ----------
    path : Path

    Raises
    ------
    OpenError
        If there is something at its place, or it cannot be made.
    """

    def __init__(self, path: Path) -> None:
        if path.exists():
            raise OpenError(path, "", "exists already", "a new folder")
        self._place = path
        try:
            self.path = Path(tempfile.mkdtemp(prefix=f".{path.name[:32]}.", dir=path.parent))
        except OSError as error:
            raise OpenError(path, "", f"cannot be made: {error.strerror}", "a writable folder") from None

    def commit(self) -> None:
        """Move the folder to its place."""
        self.path.chmod(0o755)
        self.path.rename(self._place)

    def discard(self) -> None:
        """Remove the folder, unless it was moved; what takes longer than a second is left to another process."""
        deadline = time.monotonic() + _PATIENCE
        with suppress(OSError), os.scandir(self.path) as files:
            for file in files:
                if time.monotonic() > deadline:
                    _removers.append(_remover(self.path))
                    return
                Path(file.path).unlink()
        shutil.rmtree(self.path, ignore_errors=True)


def _remover(folder: Path) -> subprocess.Popen[bytes]:
    """Return a process that removes a folder and does not end with this one, or with its terminal."""
    program = "import shutil, sys; shutil.rmtree(sys.argv[1], ignore_errors=True)"
    silent = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-c", program, folder.resolve()],
        stdin=silent,
        stdout=silent,
        stderr=silent,
        start_new_session=True,
    )


class Beside:
    """A file that is written beside its place and moved there when it is whole.

    Parameters
    ----------
    path : Path
        Its place; a file that is there is kept until :meth:`commit`.

    Raises
    ------
    OpenError
        If the folder cannot be written to.
    """

    def __init__(self, path: Path) -> None:
        if path.is_dir():
            raise OpenError(path, "", "a directory", "a file to write")
        try:
            self._mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
            handle, name = tempfile.mkstemp(prefix=f".{path.name[:32]}.", dir=path.parent)
        except (OSError, ValueError) as error:
            raise OpenError(path, "", f"cannot be written: {reason_of(error)}", "a writable folder") from None
        self._path, self._beside = path, Path(name)
        self.stream = os.fdopen(handle, "wb")

    def write(self, data: bytes) -> None:
        """Append bytes.

        Raises
        ------
        FileError
            If the disk is full, or otherwise broken.
        """
        with self._named():
            self.stream.write(data)

    def commit(self) -> None:
        """Move the file to its place."""
        with self._named():
            self.stream.close()
            self._beside.chmod(self._mode)
            self._beside.replace(self._path)

    def discard(self) -> None:
        """Remove the file, unless it was committed."""
        with suppress(OSError):  # closing writes what is left, to a disk that may be full
            self.stream.close()
        self._beside.unlink(missing_ok=True)

    @contextmanager
    def _named(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise OpenError(self._path, "", f"cannot be written: {reason_of(error)}") from None


def reason_of(error: OSError | ValueError) -> str:
    """Return what the system says of an error, without its number and the file."""
    return error.strerror or "" if isinstance(error, OSError) else str(error)


def _umask() -> int:
    """Return the umask; it can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
