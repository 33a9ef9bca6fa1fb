"""Tasks whose answer is in the papers: the rank of the answer, and what the search costs.

    python benchmarks/known_answers.py [TASK ...]

prints and writes, for each task under data/tasks that is named (by default all), the types that are listed and those
that can do it, the first ten, the rank of the known answer, and processor seconds, to
benchmarks/results/known_answers.json.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from pathlib import Path
from time import process_time
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import synth

ROOT = Path(__file__).resolve().parents[1]
ANSWERS: dict[str, tuple[tuple[str, ...], int]] = {
    "lid": (("four-bar",), 2),
    "skew-axes": (("bennett",), 2),
    "straight-lift": (("sarrus",), 1),
    "packing": (("miura",), 2),
    "four-fingers": (("fortune-teller",), 1),
    "on-a-cone": (("watt", "stephenson"), 4),
    "pop-up": (("box-pop-up",), 1),
    "carton": (("crash-lock",), 1),
}
"""Tasks, the names of their answers, and with how many starts of each placement these are looked for."""


def row(name: str) -> dict[str, Any]:
    """Return the answer to a task, and the ranks of the known ones."""
    answers, starts = ANSWERS[name]
    begun = process_time()
    found = synth.task(ROOT / "data" / "tasks" / f"{name}.json", starts=starts, rounds=1)
    seconds = process_time() - begun
    names = [found.name(one) for one in found.ranked]
    return {
        "types": found.structure.types,
        "placements": found.structure.admitted,
        "starts": found.starts,
        "can_do_it": len(names),
        "first_ten": names[:10],
        "ranks": {answer: names.index(answer) + 1 if answer in names else None for answer in answers},
        "processor_seconds": round(seconds, 1),
    }


def main() -> None:
    """Ask all tasks or those named, print and write."""
    names = sys.argv[1:] or list(ANSWERS)
    rows = {}
    for name in names:
        rows[name] = row(name)
        print(name, json.dumps(rows[name]), flush=True)
    if names == list(ANSWERS):
        result = {"python": platform.python_version(), "tasks": rows}
        place = Path(__file__).with_name("results").joinpath("known_answers.json")
        place.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
