"""The garbage collector, kept away from objects that stay: the one switch of it that the packages share."""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["set_aside"]


@contextmanager
def set_aside(until: Callable[[Callable[[], None]], object] | None = None) -> Iterator[None]:
    """Keep objects that stay out of garbage collections, unless the caller does something of the kind.

    New objects by the million set collections off, and each looks through all that is there: the modules, the machine
    code, the units of a job, a large sheet. That takes up to half the time, and finds nothing.

    Parameters
    ----------
    until : callable, optional
        Without it, what is there already is set aside within the block, and what is made there is collected as ever.
        With it, nothing is collected within the block, and what was made there stays aside too, until the function
        that it is given is called, as by ``click.Context.call_on_close``.

    Examples
    --------
    >>> with set_aside():
    ...     gc.get_freeze_count() > 1000
    True
    """
    if gc.get_freeze_count() or not gc.isenabled():
        yield
        return
    if until is None:
        gc.freeze()
        try:
            yield
        finally:
            gc.unfreeze()
        return
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()
        until(gc.unfreeze)
