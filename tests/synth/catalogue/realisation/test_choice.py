"""Of several drawings the same one is taken as if each were read back and folded; but few are."""

from itertools import chain

import numpy as np
import pytest

from enumerate.sc.jobs import sc_graphs
from graphs.errors import UnsolvableError
from graphs.identity.drawings import mechanism_from_map_id
from synth.catalogue.realisation import _realise as module
from synth.catalogue.realisation._realise import realise

NONE_IS_GOOD = "m1:ab.ac.bde.cfgd.eh.fhi.gj.ij"
"""Several loops round one centre: on each of its drawings a side is short."""
SAMPLE = ["m1:ab.ac.bde.cef.dgh.fij.gj.hi", "m1:ab.acd.bef.cf.dgh.ehi.gj.ij", "m1:ab.acd.bef.cfg.dh.ehi.gj.ij"]


def all_realised(task, wishes, drawn):
    """Each drawing at each height, read back and folded."""
    for placed in chain.from_iterable(module._placed(task, one) for one in drawn):
        try:
            yield module._realised(task, wishes, placed)
        except UnsolvableError:
            continue


@pytest.mark.parametrize("kind", ["sheet", "space"])
@pytest.mark.parametrize("code", [NONE_IS_GOOD, *SAMPLE])
def test_the_choice_is_that_among_all(monkeypatch, code, kind):
    seen = []

    def best_of(task, wishes, drawn, reasons):
        seen.append((task, wishes, list(drawn)))
        return original(task, wishes, seen[-1][2], reasons)

    original = module._best_of
    monkeypatch.setattr(module, "_best_of", best_of)
    found = realise(mechanism_from_map_id(code), kind=kind, tries=6)
    ((task, wishes, drawn),) = seen
    every = list(all_realised(task, wishes, drawn))
    good = [one for one in every if one.good]
    expected = good[0] if good else max(every, key=lambda one: one.rank)
    assert (found.number, found.folds, found.freedoms) == (expected.number, expected.folds, expected.freedoms)
    assert np.array_equal(found.sheet.coordinates, expected.sheet.coordinates)


def test_few_drawings_are_read_back(monkeypatch):
    counts = {"_placed": 0, "_realised": 0}

    def counted(name):
        original = getattr(module, name)

        def call(*arguments):
            counts[name] += 1
            return original(*arguments)

        return call

    for name in counts:
        monkeypatch.setattr(module, name, counted(name))
    found = realise(mechanism_from_map_id(NONE_IS_GOOD))
    assert not found.good
    assert found.folds
    assert counts == {"_placed": 6, "_realised": 1}  # of twelve tries six give a drawing


@pytest.mark.slow
def test_all_sc_types_of_eight_links_are_realised():
    """Each as a flat sheet that folds, with as many freedoms as its flat loops give; one does not fold."""
    folds = []
    for mechanism in sc_graphs(8, 1):
        found = realise(mechanism)
        assert found.mobility == 1
        assert found.figures.planarity < 1e-12
        folds.append(found.folds)
    assert len(folds) == 54
    assert sum(folds) == 53
