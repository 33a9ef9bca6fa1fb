"""Write synth/synthesis/atlas/named.json: the types that the literature names, by their ids.

The mechanisms of the papers (the index of this folder), chains that have a name, and what is known well. Run after
`data/make.py`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

from graphs.answer.identity import identify
from graphs.files.formats import read

HERE = Path(__file__).resolve().parent
PLACE = HERE.parent / "synth" / "synthesis" / "atlas" / "named.json"

_CHAINS = (
    ("k1:Cr", "four-bar chain", "Reuleaux 1875"),
    ("k1:DqK", "five-bar chain", "Reuleaux 1875"),
    ("k1:E`hW", "Watt chain", "Burmester 1888"),
    ("k1:E@zO", "Stephenson chain", "Burmester 1888"),
)
_WELL_KNOWN = (
    ("patterns/bird-base.fold", "bird base", "traditional"),
    ("patterns/four-bar-vertex.fold", "vertex of four creases", "Huffman 1976"),
)
_TYPE_OF_FILE = {
    "six-bar-loop-spherical": "spherical six-bar loop",
    "six-bar-loop-planar": "planar six-bar loop",
    "six-bar-loop-spatial": "spatial six-bar loop",
    "watt": "Watt six-bar",
    "watt-planar": "planar Watt six-bar",
    "stephenson": "Stephenson six-bar",
    "stephenson-planar": "planar Stephenson six-bar",
    "fig11-stephenson": "Stephenson six-bar",
    "two-centres": "two four-bars with two centres",
    "table3-row1": "Table 3, row 1 (Wiener)",
    "table3-row2": "Table 3, row 2 (Wiener)",
    "table3-row3": "Table 3, row 3 (Wiener)",
    "table3-row4": "Table 3, row 4 (Wiener)",
    "fig1": "Fig. 1 (Wampler)",
    "fig7": "Fig. 7 (Wampler)",
    "fig8": "Fig. 8 (Wampler)",
    "fig9": "Fig. 9 (Wampler)",
    "fig12": "Fig. 12 (Wampler)",
    "fig12-scd": "Fig. 12 (Wampler)",
    "fig12-open": "Fig. 12 (Wampler), open",
    "spherical-4r": "spherical four-bar",
    "ups-chain-3-3": "UPS chain, ends of 3 and 3 sides",
    "ups-chain-4-5": "UPS chain, ends of 4 and 5 sides",
    "ups-chain-6-3": "UPS chain, ends of 6 and 3 sides",
    "sarrus": "Sarrus linkage",
    "three-link-chain": "three-link chain",
}
"""Types whose files are named otherwise; figures and rows of tables have the author with them."""
_COMPOUNDS = re.compile(r"\b(\w+) (bar)\b|\b(ride) (along)\b")


def _type_name(stem: str) -> str:
    """Return the name of the type of a file: six-bar, ride-along."""
    spaced = _COMPOUNDS.sub(lambda words: "-".join(filter(None, words.groups())), stem.replace("-", " "))
    return _TYPE_OF_FILE.get(stem, spaced)


def main() -> None:
    """Write the file."""
    lines = ",\n".join("  " + json.dumps(entry) for entry in entries())
    PLACE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


def entries() -> list[dict[str, str]]:
    """Return kind, id, name and source of each type that has a name."""
    return [*_of_chains(), *_of_files()]


def _of_chains() -> Iterator[dict[str, str]]:
    for code, name, source in _CHAINS:
        yield {"kind": "chain", "id": code, "name": name, "source": source}


def _of_files() -> Iterator[dict[str, str]]:
    index = json.loads((HERE / "index.json").read_text(encoding="utf-8"))
    listed = [(entry["file"], _type_name(Path(entry["file"]).stem), entry["source"]) for entry in index]
    listed += [known for known in _WELL_KNOWN if known[0] not in {file for file, _, _ in listed}]
    for file, name, source in listed:
        mechanism = read(HERE / file)
        code = identify(mechanism).drawing
        if code is not None:
            yield {"kind": _kind(code), "id": code, "name": name, "source": source}


def _kind(code: str) -> str:
    return "scd" if "-" in code else "sc"  # an open edge


if __name__ == "__main__":
    main()
