"""Write synth/atlas/named.json: the types that the literature names, by their ids.

The mechanisms of the papers (the index of this folder), chains that have a name, and what is known well. Run after
`data/make.py`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

from graphs.answer.identity import identify
from graphs.files.formats import read

HERE = Path(__file__).resolve().parent
PLACE = HERE.parent / "synth" / "atlas" / "named.json"

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
    listed = [(entry["file"], Path(entry["file"]).stem.replace("-", " "), entry["source"]) for entry in index]
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
