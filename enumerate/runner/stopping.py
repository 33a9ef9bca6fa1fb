"""How a user stops a run: Ctrl-C, a request to end, a terminal that is closed."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["Interrupted", "interruptible"]

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
"""Signals that stop a run; not every system has all."""


class Interrupted(KeyboardInterrupt):
    """The user stopped the run; all units handed to a store are safe.

    It is a `KeyboardInterrupt`, which code that catches exceptions lets pass.

    Attributes
    ----------
    number : int
        The signal.

    Examples
    --------
    >>> Interrupted(signal.SIGTERM).status
    143
    """

    def __init__(self, number: int = signal.SIGINT) -> None:
        super().__init__(number)
        self.number = int(number)

    @property
    def status(self) -> int:
        """Exit status of a command that this ended, as shells count."""
        return 128 + self.number


@contextmanager
def interruptible() -> Iterator[Callable[[], None]]:
    """Raise `Interrupted` where the main thread is when a signal asks to stop; give what raises it again.

    It may be raised inside code that cannot pass it on, such as a finalizer: whoever works for long looks now and
    then. While one is cleaned up after, a second signal is noted only; a third one raises again.
    """
    asked: list[int] = []

    def check() -> None:
        if asked:
            raise Interrupted(asked[0])

    def ask(number: int, frame: object) -> None:
        asked.append(number)
        if len(asked) != 2:
            raise Interrupted(asked[0])

    if threading.current_thread() is not threading.main_thread():
        yield check
        return
    before = {number: signal.signal(number, ask) for number in _heeded()}
    try:
        yield check
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _heeded() -> list[signal.Signals]:
    """Return the signals that stop a run: not those that whoever started it had ignored, but for Ctrl-C.

    Shells ignore Ctrl-C for what they run in the background, and `nohup` the end of the terminal.
    """
    known = [signal.Signals[name] for name in _NAMES if name in signal.Signals.__members__]
    return [n for n in known if n is signal.SIGINT or signal.getsignal(n) is not signal.SIG_IGN]
