"""Paths, links and names in the project's papers resolve; nothing cites what is not in the project."""

import inspect
import re
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from types import FunctionType

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAPERS = sorted(
    [*ROOT.glob("*.md"), *(path for path in ROOT.glob("docs/**/*.md") if "reference" not in path.parts)]
)
CODE = sorted(path for folder in ("graphs", "enumerate", "synth", "tests", "data", "benchmarks")
              for path in (ROOT / folder).rglob("*.py"))  # fmt: skip
FOLDERS = ("graphs", "enumerate", "synth", "data", "docs", "tests", "benchmarks")
NAME = re.compile(r"(?<![\w./-])(?:graphs|enumerate|synth)(?:\.\w+)+(?![\w/])")
PATH = re.compile(rf"(?<![\w./-])(?:{'|'.join(FOLDERS)})/[\w./-]*[\w/]")
LINK = re.compile(r"\]\((?!https?:|mailto:|#)([^)#\s]+)(#[^)\s]*)?\)")


def resolves(name):
    """Whether a dotted name is a module, or something that one has."""
    parts = name.split(".")
    for cut in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(parts[:cut]))
        except ImportError:
            continue
        for part in parts[cut:]:
            if not hasattr(thing, part):
                return False
            thing = getattr(thing, part)
        return True
    return False


@pytest.mark.parametrize("path", PAPERS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_and_paths_of_papers_resolve(path):
    text = path.read_text(encoding="utf-8")
    for link, _ in LINK.findall(text):
        assert (path.parent / link).exists(), f"{path}: {link}"
    for place in PATH.findall(text):
        assert (ROOT / place).exists(), f"{path}: {place}"


@pytest.mark.parametrize("path", PAPERS, ids=lambda path: str(path.relative_to(ROOT)))
def test_names_in_papers_resolve(path):
    for name in NAME.findall(path.read_text(encoding="utf-8")):
        assert resolves(name), f"{path}: {name}"


def test_names_and_paths_in_docstrings_resolve():
    """Names in backquotes and in roles, and pages of documentation, wherever code cites them."""
    quoted = re.compile(r"`((?:graphs|enumerate|synth)(?:\.\w+)+)`")
    pages = re.compile(r"(?<![\w/])(?:docs|tests)/[\w./-]*\w")
    for path in CODE:
        text = path.read_text(encoding="utf-8")
        for name in quoted.findall(text):
            assert resolves(name), f"{path}: {name}"
        for place in pages.findall(text):
            assert (ROOT / place).exists(), f"{path}: {place}"


def test_every_document_that_is_cited_is_in_the_project():
    """Documents have names in capitals, cited with their ending or with a section."""
    cited = re.compile(r"\b([A-Z]{4,})(?:\.md\b|,? sections? \d)")
    own = {path.stem for path in PAPERS}
    assert {"README", "CHANGELOG"} < own
    for path in [*CODE, *PAPERS, ROOT / "Makefile", ROOT / "pyproject.toml"]:
        for name in cited.findall(path.read_text(encoding="utf-8")):
            assert name in own, f"{path}: {name}"


def test_every_theory_page_is_cited_by_code():
    code = "".join(path.read_text(encoding="utf-8") for path in CODE)
    for page in {*(ROOT / "docs" / "theory").glob("*.md")} - {ROOT / "docs" / "theory" / "index.md"}:
        assert f"docs/theory/{page.name}" in code, page


def test_every_theory_page_is_in_its_index():
    index = (ROOT / "docs" / "theory" / "index.md").read_text(encoding="utf-8")
    listed = re.findall(r"^[a-z0-9-]+$", index, re.MULTILINE)
    assert sorted(listed) == sorted(
        page.stem for page in (ROOT / "docs" / "theory").glob("*.md") if page.stem != "index"
    )


def offered_functions():
    """Functions that faces of rooms offer, once each."""
    found = {}
    for package in ("graphs", "enumerate", "synth"):
        for info in iter_modules(import_module(package).__path__):
            module = import_module(f"{package}.{info.name}")
            for name in getattr(module, "__all__", ()):
                thing = getattr(module, name)
                if isinstance(thing, FunctionType):
                    found[id(thing)] = (f"{module.__name__}.{name}", thing)
    return list(found.values())


def test_docstrings_of_what_rooms_offer():
    """Those without a section are counted: there may be fewer, not more."""
    functions = offered_functions()
    assert len(functions) > 200
    told = {name: inspect.getdoc(function) or "" for name, function in functions}
    assert all(told.values())
    without_parameters = [
        name
        for name, function in functions
        if inspect.signature(function).parameters and "Parameters\n---" not in told[name]
    ]
    without_example = [name for name, text in told.items() if ">>>" not in text]
    assert len(without_parameters) <= 87, without_parameters
    assert len(without_example) <= 42, without_example
