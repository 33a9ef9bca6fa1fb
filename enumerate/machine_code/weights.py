"""When machine code pays: what jobs take while kernels are interpreted, against the price of machine code.

Whole processes, seconds of processor time on one core, one worker; kernels interpreted, and with machine code that
is kept; where nothing is kept, machine code takes about three minutes of processor time for all kernels:

    synth enumerate                                 interpreted   kept
    chains --links 8 --dof 1 --count                        0.4    1.2
    chains --links 12 --dof 1 --count                       1.0    1.2
    chains --links 14 --dof 1 --count                       8.1    1.2
    chains --links 10 --dof 1                               0.6    1.4
    sc --links 6 --dof 1                                    0.5    1.4
    sc --links 10 --dof 1                                   3.8    1.4
    scd --links 6 --dof 1 --max-degree 4                    0.5    1.5
    conical --chain watt --ground 0 --slots 8               1.1    1.4

So kept machine code is the quicker way from about two seconds of interpretation on, and code that has to be made
from about 40 seconds on: as long as it takes to make what a job needs. So a job is interpreted for longer where
nothing is kept yet (`_KEPT`, `_NOTHING_KEPT`), and none takes more than twice its shortest time by much. What a job
takes is known from the numbers of loops and freedoms, before it begins, and from the number of rows, once its units
are there; where both were wrong, units show it.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from math import inf
from typing import NamedTuple

from enumerate.machine_code.folders import holds_code
from enumerate.machine_code.kernels import use_machine_code, uses_machine_code


class _Patience(NamedTuple):
    """Seconds that a job may be interpreted for, as it says itself; and that units may take in one process."""

    expected: float
    spent: float


_KEPT = _Patience(3.0, 10.0)
"""Where machine code is kept."""

_NOTHING_KEPT = _Patience(30.0, 40.0)
"""Where all of it has to be made, in 35 to 65 seconds for one kind of job."""

_LEVELS = {1: 0.0, 2: 0.005, 3: 0.03, 4: 0.15, 5: 0.8, 6: 9.0}
"""Seconds to make the contracted graphs, or maps, with so many loops, and to count chains with M = 1 on them."""

CHAIN = 1 / 3_000
"""Seconds for the row of a chain: lists of 11 and 12 links, less what placing takes."""

# This and those below are rates of jobs that ran interpreted on one core; a factor of two changes little.
PLACEMENT = 1 / 3_000
"""Seconds for a placement of open edges, symmetric ones counted apart."""

ROUND = 1 / 10_000
"""Seconds for a placement of joints round a circle, symmetric ones counted apart."""

SIGNS = 1 / 5_000
"""Seconds for what one order of joints with opposites allows, of a chain of six links."""

PLACED = 1 / 2_000
"""Seconds for the row of a linkage of six links on slots."""

_DRAWN = 0.003
_LABELLED = 0.05
"""Seconds for the row of a drawn chain, and for those with all labels of its faces."""

_TREE = 1 / 100_000
"""Seconds for one of 3^N ways to grow a plane tree of N links."""


class _Units:
    """What the units of this process have taken, while kernels were interpreted."""

    seconds = 0.0


def expect(seconds: float) -> None:
    """Use machine code from here on if what follows takes too long while kernels are interpreted."""
    if seconds > _KEPT.expected and seconds > _patience().expected:
        use_machine_code()


def _patience() -> _Patience:
    return _KEPT if holds_code() else _NOTHING_KEPT


@contextmanager
def interpreting() -> Iterator[None]:
    """Look at the clock while a unit is worked on; use machine code if the units before it took too long."""
    if _Units.seconds > _KEPT.spent and _Units.seconds > _patience().spent:
        use_machine_code()
    with _counted(1.0):
        yield


@contextmanager
def without_kernels() -> Iterator[None]:
    """Leave out of the time of a unit what machine code would not shorten."""
    with _counted(-1.0):
        yield


@contextmanager
def _counted(sign: float) -> Iterator[None]:
    begin = time.thread_time()
    yield
    if not uses_machine_code():
        _Units.seconds += sign * (time.thread_time() - begin)


def placing(loops: int, dof: int) -> float:
    """Return the seconds that binary links take to be placed, and counted, on all contracted graphs or maps.

    With the freedoms strings become longer: placements were counted in 0.05 s with one freedom and three loops, in
    0.5 s with nine, in 1.2 s with fourteen.
    """
    return 0.0 if loops < 1 else _LEVELS.get(loops, inf) * (1.0 + dof * dof / 8.0)


def drawing(number: int, *, plain: bool) -> float:
    """Return the seconds that so many drawn chains take, with centres of one kind only (`plain`) or of all."""
    return number * (_DRAWN if plain else _LABELLED)


def layering(links: int) -> float:
    """Return the seconds that it takes to put so many links in layers, about."""
    return 2.0**links / 200_000


def growing(links: int) -> float:
    """Return the seconds that all plane trees with so many links take."""
    return _TREE * 3.0**links
