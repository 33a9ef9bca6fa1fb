"""Paths, links and names in the project's papers resolve; nothing cites what is not in the project."""

import doctest
import inspect
import re
import sys
import tomllib
from dataclasses import is_dataclass
from enum import Enum
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from pkgutil import iter_modules
from types import FunctionType, UnionType
from typing import Protocol

import pytest

import synth

ROOT = Path(__file__).resolve().parent.parent
PAPERS = sorted([*ROOT.glob("*.md"), *(path for path in ROOT.glob("docs/**/*.md") if "reference" not in path.parts)])
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


def offered(kind):
    """What faces of rooms offer of a kind, functions or classes of the project, once each: name to thing.

    Single files of ``graphs`` have no face: what they hold is for other rooms, and has tests of its own below.
    """
    found = {}
    wings = [f"synth.{info.name}" for info in iter_modules(synth.__path__) if info.ispkg]
    for package in ("graphs", "enumerate", "synth", *wings):
        for info in iter_modules(import_module(package).__path__):
            if not info.ispkg and (package == "graphs" or package in wings):
                continue
            module = import_module(f"{package}.{info.name}")
            for name in getattr(module, "__all__", ()):
                thing = getattr(module, name)
                if isinstance(thing, kind) and thing.__module__.partition(".")[0] in ("graphs", "enumerate", "synth"):
                    found.setdefault(id(thing), (f"{module.__name__}.{name}", thing))
    return dict(found.values())


def sections(thing, *heads):
    """The text of the sections of a docstring that have one of some heads."""
    parts = re.split(r"^(\w[\w ]*)\n-{3,}$", inspect.cleandoc(thing.__doc__ or ""), flags=re.MULTILINE)
    return "".join(body for head, body in zip(parts[1::2], parts[2::2], strict=True) if head in heads)


def told(thing):
    """The names that a docstring lists as parameters or attributes."""
    lines = sections(thing, "Parameters", "Attributes").splitlines()
    heads = [line.partition(" : ")[0] for line in lines if line and not line.startswith(" ")]
    return {name.strip().lstrip("*") for head in heads for name in head.split(",")}


def taken_or_held(cls):
    """What has to be told of a class: members of an enumeration; else its public fields, and what it is made of."""
    if issubclass(cls, Enum):
        return set(cls.__members__)
    fields = {name for name in inspect.get_annotations(cls) if not name.startswith("_")}
    if "__init__" not in vars(cls) or is_dataclass(cls) or is_protocol(cls):
        return fields
    return fields | set(inspect.signature(cls).parameters)


def is_protocol(cls):
    return Protocol in cls.__bases__


def test_functions_that_rooms_offer_say_what_they_take():
    functions = offered(FunctionType)
    assert len(functions) > 200
    untold = {name: set(inspect.signature(one).parameters) - told(one) for name, one in functions.items()}
    assert not {name: names for name, names in untold.items() if names}


def test_functions_that_rooms_offer_have_examples():
    without = {name for name, one in offered(FunctionType).items() if ">>> " not in sections(one, "Examples")}
    assert without == {"synth.notebook.load_ipython_extension"}  # needs a shell of IPython


def test_classes_that_rooms_offer_say_what_they_hold():
    classes = offered(type)
    assert len(classes) > 140
    untold = {name: taken_or_held(cls) - told(cls) for name, cls in classes.items()}
    assert not {name: names for name, names in untold.items() if names}
    # these have methods only, each with a docstring of its own, or what their base class says
    without = {name for name, cls in classes.items() if not told(cls)}
    assert without == {"enumerate.runner.Sink"}


def test_few_classes_that_rooms_offer_are_without_an_example():
    """Many are answers of functions that have one: there may be fewer, not more."""
    without = [name for name, cls in offered(type).items() if ">>> " not in sections(cls, "Examples")]
    assert len(without) <= 67, without


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """The pages of the reference, as `make docs` writes them, and the names documented in them."""
    sys.path.insert(0, str(ROOT / "docs"))
    try:
        from reference_pages import write_reference
    except ImportError:
        pytest.skip("the reference requires sphinx")
    finally:
        sys.path.remove(str(ROOT / "docs"))
    folder = tmp_path_factory.mktemp("reference")
    return folder, dict(write_reference(folder))


def test_the_reference_has_every_name_of_the_face(reference):
    folder, documented = reference
    front = (folder / "index.md").read_text(encoding="utf-8")
    listed = re.findall(r"^   \* - (?::py:obj:`|``)(\w+)", front, re.MULTILINE)
    assert listed == sorted(synth.__all__)
    known = {id(thing) for thing in documented.values()}
    without = {name for name in synth.__all__ if id(getattr(synth, name)) not in known}
    assert without == {"Mechanism", "MechanismLike"}  # types: the table says of what
    pages = "".join(page.read_text(encoding="utf-8") for page in (folder / "rooms").iterdir())
    assert {name for name in documented if f":: {name}\n" not in pages} == set()


def test_the_face_is_documented_whole():
    """Functions and classes of the face say what they take or hold, and have an example that runs."""
    face = {name: getattr(synth, name) for name in synth.__all__ if not isinstance(getattr(synth, name), UnionType)}
    untold = {
        name: (set(inspect.signature(one).parameters) if isinstance(one, FunctionType) else taken_or_held(one))
        - told(one)
        for name, one in face.items()
        if not (isinstance(one, type) and issubclass(one, synth.SynthedraError))
    }
    assert not {name: names for name, names in untold.items() if names}
    without = {name for name, one in face.items() if ">>> " not in sections(one, "Examples")}
    assert without - {"SynthedraError", "FileError", "InvariantError", "UnsolvableError"} == {"load_ipython_extension"}


@pytest.mark.parametrize(
    "name", [info.name for info in iter_modules(import_module("graphs").__path__) if not info.ispkg]
)
def test_single_files_of_graphs_say_what_they_hold(name):
    """All that they offer has a docstring, and their examples hold."""
    module = import_module(f"graphs.{name}")
    held = {word: getattr(module, word) for word in module.__all__}
    own = {word: one for word, one in held.items() if getattr(one, "__module__", "") == module.__name__}
    assert not [word for word, one in own.items() if isinstance(one, FunctionType | type) and not one.__doc__]
    assert doctest.testmod(module).failed == 0


def test_every_misprint_is_told_on_the_page_of_its_theory():
    items = re.findall(r"^\| (\d{3}-\d+)", (ROOT / "docs" / "misprints.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(items) > 30
    theory = "".join(page.read_text(encoding="utf-8") for page in (ROOT / "docs" / "theory").glob("*.md"))
    assert not {item for item in items if not re.search(rf"\b{item}\b", theory)}


def test_the_version_stands_in_one_place_and_where_it_is_cited():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    cited = re.search(r"^version: (.+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    assert cited is not None
    assert cited[1] == project["version"] == version("synthedra")


def test_the_site_lists_the_files_of_each_theory_page():
    sys.path.insert(0, str(ROOT / "docs"))
    try:
        from cross_links import files_of
    finally:
        sys.path.remove(str(ROOT / "docs"))
    for page in (ROOT / "docs" / "theory").glob("*.md"):
        if page.stem != "index":
            assert files_of(page.stem), page
    assert tuple(
        next(file for file, what in files_of(page) if what and name in file)
        for page, name in (("thick-panels", "heights"), ("layer-orders", "local"))
    ) == ("synth/making/thickening/heights.py", "synth/analysis/layering/local.py")


def test_theory_pages_carry_no_lists_of_files():
    """The site makes them (docs/cross_links.py): those written by hand name files that have moved."""
    for page in (ROOT / "docs" / "theory").glob("*.md"):
        assert not re.search(r"^Functions?:|\bFiles(?: of `[\w.]+`)?: `", page.read_text(encoding="utf-8"), re.M), page
