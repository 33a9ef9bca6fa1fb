"""Fixtures that all tests share."""

from __future__ import annotations

import gc
import json
import os
import signal
from collections.abc import Generator
from pathlib import Path

# Many small matrices: more threads of BLAS than one wait for each other three times as long as they work, and
# every core has a process of tests already. numpy reads this when it is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Commands that are run as processes have numpy's warnings as errors too; those that end with a fault say where.
os.environ["PYTHONWARNINGS"] = "error::RuntimeWarning"
os.environ["SYNTHEDRA_DEBUG"] = "1"

import numpy as np
import pytest
from golden_numbers import golden_numbers
from hypothesis import HealthCheck, settings
from real_patterns import folder_of_patterns

pytest_plugins = ["kinds"]
collect_ignore = ["support/typed_script.py"]
"""Read by mypy alone; it is not meant to run."""

ROOT = Path(__file__).resolve().parent.parent


_HOW = {"deadline": None, "derandomize": True, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("quick", max_examples=25, **_HOW)
settings.register_profile("full", max_examples=100, **_HOW)


def pytest_configure(config: pytest.Config) -> None:
    """Try fewer examples where the slow tests are left out; hear signals, whoever starts the tests."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.SIG_IGN:  # by nohup, or in the background of a shell
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
    settings.load_profile("quick" if "not slow" in config.option.markexpr else "full")


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect tests without looking for garbage, which takes a quarter of the time, and keep what was collected apart.

    Modules and thousands of tests live to the end; looking through them again and again took a fifth of the run.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of the project's own mechanisms and golden values."""
    return ROOT / "data"


@pytest.fixture(scope="session")
def mechanisms(data: Path) -> list[Path]:
    """The project's own mechanisms, crease patterns included."""
    rows = json.loads((data / "index.json").read_text(encoding="utf-8"))
    return sorted([*(data / row["file"] for row in rows), *(data / "patterns").iterdir()])


@pytest.fixture(scope="session")
def golden() -> dict:
    """The checked numbers of the source papers."""
    return golden_numbers()


@pytest.fixture(scope="session")
def fold_folder() -> Path:
    """The folder of crease patterns by other people; the test skips where it is missing."""
    folder = folder_of_patterns()
    if not (folder / "INDEX.tsv").exists():
        pytest.skip(f"no crease patterns at {folder}; name their folder in SYNTHEDRA_FOLD")
    return folder


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers, the same every time."""
    return np.random.default_rng(20_212_020)
