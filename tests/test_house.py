"""The rooms of the project: which may import which, how large they are, and what their faces offer."""

import ast
from functools import cache
from importlib import import_module
from pathlib import Path

import networkx as nx
import pytest

from graphs.lazy import names_in_stub

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ["graphs", "enumerate", "synth"]
SOURCES = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]
FACES = [path for path in SOURCES if path.name == "__init__.py"]


def dotted(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


NAMES = {dotted(path) for path in SOURCES}


def statements(node):
    """The statements below a statement or module, without their expressions, which take longest to walk."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for inner in getattr(node, part, ()):
            yield inner
            yield from statements(inner)


@cache
def imports_of(path):
    """The statements of a file that import, at its head or inside a function."""
    every = statements(ast.parse(path.read_text(encoding="utf-8")))
    return [node for node in every if isinstance(node, ast.Import | ast.ImportFrom)]


def imported(path):
    """Every name of ours that a file imports, at its head or inside a function, with the module it is in."""
    for node in imports_of(path):
        if isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in NAMES else node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


WINGS = ("linkages", "analysis", "catalogue", "making", "synthesis")
"""Folders of rooms, in the order in which they use each other: none imports a later one."""


def room(name):
    """A folder of a package or a wing, with its subfolders; a file beside the folders is a room of its own."""
    parts = name.split(".")
    return ".".join(parts[: 3 if parts[0] == "synth" and parts[1:2] and parts[1] in WINGS else 2])


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_go_one_way(package):
    later = PACKAGES[PACKAGES.index(package) + 1 :]
    for path in (ROOT / package).rglob("*.py"):
        for name in imported(path):
            assert name.split(".")[0] not in later, f"{path} imports {name}"
            assert name != "enumerate", f"{path} hides the builtin"


@pytest.mark.parametrize("wing", WINGS)
def test_wings_go_one_way(wing):
    later = WINGS[WINGS.index(wing) + 1 :]
    for path in (ROOT / "synth" / wing).rglob("*.py"):
        for name in imported(path):
            parts = name.split(".")
            assert parts[0] != "synth" or parts[1:2] == [] or parts[1] not in (*later, "cli"), f"{path} imports {name}"


def test_there_is_no_circle_between_rooms():
    """What faces import does not count: they offer what their own rooms have."""
    rooms = nx.DiGraph()
    for path in SOURCES:
        here = room(dotted(path))
        rooms.add_edges_from(
            (here, room(name)) for name in imported(path) if name.split(".")[0] in PACKAGES and room(name) != here
        )
    assert {room(name) for name in NAMES} >= set(rooms)
    assert list(nx.simple_cycles(rooms)) == []


def test_there_is_no_circle_between_files():
    """Imports inside functions and those for type checkers count; a name that a face offers is in its file.

    Faces are left out: they import lazily what their own rooms have.
    """
    files = nx.DiGraph()
    where = {dotted(face): offered(face) for face in FACES}
    for path in SOURCES:
        if path not in FACES:
            files.add_edges_from((dotted(path), file) for file in files_imported(path, where))
    assert set(files) <= NAMES
    assert [sorted(part) for part in nx.strongly_connected_components(files) if len(part) > 1] == []
    assert list(nx.selfloop_edges(files)) == []


def files_imported(path, where):
    """The files of ours that a file imports: ``where`` says of each face in which file a name is that it offers."""
    for node in imports_of(path):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] in PACKAGES:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in NAMES else where.get(node.module, {}).get(alias.name, node.module)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in NAMES)


def test_rooms_fit_a_readers_head():
    sizes = {face.parent: len(list(face.parent.glob("*.py"))) - 1 for face in FACES}
    assert {str(folder): size for folder, size in sizes.items() if size > 16} == {}


def test_no_file_outgrows_a_reader():
    lines = {str(path): len(path.read_text(encoding="utf-8").splitlines()) for path in SOURCES}
    assert {path: n for path, n in lines.items() if n > 700} == {}


def test_every_folder_of_code_is_a_room_with_a_word_to_say():
    for path in SOURCES:
        face = path.parent / "__init__.py"
        assert face in FACES, f"{path.parent} has no face"
        assert ast.get_docstring(ast.parse(face.read_text(encoding="utf-8"))), face


def offered(face):
    """What a face offers: name to module."""
    stub = face.with_suffix(".pyi")
    return names_in_stub(stub) if stub.exists() else {}


@pytest.mark.parametrize("face", FACES, ids=dotted)
def test_a_face_offers_what_its_stub_names(face):
    module = import_module(dotted(face))
    for name, where in offered(face).items():
        assert getattr(module, name) is getattr(import_module(where), name)
    assert set(offered(face)) <= set(dir(module))
    assert face.with_suffix(".pyi").exists() == hasattr(module, "__all__")


@pytest.mark.parametrize("face", FACES, ids=dotted)
def test_no_name_of_a_face_is_a_file_or_room(face):
    """Importing the file would put the module in the place of what the face offers."""
    names = offered(face)
    inside = {path.stem for path in face.parent.glob("*.py")} | {
        path.name for path in face.parent.iterdir() if (path / "__init__.py").exists()
    }
    assert not set(names) & inside


DOUBLE_CLASSES: dict[str, str] = {}
"""Names of public classes that are in several files, each with the reason why it stays so."""


def test_no_two_public_classes_have_one_name():
    places: dict[str, list[str]] = {}
    for path in SOURCES:
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places.setdefault(node.name, []).append(dotted(path))
    assert {name: where for name, where in places.items() if len(where) > 1 and name not in DOUBLE_CLASSES} == {}
    assert {name for name in DOUBLE_CLASSES if len(places.get(name, ())) < 2} == set()


def test_a_face_has_no_other_names():
    import graphs.loops

    with pytest.raises(AttributeError, match=r"module 'graphs.loops' has no attribute 'loop_of_nothing'"):
        _ = graphs.loops.loop_of_nothing


def test_tests_mirror_the_rooms():
    """A folder of tests is named as a room is, or as a file of one."""
    for package in PACKAGES:
        for folder in (ROOT / "tests" / package).rglob("*"):
            if folder.is_dir() and folder.name != "__pycache__":
                place = ROOT / folder.relative_to(ROOT / "tests")
                assert (place / "__init__.py").exists() or place.with_suffix(".py").exists(), folder
