"""Files and folders written whole or not at all: beside their place first, moved there when they are complete.

Whoever writes holds a lock of the system on the unfinished file, which ends with the process however that ends:
what can be locked belongs to nobody. Unfinished files are named ``.NAME.xxxxxxxx.unfinished``, as no other file
is. Where there are no such locks, no file is ever taken for left over.
"""

import hashlib
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from graphs.errors import OpenError, shown

if sys.platform != "win32":
    import fcntl


_ENDING = ".unfinished"
# Letters kept of a name: file systems allow 255 bytes, and prefix, digest and ending have to fit beside it.
_LONGEST = 32

_PATIENCE = 1.0  # seconds for removing files before a run stops: who pressed Ctrl-C waits no longer

_locks: set[int] = set()
"""Descriptors that hold locks of this process."""

_removers: list[subprocess.Popen[bytes]] = []
"""Processes that remove folders, kept until this one ends."""


class Unfinished:
    """An empty file or folder beside a place, locked by this process until it is released."""

    def __init__(self, place: Path, *, folder: bool = False) -> None:
        self._lock: int | None = None
        while True:
            if folder:
                self.path = Path(tempfile.mkdtemp(_ENDING, _beginning(place), place.parent))
            else:
                handle, name = tempfile.mkstemp(_ENDING, _beginning(place), place.parent)
                os.close(handle)
                self.path = Path(name)
            try:
                self._lock = _locked(self.path)
            except (BlockingIOError, FileNotFoundError):  # another run has just removed it as left over
                continue
            return

    def release(self) -> None:
        """Let others know that this process does not work on it any more."""
        if self._lock is not None:
            _unlock(self._lock)
            self._lock = None


def _beginning(place: Path) -> str:
    name = place.name
    if len(name) > _LONGEST:
        name = name[:_LONGEST] + "~" + hashlib.blake2b(os.fsencode(name), digest_size=4).hexdigest()
    return f".{name}."


def _locked(path: Path) -> int | None:
    """Lock a file or folder; return the descriptor of the lock, None where there are no locks.

    Raise BlockingIOError if a living process has it, FileNotFoundError if it is gone.
    """
    if sys.platform == "win32":
        return None
    kind = os.O_RDONLY | os.O_DIRECTORY if path.is_dir() else os.O_RDWR  # some locks need the right to write
    descriptor = os.open(path, kind | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        path.lstat()  # whoever had the lock may have removed it
    except (BlockingIOError, FileNotFoundError):
        os.close(descriptor)
        raise
    except OSError:
        os.close(descriptor)
        return None
    _locks.add(descriptor)
    return descriptor


def _unlock(descriptor: int) -> None:
    if descriptor in _locks:  # a forked process does not hold it
        _locks.remove(descriptor)
        os.close(descriptor)


def _give_up_locks() -> None:
    """Let a lock be that of the process which made it: workers of a run that was killed live a little longer."""
    for descriptor in list(_locks):
        _unlock(descriptor)


if sys.platform != "win32":
    os.register_at_fork(after_in_child=_give_up_locks)


def remove_left(place: Path) -> None:
    """Remove what processes that have ended left unfinished beside a place, and nothing else."""
    pattern = re.compile(re.escape(_beginning(place)) + "[a-z0-9_]{8}" + re.escape(_ENDING))
    left: list[Path] = []
    with suppress(OSError), os.scandir(place.parent) as entries:
        left += [place.parent / entry.name for entry in entries if pattern.fullmatch(entry.name)]
    for path in left:
        if path.is_symlink() or not (path.is_file() or path.is_dir()):
            continue
        with suppress(OSError):
            lock = _locked(path)
            if lock is None:
                continue
            try:
                remove_folder(path) if path.is_dir() else path.unlink()
            finally:
                _unlock(lock)


def remove_folder(folder: Path) -> None:
    """Remove a folder of files; after a second another process does the rest."""
    deadline = time.monotonic() + _PATIENCE
    with suppress(OSError), os.scandir(folder) as files:
        for file in files:
            if time.monotonic() > deadline:
                _removers.append(_remover(folder))
                return
            Path(file.path).unlink()
    shutil.rmtree(folder, ignore_errors=True)


def _remover(folder: Path) -> subprocess.Popen[bytes]:
    """Return a process that removes a folder and does not end with this one, or with its terminal."""
    program = "import shutil, sys; shutil.rmtree(sys.argv[1], ignore_errors=True)"
    silent = subprocess.DEVNULL
    command = [sys.executable, "-c", program, str(folder.resolve())]
    return subprocess.Popen(command, stdin=silent, stdout=silent, stderr=silent, start_new_session=True)


def check_place(path: Path, *, force: bool) -> None:
    """Raise OpenError at the place of a file (without ``force``), a folder, a link or a special file."""
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


def make_folder(path: Path) -> None:
    """Make a folder, and those above it, where it is missing; OpenError if that cannot be."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise OpenError(path, "", "a file", "a folder, or a name for a new one") from None
    except (OSError, ValueError) as error:
        raise OpenError(path, "", f"cannot be made: {reason_of(error)}", "a folder, or a name for a new one") from None


def _check_parent(path: Path) -> None:
    if not path.parent.is_dir():
        raise OpenError(path, "", f"there is no folder {shown(str(path.parent))}", "a folder that exists")


def write_text(path: Path, text: str, *, force: bool = False) -> None:
    """Write a file beside its place and move it there; OpenError if it exists and ``force`` is not set."""
    write_chunks(path, [text], force=force)


def write_chunks(path: Path, chunks: Iterable[str | bytes], *, force: bool = False) -> None:
    """Write text or bytes piece by piece, as :func:`write_text` writes one piece."""
    beside = Beside(path, force=force)
    try:
        for chunk in chunks:
            beside.write(chunk if isinstance(chunk, bytes) else chunk.encode("utf-8"))
        beside.commit()
    finally:
        beside.discard()


class FolderBeside:
    """A new folder, made beside its place, where nothing may be, and moved there when it is complete."""

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
        """Remove the folder, unless it was moved; after a second another process does the rest."""
        remove_folder(self.path)
        self._unfinished.release()


class Beside:
    """A file written beside its place and moved there when it is complete; what is there is kept until then."""

    def __init__(self, path: Path, *, force: bool = False) -> None:
        check_place(path, force=force)
        self._force = force
        os.umask(mask := os.umask(0))  # it can only be read by setting it
        try:
            self._mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~mask
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
        """Close the file and return its present path, where it can be read before it is moved."""
        with self._named():
            self.stream.close()
        return self._beside

    def commit(self) -> None:
        """Move the file to its place; OpenError if that fails, or would replace what must not be replaced."""
        with self._named():
            self.stream.close()
            check_place(self._path, force=self._force)
            self._beside.chmod(self._mode)
            self._beside.replace(self._path)
            self._unfinished.release()

    def discard(self) -> None:
        """Remove the file, unless it was committed."""
        with suppress(OSError):  # closing writes the rest, to a disk that may be full
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
    """Return the words of the system for an error, without its number and the file."""
    return error.strerror or "" if isinstance(error, OSError) else str(error)
