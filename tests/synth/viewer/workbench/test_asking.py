"""Modules run on files: what they print comes whole, however slowly they print it, and they end with who asked."""

import asyncio
import json

import pytest

from synth.viewer.workbench.asking import Engine, beating


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


@pytest.mark.slow
def test_the_last_line_is_the_answer(data):
    place = data / "patterns" / "four-bar-vertex.fold"
    lines = asyncio.run(gathered(Engine().lines("reading", [place.name], place.read_bytes()))).splitlines()
    told = [json.loads(line) for line in lines if line]
    assert [one["step"] for one in told[:-1]] == [0, 1, 2, 3]
    assert told[-1]["shown"]["verdict"] == "Folds with 1 freedom from its pose."


@pytest.mark.slow
def test_what_ends_badly_is_told():
    lines = asyncio.run(gathered(Engine().lines("nowhere", ["a.fold"], b""))).splitlines()
    assert [json.loads(line) for line in lines if line] == [
        {"error": "a.fold: it could not be read: the engine failed"}
    ]
    assert asyncio.run(Engine().whole("nowhere", ["a.fold"], b""))[0] == 1
