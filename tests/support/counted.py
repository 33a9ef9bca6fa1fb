"""The numbers that the index of data/ may name, counted from a file."""

from __future__ import annotations

from pathlib import Path

from graphs.convert.conversions import to_sc
from graphs.count.report import mobility_report
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet

KEYS = {"N": "links", "J": "joints", "V": "vertices", "C": "implicit_centres",
        "E_ext": "external_edges", "E_int": "internal_edges", "E": "edges", "L": "on_line"}  # fmt: skip


def counted_numbers(path: Path) -> dict[str, int]:
    """Everything the index may name, from the mobility report."""
    thing = read(path)
    report = mobility_report(to_sc(thing) if isinstance(thing, Sheet) else thing).to_json()
    merged = report["counts"] | {k: report[k] for k in ("links", "joints")}
    found = {short: merged[long] for short, long in KEYS.items() if merged.get(long) is not None}
    if "E_ext" in found:
        found["E"] = found["E_ext"] + found["E_int"]
    return found | {"M": report["mobility"]}
