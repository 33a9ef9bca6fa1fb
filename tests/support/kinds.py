"""Kinds of tests, what they take, and which of the slow ones are left to the night; a plugin of pytest.

*unit*: one function or class, within a moment. *law*: properties, second methods, golden values, whole answers.
*world*: processes, signals, files that are broken on purpose, browsers. A run ends with a table of them, in seconds
of processor time, which other work on the machine does not lengthen.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Generator, Iterable
from pathlib import Path

import pytest

KINDS = ("unit", "law", "world")
DURATIONS = Path(__file__).resolve().parent.parent / "durations.json"
"""Seconds of processor time: of each test from `STORED_FROM` on, and of all tests of a kind that are not slow."""
NIGHT = 300.0
"""Slow tests that take longer, in seconds of processor time, run with `make test-night` only, as do those marked so."""
STORED_FROM = 0.1
"""Tests that take longer, in seconds of processor time, are no unit tests."""

WORLD = (
    "tests/enumerate/runner",
    "tests/graphs/files/test_fuzz.py",
    "tests/graphs/files/test_hostile_files.py",
    "tests/graphs/files/test_unfinished.py",
    "tests/machines",
    "tests/mutants",
    "tests/synth/cli",
    "tests/synth/making/viewer",
    "tests/test_examples.py",
    "tests/test_front_door.py",
    "tests/test_makefile.py",
    "tests/test_notebook.py",
    "tests/test_notebooks.py",
    "tests/test_typed_script.py",
)
LAW = ("tests/agreement", "tests/invariance", "tests/papers", "tests/test_sequences.py")
_PROCESSOR = "processor"


def stored() -> dict[str, dict[str, float]]:
    """Return the durations that are kept: under "tests" by test, under "kinds" by kind, in seconds."""
    return json.loads(DURATIONS.read_text(encoding="utf-8"))


def is_below(path: str, places: Iterable[str]) -> bool:
    """Tell whether a file is one of the places, or in a folder of them."""
    return any(path == place or path.startswith(f"{place}/") for place in places)


def kind_of(item: pytest.Item) -> str:
    """Return the kind of a test: by its place, then law for properties and for what takes long."""
    path = item.nodeid.partition("::")[0]
    if is_below(path, WORLD) or item.get_closest_marker("web") is not None:
        return "world"
    by_examples = getattr(getattr(item, "obj", None), "is_hypothesis_test", False)
    long = item.get_closest_marker("slow") is not None or _seconds(item) >= STORED_FROM
    return "law" if by_examples or long or is_below(path, LAW) else "unit"


_KNOWN = stored()["tests"]


def _seconds(item: pytest.Item) -> float:
    return _KNOWN.get(item.nodeid, 0.0)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that writes the durations anew."""
    parser.addoption("--store-durations", action="store_true", help="Write tests/durations.json anew from this run.")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark each test with its kind, and slow ones that are left to the night."""
    for item in items:
        kind = kind_of(item)
        item.add_marker(kind)
        item.user_properties.append(("kind", kind))
        if item.get_closest_marker("slow") is not None and _seconds(item) > NIGHT:
            item.add_marker("night")


def _processor() -> float:
    spent = os.times()
    return spent.user + spent.system + spent.children_user + spent.children_system


_BEGUN = pytest.StashKey[float]()


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> Generator[None]:
    """Note when a test begins."""
    item.stash[_BEGUN] = _processor()
    return (yield)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item) -> Generator[None]:
    """Note what it took, where reports take it from."""
    try:
        return (yield)
    finally:
        item.user_properties.append((_PROCESSOR, round(_processor() - item.stash[_BEGUN], 2)))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Print the table of kinds; with --store-durations write what the tests took."""
    tests, failed, seconds, by_test = Counter[str](), Counter[str](), Counter[str](), dict[str, float]()
    for outcome in ("passed", "failed", "error", "skipped", ""):  # "": setups and teardowns that passed
        for report in terminalreporter.stats.get(outcome, ()):
            properties = dict(getattr(report, "user_properties", ()))
            kind = str(properties.get("kind", "unit"))
            failed[kind] += bool(report.failed)
            if _PROCESSOR in properties and report.when == "teardown":
                tests[kind] += 1
                seconds[kind] += properties[_PROCESSOR]
                by_test[report.nodeid] = properties[_PROCESSOR]
    if not tests:
        return
    terminalreporter.write_line(f"{'kind':6} {'tests':>6} {'failed':>7} {'processor seconds':>18}")
    for kind in KINDS:
        terminalreporter.write_line(f"{kind:6} {tests[kind]:6} {failed[kind]:7} {seconds[kind]:18.0f}")
    if config.getoption("--store-durations"):
        _store(by_test, {kind: round(seconds[kind]) for kind in KINDS}, config)


def _store(by_test: dict[str, float], kinds: dict[str, int], config: pytest.Config) -> None:
    """Replace the durations of the tests that ran, and of kinds where the quick tests did."""
    known = stored()
    kept = {test: value for test, value in known["tests"].items() if test not in by_test}
    kept |= {test: round(value, 2) for test, value in by_test.items() if value >= STORED_FROM}
    whole = "not slow" in config.option.markexpr
    answer = {"kinds": kinds if whole else known["kinds"], "tests": dict(sorted(kept.items()))}
    DURATIONS.write_text(json.dumps(answer, indent=1) + "\n", encoding="utf-8")
