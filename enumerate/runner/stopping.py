"""How a user stops a run: Ctrl-C, a request to end, a terminal that is closed.

A signal sets a flag. Whoever works for long looks at it between two pieces of work, and so does the handler of the
signal before a line of our own Python code runs. What is raised inside other code may be lost: compiled code
calls back into Python and cannot pass one on (numba makes a `SystemError` of it), nor can a finalizer. There
the handler raises nothing, and is called again a moment later.
"""

from __future__ import annotations

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
"""Signals that stop a run; not every system has all."""

_OWN = frozenset({"graphs", "enumerate", "synth"})
_COMPILED = frozenset({"numba", "llvmlite"})
"""Packages whose Python code may have been called by compiled code."""

_COMPILER = ("numba.core.dispatcher", "_compile_for_args")
"""The function under which numba compiles; exceptions pass through it, but not through calls of LLVM below it."""

_AGAIN = 0.02
"""Seconds after which the handler is called again where it could not raise: not to be felt, and no load."""

_PATIENCE = 0.5
"""Seconds in which a line of our own is waited for while other Python code runs, such as an import: most take less, and
a person who pressed Ctrl-C waits no longer."""


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
def interruptible(*, ending: bool = False) -> Iterator[Callable[[], None]]:
    """Raise `Interrupted` in the main thread soon after a signal asks to stop; give what looks at the flag.

    While one is cleaned up after, a second signal is noted only; a third one raises again. An error that occurs
    after a signal is taken for its consequence. Inside another one, both have the same flag. With `ending` the
    process ends here: signals are ignored afterwards. What is yielded raises `Interrupted` if a signal has come.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: None
    elif _Flag.current is not None:
        yield _Flag.current.check
    else:
        with _heeded(_Flag(), ending) as flag:
            yield flag.check


@contextmanager
def unheard() -> Iterator[None]:
    """Put off the signals that stop a run, for processes that are started here too: see `heard_again`."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _known())
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def heard_again() -> None:
    """Hear the signals again in a process that was started where they were `unheard`."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _known())


class _Flag:
    """What the signals have asked for so far, and whether that has been raised."""

    current: _Flag | None = None
    """The flag of the process, while there is one."""

    def __init__(self) -> None:
        self._asked: list[int] = []
        self._since: float | None = None  # when a signal came that has not been raised yet
        self._caller: threading.Thread | None = None
        self._closed = False

    def check(self) -> None:
        """Raise if a signal has come."""
        if self._asked:
            self._since = None
            raise Interrupted(self._asked[0])

    def settle(self) -> None:
        """Raise if a signal has come that was not raised."""
        if self._since is not None:
            self.check()

    def ask(self, number: int, frame: FrameType | None) -> None:
        """Note a signal; raise it where that is safe, otherwise be called again."""
        if self._since is None:
            self._asked.append(number)
            if len(self._asked) == 2 or self._closed:
                return
            self._since = time.monotonic()
        if _is_safe(frame, time.monotonic() - self._since):
            self.check()
        self._call_again()

    def lost(self) -> None:
        """Note that what was raised got lost, in a finalizer."""
        self._since = time.monotonic()
        self._call_again()

    def close(self) -> None:
        """Be called no more."""
        self._closed, self._since = True, None
        if self._caller is not None:
            self._caller.join()

    def _call_again(self) -> None:
        if self._caller is None:
            self._caller = threading.Thread(target=self._keep_calling, daemon=True)
            self._caller.start()

    def _keep_calling(self) -> None:
        while not self._closed:
            time.sleep(_AGAIN)
            if self._since is not None:
                _send(self._asked[0])


@contextmanager
def _heeded(flag: _Flag, ending: bool) -> Iterator[_Flag]:
    """Let the signals set a flag."""
    before = {number: signal.signal(number, flag.ask) for number in _that_stop()}
    unraisable, sys.unraisablehook = sys.unraisablehook, _quiet_about(flag, sys.unraisablehook)
    _Flag.current = flag
    try:
        try:
            yield flag
        except Exception:
            flag.check()
            raise
        flag.settle()
    finally:
        flag.close()
        _Flag.current = None
        sys.unraisablehook = unraisable
        for number, handler in before.items():
            signal.signal(number, signal.SIG_IGN if ending else handler)


def _quiet_about(flag: _Flag, otherwise: Callable[[Any], object]) -> Callable[[Any], object]:
    """Return what is done with exceptions that cannot be passed on: `Interrupted` is raised once more."""

    def hook(unraisable: Any) -> None:
        if isinstance(unraisable.exc_value, Interrupted):
            flag.lost()
        else:
            otherwise(unraisable)

    return hook


def _is_safe(frame: FrameType | None, waited: float) -> bool:
    """Say whether an exception that is raised in a frame reaches us.

    It does in a line of our own. In other Python code it does unless compiled code may have called that: so after
    some patience it is raised there, too, since one may wait there for ever.
    """
    above: list[FrameType] = []
    while frame is not None and _package(frame) not in _OWN:
        above.append(frame)
        frame = frame.f_back
    if not above:
        return frame is not None
    compiled = [_module(one) for one in above if _package(one) in _COMPILED]
    if compiled:
        compiling = any((_module(one), one.f_code.co_name) == _COMPILER for one in above)
        return compiling and not any(name.startswith("llvmlite.binding") for name in compiled)
    return waited > _PATIENCE


def _module(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__"))


def _package(frame: FrameType) -> str:
    return _module(frame).partition(".")[0]


def _send(number: int) -> None:
    """Send a signal to the main thread, whatever it waits for."""
    if hasattr(signal, "pthread_kill"):
        main = threading.main_thread().ident
        assert main is not None
        signal.pthread_kill(main, number)
    else:
        signal.raise_signal(number)


def _known() -> list[signal.Signals]:
    return [signal.Signals[name] for name in _NAMES if name in signal.Signals.__members__]


def _that_stop() -> list[signal.Signals]:
    """Return the signals that stop a run: not those that whoever started it had ignored, but for Ctrl-C.

    Shells ignore Ctrl-C for what they run in the background, and `nohup` the end of the terminal.
    """
    return [n for n in _known() if n is signal.SIGINT or signal.getsignal(n) is not signal.SIG_IGN]
