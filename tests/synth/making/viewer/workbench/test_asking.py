"""Modules run on files: what they print comes whole, however slowly they print it, and they end with who asked."""

import asyncio
import json

import pytest

from synth.making.viewer.workbench.asking import Engine, beating, file_name


async def pieces_of(*pieces):
    for piece in pieces:
        yield piece


async def gathered(pieces):
    return b"".join([piece async for piece in pieces])


def test_blank_lines_are_between_lines_only():
    """What is silent in the middle of a line, as a large answer on a busy machine, gets none there."""
    slow = pieces_of(b"", b"", b'{"a": "b', b"", b'c"}\n', b"", b'{"d', b"", b'": 1}\n')
    lines = asyncio.run(gathered(beating(slow))).split(b"\n")
    assert [json.loads(line) for line in lines if line] == [{"a": "bc"}, {"d": 1}]
    assert lines[:2] == [b"", b""]


@pytest.mark.parametrize("name", ["折り紙" * 60 + ".fold", "x" * 300 + ".fold", "é" * 90 + ".fold"])
def test_a_long_name_is_cut_by_bytes_and_keeps_its_extension(name, tmp_path):
    safe = file_name(name)
    assert safe.endswith(".fold")
    assert 100 < len(safe.encode()) <= 120
    (tmp_path / safe).touch()


def test_two_run_side_by_side_and_a_third_says_that_it_waits(monkeypatch):
    """Without processes: what they would print is held back until the third has spoken."""
    running, release = [], asyncio.Event()

    async def begun(module, words):
        running.append(words[0])

    async def taken(process):
        await release.wait()
        yield b'{"shown": {}}\n'
        raise TimeoutError

    async def nothing(*_):
        pass

    async def three():
        engine = Engine()
        first, second, third = (engine.lines("show", [name], b"") for name in "abc")
        tasks = [asyncio.create_task(gathered(lines)) for lines in (first, second)]
        await asyncio.sleep(0)
        assert running == ["a", "b"]
        told = json.loads(await anext(third))
        assert (told["doing"], running) == ("waiting until others are done", ["a", "b"])
        release.set()
        rest = await gathered(third)
        return [await task for task in tasks], rest

    monkeypatch.setattr("synth.making.viewer.workbench.asking._begun", begun)
    monkeypatch.setattr("synth.making.viewer.workbench.asking._taken", taken)
    monkeypatch.setattr("synth.making.viewer.workbench.asking._fed", nothing)
    monkeypatch.setattr("synth.making.viewer.workbench.asking._ended", nothing)
    both, rest = asyncio.run(three())
    assert all(lines.startswith(b'{"shown": {}}') for lines in (*both, rest))
    assert running == ["a", "b", "c"]


@pytest.mark.slow
def test_the_last_line_is_the_answer(data):
    place = data / "patterns" / "four-bar-vertex.fold"
    lines = asyncio.run(gathered(Engine().lines("show", [place.name], place.read_bytes()))).splitlines()
    told = [json.loads(line) for line in lines if line]
    assert [one["step"] for one in told[:-1]] == [0, 1, 2, 3]
    assert told[-1]["shown"]["verdict"] == "Rigid-foldable from this configuration: 1 degree of freedom."


@pytest.mark.slow
def test_what_ends_badly_is_told():
    lines = asyncio.run(gathered(Engine().lines("nowhere", ["a.fold"], b""))).splitlines()
    assert [json.loads(line) for line in lines if line] == [
        {"error": "a.fold: the file could not be read: the engine failed"}
    ]
    assert asyncio.run(Engine().whole("nowhere", ["a.fold"], b""))[0] == 1
