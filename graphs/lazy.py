"""Faces of rooms: names that a folder offers, imported from its files when they are first asked for (PEP 562).

Modules of a folder are imported so too, so that ``synth.linkages.fourbar.position`` works after ``import synth``
alone. The names stand once, in the stub beside the face (``__init__.pyi``), where type checkers read them too. It is
the idea of SPEC 1 of Scientific Python; a stub may name files of any room here.
"""

import ast
import sys
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

__all__ = ["module_of", "names_in_stub", "offered"]


def offered(package: str) -> tuple[Callable[[str], object], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package, by its stub, while it is imported."""
    modules = names_in_stub(Path(str(sys.modules[package].__file__)).with_suffix(".pyi"))

    def look_up(name: str) -> object:
        if name not in modules:
            return module_of(package, name)
        value: object = getattr(import_module(modules[name]), name)
        setattr(sys.modules[package], name, value)  # found at once from now on
        return value

    def names_of_room() -> list[str]:
        return sorted({*vars(sys.modules[package]), *modules})

    return look_up, names_of_room, sorted(modules)


def module_of(package: str, name: str) -> ModuleType:
    """Return a module of a package, imported as it is asked for; AttributeError if there is none of this name."""
    if name.startswith("_") or find_spec(f"{package}.{name}") is None:
        raise AttributeError(f"module {package!r} has no attribute {name!r}")
    return import_module(f"{package}.{name}")


def names_in_stub(stub: Path) -> dict[str, str]:
    """Return the names that a stub (``__init__.pyi``) imports as themselves, each with its module."""
    return {
        alias.asname: node.module
        for node in ast.parse(stub.read_text(encoding="utf-8")).body
        if isinstance(node, ast.ImportFrom) and node.module
        for alias in node.names
        if alias.asname
    }
