"""What benchmarks/a233288.py makes of the stores of two counts."""

import json
import runpy
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from enumerate.chains.jobs import CountJob
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.sinks import CountSink
from enumerate.runner.store import SqliteSink
from graphs.errors import StoreError

PROGRAM = runpy.run_path(str(Path(__file__).parents[3] / "benchmarks" / "a233288.py"))
METHODS = ("orbits", "burnside")
BY_SIZE = {6: 50, 5: 95, 4: 72, 3: 11, 2: 2}


def stores(folder, links=10, **options):
    """Stores of the two counts, one of made graphs and one of graphs that units make."""
    found = {}
    for method in METHODS:
        found[method] = folder / f"{method}.sqlite"
        job = CountJob(ChainQuery(links, 1, **options), method, streamed=method == "burnside")
        run(job, CountSink(SqliteSink(found[method])))
    return found


def test_both_numbers_by_size(tmp_path):
    figures = PROGRAM["figures_of"](stores(tmp_path), "abc")
    assert {name: figures[name] for name in ("links", "orbits", "burnside", "commit")} == {
        "links": 10, "orbits": 230, "burnside": 230, "commit": "abc"
    }  # fmt: skip
    assert json.loads(json.dumps(figures["by_size"])) == {
        str(size): {"orbits": count, "burnside": count} for size, count in BY_SIZE.items()
    }
    assert figures["seconds"].keys() == set(METHODS)


def test_counts_that_do_not_agree_are_no_term(tmp_path):
    held = stores(tmp_path)
    with pytest.raises(StoreError, match="is no count of chains with M = 1 by orbits"):
        PROGRAM["figures_of"]({"orbits": held["burnside"], "burnside": held["orbits"]}, "abc")
    with closing(sqlite3.connect(held["orbits"])) as connection, connection:
        connection.execute("UPDATE meta SET value = 'false' WHERE key = 'complete'")
    with pytest.raises(StoreError, match="is not complete"):
        PROGRAM["figures_of"](held, "abc")


def test_sums_that_differ_are_named(tmp_path):
    """The same job with a number that is another: as if one of the methods were wrong."""

    class Wrong(CountJob):
        def work(self, payload):
            return [(count + (links == 4), links) for count, links in super().work(payload)]

    held = stores(tmp_path)
    held["orbits"] = tmp_path / "wrong.sqlite"
    run(Wrong(ChainQuery(10, 1), "orbits"), CountSink(SqliteSink(held["orbits"])))
    with pytest.raises(StoreError, match=r"do not agree at contracted graphs with \[4\] links"):
        PROGRAM["figures_of"](held, "abc")


def test_counts_of_other_chains_are_told(tmp_path):
    held = stores(tmp_path)
    (tmp_path / "other").mkdir()
    held["burnside"] = stores(tmp_path / "other", 8)["burnside"]
    with pytest.raises(StoreError, match="count different chains"):
        PROGRAM["figures_of"](held, "abc")
