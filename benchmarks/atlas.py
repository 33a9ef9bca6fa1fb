"""Questions to an atlas of 500 000 types: processor time of each.

    python benchmarks/atlas.py

builds an atlas of types of up to six links, fills it with rows like its own, asks, takes the median of five, and
writes benchmarks/results/atlas.json. Processor time, since other work on the machine does not count in it.
"""

from __future__ import annotations

import json
import platform
import random
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

from synth.synthesis.atlas.atlas_file import open_atlas
from synth.synthesis.atlas.building import AtlasPlan, build_atlas
from synth.synthesis.atlas.columns import COLUMNS

PLACE = Path(__file__).resolve().parent / "results" / "atlas.json"
ROWS = 500_000
INDEXED = (
    "links = 8 AND dof = 1 AND centres >= 3 AND all_explicit",
    "links = 8",
    "symmetry = 4 AND dof = 3",
    "centres = 5 AND kind = 'sc'",
    "chain_id = 'k1:Cr'",
    "id = 'k1:Cr'",
    "name = 'Watt chain'",
    "ride_alongs = 1 AND links = 11 AND dof = 2 AND joints = 99",
)
ANY = (
    "vertices = 99",
    "99 IN (SELECT value FROM json_each(loop_sizes))",
    "name LIKE '%watt%'",
    "dof = 1 AND layers = 99",
    "edge_ratio > 2",
)


def filled(place: Path) -> None:
    """Add rows like those that are there, of other sizes."""
    names = ", ".join(f'"{name}"' for name in COLUMNS)
    with closing(sqlite3.connect(place)) as connection, connection:
        known = [dict(zip(COLUMNS, row, strict=True)) for row in connection.execute(f"SELECT {names} FROM type")]
        marks = ", ".join("?" * (len(COLUMNS) + 1))
        connection.executemany(f"INSERT INTO type VALUES ({marks})", _rows(known))
        connection.execute("ANALYZE")


def _rows(known: list[dict[str, Any]]) -> Iterator[tuple[Any, ...]]:
    rng = random.Random(0)
    for number in range(ROWS):
        row = rng.choice(known) | {"links": rng.randrange(4, 12), "dof": rng.choice((1, 1, 2, 3)), "name": None}
        row["id"] = f"{row['id']}~{number}"
        yield (0, *row.values())


def main() -> None:
    """Measure, and write the table."""
    with TemporaryDirectory() as folder:
        place = Path(folder) / "atlas.sqlite"
        build_atlas(place, AtlasPlan(6, realised=False))
        filled(place)
        atlas = open_atlas(place)
        asked = []
        for kind, conditions in (("indexed", INDEXED), ("any", ANY)):
            for condition in conditions:
                times = []
                for _ in range(5):
                    begin = process_time()
                    found = atlas.query(condition, columns=["id"])
                    times.append(process_time() - begin)
                asked.append(
                    {"columns": kind, "condition": condition, "rows": len(found), "seconds": round(median(times), 5)}
                )
        result = {"machine": platform.machine(), "types": ROWS, "asked": asked}
    PLACE.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    for one in asked:
        print(f"{one['seconds']:8.4f} s  {one['condition']}")


if __name__ == "__main__":
    main()
