"""Mutants are found where a line decides something, and a test that holds the line kills them."""

import ast
from pathlib import Path

import pytest

from tests.mutants.__main__ import lines_of, room_tests, survivors_of
from tests.mutants.mutations import mutants_of

SOURCE = '''"""A - B."""

LIMIT: "int | None" = 3


def within(size: int, least: int = -1) -> bool:
    """Tell whether a size is between bounds."""
    return (least) < size <= LIMIT  # size < 3


def half(size):
    return size // 2 if not size % 2 else None
'''


@pytest.fixture
def no_plugins(monkeypatch):
    """Runs of pytest begin sooner: the tests of these files need none of its plugins."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")


def test_every_operator_and_guard_has_its_mutants():
    changes = [str(mutant) for mutant in mutants_of(SOURCE)]
    assert changes == [
        "line 6: -1 -> 1",
        "line 8: < -> <=",
        "line 8: <= -> <",
        "line 12: not size % 2 -> True",
        "line 12: not size % 2 -> False",
        "line 12: // -> *",
        "line 12: not size % 2 -> size % 2",
    ]


def test_mutants_differ_from_the_file_and_parse():
    file = Path(__file__).resolve().parents[2] / "graphs" / "tolerances.py"
    text = file.read_text(encoding="utf-8")
    mutants = list(mutants_of(text))
    assert len(mutants) > 10
    assert len({mutant.text for mutant in mutants}) == len(mutants)
    for mutant in mutants:
        assert ast.dump(ast.parse(mutant.text)) != ast.dump(ast.parse(text))


@pytest.mark.usefixtures("no_plugins")
def test_survivors_are_those_that_tests_do_not_notice(tmp_path, capsys):
    """Of three mutants that of the upper bound is killed."""
    (tmp_path / "sized.py").write_text(SOURCE.split("def half", maxsplit=1)[0])
    (tmp_path / "test_sized.py").write_text(
        "from sized import within\n\n\ndef test_it():\n    assert within(3) and not within(4)\n"
    )
    assert survivors_of(tmp_path, Path("sized.py"), ["test_sized.py"], range(1, 99)) == 2
    assert "sized.py: 2 of 3 mutants survive" in capsys.readouterr().out
    assert (tmp_path / "sized.py").read_text() == SOURCE.split("def half", maxsplit=1)[0]


@pytest.mark.usefixtures("no_plugins")
def test_tests_that_fail_try_nothing(tmp_path):
    (tmp_path / "sized.py").write_text("A = 1\n")
    (tmp_path / "test_sized.py").write_text("def test_it():\n    assert False\n")
    assert survivors_of(tmp_path, Path("sized.py"), ["test_sized.py"], range(1, 99)) is None


def test_tests_are_those_of_the_room():
    assert room_tests(Path("graphs/loops/loop.py")) == ["tests/graphs/loops", "graphs/loops/loop.py"]
    assert lines_of(None)[0] == 1
    assert list(range(*lines_of("3-5"))) == [3, 4, 5]
    assert list(range(*lines_of("7"))) == [7]
