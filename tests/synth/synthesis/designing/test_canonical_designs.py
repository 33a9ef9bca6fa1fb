"""Designs are those of the wishes and the start: under kernels of OpenBLAS that round differently they are the same."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from sizes import slow

from synth.catalogue.patterns import generate
from synth.synthesis.designing import Goal, JointAngle, LinkArc, WishedConfiguration, Wishes
from synth.synthesis.designing.designs import DesignSearch
from synth.synthesis.designing.search import found_from, seeded
from tests.machines.factors import FACTORS, environment_for, reason_to_leave_out

ROOT = Path(__file__).resolve().parents[4]
KERNELS = ["SkylakeX", "Haswell", "Nehalem", "Prescott"]
SCRIPT = """
import json, sys
from pathlib import Path
from synth.synthesis.designing import design
mechanism, wishes, starts = sys.argv[1:]
found = design(mechanism, Path(wishes), starts=int(starts))
every = sorted((*found.pareto, *found.others, *found.failures), key=lambda one: one.start)
print(json.dumps([[one.numbers.tolist(), one.settled, one.faults] for one in every]))
"""


def wishes_of_the_guide(title):
    """The wishes below a heading of the guide."""
    text = (ROOT / "docs" / "guides" / "design-dimensions.md").read_text(encoding="utf-8")
    section = text.split(f"## {title}")[1]
    return next(block for block in re.findall(r"```json\n(.*?)```", section, re.S) if '"synthedra/wishes"' in block)


def by_kernels(kernels, *words):
    """Designs by each kernel that the processor has."""
    answers = {}
    for name in kernels:
        if reason_to_leave_out(FACTORS[name]):
            continue
        child = subprocess.run(
            [sys.executable, "-c", SCRIPT, *map(str, words)],
            env=environment_for(FACTORS[name]),
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=True,
        )
        answers[name] = json.loads(child.stdout)
    return answers


def assert_alike(answers, within):
    first = next(iter(answers.values()))
    for name, answer in answers.items():
        for (numbers, *words), (others, *other_words) in zip(first, answer, strict=True):
            np.testing.assert_allclose(others, numbers, rtol=0, atol=within, err_msg=name)
            assert words == other_words, name


@pytest.mark.parametrize("kernels", [["Haswell", "Nehalem"], slow(KERNELS)], ids=["two", "four"])
def test_the_lid_of_the_guide_is_the_same_under_kernels(kernels, tmp_path):
    import synth

    synth.write(generate("four-bar").mechanism, tmp_path / "box.json")
    (tmp_path / "lid.json").write_text(wishes_of_the_guide("A box lid"))
    answers = by_kernels(kernels, tmp_path / "box.json", tmp_path / "lid.json", 2)
    assert all(settled for answer in answers.values() for _, settled, _ in answer)
    assert_alike(answers, 1e-9)


@pytest.mark.parametrize("kernels", [slow(KERNELS)], ids=["four"])
def test_the_saddle_of_the_guide_is_the_same_under_kernels(kernels, tmp_path):
    (tmp_path / "saddle.json").write_text(wishes_of_the_guide("A Miura-like sheet"))
    assert_alike(by_kernels(kernels, "miura", tmp_path / "saddle.json", 1), 1e-7)


def test_what_wishes_leave_free_stays_as_it_was():
    """One arc is wished: the axes of its joints turn alike in their plane, the other axes stay."""
    search = DesignSearch(generate("four-bar").mechanism, Wishes((LinkArc(joints=("0", "1"), goal=Goal(equals=1.0)),)))
    numbers = search.family.start
    found = found_from(search.problem, numbers, seeded("free", 0))
    before, after = (one.reshape(4, 3) for one in (numbers, found.numbers))
    np.testing.assert_allclose(after[2:], before[2:], atol=1e-9)
    turns = [
        np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1))
        for a, b in zip(before, after, strict=True)
    ]
    assert turns[0] == pytest.approx(turns[1], abs=1e-9)
    assert turns[0] > 0.01
    assert found.settled


def test_a_start_that_meets_its_wishes_stays():
    wish = JointAngle(at="open", joint="3", goal=Goal(equals=-0.9))
    wishes = Wishes((wish,), (WishedConfiguration("open", {"0": 0.7}),))
    search = DesignSearch(generate("four-bar").mechanism, wishes)
    first = search.design(0)
    again = found_from(search.problem, first.numbers, seeded("again", 0))
    np.testing.assert_allclose(again.numbers, first.numbers, atol=1e-9)
