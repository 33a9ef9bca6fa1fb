"""A word to the user when code has to be compiled: once in a run, whichever of its processes is the first."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from multiprocessing.synchronize import Semaphore

__all__ = ["Telling", "compiling", "heard_by", "on_compiling", "to_workers"]

Telling: TypeAlias = Callable[[Path | None], None]
"""Tells the user; takes the folder where the code will be kept, if there is one."""


class _Notice:
    """How this process tells, and whether it has; the count of a semaphore says whether another process has."""

    tell: Telling | None = None
    told = False
    left: Semaphore | None = None


_notice = _Notice()


def on_compiling(tell: Telling | None) -> None:
    """Let a function be called before the first function is compiled; without one, nothing is said."""
    _notice.tell, _notice.told, _notice.left = tell, False, None


def compiling() -> None:
    """Note that something is about to be compiled."""
    if _notice.tell is None or _notice.told:
        return
    _notice.told = True
    if _notice.left is None or _notice.left.acquire(block=False):
        from enumerate.machine_code.folders import writable_base

        _notice.tell(writable_base())


def to_workers() -> tuple[Telling, Semaphore] | None:
    """Return what `heard_by` needs in each worker process, so that only one process of all tells."""
    if _notice.tell is None:
        return None
    if _notice.left is None:
        from multiprocessing import Semaphore

        _notice.left = Semaphore(0 if _notice.told else 1)
    return _notice.tell, _notice.left


def heard_by(shared: tuple[Telling, Semaphore] | None) -> None:
    """Share in a worker what `to_workers` gave in the process that started it."""
    tell, left = shared or (None, None)
    _notice.tell, _notice.told, _notice.left = tell, False, left
