import os
import random
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
from commands import run as command_line
from toy_job import Squares

from enumerate.chains.jobs import ChainJob
from enumerate.chains.kinematic import count_chains
from enumerate.chains.query import ChainQuery
from enumerate.runner.running import Interrupted, run
from enumerate.runner.sinks import CountSink, RowSink
from enumerate.runner.store import SqliteSink, read_meta, read_rows
from graphs.errors import StoreError

SYNTH = [sys.executable, "-m", "synth.cli"]


def complaints(errors):
    """Lines of standard error, but for the one that says that code is compiled."""
    return [line for line in errors.splitlines() if not line.startswith("synth: compiling")]


def rows_of(job, **options):
    found = []
    progress = run(job, RowSink(lambda columns, rows: found.extend(rows)), **options)
    assert progress.rows == len(found)
    assert progress.done == progress.units == len(job.units())
    return found


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_rows_come_in_order(workers):
    assert rows_of(Squares(), workers=workers) == [(n, n * n) for n in range(200)]


def test_progress_is_told():
    told = []
    run(
        Squares(), CountSink(), workers=2, report=lambda p: told.append((p.done, p.rows, p.weight, p.seconds_left))
    )
    assert [(done, rows, weight) for done, rows, weight, _ in told] == [
        (k, 10 * k, 1000 * k) for k in range(1, 21)
    ]
    assert told[-1][3] == 0 <= told[5][3]


def test_a_worker_that_dies_is_replaced(tmp_path):
    job = Squares(deadly=7, note=str(tmp_path / "died"))
    assert rows_of(job, workers=2) == rows_of(Squares())
    assert (tmp_path / "died").exists()


def test_a_unit_that_always_kills_its_worker_stops_the_run(tmp_path):
    store = tmp_path / "squares.sqlite"
    with pytest.raises(StoreError, match="died 3 times at unit 7"):
        run(Squares(deadly=7), SqliteSink(store), workers=2)
    assert list(read_rows(store)) == [(n, n * n) for n in range(70)]
    assert read_meta(store)["complete"] is False
    run(Squares(), SqliteSink(store, resume=True))
    assert list(read_rows(store)) == rows_of(Squares())
    assert read_meta(store)["complete"] is True


def test_ctrl_c_stops_between_units_and_leaves_the_store_whole(tmp_path):
    store = tmp_path / "squares.sqlite"
    before = signal.getsignal(signal.SIGINT)  # ignored, where the tests run in the background of a shell

    def press(progress):
        if progress.done == 5:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted):
        run(Squares(), SqliteSink(store), report=press)
    assert list(read_rows(store)) == [(n, n * n) for n in range(50)]
    run(Squares(), SqliteSink(store, resume=True), workers=2)
    assert list(read_rows(store)) == rows_of(Squares())
    assert signal.getsignal(signal.SIGINT) is before


def chains_command(links, dof, *words):
    """The command line that lists chains, in a process of its own."""
    return [*SYNTH, "enumerate", "chains", "--links", str(links), "--dof", str(dof), *map(str, words)]


@pytest.mark.parametrize(
    ("name", "words", "links", "dof"),
    [
        ("chains.sqlite", "go on with --resume", 15, 4),
        pytest.param("chains.sqlite", "go on with --resume", 16, 1, marks=pytest.mark.slow),
        pytest.param("chains.g6", "nothing was written", 16, 1, marks=pytest.mark.slow),
    ],
)
def test_ctrl_c_at_the_command_line(tmp_path, links, dof, name, words):
    command = chains_command(links, dof, "--workers", 2, "-o", tmp_path / name)
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 120
    while sum(path.stat().st_size for path in tmp_path.iterdir()) < 100_000:  # some units have been written
        assert time.monotonic() < deadline
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert complaints(errors) == [f"stopped; {words}"]
    left = {path.name for path in tmp_path.iterdir()}
    assert left == ({name} if name.endswith(".sqlite") else set())
    if left:
        assert read_meta(tmp_path / name)["complete"] is False
        assert next(read_rows(tmp_path / name))[1] == links


def test_a_complete_store_can_be_resumed_and_has_nothing_to_do(tmp_path):
    store = tmp_path / "squares.sqlite"
    run(Squares(), SqliteSink(store))
    assert run(Squares(), SqliteSink(store, resume=True)).rows == 0
    assert len(list(read_rows(store))) == 200


def test_stores_that_are_refused(tmp_path):
    store = tmp_path / "squares.sqlite"
    run(Squares(), SqliteSink(store))
    before = store.read_bytes()
    with pytest.raises(StoreError, match="exists already"):
        run(Squares(), SqliteSink(store))
    with pytest.raises(StoreError, match=r"holds another run \(squares=200\)"):
        run(Squares(100), SqliteSink(store, resume=True))
    assert store.read_bytes() == before
    text = tmp_path / "text.sqlite"
    text.write_text("no database at all, only words" * 100)
    with pytest.raises(StoreError, match="not a database"):
        run(Squares(), SqliteSink(text, resume=True))
    other = tmp_path / "other.sqlite"
    with sqlite3.connect(other) as connection:
        connection.execute("CREATE TABLE meta (key TEXT, value TEXT)")
    connection.close()
    with pytest.raises(StoreError, match="is not a store of version 3"):
        run(Squares(), SqliteSink(other, resume=True))
    with pytest.raises(StoreError, match="there is no folder"):
        run(Squares(), SqliteSink(tmp_path / "no" / "store.sqlite"))
    with pytest.raises(StoreError, match="unable to open"):
        run(Squares(), SqliteSink("/proc/store.sqlite"))
    with pytest.raises(StoreError, match="no such file"):
        list(read_rows(tmp_path / "no.sqlite"))


def test_two_runs_on_one_store(tmp_path):
    store = tmp_path / "squares.sqlite"
    one = SqliteSink(store)
    one.start(Squares())
    other = SqliteSink(store, resume=True)
    assert len(other.start(Squares())) == 0
    one.take(0, [(0, 0)], 0.0)
    with pytest.raises(StoreError, match="another run is writing"):
        other.take(0, [(0, 0)], 0.0)
    one.abort()
    other.abort()
    assert list(read_rows(store)) == [(0, 0)]


@contextmanager
def small_disk(path, size):
    made = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", path], capture_output=True, check=False
    )
    if made.returncode:
        pytest.skip("a small disk cannot be mounted here")
    try:
        yield
    finally:
        subprocess.run(["umount", path], check=True)


@pytest.mark.parametrize("name", ["chains.sqlite", "chains.jsonl", "chains.parquet", "chains.g6", "chains"])
def test_a_full_disk_gives_one_line_and_loses_nothing(tmp_path, name):
    disk = tmp_path / "disk"
    disk.mkdir()
    with small_disk(disk, "200k"):
        command = chains_command(12, 1, "-o", disk / name)
        if name in ("chains.g6", "chains.parquet"):
            (disk / "ballast").write_bytes(bytes(180_000))
        if name == "chains.sqlite":  # a process of its own: an open store keeps the small disk busy
            first = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
            assert first.returncode == 2
        else:
            first = command_line(*command[len(SYNTH) :], code=2)
        assert len(complaints(first.stderr)) == 1
        assert name in first.stderr
        if name == "chains.sqlite":
            assert "make room and --resume" in first.stderr
            subprocess.run(["mount", "-o", "remount,size=20m", disk], check=True)
            subprocess.run([*command, "--resume"], check=True, timeout=120)
            assert [row[0] for row in read_rows(disk / name)] == ids(12)
        else:
            assert {p.name for p in disk.iterdir()} <= {"ballast"}


def ids(links):
    job = ChainJob(ChainQuery(links, 1), bare=True)
    return [code for unit in job.units() for (code,) in job.work(unit.payload)]


def killed_and_resumed(store, links, dof, kills, longest):
    """Kill a run, or one of its workers, at random moments after it stored something; go on until it ends by itself.

    Return how often.
    """
    command = chains_command(links, dof, "--workers", 2, "-o", store)
    random.seed(links)
    done = 0
    while True:
        before = units_in(store)
        process = subprocess.Popen([*command, *(["--resume"] if store.exists() else [])])
        if done < kills:
            wait_for(lambda held=before, run=process: units_in(store) > held or run.poll() is not None)
            time.sleep(random.uniform(0, longest))
            workers = children(process.pid)
            if done % 2 and workers:  # a worker now, the run itself a little later
                os.kill(random.choice(workers), signal.SIGKILL)
                time.sleep(random.uniform(0.1, longest))
            process.kill()
        code = process.wait(timeout=1800)
        if code == 0:
            return done
        assert code == -signal.SIGKILL
        done += 1
        wait_for(lambda left=workers: all(not Path(f"/proc/{pid}").exists() or is_zombie(pid) for pid in left))


def wait_for(true, seconds=600):
    """Wait until something is so; a store of millions of rows is looked through for minutes before it grows."""
    deadline = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def children(pid):
    """Process ids of the worker processes of a run."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = status.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(status.parent.name))
    return found


def is_zombie(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def contents(store):
    with sqlite3.connect(store) as connection:
        units = connection.execute("SELECT id, state, rows FROM unit ORDER BY id").fetchall()
        rows = connection.execute("SELECT rowid, * FROM type ORDER BY rowid").fetchall()
    connection.close()
    return units, rows


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The store of a run that nobody stopped."""
    store = tmp_path_factory.mktemp("whole") / "whole.sqlite"
    run(ChainJob(ChainQuery(13, 2)), SqliteSink(store), workers=2)
    return contents(store)


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for worker processes in /proc")
def test_killed_runs_lose_nothing(tmp_path, whole):
    store = tmp_path / "chains.sqlite"
    assert killed_and_resumed(store, 13, 2, kills=2, longest=0.3) >= 1
    assert contents(store) == whole
    assert len({row[2] for row in whole[1]}) == count_chains(13, 2, "burnside") == 27_496


@pytest.mark.slow
def test_killed_runs_lose_nothing_at_sixteen_links(tmp_path):
    whole = tmp_path / "whole.sqlite"
    run(ChainJob(ChainQuery(16, 1)), SqliteSink(whole), workers=2)
    store = tmp_path / "chains.sqlite"
    assert killed_and_resumed(store, 16, 1, kills=10, longest=30.0) == 10
    with sqlite3.connect(store) as connection:
        connection.execute("ATTACH ? AS whole", (str(whole),))
        for table in ("type", "unit"):
            columns = "rowid, *" if table == "type" else "id, state, rows"
            one, other = f"SELECT {columns} FROM main.{table}", f"SELECT {columns} FROM whole.{table}"
            assert connection.execute(f"SELECT count(*) FROM ({one} EXCEPT {other})").fetchone() == (0,)
            assert connection.execute(f"SELECT count(*) FROM ({other} EXCEPT {one})").fetchone() == (0,)
        assert connection.execute("SELECT count(*), count(DISTINCT code) FROM type").fetchone() == (19819281,) * 2
    connection.close()


def test_a_cluster_that_loses_a_worker_gives_the_same_rows(tmp_path, whole):
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    port = free_port()
    address = f"tcp://127.0.0.1:{port}"

    def start(*words):
        command = [sys.executable, "-m", "distributed.cli." + words[0], *words[1:]]
        with (tmp_path / f"{len(processes)}.log").open("w") as log:
            processes.append(subprocess.Popen(command, stdout=log, stderr=log))

    processes = []
    try:
        start("dask_scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard")
        for _ in range(2):
            start("dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard")
        store = tmp_path / "chains.sqlite"
        running = subprocess.Popen(chains_command(13, 2, "--scheduler", address, "-o", store))
        processes.append(running)
        wait_for(lambda: units_in(store) or running.poll() is not None)
        assert running.poll() is None
        processes[1].kill()
        assert running.wait(timeout=120) == 0
        assert contents(store) == whole
    finally:
        for process in reversed(processes):
            process.kill()
            process.wait()


def free_port():
    """A port that nobody listens at, so that runs of the tests beside this one have their own."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return str(free.getsockname()[1])


def units_in(store):
    if not store.exists():
        return 0
    try:
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as connection:
            return connection.execute("SELECT count(*) FROM unit").fetchone()[0]
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()


def test_no_scheduler_there():
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    result = command_line("enumerate", "chains", "--links", 8, "--dof", 1, "--scheduler", "nonsense", code=2)
    assert "no Dask scheduler at 'nonsense'" in result.stderr
    assert len(complaints(result.stderr)) == 1
