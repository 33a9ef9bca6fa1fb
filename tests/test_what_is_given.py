"""The functions of ``synth`` given a name, a number or nothing where they take a mechanism."""

from pathlib import Path

import pytest

import synth

VERBS = {
    "mobility": (), "identify": (), "reconstruct": (), "reduce": (), "convert": ("sc",), "write": ("a.json",), "draw": (),
    "fold": (), "move": (), "positions": ({},), "explain": (), "states": (), "advise": (1,), "realise": (),
    "realise_on_cone": (), "map_linkage": (),
}  # fmt: skip
"""The functions that take a mechanism, and what else they need."""


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("name", ["k1:Cr", "path.fold", Path("path.fold")])
def test_a_name_is_to_be_read_first(verb, name):
    with pytest.raises(TypeError) as refused:
        getattr(synth, verb)(name, *VERBS[verb])
    assert isinstance(refused.value, synth.SynthedraError)
    assert str(refused.value).startswith(f"{verb}: the ")
    assert str(refused.value).endswith(f"try synth.{verb}(synth.read({str(name)!r}))")


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize(("thing", "told"), [(None, "None"), (3, "3"), ([1], "an object of type list")])
def test_what_is_no_mechanism_is_told(verb, thing, told):
    with pytest.raises(synth.SynthedraError) as refused:
        getattr(synth, verb)(thing, *VERBS[verb])
    assert str(refused.value).startswith(f"{verb}: {told}; expected a")
    assert "synth.read" in str(refused.value)


def test_a_graph_is_no_sheet():
    with pytest.raises(TypeError, match="fold: an object of type SCGraph; expected a Sheet"):
        synth.fold(synth.read("k1:Cr"))


def test_a_branch_of_five_thousand_digits_is_no_branch(data):
    sheet = synth.read(data / "patterns" / "bird-base.fold")
    with pytest.raises(
        synth.SynthedraError, match="there is no branch of so large a number; expected one from 0 to 15"
    ):
        synth.fold(sheet, branch=10**5000)
