"""`synth advise`."""

import json

import pytest

from tests.support.commands import run


@pytest.fixture
def miura(tmp_path):
    place = tmp_path / "miura.fold"
    run("generate", "miura", "--rows", 3, "--columns", 3, "--fold", 60, "-o", place)
    return place


def test_diagonals_are_told(miura):
    told = run("advise", miura, "--freedoms", 2).output
    assert "1 degree of freedom at this configuration; required: 2" in told
    assert "crease 1 diagonal: 4 sets, all there are" in told


def test_none_found_is_no(miura):
    assert "all were checked" in run("advise", miura, "--freedoms", 2, "--no-flaps", "--size", 1, code=1).output


def test_locks_as_json(miura):
    every = json.loads(run("advise", miura, "--freedoms", 0, "--json").output)
    joints = [lock["joints"][0] for lock in every["locks"]]
    assert (every["freedoms"], every["wanted"], every["more"], len(joints)) == (1, 0, False, 12)
    words = ("--weight", f"{joints[5]}=0.5", "--protect-joint", joints[3], "--protect-link", 4, "--limit", 3)
    few = json.loads(run("advise", miura, "--freedoms", 0, *words, "--json").output)
    assert few["more"]
    assert few["locks"][0]["joints"] == [joints[5]]
    assert [lock["weight"] for lock in few["locks"]] == [0.5, 1.0, 1.0]
    assert joints[3] not in [lock["joints"][0] for lock in few["locks"]]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--weight", "2"), "is not JOINT=W"),
        (("--protect-joint", "99"), "'99' is no joint"),
        (("--weight", "2=nan"), "nan"),
    ],
)
def test_bad_words_are_one_line(miura, words, told):
    assert told in run("advise", miura, "--freedoms", 0, *words, code=2).output
