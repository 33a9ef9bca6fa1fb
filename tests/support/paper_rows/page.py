"""The page of the rows: docs/papers.md."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from typing import Any

from paper_rows import hyatt_2020, hyatt_2021, independent_pass, tipparthi_2011, wampler_2007, wiener_2016
from paper_rows.row import Row

__all__ = ["PAPERS", "numbered", "page"]

PAPERS = {
    "Hyatt, Magleby, Howell 2020": hyatt_2020.ROWS,
    "Hyatt et al. 2021": hyatt_2021.ROWS,
    "Tipparthi and Larochelle 2011": tipparthi_2011.ROWS,
    "Wiener 2016": wiener_2016.ROWS,
    "Wampler, Larson, Erdman 2007": wampler_2007.ROWS,
    "What an independent pass found": independent_pass.ROWS,
}

_HEAD = """# The five papers, figure by figure

What the papers print, what is asked here, and what comes out. The tests run every row, the slow ones in `make test-slow`, and hold this page to
them; `make examples` writes it anew from `tests/support/paper_rows/`. Angles are in degrees.

The papers themselves are not at hand, only text that was taken out of them, and [golden values](misprints.md) computed from it: a figure stands
under *printed* where it is in that text. The last column is *equal*; or *holds*, of a claim without a figure; or *none at hand*, where the figure is not in that text and
ours is held to a second method or to `data/golden.json`; or the item in the list of [misprints](misprints.md), *ours* then being the right figure; or why it cannot be done. `answer` is
what the command prints with `--json`, or the value of the call, before the last expression is taken of it. Commands run in a clone of the repository, in this order in a row;
expressions are Python as it stands, after `import json, graphs, synth`, `import numpy as np` and, for a command with `--json`, `answer = json.loads(output)`.
The last section has what an independent pass through the papers found to differ, or not to be answered, as far as its items are at hand; where a row of a
paper shows an item, it is *shown above*.
"""


def numbered() -> Iterator[tuple[int, str, Row]]:
    """Yield every row with its number and its paper."""
    rows = [(paper, row) for paper, listed in PAPERS.items() for row in listed]
    yield from ((number, paper, row) for number, (paper, row) in enumerate(rows, 1))


def page(figures: dict[int, Any]) -> str:
    """Return the page, with the figures that came out, by the numbers of the rows."""
    text, last = _HEAD + "\n" + _summary(), None
    for number, paper, row in numbered():
        if paper != last:
            text += f"\n## {paper}\n\n| # | where | what | how it is asked | printed | ours | |\n|---|---|---|---|---|---|---|\n"
            last = paper
        ours = "-" if row.why or row.same else shown(figures[number])
        text += (
            f"| {number} | {row.place} | {row.what} | {_asked(row)} | {_printed(row)} | {ours} | {_verdict(row)} |\n"
        )
    return text


def _number(row: Row) -> int:
    """Return the number of a row of a paper."""
    return next(number for number, _, other in numbered() if other is row)


def _summary() -> str:
    number = Counter(row.status for _, _, row in numbered())
    listed = ", ".join(f"{number[status]} {status}" for status in sorted(number, key=lambda status: -number[status]))
    return f"{number.total()} rows: {listed}.\n"


def _asked(row: Row) -> str:
    if row.same:
        return f"row {_number(row.same)}"
    if row.why:
        return "-"
    asked = [f"`{command}`" for command in (*row.first, row.ask)]
    if row.figure != "answer":
        asked.append(f"`{row.figure}`")
    return "; ".join(asked)


def _printed(row: Row) -> str:
    if row.words or row.printed is None:
        return row.words or "-"
    return shown(row.printed)


def _verdict(row: Row) -> str:
    more = f" {row.misprint}" if row.misprint else f": {row.why}" if row.why else ""
    return "; ".join(filter(None, [row.status + more, row.remark]))


def shown(value: Any) -> str:
    """Return a figure as the page has it: six digits, what is nothing but rounding as 0."""
    match value:
        case bool():
            return "yes" if value else "no"
        case float():
            return f"{0.0 if abs(value) < 1e-9 else value:.6g}"
        case list():
            inner = [f"({shown(one)})" if isinstance(one, list) else shown(one) for one in value]
            return ", ".join(inner)
        case dict():
            return ", ".join(f"{key} {shown(one)}" for key, one in value.items())
        case str():
            return value
    return json.dumps(value)
