"""Every command and every piece of Python in README and documentation does what is written there."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

from tests.support.examples import agree, commands_of, fences_of, printed_by

ROOT = Path(__file__).resolve().parent.parent
DOCUMENTS = [
    ROOT / "README.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "guides").glob("*.md")),
]
"""Pages whose examples take seconds."""
WITH_EXAMPLES = [
    path for path in DOCUMENTS if {"console", "python"} & {one.language for one in fences_of(path.read_text())}
]


@pytest.fixture
def beside_the_data(tmp_path, monkeypatch):
    """An empty folder with the project's data in it, where the examples run."""
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("beside_the_data")
@pytest.mark.parametrize("path", WITH_EXAMPLES, ids=lambda path: str(path.relative_to(ROOT)))
def test_examples(path):
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    names: dict[str, object] = {}
    run = 0
    for fence in fences_of(path.read_text(encoding="utf-8")):
        if fence.place is not None:
            Path(fence.place).write_text(fence.text, encoding="utf-8")
        if fence.language == "console":
            for command in commands_of(fence.text):
                printed = printed_by(command.words)
                told = f"synth {' '.join(command.words)}\n" + "\n".join(printed)
                assert agree(command.output, printed), told
                run += 1
        elif fence.language == "python":
            test = doctest.DocTestParser().get_doctest(fence.text, names, path.name, str(path), 0)
            assert test.examples, f"Python without >>>: {fence.text}"
            runner.run(test, clear_globs=False)
            names.update(test.globs)
            run += len(test.examples)
    assert run
    assert runner.summarize(verbose=False).failed == 0


def test_what_is_printed_is_compared():
    assert agree(["a 1.25 b"], ["a 1.26   b"])
    assert not agree(["a 1.25 b"], ["a 1.27 b"])
    assert not agree(["a 3 b"], ["a 4 b"])
    assert agree(["a", "...", "z"], ["a", "b", "c", "z"])
    assert not agree(["a", "...", "z"], ["a", "b"])
    assert agree(["gap 5e+11"], ["gap 6e+11"])
    assert not agree([], ["more"])
    assert agree(["from ... to 3"], ["from here to 3"])
