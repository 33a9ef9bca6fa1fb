"""Run commands, examples and tests as other machines would: `make test-machines`, `python -m tests.machines --help`.

Each factor has child processes of its own, as many factors at a time as there are cores. What the commands answer is
compared with what they answer here without any factor.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic

from tests.machines.comparison import Answer, differences
from tests.machines.factors import FACTORS, ROOT, Factor, environment_for, reason_to_leave_out
from tests.machines.transcript import read_transcript, transcript_under

_ROOMS = """
analysis/folding analysis/verdict analysis/overconstraint analysis/advice analysis/compliance analysis/assembly
analysis/moving catalogue/realisation catalogue/patterns making/templates synthesis/designing synthesis/tasks
"""

TESTS = (
    ["-m", "not slow and not web", "tests/test_examples.py", "tests/test_data.py", "tests/graphs/rank"]
    + [f"tests/synth/{room}" for room in _ROOMS.split()],
    ["tests/test_data.py::test_the_sheets_are_what_the_script_makes"],
)
"""What pytest runs under each factor beside the commands: the rooms of real arithmetic, examples, data made anew."""

_LINES = 4
"""Lines of an answer to print where many differ."""


def main() -> int:
    """Run under the factors named, or under all; return 1 where something differs or fails."""
    options = _options()
    with TemporaryDirectory() as folder, ThreadPoolExecutor(options.side_by_side) as pool:
        place = Path(folder) / "here"
        transcript_under(None, options.commands, place).wait()
        here = read_transcript(place)
        print(f"{len(here)} commands without any factor")
        wrong = [
            name
            for name, report in zip(
                options.factors,
                pool.map(lambda name: _report(FACTORS[name], options, Path(folder) / name, here), options.factors),
                strict=True,
            )
            if not _printed(report)
        ]
    print(f"Other answers or failures under {', '.join(wrong)}" if wrong else "The same answers everywhere.")
    return bool(wrong)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.machines", description=__doc__)
    parser.add_argument("factors", nargs="*", metavar="FACTOR", help=f"Factors: {', '.join(FACTORS)}; default all.")
    parser.add_argument("--commands", choices=["quick", "all"], default="quick", help="Set of commands.")
    parser.add_argument("--no-tests", action="store_true", help="Run the commands only.")
    parser.add_argument("--side-by-side", type=int, default=os.cpu_count(), help="Factors that run at a time.")
    options = parser.parse_args()
    options.factors = options.factors or list(FACTORS)
    for name in options.factors:
        if name not in FACTORS:
            parser.error(f"{name}: expected one of {', '.join(FACTORS)}")
    return options


def _report(factor: Factor, options: argparse.Namespace, place: Path, here: list[Answer]) -> tuple[bool, list[str]]:
    """Return whether all is the same under a factor, and the lines that say so."""
    start = monotonic()
    if reason := reason_to_leave_out(factor):
        return True, [f"{factor.name}: left out, {reason}"]
    lines = []
    child = transcript_under(factor, options.commands, place)
    if child.wait():
        lines.append(f"  the commands ended with status {child.returncode}")
    else:
        for difference in differences(here, read_transcript(place)):
            lines.append(f"  synth {difference.command}: {len(difference.lines)} lines differ")
            lines += [
                f"    {mark} {line}"
                for pair in difference.lines[:_LINES]
                for mark, line in zip("<>", pair, strict=True)
            ]
    if not options.no_tests:
        lines += _failures(factor)
    seconds = f"{monotonic() - start:.0f} s"
    return not lines, [f"{factor.name}: {'differs' if lines else 'the same'} ({seconds})", *lines]


def _failures(factor: Factor) -> Iterator[str]:
    """Run the tests under a factor; yield lines about those that fail."""
    for tests in TESTS:
        words = [sys.executable, "-m", "pytest", "-n", "0", "-p", "no:cacheprovider", *tests]
        child = subprocess.run(
            words, env=environment_for(factor), cwd=ROOT, capture_output=True, text=True, check=False
        )
        if child.returncode:
            failures = [line for line in child.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
            yield from (f"  {line}" for line in failures or [f"pytest: {child.stdout[-500:]} {child.stderr[-500:]}"])


def _printed(report: tuple[bool, list[str]]) -> bool:
    same, lines = report
    print("\n".join(lines), flush=True)
    return same


if __name__ == "__main__":
    sys.exit(main())
