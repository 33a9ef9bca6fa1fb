"""An atlas built, asked, stopped and gone on with."""

from __future__ import annotations

import json
import random
import shutil
import sqlite3
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from time import monotonic
from typing import Any

import pytest
from commands import run

import synth
from enumerate.sc.jobs import sc_rows
from graphs.edit.analogues import planar_analogue
from graphs.errors import InvariantError, StoreError, SynthedraError, UnsolvableError
from graphs.files.formats import mechanism_of_id, read
from graphs.files.patterns.fold import read_fold
from graphs.identity.drawings import map_id
from synth.synthesis.atlas.atlas_file import Atlas, open_atlas
from synth.synthesis.atlas.building import AtlasJob, AtlasPlan, build_atlas
from synth.synthesis.atlas.columns import COLUMNS, KINDS, named_types
from synth.synthesis.atlas.export import write_rows
from synth.synthesis.atlas.finding import find_type

DATA = Path(__file__).resolve().parents[4] / "data"
MOST_LINKS = 10
"""Of files that are looked for: each joint of a mechanism is edited."""
TINY = AtlasPlan(4, creases=2, orders_of=(), realised=False)


def test_what_it_holds_is_what_enumerations_list(small_atlas: Atlas) -> None:
    assert small_atlas.about()["types"] == {"chain": 3, "order": 204, "sc": 5, "scd": 34, "string": 20}
    rows = {row["id"]: row for row in small_atlas.query("kind = 'sc'")}
    listed = [row for links in (4, 6) for row in sc_rows(links, 1)]
    assert set(rows) == {row["code"] for row in listed}
    for row in listed:
        assert rows[row["code"]]["chain_id"] == row["chain"]
        for name in ("links", "joints", "dof", "centres", "symmetry", "exact_dof", "outer_size"):
            assert rows[row["code"]][name] == row[name]
        assert rows[row["code"]]["loop_sizes"] == tuple(row["loop_sizes"])
        assert rows[row["code"]]["planar_analogue"] == map_id(planar_analogue(mechanism_of_id(row["code"])))


def test_kinds_have_values_where_columns_say(small_atlas: Atlas) -> None:
    filled: dict[str, Counter[str]] = {kind: Counter() for kind in KINDS}
    for row in small_atlas.query(limit=10_000):
        filled[row["kind"]].update(name for name, value in row.items() if value is not None)
    for name, column in COLUMNS.items():
        for kind in KINDS:
            assert kind in column.kinds or not filled[kind][name], (name, kind)
    without = {name for name in COLUMNS if not any(filled[kind][name] for kind in KINDS)}
    assert without == {"realised", "flat", "least_angle_deg", "edge_ratio", "fold_deg", "fold_end", "fold_file"}


def test_queries(small_atlas: Atlas) -> None:
    rows = small_atlas.query("links = 6 AND dof = 1 AND centres >= 2 AND all_explicit")
    assert {(row["links"], row["all_explicit"]) for row in rows} == {(6, True)}
    assert len(rows) == sum(row["implicit"] == 0 and row["centres"] >= 2 for row in small_atlas.query("kind = 'scd'"))
    falling = [row["joints"] for row in small_atlas.query(sort="-joints", columns=["joints"], limit=50)]
    assert falling == sorted(falling, reverse=True)
    first = small_atlas.query(limit=3)
    assert (len(first), first.more) == (3, True)
    assert "there are more" in str(first)
    with pytest.raises(InvariantError, match="the nearest is 'joints'"):
        small_atlas.query(columns=["jonts"])
    with pytest.raises(InvariantError, match="1 or more rows"):
        small_atlas.query(limit=0)


def test_statements_select_and_do_nothing_else(small_atlas: Atlas, tmp_path: Path) -> None:
    place = tmp_path / "atlas.sqlite"
    shutil.copy(small_atlas.path, place)
    before = place.read_bytes()
    atlas = open_atlas(place)
    [row] = atlas.sql("SELECT count(*) AS number FROM types WHERE kind = 'sc'")
    assert row == {"number": 5}
    assert atlas.sql("SELECT 9e999, x'00'").to_json() == [{"9e999": None, "x'00'": "00"}]
    for statement in (
        "DELETE FROM type", "DROP VIEW types", f"ATTACH '{tmp_path}/other.sqlite' AS other", "PRAGMA user_version = 1",
        "VACUUM", f"VACUUM INTO '{tmp_path}/copy.sqlite'", "SELECT * FROM sqlite_master", "CREATE TEMP TABLE a (b)",
        "SELECT load_extension('a')", "SELECT * FROM pragma_database_list", "BEGIN", "SELECT zeroblob(1000000000)",
        "SELECT printf('%.*c', 2147483647, 'x')", "SELECT format('%.*c', 2147483647, 'x')", "SELECT trim('a', 'b')",
        "", "SELECT 1; SELECT 2", "REINDEX", "SELECT * FROM unit",
    ):  # fmt: skip
        with pytest.raises(InvariantError) as caught:
            atlas.sql(statement)
        assert str(caught.value).isprintable()
    endless = "WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n) SELECT max(x) FROM n"
    with pytest.raises(UnsolvableError, match="takes longer than"):
        atlas.sql(endless, seconds=0.05)
    doubled = "hex(x)"
    for _ in range(20):
        doubled = f"replace({doubled}, '3', '333')"
    with pytest.raises(InvariantError, match="string or blob too big"):
        atlas.sql(f"WITH one(x) AS (SELECT '3333333') SELECT {doubled} FROM one")
    long = "WITH RECURSIVE n(t) AS (SELECT 'aaaaaaaaaa' UNION ALL SELECT t || t FROM n WHERE length(t) < 100000)"
    slow = f"{long} SELECT sum(instr(t, substr(t, 9, 50000) || a.id || b.id)) FROM n, types AS a, types AS b"
    begin = monotonic()
    with pytest.raises(UnsolvableError, match="takes longer than"):
        atlas.sql(slow, seconds=0.1)
    assert monotonic() - begin < 5  # ten thousand steps of these take minutes
    assert place.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == [place.name]


SQL_WORDS = [
    "SELECT",
    "*",
    "FROM",
    "types",
    "type",
    "relations",
    "unit",
    "sqlite_master",
    "WHERE",
    "id",
    "kind",
    "links",
    "=",
    "1",
    "'a'",
    "(",
    ")",
    ",",
    "ORDER",
    "BY",
    "LIMIT",
    "UNION",
    "ALL",
    "GROUP",
    "count(*)",
    "upper('a')",
    "hex(",
    "randomblob(9)",
    "ATTACH",
    "DETACH",
    "PRAGMA",
    "INSERT",
    "INTO",
    "DELETE",
    "UPDATE",
    "SET",
    "DROP",
    "TABLE",
    "VIEW",
    "CREATE",
    "TEMP",
    "WITH",
    "RECURSIVE",
    "AS",
    ";",
    "--",
    "/*",
    "*/",
    "\x00",
    "'",
    '"',
    "`",
    "[",
    "]",
    "?",
    ":a",
    "json_each(sides)",
    "VALUES",
    "EXPLAIN",
    "BEGIN",
    "COMMIT",
]


def fuzzed(atlas: Atlas, count: int, seed: int) -> None:
    rng = random.Random(seed)
    before, answered = atlas.path.read_bytes(), 0
    for _ in range(count):
        words = [rng.choice(SQL_WORDS) for _ in range(rng.randrange(1, 9))]
        statement = " ".join(["SELECT"] * (rng.random() < 0.6) + words)
        try:
            json.dumps(atlas.sql(statement, seconds=1.0).to_json(), allow_nan=False)
            answered += 1
        except SynthedraError as error:
            assert str(error).isprintable()
    assert answered
    assert atlas.path.read_bytes() == before


def test_no_statement_is_a_traceback(small_atlas: Atlas) -> None:
    fuzzed(small_atlas, 400, 3)


@pytest.mark.slow
def test_no_statement_is_a_traceback_of_many(small_atlas: Atlas) -> None:
    fuzzed(small_atlas, 10_000, 4)


class Killed(Exception):
    """The run ends here."""


def test_a_stopped_build_goes_on_to_the_same_atlas(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place, whole = tmp_path / "stopped.sqlite", tmp_path / "whole.sqlite"
    work, begun = AtlasJob.work, Counter[str]()

    def dying(self: AtlasJob, payload: Any) -> Any:
        begun["units"] += 1
        if begun["units"] == 3:
            raise Killed
        return work(self, payload)

    build_atlas(whole, TINY)
    monkeypatch.setattr(AtlasJob, "work", dying)
    with pytest.raises(Killed):
        build_atlas(place, TINY)
    with pytest.raises(StoreError, match="not finished"):
        open_atlas(place)
    with pytest.raises(StoreError, match="exists already"):
        build_atlas(place, TINY)
    with pytest.raises(StoreError, match="holds another run"):
        build_atlas(place, AtlasPlan(4, creases=3, orders_of=(), realised=False), resume=True)
    build_atlas(place, TINY, resume=True)
    assert list(open_atlas(place).query()) == list(open_atlas(whole).query())
    assert open_atlas(place).about() == open_atlas(whole).about()


def test_workers_build_the_same(small_atlas: Atlas, tmp_path: Path) -> None:
    build_atlas(tmp_path / "two.sqlite", AtlasPlan(6, realised=False), workers=2)
    assert list(open_atlas(tmp_path / "two.sqlite").query()) == list(small_atlas.query())


def test_what_is_no_atlas_is_refused(tmp_path: Path, small_atlas: Atlas) -> None:
    (tmp_path / "text.sqlite").write_text("no database, and longer than a header of SQLite would be " * 9)
    with pytest.raises(StoreError, match="cannot be read as a store: file is not a database"):
        open_atlas(tmp_path / "text.sqlite")
    newer = tmp_path / "newer.sqlite"
    shutil.copy(small_atlas.path, newer)
    with sqlite3.connect(newer) as connection:
        connection.execute("UPDATE atlas SET schema = 99")
    connection.close()
    with pytest.raises(StoreError, match=r"version 99.*expected version.*build it again"):
        open_atlas(newer)


@pytest.mark.parametrize(
    ("column", "value", "told"),
    [
        ("assortment", "[4,2", "assortment is '[4,2'; expected a list in JSON"),
        ("assortment", "4", "assortment is '4'; expected a list in JSON"),
        ("sides", '["a"]', "expected a list in JSON"),
        ("links", "six", "links is 'six'; expected a whole number"),
        ("planar", 2, "planar is 2; expected 0 or 1"),
        ("kind", "knot", "kind is 'knot'; expected one of chain, sc"),
        ("name", b"\xff", "expected a text"),
        ("fold_deg", "far", "expected a number"),
        ("fold_deg", float("inf"), "fold_deg is inf; expected a number"),
    ],
)
def test_damaged_values_are_told_with_their_place(
    small_atlas: Atlas, tmp_path: Path, column: str, value: Any, told: str
) -> None:
    place = tmp_path / "damaged.sqlite"
    shutil.copy(small_atlas.path, place)
    with sqlite3.connect(place) as connection:
        connection.execute(f"UPDATE type SET {column} = ?", (value,))
    connection.close()
    atlas = open_atlas(place)
    with pytest.raises(StoreError) as caught:
        atlas.query(columns=[column])
    assert str(caught.value).startswith(f"{place}: is damaged: {column} is ")
    assert told in str(caught.value)
    with pytest.raises(StoreError, match=r"damaged\.sqlite: is damaged"):
        atlas.show("k1:Cr")
    assert run("atlas", "query", place, code=2).stderr.count("\n") == 1


def test_a_damaged_file_of_a_type_is_told(small_atlas: Atlas, tmp_path: Path) -> None:
    place = tmp_path / "damaged.sqlite"
    shutil.copy(small_atlas.path, place)
    with sqlite3.connect(place) as connection:
        connection.execute("UPDATE type SET fold_file = '{'")
    connection.close()
    told = run("atlas", "show", place, "k1:Cr", "-o", tmp_path / "a.fold", code=2).stderr
    assert told.startswith("fold_file of k1:Cr: is not JSON: ")
    assert not (tmp_path / "a.fold").exists()


def test_what_a_statement_selects_is_written_whatever_it_is(small_atlas: Atlas, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    for statement in ("SELECT * FROM types", "SELECT 1 AS a UNION SELECT 'b' UNION SELECT x'00' UNION SELECT 0.5"):
        write_rows(small_atlas.sql(statement), tmp_path / "rows.parquet", force=True)
        write_rows(small_atlas.sql(statement), tmp_path / "rows.csv", force=True)
    with pytest.raises(InvariantError, match="kind 1, id 2; expected texts"):
        write_rows(small_atlas.sql("SELECT 1 AS kind, 2 AS id"), tmp_path / "rows.svg")
    with pytest.raises(InvariantError, match="'k1:Cr:0-0' is not an order of the joints of its chain"):
        write_rows(small_atlas.sql("SELECT 'order' AS kind, 'k1:Cr:0-0' AS id"), tmp_path / "rows.svg")


def test_rows_of_an_atlas_are_realised_and_drawn(tmp_path: Path) -> None:
    place = tmp_path / "few.sqlite"
    build_atlas(place, AtlasPlan(4, creases=2, orders_of=("four-bar",), realised=False))
    told = json.loads(run("realise", place, "-o", tmp_path / "things", "--workers", 1, "--json").stdout)
    rows = open_atlas(place).query().rows
    assert [one["name"] for one in told["types"]] == [row["id"] for row in rows]
    refused = [row["id"] for row, one in zip(rows, told["types"], strict=True) if one["outcome"] == "refused"]
    assert refused == [row["id"] for row in rows if row["kind"] == "order"]
    assert told["realised"] == len(rows) - len(refused)
    assert len(list((tmp_path / "things").iterdir())) == told["realised"]
    run("atlas", "query", place, "links = 4", "-o", tmp_path / "some.jsonl")
    run("draw", tmp_path / "some.jsonl", "-o", tmp_path / "some.svg")


def test_types_with_coordinates(real_atlas: Atlas, tmp_path: Path) -> None:
    rows = real_atlas.query("kind = 'scd'", columns=["id", "realised", "flat", "all_explicit", "fold_deg", "fold_file"])
    assert len(rows) == 7
    for number, row in enumerate(rows):
        assert row["realised"]
        assert row["flat"]
        assert 90 < row["fold_deg"] <= 180.000001
        place = tmp_path / f"{number}.fold"
        place.write_text(row["fold_file"])
        sheet = read_fold(place)
        assert map_id(synth.convert(sheet, "scd")) == row["id"]


def test_show_by_id_and_by_name(small_atlas: Atlas) -> None:
    watt = small_atlas.show("Watt chain")
    assert watt.values["id"] == "k1:E`hW"
    assert ("Watt chain", "Burmester 1888") in {(one.name, one.source) for one in watt.named}
    drawn = {row["id"] for row in small_atlas.query("chain_id = 'k1:E`hW'")}
    reduced = {row["id"] for row in small_atlas.query("reduced = 'k1:E`hW'")}
    shown_ids = [one.id for one in watt.neighbours]
    assert set(shown_ids) == drawn | reduced
    assert "more related types" in str(watt)
    assert small_atlas.show("UPS").values["id"] == "RR-R-RRR"
    four_bar = small_atlas.show("m1:ab.ac.bd.cd")
    assert ("has the planar analogue", "m1:ab.ac.bd.cd;i", False) in {
        (one.relation, one.id, one.there) for one in four_bar.neighbours
    }
    with pytest.raises(InvariantError, match="holds no type 'nothing'"):
        small_atlas.show("nothing")


def test_files_of_data_are_named(small_atlas: Atlas) -> None:
    index = [entry for entry in json.loads((DATA / "index.json").read_text()) if entry.get("N", 0) <= MOST_LINKS]
    known = {row["id"] for row in small_atlas.query(limit=10_000)}
    there = 0
    for entry in index:
        found = find_type(small_atlas, read(DATA / entry["file"]))
        if found.drawing is not None:
            assert entry["source"] in {one.source for one in found.named}, entry["file"]
        if found.drawing in known or found.chain in known:
            assert found.rows, entry["file"]
            there += 1
    assert there >= 19
    ups = find_type(small_atlas, read(DATA / "wiener/chain-UPS.json"))
    assert [row["id"] for row in ups.rows] == ["RR-R-RRR"]


def test_types_one_edit_away(small_atlas: Atlas) -> None:
    near = find_type(small_atlas, mechanism_of_id("m1:ab.ac.bd.cd")).near
    assert {one.row["id"] for one in near} == {"m1:ab.ac.bde.cef.dg.fg"}  # a ride-along makes Watt's chain
    assert all("ride" in one.edit for one in near)


def test_named_types_have_ids_of_their_mechanisms() -> None:
    for one in named_types():
        if one.kind != "chain":
            assert map_id(mechanism_of_id(one.id)) == one.id
        assert one.source
    by_name = {one.name: one for one in named_types()}
    assert by_name["Watt six-bar"].id == map_id(read(DATA / "wiener/watt.json"))
    assert by_name["fortune teller"].kind == "scd"


@pytest.mark.parametrize("name", ["q.csv", "q.json", "q.jsonl", "q.parquet", "q.svg", "mechanisms"])
def test_rows_are_written(small_atlas: Atlas, tmp_path: Path, name: str) -> None:
    if name.endswith("parquet"):
        pytest.importorskip("pyarrow")
    rows = small_atlas.query("links = 4 AND kind != 'order' OR kind = 'string'")
    assert write_rows(rows, tmp_path / name) == [tmp_path / name] or name == "q.svg"
    if name == "mechanisms":
        assert len(list((tmp_path / name).iterdir())) == len(rows)
        assert read(next(iter(sorted((tmp_path / name).iterdir())))) is not None
    if name == "q.csv":
        assert len((tmp_path / name).read_text().splitlines()) == len(rows) + 1
    if name == "q.jsonl":
        lines = [json.loads(line) for line in (tmp_path / name).read_text().splitlines()]
        assert lines == rows.to_json()


def test_plans_say_what_is_wrong() -> None:
    with pytest.raises(InvariantError, match="max links 2"):
        AtlasPlan(2)
    with pytest.raises(InvariantError, match="each once"):
        AtlasPlan(6, dofs=(1, 1))
    with pytest.raises(InvariantError, match="no chain is named"):
        AtlasPlan(6, orders_of=("wat",))


def test_rows_as_a_data_frame(small_atlas: Atlas) -> None:
    pytest.importorskip("pandas")
    frame = small_atlas.query("kind = 'chain'", columns=["id", "links"]).to_frame()
    assert list(frame.columns) == ["id", "links"]
    assert frame["links"].tolist() == [4, 6, 6]


def test_the_names_are_those_of_the_data() -> None:
    import atlas_names

    assert [asdict(one) for one in named_types()] == atlas_names.entries()
