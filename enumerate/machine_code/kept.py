"""Machine code of one function in files: one for each signature, whole or not there.

numba's own cache has an index of each function, with numbers for signatures; two processes that compile different
signatures at once overwrite each other's. Here the name of a file says which signature it holds, and so does what
is in it.
"""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any
from uuid import uuid4

import llvmlite  # type: ignore[import-untyped,unused-ignore]
import numba
import numpy as np
from numba.core import caching, serialize

from enumerate.machine_code.folders import is_ours, made, prune, safe, touch, usable_bases
from enumerate.machine_code.notice import compiling
from enumerate.machine_code.sources import fingerprint

__all__ = ["CodeFiles", "KeptCode", "read_whole", "write_whole"]

_numba: Any = caching
_dumps: Callable[[object], bytes] = serialize.dumps
_DIGEST = 32
"""Bytes of the digest that a file begins with."""


class _Place(_numba._CacheLocator):
    """The name of the folder of a function's module; it changes with all that the code is made of."""

    def __init__(self, function: Callable[..., object]) -> None:
        self._py_file = function.__code__.co_filename  # numba names it in a warning
        self._line = function.__code__.co_firstlineno
        self._folder = _folder(function.__module__)

    def get_cache_path(self) -> str:
        return self._folder

    def ensure_cache_path(self) -> None:
        """Make nothing: folders are made when there is something to keep."""

    def get_source_stamp(self) -> str:
        return self._folder

    def get_disambiguator(self) -> str:
        return str(self._line)

    @classmethod
    def from_function(cls, py_func: Callable[..., object], py_file: str) -> _Place:
        del py_file
        return cls(py_func)


class _Kept(_numba.CompileResultCacheImpl):
    _locator_classes = (_Place,)


class KeptCode(_numba.FunctionCache):
    """The cache of one compiled function, for its ``Dispatcher``.

    The module of the Python function must have a file: see `fingerprint`.
    """

    _impl_class = _Kept

    def __init__(self, function: Callable[..., object]) -> None:
        super().__init__(function)
        self._cache_file = CodeFiles(self.cache_path, self._impl.filename_base)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the kept code of a signature, or None and say that it will be compiled."""
        found = super().load_overload(sig, target_context)
        if found is None:
            compiling()
        return found


@cache
def _folder(module: str) -> str:
    made_of = [fingerprint(module), sys.version, numba.__version__, llvmlite.__version__, np.__version__]
    return f"{module}-{sha256(repr(made_of).encode()).hexdigest()[:32]}"


class CodeFiles:
    """What numba calls the file of a cache: it loads, saves and forgets by key, here one file a key."""

    def __init__(self, folder: str, stem: str) -> None:
        self._folder, self._stem = folder, stem

    def _name(self, key: object) -> str:
        """Return the name of the file of a key: signature, processor and bytecode."""
        return f"{self._stem}-{sha256(repr(key).encode()).hexdigest()[:32]}.nbc"

    def load(self, key: object) -> object:
        """Return what is kept for a key, from the first folder that has it, or None."""
        for base in usable_bases():
            folder = safe(base, self._folder)
            if folder is not None:
                held = read_whole(folder / self._name(key))
                found, value = pickle.loads(held) if held is not None else (None, None)
                if found == key:
                    touch(folder)
                    return value
        return None

    def save(self, key: object, data: object) -> None:
        """Keep something in the first folder that takes it; if there is none, it is compiled again next time."""
        text = _dumps((key, data))
        for base in usable_bases():
            folder = made(base, self._folder)
            if folder is not None and write_whole(folder / self._name(key), text):
                _prune_once(base)
                return

    def flush(self) -> None:
        """Forget all signatures of the function."""
        for base in usable_bases():
            for file in (base / self._folder).glob(f"{self._stem}-*.nbc"):
                with suppress(OSError):
                    file.unlink()


@cache
def _prune_once(base: Path) -> None:
    prune(base)


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
