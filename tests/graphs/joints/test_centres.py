"""Loops are spherical or planar by their axes: also of solids and joints that declare none, and within the precision."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import synth
from graphs.convert.conversions import to_solids
from graphs.joints.centres import centred_by_axes
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import EPSILON
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate

CASES = Path(__file__).parents[3].parent / "shared" / "cases"


def centres(solids, precision=EPSILON, slides=()):
    """How many loops have each centre, of the links and joints of solids without any."""
    bare = SCGraph(solids.chain.nodes, solids.chain.joints)
    return Counter(loop.centre for loop in centred_by_axes(bare, solids.axes, precision, slides).loops)


def shaken(solids, size, seed=1):
    random = np.random.default_rng(seed)
    axes = {
        joint: tuple(tuple((np.array(part) + size * random.uniform(-1, 1, 3)).tolist()) for part in axis)
        for joint, axis in solids.axes.items()
    }
    return HingedSolids(SCGraph(solids.chain.nodes, solids.chain.joints), axes)


def test_vertices_of_a_sheet_as_solids():
    """Not only loops of a tree: each of the four vertices, also where coordinates are rounded."""
    solids = to_solids(generate("miura", rows=3, columns=3).mechanism)
    assert centres(solids) == {Centre.FINITE: 4}
    assert centres(shaken(solids, 1e-3), precision=1e-3) == {Centre.FINITE: 4}
    assert Centre.FINITE not in centres(shaken(solids, 1e-3))


def test_branches_of_solids_are_those_of_the_sheet():
    """A Miura sheet of 3 x 3 panels: one branch of 2 degrees of freedom and three of 1."""
    sheet = generate("miura", rows=3, columns=3).mechanism
    solids = to_solids(sheet)
    bare = HingedSolids(SCGraph(solids.chain.nodes, solids.chain.joints), solids.axes)
    here, due = (configuration_of(one).branches for one in (bare, sheet))
    assert sorted(one.freedoms for one in here.branches) == sorted(one.freedoms for one in due.branches) == [1, 1, 1, 2]


def test_parallel_and_skew_axes():
    up = (0.0, 0.0, 1.0)
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    corners = [(0.0, 0.0, 0.0), (0.3, 1.0, 0.7), (2.0, 1.5, 0.1), (2.2, 0.0, -1.0)]
    flat = HingedSolids(ring, {joint: (corner, up) for joint, corner in enumerate(corners)})
    assert centres(flat) == {Centre.INFINITE: 1}
    slider = HingedSolids(ring, {**flat.axes, 3: (corners[3], (1.0, 0.2, 0.0))})
    assert centres(slider, slides=(3,)) == {Centre.INFINITE: 1}
    assert centres(slider) == {}
    assert centres(to_solids(generate("bennett").mechanism)) == {}


def test_a_shared_case():
    path = CASES / "thick" / "miura-tapered.json"
    if not path.exists():
        pytest.skip("the shared cases are not here")
    branches = configuration_of(path).branches.branches
    assert sorted(one.freedoms for one in branches) == [1, 1, 1, 2]
    assert "4 motion branches" in str(synth.mobility(path))
