"""What the machine code of a module is made of: the text of the module and of every own module that it imports.

numba itself looks at the file of the function that is called, and not at those of the functions called there,
which are part of the same machine code.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from importlib.util import resolve_name
from pathlib import Path

__all__ = ["fingerprint"]

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
