"""List the mutants of files that no test kills: `python -m tests.mutants [FILE...] [--tests PATH...]`.

Without files those changed since --since. The tests are those of the room (the folder of the same name in tests)
and the doctests of the file. Mutants are made in a copy of the tree.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic

from tests.mutants.mutations import Mutant, mutants_of

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("graphs", "enumerate", "synth")
_PATIENCE = 4.0
"""A mutant that takes so many times as long as the file itself, and ten seconds more, is killed: it does not end."""


def main() -> int:
    """Try all mutants; return 1 where some survive, 2 where the tests fail without any."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help="Source files, from the root on.")
    parser.add_argument("--tests", nargs="+", metavar="PATH", help="Tests that have to kill the mutants.")
    parser.add_argument("--since", default="HEAD", metavar="COMMIT", help="Without files: those changed since.")
    parser.add_argument("--lines", metavar="A-B", help="Only mutants of these lines.")
    options = parser.parse_args()
    files = options.files or changed_since(options.since)
    if not files:
        print(f"no source file has changed since {options.since}")
        return 0
    survivors = 0
    with TemporaryDirectory() as folder:
        tree = copy_of_tree(Path(folder))
        for file in files:
            tests = options.tests or room_tests(file)
            lines = range(*lines_of(options.lines))
            came = survivors_of(tree, file, tests, lines)
            if came is None:
                print(f"{file}: its tests fail as it is; nothing was tried", file=sys.stderr)
                return 2
            survivors += came
    return int(survivors > 0)


def changed_since(commit: str) -> list[Path]:
    """Return the source files that differ from a commit."""
    command = ["git", "diff", "--name-only", "--diff-filter=d", commit, "--", *PACKAGES]
    names = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    return [Path(name) for name in names if name.endswith(".py")]


def lines_of(text: str | None) -> tuple[int, int]:
    """Return the first line, and that after the last one."""
    if text is None:
        return 1, sys.maxsize
    first, _, last = text.partition("-")
    return int(first), int(last or first) + 1


def room_tests(file: Path) -> list[str]:
    """Return the nearest folder of tests that is named as the folder of a file, and the file with its doctests."""
    folder = Path("tests") / file.parent
    while not (ROOT / folder).is_dir():
        folder = folder.parent
    return [str(folder), str(file)]


def copy_of_tree(folder: Path) -> Path:
    """Copy what tests need; return where it is."""
    tree = folder / "tree"
    hidden = shutil.ignore_patterns(".*", "__pycache__", "node_modules", "_build", "dist")
    shutil.copytree(ROOT, tree, ignore=hidden)
    return tree


def survivors_of(tree: Path, file: Path, tests: Sequence[str], lines: range) -> int | None:
    """Print the mutants of a file that survive, and their number; None where the tests fail without a mutant."""
    original = (tree / file).read_text(encoding="utf-8")
    begun = monotonic()
    if not passes(tree, tests, None):
        return None
    patience = _PATIENCE * (monotonic() - begun) + 10.0
    survived, tried = list[Mutant](), 0
    try:
        for mutant in mutants_of(original):
            if mutant.line not in lines:
                continue
            tried += 1
            (tree / file).write_text(mutant.text, encoding="utf-8")
            if passes(tree, tests, patience):
                survived.append(mutant)
                print(f"{file}: {mutant}", flush=True)
    finally:
        (tree / file).write_text(original, encoding="utf-8")
    print(f"{file}: {len(survived)} of {tried} mutants survive")
    return len(survived)


def passes(tree: Path, tests: Sequence[str], seconds: float | None) -> bool:
    """Tell whether tests pass in a tree, in time; they end with the first that fails."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
    command += ["-m", "not slow and not web", *tests]
    environment = {**os.environ, "PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    try:
        run = subprocess.run(command, cwd=tree, env=environment, capture_output=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return False
    return run.returncode == 0


if __name__ == "__main__":
    sys.exit(main())
