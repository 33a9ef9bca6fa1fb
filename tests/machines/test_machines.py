"""How answers of two machines are compared, and, in full, that they are the same under each factor."""

import subprocess
import sys

import pytest

from tests.machines.commands import COMMANDS, QUICK
from tests.machines.comparison import Answer, differences, same_line
from tests.machines.factors import FACTORS, ROOT, Factor, reason_to_leave_out


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("joint 3 at 42.6102 degrees", "joint 3 at 42.6103 degrees"),
        ("at 55.272", "at 55.2721"),
        ("loop-closure residual 2.7e-15", "loop-closure residual 8e-17"),
        ("gap 6e14", "gap 2e15"),
        ('"x": 0.12345678901234', '"x": 0.12345678909999'),
        ("0.0, 1", "-0.0, 1"),
    ],
)
def test_numbers_may_differ_in_the_last_digit(one, other):
    assert same_line(one, other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("joint 3 at 42.6102", "joint 3 at 42.6104"),
        ("joint 3 at 42.6", "joint 4 at 42.6"),
        ("signs --+-", "signs -0-0"),
        ("13 frames", "14 frames"),
        ("at 60 degrees", "at -60 degrees"),
        ("a 1.5", "a 1.5 2.5"),
        ("gap 5e4", "gap 5e12"),
    ],
)
def test_words_and_counts_may_not(one, other):
    assert not same_line(one, other)


def test_a_command_that_answers_otherwise_is_named_with_its_lines():
    one = [Answer("mobility a", 0, ("rigid",)), Answer("fold a", 1, ("no", "2 frames"))]
    other = [Answer("mobility a", 0, ("rigid",)), Answer("fold a", 0, ("no", "3 frames", "more"))]
    (difference,) = differences(one, other)
    assert difference.command == "fold a"
    assert difference.lines == (("exit status 1", "exit status 0"), ("2 frames", "3 frames"), ("", "more"))


def test_a_kernel_that_does_not_run_is_left_out():
    unknown = Factor("nobody's", {"OPENBLAS_CORETYPE": "nobody's"}, "kernel nobody's")
    assert reason_to_leave_out(unknown).startswith("expected nobody's, the libraries report ")
    assert reason_to_leave_out(FACTORS["no-avx2"]) is None


def test_the_commands_are_many_and_none_is_listed_twice():
    assert len(QUICK) > 100
    assert len(COMMANDS) > 300
    assert len(set(COMMANDS)) == len(COMMANDS)


@pytest.mark.slow
def test_all_answers_are_the_same_under_every_factor():
    """Factors that this processor lacks are left out, and named."""
    words = [sys.executable, "-m", "tests.machines", "--commands", "all", "--no-tests"]
    child = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert child.returncode == 0, child.stdout + child.stderr
