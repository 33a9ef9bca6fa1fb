"""Paths, links and names in the project's papers resolve; nothing cites what is not in the project."""

import re
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAPERS = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])
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
    for page in (ROOT / "docs" / "theory").glob("*.md"):
        assert f"docs/theory/{page.name}" in code, page
