"""Machine code of one function in files, one for each signature, whole or not there; and what it is made of.

numba's own cache has an index of each function, with numbers for signatures; two processes that compile different
signatures at once overwrite each other's. Here the name of a file says which signature it holds, and so does what
is in it. And numba looks at the file of the function that is called only. Here code is renewed when the text of
its module changes, or of any own module that this imports: functions called there are part of the machine code.
"""

from __future__ import annotations

import pickle
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from hashlib import sha256
from importlib.util import resolve_name
from pathlib import Path
from typing import Any

import llvmlite  # type: ignore[import-untyped,unused-ignore]
import numba
import numpy as np
from numba.core import caching, serialize

from enumerate.machine_code.folders import compiled, compiling, keep, kept, usable_bases

_numba: Any = caching
_dumps: Callable[[object], bytes] = serialize.dumps


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

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep the code of a signature, and say that it is compiled."""
        super().save_overload(sig, data)
        compiled()


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
        held = kept(self._folder, self._name(key))
        found, value = pickle.loads(held) if held is not None else (None, None)
        return value if found == key else None

    def save(self, key: object, data: object) -> None:
        """Keep something in the first folder that takes it; if there is none, it is compiled again next time."""
        keep(self._folder, self._name(key), _dumps((key, data)))

    def flush(self) -> None:
        """Forget all signatures of the function."""
        for base in usable_bases():
            for file in (base / self._folder).glob(f"{self._stem}-*.nbc"):
                with suppress(OSError):
                    file.unlink()


_OWN = frozenset({"graphs", "enumerate", "synth"})
_IMPORT = re.compile(r"^from +([\w.]+) +import +(\([^)]*\)|[^\n#]*)|^import +([^\n#]*)", re.MULTILINE)
"""An import at the head of a file. Found by its looks: parsing takes fifteen times as long as reading."""
_NAME = re.compile(r"([\w.]+)(?: +as +\w+)?")


@cache
def fingerprint(module: str) -> str:
    """Return a digest of the source of a module and of all own modules that it imports, at any remove.

    Own are the packages of the project and the one that the module is in. Files are read once in a process: an
    edit while it runs does not change what it has imported. A module without a file has the empty text.
    """
    own = _OWN | {module.partition(".")[0]}
    if _file(module) is None:
        return ""
    seen: dict[str, bytes] = {}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name not in seen and name.partition(".")[0] in own and _file(name) is not None:
            seen[name], imported = _read(name)
            waiting.extend(imported)
    lines = (f"{name} {digest.hex()}" for name, digest in sorted(seen.items()))
    return sha256("\n".join(lines).encode()).hexdigest()


@cache
def _file(name: str) -> Path | None:
    """Return the file of a module of the project, or of another package that is imported, or None."""
    package = name.partition(".")[0]
    own = __file__ if package in _OWN else getattr(sys.modules.get(package), "__file__", None)
    if own is None:
        return None
    root = Path(own).parents[2 if package in _OWN else 1 if own.endswith("__init__.py") else 0]
    here = root.joinpath(*name.split("."))
    return next((file for file in (here.with_suffix(".py"), here / "__init__.py") if file.is_file()), None)


@cache
def _read(module: str) -> tuple[bytes, frozenset[str]]:
    """Return the digest of a module's file, and the modules that its head may take something from."""
    file = _file(module)
    assert file is not None
    text = file.read_bytes()
    package = module if file.name == "__init__.py" else module.rpartition(".")[0]
    found: set[str] = set()
    for source, names, plain in _IMPORT.findall(text.decode("utf-8", "replace")):
        words = _NAME.findall(re.sub(r"#[^\n]*", "", names or plain))
        found.update(_sources_of(resolve_name(source, package), words) if source else words)
    return sha256(text).digest(), frozenset(found)


def _sources_of(module: str, names: list[str]) -> Iterator[str]:
    """Yield where names that are imported from a module may come from.

    A name that is taken from the face of a room comes from one of its files: all of them count.
    """
    yield module
    file = _file(module)
    if file is None or file.name != "__init__.py":
        return
    inner = [f"{module}.{name}" for name in names]
    yield from inner
    if any(_file(name) is None for name in inner):
        yield from (f"{module}.{path.stem}" for path in file.parent.glob("*.py") if path != file)
