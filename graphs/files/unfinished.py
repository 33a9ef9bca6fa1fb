"""What is not finished lies beside its place; what killed processes left there is found and removed.

A process that is killed removes nothing. So whoever writes holds a lock of the system on what it writes, which
ends with the process however that ends: what can be locked belongs to nobody. Names begin and end in a way that no
other file has: ``.NAME.xxxxxxxx.unfinished``. Where the system or the file system has no such locks, nothing is
ever taken for left over.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

__all__ = ["Unfinished", "remove_folder", "remove_left"]

_ENDING = ".unfinished"
_LONGEST = 32
"""Letters of a name that are kept in that of what is not finished; a digest stands for the rest."""

_PATIENCE = 1.0
"""Seconds in which whoever stops a run may wait for files to be removed."""

_locks: set[int] = set()
"""Descriptors that hold locks of this process."""

_removers: list[subprocess.Popen[bytes]] = []
"""Processes that remove folders, kept until this one ends."""


class Unfinished:
    """An empty file or folder beside a place, locked by this process until it is released.

    `place` is where it is moved when it is finished. Raise OSError or ValueError if it cannot be made.
    """

    def __init__(self, place: Path, *, folder: bool = False) -> None:
        self._lock: int | None = None
        while True:
            self.path = _made(place, folder)
            try:
                self._lock = _locked(self.path)
            except (BlockingIOError, FileNotFoundError):  # another run just took it for left over
                continue
            return

    def release(self) -> None:
        """Let others know that this process does not work on it any more."""
        if self._lock is not None:
            _unlock(self._lock)
            self._lock = None


def _made(place: Path, folder: bool) -> Path:
    if folder:
        return Path(tempfile.mkdtemp(_ENDING, _beginning(place), place.parent))
    handle, name = tempfile.mkstemp(_ENDING, _beginning(place), place.parent)
    os.close(handle)
    return Path(name)


def _beginning(place: Path) -> str:
    name = place.name
    if len(name) > _LONGEST:
        name = name[:_LONGEST] + "~" + hashlib.blake2b(os.fsencode(name), digest_size=4).hexdigest()
    return f".{name}."


def _locked(path: Path) -> int | None:
    """Lock a file or folder; return the descriptor that holds the lock, None where there are no locks.

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
    if descriptor in _locks:  # a process that was forked has given it up
        _locks.remove(descriptor)
        os.close(descriptor)


def _give_up_locks() -> None:
    """Let a lock be that of the process which made it: workers of a run that was killed live a little longer."""
    for descriptor in list(_locks):
        _unlock(descriptor)


if sys.platform != "win32":
    os.register_at_fork(after_in_child=_give_up_locks)


def remove_left(place: Path) -> None:
    """Remove what processes that have ended left unfinished beside a place, and nothing else.

    Unfinished files for other places stay, and so does what cannot be removed: it hinders nobody.
    """
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
    """Remove a folder of files; what takes longer than a second is left to another process."""
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
    return subprocess.Popen(
        [sys.executable, "-c", program, folder.resolve()],
        stdin=silent,
        stdout=silent,
        stderr=silent,
        start_new_session=True,
    )
