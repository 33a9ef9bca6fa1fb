"""Make data/realised: the mechanisms of the papers that come without coordinates, as flat sheets, or in space.

``make data`` runs it. Coordinates are solved for; nine decimals of them are the same on every machine.
"""

from __future__ import annotations

import json
from pathlib import Path

import wampler_2007
import wiener_2016
from decimals import with_few_decimals
from entries import Entry

from graphs.files.formats import write
from graphs.mechanism.polyhedron import PolyhedronModel
from synth.catalogue.realisation._realise import Realisation, realise

HERE = Path(__file__).resolve().parent / "realised"

WITHOUT = {
    "wiener/concentric-loops": "a closed surface of ten centres: it has no border, and cannot lie flat",
    "wiener/mesh-4x4-edge-creases": "its corner panels hang on one link: a drawing that a link cuts has no id to check",
    "wiener/six-bar-loop-spatial": "a loop without a centre needs three open edges; the drawing of wiener/sarrus has them",
    "wampler/fig12": "a model with a remote centre, not of panels; its type is wampler/fig12-scd",
}
"""Why others have none, besides models of rods and of scissors, which have no panels."""

IN_SPACE = [
    f"wiener/{name}.json" for name in ("six-bar-loop-planar", "stephenson-planar", "table3-row4", "watt-planar")
]
"""Creases that are parallel round a hole: no flat sheet of them was found, or there is none."""


def sources() -> list[Entry]:
    """Return the mechanisms without coordinates that are realised."""
    entries = [*wiener_2016.ENTRIES, *wampler_2007.ENTRIES]
    plain = [entry for entry in entries if entry.file.endswith(".json") and not _is_without(entry)]
    return [entry for entry in plain if not _is_of_rods(entry)]


def _is_without(entry: Entry) -> bool:
    return entry.file.removesuffix(".json") in WITHOUT


def _is_of_rods(entry: Entry) -> bool:
    made = entry.make()
    return isinstance(made, PolyhedronModel) and not made.links


def row(entry: Entry, found: Realisation) -> dict[str, object]:
    """Return what the index says of a realised mechanism."""
    told = found.to_json()
    return {"file": f"{Path(entry.file).stem}.fold", "of": entry.file} | {
        key: told[key] for key in ("kind", "drawing", "mobility", "freedoms", "folds", "notes")
    }


def main(folder: Path = HERE) -> None:
    """Write them and their index into a folder."""
    folder.mkdir(exist_ok=True)
    rows = []
    for entry in sources():
        found = realise(entry.make(), kind="space", tries=60) if entry.file in IN_SPACE else realise(entry.make())
        rows.append(row(entry, found))
        write(with_few_decimals(found.sheet), folder / str(rows[-1]["file"]), force=True)
    lines = ",\n".join("  " + json.dumps(one) for one in rows)
    (folder / "index.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
