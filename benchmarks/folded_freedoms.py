"""Degrees of freedom of the verdict beside the nullity of the closure equations at folded configurations.

    python benchmarks/folded_freedoms.py
    python benchmarks/folded_freedoms.py --before OTHER/bin/python

Takes all crease patterns of the folder that SYNTHEDRA_FOLD names, or of ../shared/fold, and writes
benchmarks/results/folded_freedoms.json: the verdict of `synth mobility` and its processor time, a fresh process each,
start and reading included; and the nullity at five folds of `synth fold`, read at the gap of the spectrum, of sheets of
up to 700 creases (tests/support/folded_nullity.py). With --before the verdict and time of another version are beside.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "support"))

from folded_nullity import folded_nullity  # noqa: E402
from real_patterns import folder_of_patterns, names_of_patterns  # noqa: E402

from graphs.errors import SynthedraError  # noqa: E402
from graphs.files.formats import read  # noqa: E402

MOST_JOINTS = 700
KEYS = ("freedoms", "certainty", "count", "at_least", "proved", "text")


def verdict(python: str, name: str) -> dict[str, Any]:
    """Return what a version answers about a pattern, and its processor seconds."""
    command = [python, "-m", "synth.cli", "mobility", str(folder_of_patterns() / name), "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        text = process.stdout.read()
        _, _, usage = os.wait4(process.pid, 0)
        process.returncode = 0  # it was waited for
    seconds = round(usage.ru_utime + usage.ru_stime, 2)
    answers = json.loads(text) if text.strip() else []
    if not answers:
        return {"seconds": seconds, "refused": True}
    said = answers[0].get("verdict") or {}
    return {"seconds": seconds, **{key: said.get(key) for key in KEYS}}


def nullities(name: str) -> dict[str, Any]:
    """Return the nullities at folds of a pattern and the least gap, or why there are none."""
    try:
        mechanism = read(folder_of_patterns() / name)
        sheet = getattr(mechanism, "mechanism", mechanism)
        if len(sheet.edges) > 3 * MOST_JOINTS:
            return {"left_out": "large"}
        folded = folded_nullity(sheet)
    except SynthedraError as error:
        return {"left_out": str(error).split(":")[0][:80]}
    return {"nullities": folded.nullities, "gap": round(min(folded.gap, 99.0), 1)}


def main() -> None:
    """Measure all patterns, print a line for each, and store them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--before", help="Python of another version.")
    before = parser.parse_args().before
    rows: dict[str, dict[str, Any]] = {}
    for name in names_of_patterns():
        rows[name] = {"now": verdict(sys.executable, name), "folded": nullities(name)}
        if before:
            rows[name]["before"] = verdict(before, name)
        print(name, {key: {k: v for k, v in row.items() if k != "text"} for key, row in rows[name].items()}, flush=True)
    whole = {which: sum(row[which]["seconds"] for row in rows.values() if which in row) for which in ("before", "now")}
    answer = {"seconds": {which: round(value, 1) for which, value in whole.items()}, "patterns": rows}
    file = ROOT / "benchmarks" / "results" / "folded_freedoms.json"
    file.write_text(json.dumps(answer, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
