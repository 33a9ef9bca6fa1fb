"""Ctrl-C at any moment of a command: one line and exit status 130, also in the midst of compiled code."""

import os
import random
import signal

import pytest
from commands import run as command_line
from pressed import ENUMERATIONS, pressed
from sizes import night, slow

from enumerate.runner.stopping import Interrupted, interruptible

LONGEST = 5.0

RESUMED = ("conical", "atlas")
"""Those that write a store, which stays."""


def lines_of(name):
    return {"stopped", "stopped; go on with --resume" if name in RESUMED else "stopped; nothing was written"}


def check(name, end, number=signal.SIGINT):
    assert end.status == 128 + number, end
    assert len(end.lines) == 1, end
    assert end.lines[0] in lines_of(name), end
    assert not end.left or name in RESUMED, end


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.slow)])
def test_one_line_in_compiled_code(number):
    check("chains", pressed("chains", 1, 1.3, number=number), number)


@pytest.mark.parametrize("moments", [slow(8), night(30)])
@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("name", ENUMERATIONS)
def test_one_line_at_any_moment(name, workers, moments, tmp_path):
    sheet = tmp_path / "sheet.fold"
    if name == "addenda":
        command_line("generate", "miura", "--rows", 10, "--columns", 10, "-o", sheet)
    dice = random.Random(f"{name} {workers}")
    for _ in range(moments):
        check(name, pressed(name, workers, dice.uniform(0, LONGEST), sheet))


def called(module, press, name="callback"):
    """Call a function of a module of that name, which presses."""
    names = {"__name__": module, "press": press}
    exec(f"def {name}():\n    press()\n    for _ in range(3): pass\n    return 'done'", names)
    return names[name]()


def press():
    os.kill(os.getpid(), signal.SIGINT)


def interrupted(work):
    """Run a function that looks at the flag, is pressed, and should not come to its end."""
    with pytest.raises(Interrupted):
        run(work)


def run(work):
    with interruptible() as look:
        work(look)
        pytest.fail("nothing was raised")


def test_nothing_is_raised_in_what_compiled_code_calls():
    def work(look):
        assert called("numba.core.serialize", press) == "done"
        look()

    interrupted(work)


def test_it_is_raised_while_something_is_compiled():
    def compiling():
        called("numba.core.typing", press)
        pytest.fail("it went on")

    interrupted(lambda look: called("numba.core.dispatcher", compiling, "_compile_for_args"))


def test_it_is_not_raised_below_a_call_of_llvm():
    def llvm():
        assert called("llvmlite.binding.ffi", lambda: called("numba.core.codegen", press)) == "done"

    def work(look):
        called("numba.core.dispatcher", llvm, "_compile_for_args")
        look()

    interrupted(work)


def test_what_a_finalizer_swallows_is_raised_again(capsys):
    class Finalized:
        def __del__(self):
            called("graphs.answer", press)

    def work(look):
        Finalized()
        for _ in range(10_000_000):
            called("graphs.answer", lambda: None)

    interrupted(work)
    assert capsys.readouterr().err == ""


def failing(error, pressing):
    with interruptible():
        if pressing:
            called("numba.core.serialize", press)
        raise error


def test_an_error_that_follows_a_signal_is_its_consequence():
    with pytest.raises(Interrupted):
        failing(SystemError("returned a result with an exception set"), pressing=True)
    with pytest.raises(SystemError):
        failing(SystemError("returned a result with an exception set"), pressing=False)


def test_what_could_not_be_raised_in_time_is_raised_at_the_end():
    with pytest.raises(Interrupted), interruptible():
        called("numba.core.serialize", press)


def test_one_inside_another_has_the_same_flag():
    def work(look):
        with interruptible() as inner:
            called("numba.core.serialize", press)
            with pytest.raises(Interrupted):
                inner()
        look()

    interrupted(work)
