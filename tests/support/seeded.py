"""Small files that were answered wrongly once, in `tests/support/seeds`."""

from __future__ import annotations

from pathlib import Path

SEEDS = Path(__file__).with_name("seeds")


def seed_file(name: str) -> Path:
    """Return the path of a file by its name without its ending."""
    return SEEDS / f"{name}.json"
