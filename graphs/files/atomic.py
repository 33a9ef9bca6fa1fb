"""Files and folders written whole or not at all: made beside their place, moved there when they are complete.

What is there already is not replaced unless that is asked for (``force``). Symbolic links and special files
(pipes, devices) are never written to nor replaced. What a killed process leaves: `graphs.files.unfinished`.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from graphs.errors import OpenError, shown
from graphs.files.unfinished import Unfinished, remove_folder

__all__ = ["Beside", "FolderBeside", "check_new_folder", "check_place", "reason_of", "write_chunks", "write_text"]


def check_place(path: Path, *, force: bool) -> None:
    """Refuse a place where something must not be replaced; with ``force`` a plain file may be.

    Raise OpenError for a file (without ``force``), a folder, a symbolic link, wherever it leads, a special file,
    or if there is no folder to write to.
    """
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        _check_parent(path)
        return
    except (OSError, ValueError) as error:
        raise OpenError(path, "", f"cannot be written: {reason_of(error)}", "a writable folder") from None
    if stat.S_ISLNK(mode):
        raise OpenError(path, "", "a symbolic link", "the name of the file itself")
    if stat.S_ISDIR(mode):
        raise OpenError(path, "", "a directory", "a file to write")
    if not stat.S_ISREG(mode):
        raise OpenError(path, "", "a special file, such as a pipe or a device", "a file to write")
    if not force:
        raise OpenError(path, "", "exists already", "another name, or --force (in Python force=True)")


def check_new_folder(path: Path) -> None:
    """Raise OpenError if something is at the place of a new folder."""
    if path.exists() or path.is_symlink():
        raise OpenError(path, "", "exists already", "a new folder: folders are not replaced")
    _check_parent(path)


def _check_parent(path: Path) -> None:
    if not path.parent.is_dir():
        raise OpenError(path, "", f"there is no folder {shown(str(path.parent))}", "a folder that exists")


def write_text(path: Path, text: str, *, force: bool = False) -> None:
    """Write a file beside its place and move it there, so that it is never half written.

    Raise OpenError if it cannot be written, or exists and ``force`` is not set; the file there is kept.
    """
    write_chunks(path, [text], force=force)


def write_chunks(path: Path, chunks: Iterable[str], *, force: bool = False) -> None:
    """Write text that comes piece by piece, as :func:`write_text` writes one piece."""
    beside = Beside(path, force=force)
    try:
        for chunk in chunks:
            beside.write(chunk.encode("utf-8"))
        beside.commit()
    finally:
        beside.discard()


class FolderBeside:
    """A new folder, made beside its place and moved there when it is complete.

    Raise OpenError if something is at its place, or it cannot be made.
    """

    def __init__(self, path: Path) -> None:
        check_new_folder(path)
        self._place = path
        try:
            self._unfinished = Unfinished(path, folder=True)
        except OSError as error:
            raise OpenError(path, "", f"cannot be made: {error.strerror}", "a writable folder") from None
        self.path = self._unfinished.path

    def commit(self) -> None:
        """Move the folder to its place."""
        self.path.chmod(0o755)
        self.path.rename(self._place)
        self._unfinished.release()

    def discard(self) -> None:
        """Remove the folder, unless it was moved; what takes longer than a second is left to another process."""
        remove_folder(self.path)
        self._unfinished.release()


class Beside:
    """A file that is written beside its place and moved there when it is complete.

    A file at its place is kept until :meth:`commit`, and replaced only with `force`. Raise OpenError if the folder
    cannot be written to, or something there must not be replaced.
    """

    def __init__(self, path: Path, *, force: bool = False) -> None:
        check_place(path, force=force)
        self._force = force
        try:
            self._mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
            self._unfinished = Unfinished(path)
            self.stream = self._unfinished.path.open("wb")
        except (OSError, ValueError) as error:
            raise OpenError(path, "", f"cannot be written: {reason_of(error)}", "a writable folder") from None
        self._path, self._beside = path, self._unfinished.path

    def write(self, data: bytes) -> None:
        """Append bytes; FileError if the disk is full, or writing fails otherwise."""
        with self._named():
            self.stream.write(data)

    def closed(self) -> Path:
        """Return where the file is before it is moved, written out so that it can be read."""
        with self._named():
            self.stream.close()
        return self._beside

    def commit(self) -> None:
        """Move the file to its place.

        Raise OpenError if that fails, or something is there now that must not be replaced.
        """
        with self._named():
            self.stream.close()
            check_place(self._path, force=self._force)
            self._beside.chmod(self._mode)
            self._beside.replace(self._path)
            self._unfinished.release()

    def discard(self) -> None:
        """Remove the file, unless it was committed."""
        with suppress(OSError):  # closing writes what is left, to a disk that may be full
            self.stream.close()
        self._beside.unlink(missing_ok=True)
        self._unfinished.release()

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
