"""What takes how long: the plots and the table of docs/performance.md, from benchmarks/results.

``make pictures`` draws, ``make bench`` measures and then runs this.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

DOCS = Path(__file__).resolve().parent
RESULTS = DOCS.parent / "benchmarks" / "results"
PAGE = DOCS / "performance.md"
BEGIN, END = "<!-- table -->", "<!-- end of table -->"


def results(name: str) -> dict[str, Any]:
    """Return stored figures."""
    figures: dict[str, Any] = json.loads((RESULTS / f"{name}.json").read_text(encoding="utf-8"))
    return figures


def draw() -> None:
    """Draw the growth of a frame with panels, and of counts of chains with links."""
    mpl.rcParams.update({"svg.hashsalt": "growth", "svg.fonttype": "none", "font.size": 9, "axes.grid": True})
    figure = Figure(figsize=(8.4, 3.3), layout="constrained")
    frames, chains = figure.subplots(1, 2)
    sizes = results("folding")["sizes"]
    frames.loglog([one["panels"] for one in sizes], [one["frame_ms"] for one in sizes], "o-", label="synthedra, Python")
    sizes = results("page_solver")["sizes"]
    frames.loglog([one["panels"] for one in sizes], [one["frame_ms"] for one in sizes], "s-", label="synthedra, page")
    rows = results("table")["rows"]
    beside = [(int(name.split("-")[1]), row) for name, row in rows.items() if name.startswith("frame-")]
    osbo = [(panels, row["others"]["osbo"]["median"]) for panels, row in beside if "osbo" in row.get("others", {})]
    if osbo:
        frames.loglog(*zip(*osbo, strict=True), "^--", color="grey", label="osbo")
    frames.set(xlabel="panels of a Miura sheet", ylabel="a frame, ms", title="Folding by one crease")
    frames.legend()
    seconds = results("chains")["seconds"]
    for title, label, line in (("count", "synthedra, counted", "o-"), ("geng", "nauty's geng, listed", "^--")):
        links = [n for n in range(8, 20, 2) if f"{title} {n}" in seconds]
        chains.semilogy(links, [seconds[f"{title} {n}"] for n in links], line, label=label)
    chains.set(xlabel="links", ylabel="s", title="Kinematic chains of one degree of freedom")
    chains.legend()
    figure.savefig(DOCS / "pictures" / "growth.svg", metadata={"Date": None})


def table() -> str:
    """Return the rows in Markdown."""
    told = results("table")
    lines = ["| what | median | others, on the same input |", "|---|---|---|"]
    for row in told["rows"].values():
        others = [
            f"{name}: {one['median']:.3g} {row['unit']} ({one['ratio']:g} times)"
            for name, one in row.get("others", {}).items()
        ]
        middle = f"{row['median']:.3g} {row['unit']}"
        if "worst" in row:
            middle += f", worst of {len(row['runs'])}: {row['worst']:.3g} {row['unit']}"
        lines.append(f"| {row['what']} | {middle} | {', '.join(others) or '-'} |")
    lines += ["", f"Python {told['python']}, {told['machine']}, {told['cores']} cores."]
    return "\n".join(lines)


def main() -> None:
    """Draw, and write the table into the page."""
    draw()
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    _, _, after = rest.partition(END)
    PAGE.write_text(f"{before}{BEGIN}\n\n{table()}\n\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
