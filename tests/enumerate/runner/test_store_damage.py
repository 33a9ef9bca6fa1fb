"""Stores that were damaged: what is lost is told and made again, what was altered is not believed."""

import math
import random
import sqlite3

import numpy as np
import pytest
from commands import run as command_line
from sizes import slow
from toy_job import Squares

from enumerate.chains.jobs import ChainJob
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.store import SqliteSink, read_meta, read_rows
from enumerate.runner.store_units import UnitTable, make_tables
from graphs.errors import StoreError

JOB = Squares(1000)  # some ten pages
ROWS = [(n, n * n) for n in range(1000)]


@pytest.fixture(scope="module")
def stores(tmp_path_factory):
    """The bytes of a complete store, and of one that was left after 60 of its 100 units."""
    folder = tmp_path_factory.mktemp("stores")
    run(JOB, SqliteSink(folder / "complete.sqlite"))

    def stop(progress):
        if progress.done == 60:
            raise StoreError("enough")

    with pytest.raises(StoreError, match="enough"):
        run(JOB, SqliteSink(folder / "left.sqlite"), report=stop)
    return [(folder / name).read_bytes() for name in ("complete.sqlite", "left.sqlite")]


def contents(store):
    with sqlite3.connect(store) as connection:
        units = connection.execute("SELECT id, state, rows FROM unit ORDER BY id").fetchall()
        rows = connection.execute("SELECT rowid, * FROM type ORDER BY rowid").fetchall()
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    connection.close()
    return units, rows


WHOLE = ([(unit, "done", 10) for unit in range(100)], [(n + 1, n // 10, n, n * n) for n in range(1000)])


def altered(store, *statements):
    with sqlite3.connect(store) as connection:
        for statement in statements:
            connection.execute(statement)
    connection.close()


def mended(store):
    """Resume; return the lines that were told, and how many units were made."""
    told, made = [], []
    before = run(JOB, SqliteSink(store, resume=True, tell=told.append), report=lambda p: made.append(p.rows))
    assert before.done == 100
    assert contents(store) == WHOLE
    assert read_meta(store)["complete"] is True
    return told, len(made)


@pytest.mark.parametrize(
    ("statement", "lost"),
    [
        ("UPDATE type SET square = square + 1 WHERE rowid = 355", 1),
        ("UPDATE type SET square = '1225' WHERE n = 35", 1),
        ("UPDATE type SET unit = 4 WHERE n = 35", 1),
        ("DELETE FROM type WHERE n IN (35, 48, 49)", 2),
        ("DELETE FROM type WHERE n >= 970", 3),
        ("DELETE FROM unit WHERE id IN (0, 7)", 2),
        ("UPDATE unit SET rows = 11 WHERE id = 7", 1),
        ("UPDATE unit SET rows = 'ten', first = NULL WHERE id = 7", 1),
        ("UPDATE unit SET id = 700 WHERE id = 7", 1),
        ("UPDATE unit SET digest = NULL", 100),
        ("UPDATE unit SET state = CAST(x'ff41' AS TEXT) WHERE id = 7", 1),
        ("UPDATE type SET square = CAST(x'c3' AS TEXT) WHERE n = 35", 1),
        ("INSERT INTO type VALUES (4, 40, 1600)", 0),
        ("INSERT INTO unit SELECT 100, state, first, rows, seconds, digest FROM unit WHERE id = 0", 0),
    ],
)
def test_only_what_was_altered_is_made_again(tmp_path, stores, statement, lost):
    store = tmp_path / "squares.sqlite"
    store.write_bytes(stores[0])
    altered(store, statement)
    told, made = mended(store)
    assert told == [f"{store}: repaired a damaged store; kept {100 - lost} of 100 units"]
    assert made == lost
    assert mended(store) == ([], 0)
    assert [path.name for path in tmp_path.iterdir()] == ["squares.sqlite"]


def test_altered_rows_are_not_read(tmp_path, stores):
    store = tmp_path / "squares.sqlite"
    store.write_bytes(stores[0])
    altered(store, "UPDATE type SET square = 0 WHERE n = 355")
    rows = read_rows(store)
    assert [next(rows) for _ in range(350)] == ROWS[:350]
    with pytest.raises(StoreError, match="damaged at unit 35; try the same command with --resume"):
        next(rows)


@pytest.mark.parametrize(
    ("statement", "words"),
    [
        ("UPDATE meta SET value = '{\"squares\": 900}' WHERE key = 'job'", "its table meta was altered"),
        ("UPDATE meta SET value = '{' WHERE key = 'job'", "its table meta was altered"),
        ("UPDATE meta SET key = x'0102' WHERE key = 'columns'", "its table meta was altered"),
        ("UPDATE meta SET value = '2' WHERE key = 'version'", "not a store that can be read here; .* version '2'"),
        ("UPDATE meta SET value = 1 WHERE key = 'complete'", "its table meta was altered"),
        ("DROP TABLE meta", "no such table: meta"),
    ],
)
def test_a_store_whose_head_is_damaged_is_refused(tmp_path, stores, statement, words):
    store = tmp_path / "squares.sqlite"
    store.write_bytes(stores[0])
    altered(store, statement)
    before = store.read_bytes()
    with pytest.raises(StoreError, match=words):
        run(JOB, SqliteSink(store, resume=True))
    with pytest.raises(StoreError, match=words):
        list(read_rows(store))
    assert store.read_bytes() == before


def damaged(data, chance):
    """Return bytes with a few of them altered, a stretch of zeros, or an end that is missing."""
    data = bytearray(data)
    kind = chance.randrange(4)
    if kind == 0:
        return bytes(data[: chance.randrange(len(data))])
    if kind == 1:
        start = chance.randrange(len(data))
        zeros = min(chance.choice([16, 512, 4096]), len(data) - start)
        data[start : start + zeros] = bytes(zeros)
        return bytes(data)
    for _ in range(chance.choice([1, 1, 8, 64])):
        data[chance.randrange(len(data) if kind == 2 else 4096 * 3)] ^= 1 << chance.randrange(8)
    return bytes(data)


@pytest.mark.parametrize("cases", [20, slow(400)])
def test_damage_anywhere_is_mended_or_told_in_one_line(tmp_path, stores, cases):
    chance = random.Random(18)
    good = 0
    for case in range(cases):
        store = tmp_path / f"{case}.sqlite"
        store.write_bytes(damaged(stores[case % 2], chance))
        try:
            mended(store)
        except StoreError as error:
            assert str(error).startswith(f"{store}: ")
            assert "\n" not in str(error)
        else:
            assert list(read_rows(store)) == ROWS
            good += 1
        for path in tmp_path.iterdir():
            path.unlink()
    assert good > cases / 2


def test_a_damaged_store_at_the_command_line(tmp_path):
    store = tmp_path / "chains.sqlite"
    command = ("enumerate", "chains", "--links", 8, "--dof", 1, "-o", store)
    job = ChainJob(ChainQuery(8, 1))
    run(job, SqliteSink(store))
    rows = list(read_rows(store))
    altered(store, "UPDATE type SET links = 11 WHERE rowid = 5")
    assert "exists already" in command_line(*command, code=2).stderr
    units = len(job.units())
    line = f"{store}: repaired a damaged store; kept {units - 1} of {units} units\n"
    assert command_line(*command, "--resume").stderr == line
    assert list(read_rows(store)) == rows
    store.chmod(0)
    store.unlink()
    store.mkdir()
    assert len(command_line(*command, "--resume", code=2).stderr.splitlines()) == 1


class Odd(Squares):
    """Values that a store does not give back as they were: truth values, numpy's numbers, what is no number."""

    columns = {"yes": bool, "number": float, "text": str}  # noqa: RUF012

    def work(self, start):
        values = [np.float64(0.1), math.nan, math.inf, -0.0, 2.0, 1e300]
        return [(n % 2 == 0, value, f"{start} \u202e\0\n") for n, value in zip(range(6), values, strict=True)]


def test_values_that_change_their_type_are_not_taken_for_damage(tmp_path):
    store = tmp_path / "odd.sqlite"
    run(Odd(), SqliteSink(store))
    assert run(Odd(), SqliteSink(store, resume=True)).rows == 0
    expected = [(1, 0.1), (0, None), (1, math.inf), (0, -0.0), (1, 2.0), (0, 1e300)]
    assert str([row[:2] for row in read_rows(store)]) == str(expected * 20)


def test_digests_are_those_of_every_version_of_python():
    rows = [(1, True, 0.1, None, "ß\0"), (-(2**62), False, math.inf, 2.0, "")]
    with sqlite3.connect(":memory:") as connection:
        columns = list("abcde")
        make_tables(connection, {"columns": columns})
        table = UnitTable(connection, columns)
        table.add(3, 1, rows, 0.25)
        assert table.entry(3).digest == "1b962a360dd55544c8e7a6a770e84763"
        assert table.rows(3) == rows
    connection.close()


def test_what_a_repair_that_was_killed_left_is_removed(tmp_path, stores):
    store = tmp_path / "squares.sqlite"
    store.write_bytes(stores[1])
    left = tmp_path / ".squares.sqlite.01234567.unfinished"
    left.mkdir()
    for name in ("squares.sqlite", "squares.sqlite-wal"):
        (left / name).touch()
    assert mended(store) == ([], 40)
    assert list(tmp_path.iterdir()) == [store]


def test_how_much_has_been_looked_through_is_told(tmp_path, stores):
    store, parts = tmp_path / "squares.sqlite", []
    store.write_bytes(stores[1])
    altered(store, "UPDATE type SET square = square + 1 WHERE rowid = 355")
    with pytest.warns(UserWarning, match="repaired a damaged store; kept 59 of 100 units"):
        SqliteSink(store, resume=True, looking=parts.append).start(JOB)
    assert parts == [k / 60 for k in range(1, 60)]


def test_a_run_that_was_killed_while_it_wrote_without_a_log_goes_on(tmp_path, stores):
    """Such a run leaves a journal, which a connection that only reads may not play back."""
    alive, store = tmp_path / "alive.sqlite", tmp_path / "squares.sqlite"
    alive.write_bytes(stores[1])
    connection = sqlite3.connect(alive, isolation_level=None)
    connection.execute("PRAGMA journal_mode=DELETE")
    connection.execute("PRAGMA cache_size=1")  # pages go to the file before the end
    connection.execute("BEGIN")
    connection.execute("UPDATE type SET square = square + 1")
    for end in ("", "-journal"):
        store.with_name(store.name + end).write_bytes(alive.with_name(alive.name + end).read_bytes())
    connection.close()
    assert store.read_bytes() != stores[1]
    assert not read_meta(store)["complete"]
    assert mended(store) == ([], 40)


def test_a_store_of_another_version_is_named_with_the_column_that_it_lacks(tmp_path):
    """As conical stores of before the half angle stood beside lambda: nothing is written to it."""
    store = tmp_path / "old.sqlite"
    run(JOB, SqliteSink(store))
    rest = dict(JOB.columns)
    lacking = rest.popitem()[0]

    class Newer(Squares):
        columns = {**JOB.columns, "half_angle_deg": float}  # noqa: RUF012

    before = store.read_bytes()
    with pytest.raises(StoreError) as refused:
        run(Newer(1000), SqliteSink(store, resume=True))
    assert str(refused.value) == (
        f"{store}: another version wrote it, without half_angle_deg; expected the columns of this version: "
        "try another file name, or --force to begin again"
    )

    class Older(Squares):
        columns = rest

    with pytest.raises(StoreError, match=f"another version wrote it, with {lacking};"):
        run(Older(1000), SqliteSink(store, resume=True))
    assert store.read_bytes() == before
