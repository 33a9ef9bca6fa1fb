"""The library of C against numpy: the cost of drawings, and whole realisations."""

from functools import partial

import numpy as np
import pytest

from enumerate.sc.jobs import sc_graphs
from enumerate.scd.jobs import scd_graphs
from graphs.c_libraries import place_of
from synth.catalogue.realisation import drawing
from synth.catalogue.realisation._realise import realise
from synth.catalogue.realisation.drawing import (
    SOURCE,
    KernelDrawing,
    barycentric_start,
    first_unknowns,
    improved,
    kernel,
    shape_cost,
)
from synth.catalogue.realisation.pattern import pattern_of, simplest_drawn

needs_library = pytest.mark.skipif(kernel() is None, reason="there is no library: no compiler was at hand")
SIZES = drawing.SHAPE


def patterns():
    """Holes, inner vertices, bent panels with hubs, and parallel creases."""
    for mechanism in [*sc_graphs(6, 1, infinite=True), *list(scd_graphs(6, 1, 4, infinite=True))[::3]]:
        yield pattern_of(simplest_drawn(mechanism)[0])


@needs_library
def test_costs_and_their_derivatives():
    rng = np.random.default_rng(0)
    drawn = none = 0
    for pattern in patterns():
        start = first_unknowns(pattern, *barycentric_start(pattern, rng))
        library = KernelDrawing(kernel(), pattern, len(start), SIZES)
        for spread in (0.0, 0.02, 0.1, 0.4):
            unknowns = start + spread * rng.normal(size=start.shape)
            aims = 0.3 * rng.normal(size=len(pattern.edges))
            for convex in (True, False):
                expected = shape_cost(pattern, unknowns, aims, convex=convex)
                found = library.cost(unknowns, aims, convex=convex)
                assert (found is None) == (expected is None)
                if found is None or expected is None:
                    none += 1
                    continue
                drawn += 1
                for one, other in zip(found, expected, strict=True):
                    assert one.shape == other.shape
                    assert np.allclose(one, other, rtol=1e-11, atol=1e-12 * np.abs(other).max())
    assert drawn > 50
    assert none > 30


@needs_library
def test_vertices_that_coincide_and_edges_that_cross_are_no_drawing():
    pattern = next(pattern for pattern in patterns() if pattern.hubs)
    start = first_unknowns(pattern, *barycentric_start(pattern))
    cost = partial(KernelDrawing(kernel(), pattern, len(start), SIZES).cost, lengths=np.zeros(len(pattern.edges)))
    assert cost(start, convex=True) is not None
    together, mirrored = start.copy(), start * (-1.0, 1.0)
    together[1] = together[0]
    assert cost(together, convex=True) is None
    assert cost(mirrored, convex=True) is None


def test_derivatives_are_those_of_differences():
    """A second method for both: central differences."""
    pattern = next(pattern for pattern in patterns() if pattern.hubs and pattern.free_centres)
    start = first_unknowns(pattern, *barycentric_start(pattern, np.random.default_rng(3)))
    aims = np.zeros(len(pattern.edges))
    _, derivatives = shape_cost(pattern, start, aims, convex=True)
    step = 1e-6
    for place in range(start.size):
        ahead, back = start.copy(), start.copy()
        ahead.ravel()[place] += step
        back.ravel()[place] -= step
        difference = [shape_cost(pattern, there, aims, convex=True)[0] for there in (ahead, back)]
        slope = (difference[0] - difference[1]) / (2.0 * step)
        assert np.allclose(slope, derivatives[:, place], atol=1e-6 * np.abs(derivatives).max())


@needs_library
def test_realisations_without_the_library(monkeypatch):
    mechanisms = [*list(scd_graphs(6, 1, 5))[::150], *list(sc_graphs(6, 1))[::2]]
    found = [realise(mechanism) for mechanism in mechanisms]
    monkeypatch.setattr(drawing, "kernel", lambda: None)
    for mechanism, one in zip(mechanisms, found, strict=True):
        other = realise(mechanism)
        assert (one.number, one.folds, one.sheet.assignments) == (other.number, other.folds, other.sheet.assignments)
        assert np.allclose(one.sheet.coordinates, other.sheet.coordinates, atol=1e-5)


@needs_library
def test_the_library_is_the_one_of_this_source_and_is_used(monkeypatch):
    assert place_of(SOURCE).exists()
    pattern = next(patterns())
    start = first_unknowns(pattern, *barycentric_start(pattern))
    monkeypatch.setattr(drawing, "shape_cost", None)
    assert improved(pattern, start) is not None
