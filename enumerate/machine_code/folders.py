"""Folders that machine code is kept in: which may be used, which are old; a notice when code is compiled, or cannot be.

Others keep there what takes long to find and is the same each time. Machine code is kept as pickles, which do what
they like when they are loaded. So a folder counts only if it belongs to this user and nobody else may write there.
There may be several: what one cannot take goes to the next. The user is notified once in a run, by the process that
is the first to compile. Loads without numba.
"""

import os
import re
import shutil
import stat
import tempfile
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeAlias
from uuid import uuid4

_DAY = 86_400
"""Seconds of a day."""
_OLD = 30 * _DAY
"""Seconds after which machine code that nobody used is removed: who comes back after a month waits once."""
_MOST = 8
"""Folders kept of one module: each edit of what it is made of begins another, and two or three versions side by side,
as of branches, are as many as somebody goes back to."""
_DIGEST = 32
"""Bytes of the digest that a file begins with: those of SHA-256."""
_FOLDER = re.compile(r"([\w.]+)-[0-9a-f]{32}")
"""Name of a folder of one module. Nothing else is ever removed: a base may be anybody's folder."""


def bases() -> Iterator[Path]:
    """Yield the folders that may hold machine code, best first; none has to exist.

    ``$SYNTHEDRA_CACHE``; ``synthedra`` in ``$XDG_CACHE_HOME``, or in ``~/.cache`` where that is not set,
    if this user owns that, or the home; one in the temporary folder.
    """
    named = os.environ.get("SYNTHEDRA_CACHE")
    if named:
        yield Path(named).absolute()
    with suppress(RuntimeError, OSError):  # no home, or one that is not there
        caches = _caches()
        if caches is not None:
            yield caches / "synthedra"
    with suppress(OSError):  # no temporary folder
        user = os.geteuid() if hasattr(os, "geteuid") else 0
        yield Path(tempfile.gettempdir()) / f"synthedra-{user}"


def _caches() -> Path | None:
    """Return where programs of this user keep what they can make again; None if that is another user's.

    A relative path in ``XDG_CACHE_HOME`` counts as none, says the XDG Base Directory Specification.
    """
    named = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if named.is_absolute():
        return named if not named.exists() or _by_us(named.stat()) else None
    home = Path.home()
    return home / ".cache" if _by_us(home.stat()) else None


def _by_us(entry: os.stat_result) -> bool:
    return not hasattr(os, "geteuid") or entry.st_uid == os.geteuid()


def is_ours(entry: os.stat_result) -> bool:
    """Return whether a file or folder belongs to this user and no other may write it."""
    return _by_us(entry) and (os.name == "nt" or not entry.st_mode & (stat.S_IWGRP | stat.S_IWOTH))


def _is_safe(folder: Path) -> bool:
    """Say whether there is such a folder and it is ours; so must be a link to it."""
    try:
        return _by_us(folder.lstat()) and is_ours(folder.stat()) and folder.is_dir()
    except OSError:
        return False


def safe(base: Path, name: str) -> Path | None:
    """Return a folder in a base if there is one and both are ours, else None."""
    return base / name if _is_safe(base) and _is_safe(base / name) else None


def make_folder(base: Path, name: str = "") -> Path | None:
    """Return a folder in a base, made with the base if need be; None if it cannot be made or is not ours."""
    for folder in (base, base / name):
        with suppress(OSError):
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _is_safe(folder):
            return None
    return base / name


def usable_bases() -> Iterator[Path]:
    """Yield the bases to look into, and to write to if they allow it: all to the first that can be written.

    One that is ours and read-only, as in an image, is read before that.
    """
    for base in bases():
        if make_folder(base) is not None:
            yield base
            if os.access(base, os.W_OK):
                return


def writable_base() -> Path | None:
    """Return the base that new code goes to, or None."""
    return next((base for base in usable_bases() if os.access(base, os.W_OK)), None)


def holds_code() -> bool:
    """Return whether code of enumerations is kept already, perhaps of older sources; no folder is made to find out.

    It looks where `usable_bases` does: up to the first base that can be written, or made.
    """
    for base in bases():
        with suppress(OSError):
            if _is_safe(base) and any(_of_enumerations(folder.name) for folder in base.iterdir()):
                return True
        there = next(folder for folder in (base, *base.parents) if folder.exists())
        if (there != base or _is_safe(base)) and os.access(there, os.W_OK):
            return False
    return False


def _of_enumerations(name: str) -> bool:
    return name.startswith("enumerate.") and _FOLDER.fullmatch(name) is not None


def touch(folder: Path) -> None:
    """Note that a folder is used; once a day will do."""
    with suppress(OSError):
        if time.time() - folder.stat().st_mtime > _DAY:
            os.utime(folder)


def prune(base: Path) -> None:
    """Remove the folders of modules that were not used for a month, and all but the newest few of each module.

    Another process may do the same, or still use one: it compiles again what it does not find.
    """
    used: dict[str, list[tuple[float, Path]]] = {}
    with suppress(OSError):
        for folder in base.iterdir():
            named = _FOLDER.fullmatch(folder.name)
            if named and not folder.is_symlink():
                with suppress(OSError):
                    used.setdefault(named[1], []).append((folder.stat().st_mtime, folder))
    for folders in used.values():
        for number, (last, folder) in enumerate(sorted(folders, reverse=True)):
            if number >= _MOST or time.time() - last > _OLD:
                shutil.rmtree(folder, ignore_errors=True)


def read_whole(path: Path) -> bytes | None:
    """Return what `write_whole` wrote; None if there is no such file, it is damaged, or it is not ours."""
    try:
        with path.open("rb") as file:
            if not is_ours(os.fstat(file.fileno())):
                return None
            text = file.read()
    except OSError:
        return None
    return text[_DIGEST:] if sha256(text[_DIGEST:]).digest() == text[:_DIGEST] else None


def write_whole(path: Path, text: bytes) -> bool:
    """Write a file beside its place and move it there, readable to this user only; say whether it could be."""
    beside = path.with_name(f"{path.name}.{uuid4().hex}")
    try:
        descriptor = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600)
        with os.fdopen(descriptor, "wb") as file:
            file.write(sha256(text).digest() + text)
        beside.replace(path)
    except OSError:
        with suppress(OSError):
            beside.unlink()
        return False
    return True


def kept(name: str, file: str) -> bytes | None:
    """Return what is kept in a file of a folder that is so named, from the first base that has it, or None."""
    for base in usable_bases():
        folder = safe(base, name)
        held = None if folder is None else read_whole(folder / file)
        if folder is not None and held is not None:
            touch(folder)
            return held
    return None


def keep(name: str, file: str, text: bytes) -> None:
    """Keep a text in the first base that takes it; if there is none, it is made again next time."""
    for base in usable_bases():
        folder = make_folder(base, name)
        if folder is not None and write_whole(folder / file, text):
            _prune_once(base)
            return


@cache
def _prune_once(base: Path) -> None:
    prune(base)


Notify: TypeAlias = Callable[[Path | None, bool], None]
"""Notifies the user; takes the folder where the code will be kept, if there is one, and whether it can be compiled."""

Progress: TypeAlias = Callable[[int, int], None]
"""Takes how many functions this process has begun to compile, and how many of them are done."""

MISSING = "numba is not installed; try: pip install 'synthedra[enumerate]'"
"""Why nothing is compiled."""

INTERPRETED = f"this is interpreted, which takes many times as long as compiled code: {MISSING}"
"""What users are told where machine code would pay and cannot be made."""


class _Notice:
    """How this process notifies the user, whether it has, and how many functions it compiles.

    The count of the semaphore `left`, if there are several processes, says whether another one has.
    """

    notify: Notify | None = None
    progress: Progress | None = None
    notified = False
    shows = False
    left: Any = None
    begun = done = 0


_notice = _Notice()


def on_compiling(notify: Notify | None, progress: Progress | None = None) -> None:
    """Let a function be called before the first function is compiled, or where one should be and cannot.

    In the process that notifies, progress is called whenever a function is begun or done.
    """
    _begin(notify, progress, None)


def _begin(notify: Notify | None, progress: Progress | None, left: Any) -> None:
    _notice.notify, _notice.progress, _notice.left = notify, progress, left
    _notice.notified = _notice.shows = False
    _notice.begun = _notice.done = 0


def compiling() -> None:
    """Note that something is about to be compiled."""
    if _notice.notify is not None and _first():
        _notice.notify(writable_base(), True)
        _notice.shows = True
    _notice.begun += 1
    _show()


def compiled() -> None:
    """Note that something has been compiled."""
    _notice.done += 1
    _show()


def _show() -> None:
    if _notice.progress is not None and _notice.shows:
        _notice.progress(_notice.begun, _notice.done)


def interpreting_all() -> None:
    """Note that something should be compiled, and numba is missing; warn of it if nobody is to be notified."""
    if not _first():
        return
    if _notice.notify is not None:
        _notice.notify(None, False)
    else:
        warnings.warn(INTERPRETED, stacklevel=2)


def _first() -> bool:
    """Return whether nobody has been notified yet; from now on somebody has."""
    if _notice.notified:
        return False
    _notice.notified = True
    return _notice.left is None or bool(_notice.left.acquire(block=False))


def to_workers() -> tuple[Notify, Progress | None, Any] | None:
    """Return what `heard_by` needs in each worker process, so that only one process of all notifies."""
    if _notice.notify is None:
        return None
    if _notice.left is None:
        from multiprocessing import Semaphore

        _notice.left = Semaphore(0 if _notice.notified else 1)
    return _notice.notify, _notice.progress, _notice.left


def heard_by(shared: tuple[Notify, Progress | None, Any] | None) -> None:
    """Share in a worker what `to_workers` returned in the process that started it."""
    _begin(*(shared or (None, None, None)))
