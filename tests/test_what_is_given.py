"""The functions of ``synth`` given a path, an id, a number or nothing where they take a mechanism."""

from inspect import signature
from pathlib import Path

import pytest
from sizes import slow

import synth

VERBS = {
    "mobility": {}, "identify": {}, "reconstruct": {}, "reduce": {}, "convert": {"kind": "sc"}, "write": {"path": "a.json"},
    "draw": {}, "fold": {}, "move": {}, "positions": {"drive": {}}, "explain": {}, "states": {}, "advise": {"freedoms": 1},
    "layers": {},
    "realise": {}, "realise_on_cone": {}, "map_linkage": {}, "move_on_surface": {}, "surface_behaviours": {},
}  # fmt: skip
"""The functions that take a mechanism, and what else they need."""


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("path", ["no such file.fold", Path("no such file.fold")])
def test_every_verb_reads_a_path(verb, path):
    assert next(iter(signature(getattr(synth, verb)).parameters)) == "mechanism"
    with pytest.raises(synth.FileError, match=r"^no such file.fold: no such file; expected a file$"):
        getattr(synth, verb)(path, **VERBS[verb])


@pytest.mark.parametrize("name", ["four-bar-vertex", slow("bird-base")])
def test_the_answer_for_a_path_is_that_for_its_mechanism(name, data):
    path = data / "patterns" / f"{name}.fold"
    sheet = synth.read(path)
    assert synth.fold(path, frames=2).to_json() == synth.fold(sheet, frames=2).to_json()
    assert synth.mobility(str(path)).to_json() == synth.mobility(sheet).to_json()
    assert synth.identify("k1:Cr") == synth.identify(synth.read("k1:Cr"))


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize(("thing", "told"), [(None, "None"), (3, "3"), ([1], "an object of type list")])
def test_what_is_no_mechanism_is_told(verb, thing, told):
    with pytest.raises(synth.SynthedraError) as refused:
        getattr(synth, verb)(thing, **VERBS[verb])
    assert str(refused.value).startswith(f"{verb}: {told}; expected a")
    assert "synth.read" in str(refused.value)


def test_a_graph_is_no_sheet():
    with pytest.raises(TypeError, match=r"fold: the SC graph has no coordinates; expected a Sheet; .* synth\.realise"):
        synth.fold("k1:Cr")
    assert synth.fold(synth.realise("k1:Cr").sheet, frames=2).path.angles.shape[1] == 4


def test_a_branch_of_five_thousand_digits_is_no_branch(data):
    sheet = synth.read(data / "patterns" / "bird-base.fold")
    with pytest.raises(
        synth.SynthedraError, match="there is no branch of so large a number; expected one from 0 to 15"
    ):
        synth.fold(sheet, branch=10**5000)
