"""Equations of mobility stand in one table: an entry is evaluated, written and printed."""

import pytest

import synth
from graphs.count import applicability
from graphs.count.applicability import EQUATIONS, Equation
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.printing import text_of


def _cyclomatic(sc: SCGraph) -> int:
    return len(sc.joints) - len(sc) + 1


def test_a_formula_is_added_in_one_place(monkeypatch):
    euler = Equation("euler", _cyclomatic, lambda sc: (sc.components == 1, "for connected chains"), "Euler (by me)")
    monkeypatch.setattr(applicability, "EQUATIONS", (*EQUATIONS, euler))
    answer = synth.mobility(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    assert answer.to_json()["equations"]["euler"] == {"value": 1, "applies": True, "why": "for connected chains"}
    assert "Euler (by me)" in text_of(answer.blocks(verbose=True))
    assert "Euler (by me): 1" in text_of(answer.blocks())


def test_an_equation_without_a_title_cannot_be_entered():
    with pytest.raises(TypeError, match="title"):
        Equation("euler", _cyclomatic, lambda sc: (True, ""))


def test_names_are_distinct_and_each_equation_counts_one_type_of_mechanism():
    names = [equation.name for equation in EQUATIONS]
    assert len(set(names)) == len(names)
    assert {equation.mechanism for equation in EQUATIONS} == {SCGraph, PolyhedronModel}
