"""What people wait for: a table of processor times, beside those of other programs where these are at hand.

    python benchmarks/table.py [ROW ...]

measures each row, or those named, and writes benchmarks/results/table.json: the median, all runs, other programs on
the same input in turn, ratios, and the machine. Processor time, children included, since other work on the machine
does not count in it. Other programs are looked for in the folder that SYNTHEDRA_PEERS names, or in ../shared/peers.
Rows that take minutes are measured only if they are named.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter, process_time
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benchmarks.gensparseg import built
from benchmarks.osbo import frames_of_osbo
from benchmarks.page_solver import measured as frames_of_page
from graphs.files.formats import write
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns.creases import miura

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benchmarks" / "results" / "table.json"
VERTEX = ROOT / "data" / "patterns" / "four-bar-vertex.fold"
RUNS = 5
SECTOR = np.radians(70.0)
Figures = dict[str, Any]


def children() -> float:
    """Return the processor seconds of all processes that were started from here and have ended."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def processor_seconds(*words: str, runs: int = RUNS, **environment: str) -> list[float]:
    """Return the processor seconds of a command in processes of its own, run by run."""
    taken = []
    for _ in range(runs):
        before = children()
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env={**os.environ, **environment})
        taken.append(children() - before)
    return taken


def synth(*words: str, runs: int = RUNS, **environment: str) -> list[float]:
    """Return the processor seconds of a command of synth."""
    return processor_seconds(sys.executable, "-m", "synth.cli", *words, runs=runs, **environment)


@contextmanager
def empty_cache() -> Iterator[dict[str, str]]:
    """Give an environment in which no machine code is there yet."""
    with tempfile.TemporaryDirectory() as folder:
        yield {"SYNTHEDRA_CACHE": folder}


def first_count(*words: str) -> Callable[[], Figures]:
    """Return what measures an enumeration with an empty cache, one run."""

    def measure() -> Figures:
        with empty_cache() as environment:
            return {"runs": synth("enumerate", *words, runs=1, **environment)}

    return measure


def demo() -> Figures:
    """Measure `make demo` in a fresh clone of the last commit; pip keeps what it has fetched once."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["git", "clone", "--quiet", str(ROOT), folder], check=True)
        return {"runs": processor_seconds("make", "--quiet", "-C", folder, f"PYTHON={sys.executable}", "demo", runs=1)}


def installed(extras: str) -> Figures:
    """Measure what an installation with some extras takes on disk, in MB, without byte code and what installs it."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        pip = [str(Path(folder, "bin", "python")), "-m", "pip", "install", "--quiet", "--no-compile"]
        subprocess.run([*pip, f"{ROOT}{extras}"], check=True)
        [packages] = Path(folder).glob("lib/python*/site-packages")
        bytes_of: Counter[str] = Counter()
        for path in packages.rglob("*"):
            name = path.relative_to(packages).parts[0]
            if path.is_file() and path.suffix != ".pyc" and not name.startswith(_INSTALLERS):
                bytes_of[name] += path.stat().st_size
        return {"runs": [bytes_of.total() / 1e6], "largest": dict(bytes_of.most_common(5))}


_INSTALLERS = ("pip", "setuptools", "pkg_resources", "_distutils_hack", "distutils-precedence")
"""What a new environment has before anything is installed there."""


def milliseconds(call: Callable[[], object], runs: int = RUNS) -> list[float]:
    """Return the milliseconds of processor time of a call, run by run, after one that is not counted."""
    call()
    taken = []
    for _ in range(runs):
        start = process_time()
        call()
        taken.append(1000.0 * (process_time() - start))
    return taken


def frames(n: int, count: int) -> Callable[[], Figures]:
    """Return what measures a frame of n x n panels, one crease driven by a degree each, by all that can."""

    def measure() -> Figures:
        flat = miura(n, n, SECTOR)
        begun = fold(flat, frames=9).frames()[1]
        angles = np.array([angle or 0.0 for angle in begun.fold_angles or ()])
        driven = int(np.abs(angles).argmax())
        goal = angles[driven] + np.sign(angles[driven]) * np.radians(count)
        times: list[float] = []
        folded = fold(begun, drive={driven: goal}, frames=count, report=lambda _: times.append(process_time()))
        assert folded.path.stopped == ""
        found: Figures = {"runs": (1000.0 * np.diff(times)).tolist(), "closure": folded.closure, "others": {}}
        others = {
            "osbo": lambda: frames_of_osbo(
                flat, dict(zip(begun.edges, angles, strict=True)), begun.edges[driven], count
            ),
            "page in node": lambda: _page(n),
        }
        for name, other in others.items():
            figures = other()
            if figures is not None:
                found["others"][name] = figures
        return found

    return measure


def _page(n: int) -> Figures | None:
    if shutil.which("node") is None or n > 32:
        return None
    figures = frames_of_page(n)
    return {"median": figures["frame_ms"], "closure": figures["closure"]}


def counted(links: int) -> Figures:
    """Measure a count of chains with machine code, and the program that holds the record of listing them."""
    words = ("enumerate", "chains", "--links", str(links), "--dof", "1", "--count")
    synth(*words, runs=1)
    found: Figures = {"runs": synth(*words), "others": {}}
    with tempfile.TemporaryDirectory() as folder:
        program = built(Path(folder))
        if program is not None:
            taken = processor_seconds(str(program), str(links), "-K3/2", "-L2", "-uq", runs=1)
            found["others"]["gensparseg"] = {"median": median(taken)}
    return found


def positions(*, circuits: bool) -> Figures:
    """Measure the positions of a spherical four-bar, circuits told apart or not."""
    from synth.analysis.assembly import positions as assembly_modes
    from synth.catalogue.patterns import generate

    ring = generate("four-bar").mechanism
    return {"runs": milliseconds(lambda: assembly_modes(ring, drive={0: 1.0}, circuits=circuits))}


def cones() -> Figures:
    """Measure the cones of a four-bar, by numbers that differ each time."""
    from synth.linkages.surfaces import map_to_cones

    angles = iter(np.radians([30.0, 45.0, 60.0, 70.0]) + 0.01 * k for k in range(100))
    return {"runs": milliseconds(lambda: map_to_cones(next(angles)), 20)}


def cones_at_once(count: int) -> Callable[[], Figures]:
    """Return what measures the cones of many four-bars that close."""

    def measure() -> Figures:
        from synth.linkages.fourbar.closing import can_close
        from synth.linkages.surfaces import cones_of_loops

        angles = np.random.default_rng(1).uniform(0.02, np.pi - 0.02, (2 * count, 4))
        angles = angles[can_close(angles)][:count]
        return {"runs": [one / 1000.0 for one in milliseconds(lambda: cones_of_loops(angles))]}

    return measure


def swept(members: int, batch: int) -> Callable[[], Figures]:
    """Return what measures spherical four-bars whose crank turns all round, at 64 inputs, batch by batch.

    What is waited for on two cores is half of the processor time.
    """

    def measure() -> Figures:
        from synth.analysis.members import sweep
        from synth.catalogue.patterns.hinged_rings import spherical_ring

        arcs, random = np.radians([30.0, 80.0, 70.0, 75.0]), np.random.default_rng(1)
        ring, turn = spherical_ring(arcs), np.linspace(0.0, 2.0 * np.pi, 64)
        taken, waited, closed, worst = 0.0, 0.0, 0, 0.0
        for _ in range(members // batch):
            given = arcs + np.radians(random.uniform(-5.0, 5.0, (batch, 4)))
            start, begun = process_time(), perf_counter()
            answer = sweep(ring, {"arcs": given}, drive={0: turn})
            taken, waited = taken + process_time() - start, waited + perf_counter() - begun
            closed, worst = closed + int(answer.closed.sum()), max(worst, float(np.nanmax(answer.residuals)))
        return {"runs": [taken / 2.0], "waited": waited, "closed": closed, "closure": worst}

    return measure


def realised(kind: str, links: int, step: int) -> Callable[[], Figures]:
    """Return what measures the realisation of every so manieth type of a kind, after one that is not counted."""

    def measure() -> Figures:
        from enumerate.sc import sc_graphs
        from enumerate.scd import scd_graphs
        from graphs.errors import SynthedraError
        from synth.catalogue.realisation import realise

        listed = list(scd_graphs(links, 1, 4) if kind == "scd" else sc_graphs(links, 1))[::step]
        taken, refused = [], 0
        realise(listed[0])
        for graph in listed:
            start = process_time()
            try:
                realise(graph)
            except SynthedraError:
                refused += 1
            taken.append(1000.0 * (process_time() - start))
        return {"runs": taken, "worst": max(taken), "refused": refused}

    return measure


def atlas() -> Figures:
    """Measure an atlas of types of up to six links, per type."""
    from synth.synthesis.atlas.building import AtlasPlan, build_atlas

    taken = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(3):
            start = process_time()
            rows = build_atlas(Path(folder) / f"{number}.sqlite", AtlasPlan(6)).rows
            taken.append(1000.0 * (process_time() - start) / rows)
    return {"runs": taken, "types": rows}


def of_sheet(n: int, command: str, *words: str) -> Callable[[], Figures]:
    """Return what measures a command on a Miura sheet of n x n panels, reading and start included."""

    def measure() -> Figures:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "miura.fold"
            write(miura(n, n, SECTOR), path)
            return {"runs": synth(command, str(path), *words, runs=1)}

    return measure


@dataclass(frozen=True)
class Row:
    """A line of the table: what is measured, in which unit, and what was wanted."""

    what: str
    unit: str
    wanted: float
    measure: Callable[[], Figures]
    long: bool = False


ROWS = {
    "demo": Row("fresh clone: make demo", "s", 75, demo, long=True),
    "installed": Row("pip install .", "MB", 250, lambda: installed(""), long=True),
    "installed-enumerate": Row("the same, with [enumerate]", "MB", 420, lambda: installed("[enumerate]"), long=True),
    "chains-8": Row(
        "empty cache: chains of 8 links counted", "s", 3,
        first_count("chains", "--links", "8", "--dof", "1", "--count"),
    ),
    "sc-6": Row("empty cache: SC graphs of 6 links", "s", 3, first_count("sc", "--links", "6", "--dof", "1")),
    "scd-6": Row(
        "empty cache: SCD graphs of 6 links", "s", 3,
        first_count("scd", "--links", "6", "--dof", "1", "--max-degree", "4"),
    ),
    "watt": Row(
        "empty cache: Watt's linkage on cones", "s", 3, first_count("conical", "--chain", "watt", "--count")
    ),
    "mobility": Row("mobility of four panels", "s", 0.8, lambda: {"runs": synth("mobility", str(VERTEX))}),
    "chains-12": Row("chains of 12 links counted", "s", 1, lambda: counted(12)),
    "chains-14": Row("chains of 14 links counted", "s", 2, lambda: counted(14)),
    "frame-100": Row("a frame, 100 panels", "ms", 0.8, frames(10, 60)),
    "frame-1024": Row("a frame, 1 024 panels", "ms", 6, frames(32, 30)),
    "frame-5625": Row("a frame, 5 625 panels", "ms", 35, frames(75, 12), long=True),
    "positions": Row("positions of a spherical four-bar", "ms", 2, lambda: positions(circuits=False)),
    "circuits": Row("the same, with circuits", "ms", 10, lambda: positions(circuits=True)),
    "cones": Row("cones of a four-bar", "ms", 2, cones),
    "cones-100000": Row("cones of 100 000 four-bars", "s", 1, cones_at_once(100_000)),
    "sweep": Row("1 000 000 four-bars at 64 inputs, on two cores", "s", 30, swept(1_000_000, 50_000), long=True),
    "scd-8": Row("an SCD type of 8 links realised", "ms", 20, realised("scd", 8, 13)),
    "sc-8": Row("an SC type of 8 links realised", "ms", 200, realised("sc", 8, 1)),
    "atlas": Row("an atlas to 6 links, each type", "ms", 25, atlas),
    "verdict-1024": Row("verdict on 1 024 panels", "s", 1, of_sheet(32, "mobility")),
    "rank-10000": Row(
        "mobility of 10 000 panels, without motion", "s", 5, of_sheet(100, "mobility", "--no-motion"), long=True
    ),
    "rank-100000": Row(
        "mobility of 100 000 panels, without motion", "s", 20, of_sheet(316, "mobility", "--no-motion"), long=True
    ),
    "fold-10000": Row("four frames of 10 000 panels", "s", 10, of_sheet(100, "fold", "--frames", "4"), long=True),
    "fold-100000": Row("four frames of 100 000 panels", "s", 60, of_sheet(316, "fold", "--frames", "4"), long=True),
}  # fmt: skip


def measured(row: Row) -> Figures:
    """Measure a row: its figures with median and ratios."""
    found = row.measure()
    middle = median(found["runs"])
    others = found.pop("others", {})
    for other in others.values():
        other["ratio"] = round(other["median"] / middle, 2)
    return {
        "what": row.what,
        "unit": row.unit,
        "wanted": row.wanted,
        "median": middle,
        **found,
        **({"others": others} if others else {}),
    }


def main() -> None:
    """Measure the rows and store them beside those that were not asked for."""
    names = sys.argv[1:] or [name for name, row in ROWS.items() if not row.long]
    unknown = [name for name in names if name not in ROWS]
    if unknown:
        sys.exit(f"no row {unknown[0]}; expected: {', '.join(ROWS)}")
    stored = json.loads(RESULTS.read_text(encoding="utf-8"))["rows"] if RESULTS.exists() else {}
    for name in names:
        stored[name] = figures = measured(ROWS[name])
        beside = "".join(f"; {other}: {one['ratio']:g} times" for other, one in figures.get("others", {}).items())
        print(
            f"{name:13} {figures['median']:9.3g} {figures['unit']:3} (wanted {figures['wanted']:g}){beside}", flush=True
        )
    machine = {"machine": platform.machine(), "cores": os.cpu_count(), "python": platform.python_version()}
    rows = {name: stored[name] for name in ROWS if name in stored}
    rounded = json.loads(json.dumps({**machine, "rows": rows}), parse_float=lambda text: float(f"{float(text):.4g}"))
    RESULTS.write_text(json.dumps(rounded, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
