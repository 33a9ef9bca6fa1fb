"""A term of OEIS A233288 from the stores of its two counts, by sizes of contracted graphs.

    synth enumerate chains --links 20 --dof 1 --count --method orbits -o orbits.sqlite --resume
    synth enumerate chains --links 20 --dof 1 --count --method burnside -o burnside.sqlite --resume
    python benchmarks/a233288.py orbits.sqlite burnside.sqlite --commit COMMIT

writes the number to benchmarks/results/a233288-20.json (20: the number of links), if both counts are complete and
agree, size by size: `orbits` and `burnside`, with the seconds of wall time of all units and the commit that
counted, which is told by the caller, since a store does not know it.
"""

from __future__ import annotations

import argparse
import json
import sqlite3
import sys
from collections import Counter
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from typing import Any

from enumerate.runner.store import read_meta, read_rows
from graphs.errors import StoreError

RESULTS = Path(__file__).parent / "results"
METHODS = ("orbits", "burnside")


def sums_of(store: Path) -> dict[int, int]:
    """Return the sums of a store by the number of links of contracted graphs, the largest first."""
    sums: Counter[int] = Counter()
    for count, links in read_rows(store):
        sums[links] += count
    return dict(sorted(sums.items(), reverse=True))


def seconds_of(store: Path) -> float:
    """Return the seconds that all units of a store took, each in its process."""
    with closing(sqlite3.connect(f"{store.resolve().as_uri()}?mode=ro", uri=True)) as connection:
        return float(connection.execute("SELECT total(seconds) FROM unit").fetchone()[0])


def counted(store: Path, method: str) -> dict[str, Any]:
    """Return what a store is a count of.

    Raises
    ------
    StoreError
        If it is no complete count of all chains of one freedom by a method.
    """
    meta = read_meta(store)
    job = meta["job"]
    if (job.get("count"), job.get("method"), job.get("dof")) != ("chains", method, 1) or job["inversions"]:
        raise StoreError(f"{store}: is no count of chains with M = 1 by {method}: {job}")
    if not meta["complete"]:
        raise StoreError(f"{store}: is not complete; go on with --resume")
    return {name: value for name, value in job.items() if not name.endswith("_of_a_unit") and name != "method"}


def figures_of(stores: Mapping[str, Path], commit: str) -> dict[str, Any]:
    """Return what is written of a term.

    Parameters
    ----------
    stores : mapping
        Method to store.
    commit : str
        What counted.

    Raises
    ------
    StoreError
        If a count is not complete, or not of the same chains, or not the same.
    """
    queries = [counted(store, method) for method, store in stores.items()]
    if queries[0] != queries[1]:
        raise StoreError(f"the stores count different chains: {queries[0]} and {queries[1]}")
    sums = {method: sums_of(store) for method, store in stores.items()}
    one, other = sums.values()
    apart = [size for size in sorted({*one, *other}, reverse=True) if one.get(size, 0) != other.get(size, 0)]
    if apart:
        raise StoreError(f"the methods do not agree at contracted graphs with {apart} links: {sums}")
    return {
        "links": queries[0]["links"],
        **{method: sum(parts.values()) for method, parts in sums.items()},
        "by_size": {size: {method: sums[method].get(size, 0) for method in METHODS} for size in one},
        "seconds": {method: round(seconds_of(store)) for method, store in stores.items()},
        "commit": commit,
    }


def main() -> None:
    """Write the figures, or say in a line why not."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for method in METHODS:
        parser.add_argument(method, type=Path, metavar=f"{method.upper()}.sqlite")
    parser.add_argument("--commit", required=True)
    options = parser.parse_args()
    try:
        figures = figures_of({method: getattr(options, method) for method in METHODS}, options.commit)
    except StoreError as error:
        sys.exit(str(error))
    place = RESULTS / f"a233288-{figures['links']}.json"
    place.write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    print(f"{figures['orbits']} chains of {figures['links']} links, by both methods: {place}")


if __name__ == "__main__":
    main()
