"""A task of three poses with all SC graphs of up to six and up to eight links: seconds, and runs that are killed.

    python benchmarks/large_tasks.py [--kills N] [--every SECONDS]

takes the lid of data/tasks/lid.json, without its limits on distance and system, from the file to the report with two
workers. The run with eight links is then done again in a new store, killed after every so many seconds of work, and
resumed; its report and its JSON are compared with those of the first run. Writes
benchmarks/results/large_tasks.json.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import signal
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

ROOT = Path(__file__).resolve().parents[1]


def task(links: int) -> dict[str, Any]:
    """Return the task of the lid with SC graphs of up to so many links."""
    lid = json.loads((ROOT / "data" / "tasks" / "lid.json").read_text(encoding="utf-8"))
    kept = {key: value for key, value in lid.items() if key not in ("distance", "system")}
    return kept | {"types": ["sc"], "links": [4, links]}


def started(folder: Path, store: str, *options: str) -> subprocess.Popen[bytes]:
    """Start `synth task` in a process group of its own."""
    command = [sys.executable, "-m", "synth.cli", "task", "task.json", "--workers", "2", "--json", "--force"]
    command += ["--store", store, "--report", "report.html", *options]
    environment = os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    with (folder / "answer.json").open("wb") as answer:
        return subprocess.Popen(command, cwd=folder, stdout=answer, env=environment, start_new_session=True)


def answered(folder: Path) -> tuple[dict[str, Any], bytes]:
    """Return the JSON and the report."""
    return json.loads((folder / "answer.json").read_text(encoding="utf-8")), (folder / "report.html").read_bytes()


def killed(folder: Path, kills: int, every: float) -> tuple[int, dict[str, Any], bytes]:
    """Return how often a run was killed before it ended, and its answer."""
    done = 0
    resume: tuple[str, ...] = ()
    for _ in range(kills):
        run = started(folder, "killed", *resume)
        try:
            run.wait(every)
            break
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGKILL)
            run.wait()
            done, resume = done + 1, ("--resume",)
    if started(folder, "killed", "--resume").wait() != 0:
        raise SystemExit("the last run failed")
    return done, *answered(folder)


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=5)
    parser.add_argument("--every", type=float, default=40.0)
    options = parser.parse_args()
    result: dict[str, Any] = {"python": platform.python_version(), "workers": 2}
    with TemporaryDirectory() as name:
        folder = Path(name)
        for links in (6, 8):
            (folder / "task.json").write_text(json.dumps(task(links)), encoding="utf-8")
            begun = perf_counter()
            if started(folder, f"whole-{links}").wait() != 0:
                raise SystemExit("a run failed")
            seconds = round(perf_counter() - begun, 1)
            answer, report = answered(folder)
            figures = {key: answer[key] for key in ("types", "left_out", "placements", "starts")}
            result[f"to {links} links"] = figures | {"ranked": len(answer["ranked"]), "seconds": seconds}
            print(json.dumps(result[f"to {links} links"]), flush=True)
        kills, again, shown = killed(folder, options.kills, options.every)
        result["killed"] = {"times": kills, "same_report": shown == report, "same_answer": again == answer}
        print(json.dumps(result["killed"]))
    text = json.dumps(result, indent=2) + "\n"
    Path(__file__).with_name("results").joinpath("large_tasks.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
