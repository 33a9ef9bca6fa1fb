"""What machine code is made of."""

import ast
import sys
from importlib.util import resolve_name
from pathlib import Path

import pytest
from toy_kernels import ROOT, edit, make_toy

from enumerate.machine_code import cache

FILES = [path for package in ("graphs", "enumerate", "synth") for path in (ROOT / package).rglob("*.py")]


@pytest.fixture
def fresh(monkeypatch, tmp_path):
    """The toy package, as if imported; what was read is forgotten."""

    def fingerprint(module):
        for known in (cache.fingerprint, cache._file, cache._read):
            known.cache_clear()
        return cache.fingerprint(module)

    package = make_toy(tmp_path)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    monkeypatch.setitem(sys.modules, "toy", type(sys)("toy"))
    sys.modules["toy"].__file__ = str(package / "__init__.py")
    yield package, fingerprint
    fingerprint("toy")


def test_a_fingerprint_follows_imports(fresh):
    package, fingerprint = fresh
    outer, inner = fingerprint("toy.outer"), fingerprint("toy.inner")
    assert fingerprint("toy.outer") == outer
    edit(package / "outer.py", "10 *", "20 *")
    assert fingerprint("toy.inner") == inner
    second = fingerprint("toy.outer")
    edit(package / "inner.py", "x + 1", "x + 2")
    assert len({outer, second, fingerprint("toy.outer")}) == 3
    assert fingerprint("toy.inner") != inner


@pytest.mark.parametrize(
    "line",
    ["from toy import constants", "from toy.constants import (\n    TWO,  # a number\n)", "import toy.constants as c",
     "from . import constants", "from .constants import TWO", "from toy import TWO"],
)  # fmt: skip
def test_every_form_of_import_counts(fresh, line):
    """The last takes a name from the face of the package, which has it from one of its files."""
    package, fingerprint = fresh
    (package / "constants.py").write_text("TWO = 2\n")
    (package / "outer.py").write_text(line + "\n")
    before = fingerprint("toy.outer")
    edit(package / "constants.py", "TWO = 2", "TWO = 3")
    assert fingerprint("toy.outer") != before


def heads(path: Path) -> set[str]:
    """Modules imported at the head of a file, by its syntax tree."""
    name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
    package = name.removesuffix(".__init__") if path.name == "__init__.py" else name.rpartition(".")[0]
    found = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom):
            found.add(resolve_name("." * node.level + (node.module or ""), package))
        elif isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
    return found


def test_imports_are_found_as_the_syntax_tree_has_them():
    for path in FILES:
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        assert heads(path) <= cache._read(name)[1], path
