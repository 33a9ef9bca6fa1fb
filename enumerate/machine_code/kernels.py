"""Kernels: functions of numbers and arrays that are interpreted, or compiled by numba.

A kernel is a Python function that numba can compile. While little is asked of them, kernels are interpreted, and
numba is not even imported. `use_machine_code` puts machine code in their place, wherever they are named, for the
rest of the process; what they return is the same. `enumerate.machine_code.weights` says when that pays, unless
``SYNTHEDRA_MACHINE_CODE`` is ``always`` or ``never``. Where numba is not installed (the extra ``enumerate``), all
kernels are interpreted, and the user is notified of it where machine code would pay. So that both return the same,
kernels

- read bytes as ``int(...)`` before they reckon with them: numpy's bytes run over, numba's do not;
- leave sums and products that run over 64 bits to `enumerate.kernel.words`;
- return numbers to Python as ``int(...)``.
"""

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import wraps
from importlib.util import find_spec
from threading import Lock
from types import FunctionType
from typing import Any, TypeVar, cast

import numpy as np

from enumerate.machine_code.folders import interpreting_all

F = TypeVar("F", bound=Callable[..., object])


def _choice() -> str:
    return os.environ.get("SYNTHEDRA_MACHINE_CODE", "auto")


def can_compile() -> bool:
    """Return whether numba is installed: it belongs to the extra ``enumerate``."""
    return find_spec("numba") is not None


_NEVER_INTERPRETED = frozenset({"synth.analysis.assembly.kernel"})
"""Modules whose kernels begin with machine code if they can: interpreted they are too slow for any answer."""


@dataclass
class _Kernels:
    """The kernels of the modules imported so far: as they are interpreted, with what numba compiles for each.

    `machine_code` are the functions of numba, in the same order, once machine code is used.
    """

    used: bool
    interpreted: list[tuple[FunctionType, FunctionType]] = field(default_factory=list)
    machine_code: list[Any] = field(default_factory=list)
    lock: Lock = field(default_factory=Lock)


_kernels = _Kernels(used=_choice() == "always" and can_compile())


def compiled(function: F) -> F:
    """Make a function of numbers and arrays a kernel: it stays as it is until machine code is used.

    Then it is compiled when it is first called, and the machine code is kept for this user in
    ``~/.cache/synthedra``, or where ``SYNTHEDRA_CACHE`` or ``XDG_CACHE_HOME`` says. It is renewed when the
    function's module changes or any own module that it imports. Other threads run meanwhile.
    """
    return _kernel(function, function)


def compiled_beside(interpreted: F) -> Callable[[F], F]:
    """Return a decorator like `compiled` for a function that is interpreted by another, which returns the same."""
    return lambda function: _kernel(interpreted, function)


def _kernel(interpreted: F, function: F) -> F:
    if interpreted.__module__ in _NEVER_INTERPRETED:
        interpreted = _beginning_machine_code(interpreted)
    with _kernels.lock:
        _kernels.interpreted.append((cast(FunctionType, interpreted), cast(FunctionType, function)))
        if not _kernels.used:
            return interpreted
        _kernels.machine_code.append(_dispatcher(function))
        return cast(F, _kernels.machine_code[-1])


def _beginning_machine_code(function: F) -> F:
    """Return a function that puts machine code in the place of all kernels, and calls what is then in its own."""

    @wraps(function)
    def first_call(*arguments: Any) -> Any:
        use_machine_code()
        kernel = getattr(sys.modules[function.__module__], function.__name__)
        if kernel is not first_call:
            return kernel(*arguments)
        with np.errstate(all="ignore"):  # as machine code does: complex sines may run over
            return function(*arguments)

    return cast(F, first_call)


def _dispatcher(function: Callable[..., object]) -> Any:
    """Return the function of numba that compiles a kernel, or takes machine code that is kept."""
    import numba

    from enumerate.machine_code.cache import KeptCode, fingerprint

    kernel: Any = numba.njit(nogil=True)(function)
    if fingerprint(function.__module__) and hasattr(kernel, "enable_caching"):  # without, numba compiles nothing
        kernel._cache = KeptCode(function)
    return kernel


def use_machine_code() -> None:
    """Put machine code in the place of all kernels, in all modules: it is made, or loaded, as it is called."""
    if _choice() == "never":
        return
    if not can_compile():
        interpreting_all()
        return
    with _kernels.lock:
        if _kernels.used:
            return
        _kernels.machine_code = [_dispatcher(function) for _, function in _kernels.interpreted]
        _kernels.used = True
        pairs = zip(_kernels.interpreted, _kernels.machine_code, strict=True)
        instead = {interpreted: kernel for (interpreted, _), kernel in pairs}
        for module in list(sys.modules.values()):
            for name, value in list(vars(module).items()):
                if isinstance(value, FunctionType) and value in instead:
                    setattr(module, name, instead[value])


def uses_machine_code() -> bool:
    """Say whether kernels of this process are machine code."""
    return _kernels.used


def compiled_here() -> int:
    """Return how many functions this process has compiled; each counts once for each type of arguments."""
    return sum(sum(kernel.stats.cache_misses.values()) for kernel in _kernels.machine_code)
