"""Hervé's class: trivial, exceptional or paradoxical, told by groups and by random axes with the same relations."""

import json
from math import radians

import numpy as np
import pytest
from commands import run
from seeded import seed_file
from sizes import slow

import synth
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.overconstraint.herve import herve_class
from synth.catalogue.patterns import generate

KNOWN = {
    "four-bar": ("trivial", 3), "five-bar": ("trivial", 3), "6-uuu": ("trivial", 6), "box-pop-up": ("trivial", 3),
    "sarrus": ("exceptional", 6), "3-crr": ("exceptional", 6), "beaked-box": ("exceptional", 6),
    "bennett": ("paradoxical", 6), "goldberg": ("paradoxical", 6), "myard": ("paradoxical", 6),
    "bricard-line-symmetric": ("paradoxical", 6), "bricard-plane-symmetric": ("paradoxical", 6),
    "bricard-trihedral": ("paradoxical", 6), "kaleidocycle": ("paradoxical", 6), "miura": ("paradoxical", 6),
    "scissor-ring": ("paradoxical", 3),
}  # fmt: skip


@pytest.mark.parametrize("name", KNOWN)
def test_linkages_of_the_literature(name):
    told = herve_class(configuration_of(generate(name).mechanism))
    assert (told.kind, told.dimension) == KNOWN[name]
    assert (told.by_group == told.freedoms) == (told.kind == "trivial")
    assert (told.by_axes >= told.freedoms) == (told.kind != "paradoxical")


@pytest.mark.parametrize(
    ("name", "kind"), [("parallel-wrist", "exceptional"), ("crank-rocker", "trivial"), ("watt-on-cone", "trivial")]
)
def test_mobility_and_explain_have_one_class(name, kind):
    (told,) = json.loads(run("mobility", seed_file(name), "--json").stdout)
    why = json.loads(run("explain", seed_file(name), "--json").stdout)
    assert told["herve"] == why["herve"]
    assert told["herve"]["class"] == kind
    for command in ("mobility", "explain"):
        assert f"Hervé's class: {kind}" in run(command, seed_file(name)).stdout


def _ring(points, axes):
    number = len(points)
    ring = SCGraph(number, [(i, (i + 1) % number) for i in range(number)])
    lines = {i: (tuple(points[i]), tuple(axes[i])) for i in range(number)}
    return HingedSolids(ring, lines)


@pytest.mark.parametrize("seed", [0, slow(1), slow(2)])
def test_random_lengths_keep_sarrus_and_lose_bennett(seed):
    """Two triples of parallel axes move whatever the lengths are; seven general axes count right."""
    random = np.random.default_rng(seed)
    ways = random.normal(size=(2, 3))
    sarrus = _ring(random.normal(size=(6, 3)), ways[[0, 0, 0, 1, 1, 1]])
    assert herve_class(configuration_of(sarrus)).kind == "exceptional"
    seven = _ring(random.normal(size=(7, 3)), random.normal(size=(7, 3)))
    told = herve_class(configuration_of(seven))
    assert (told.kind, told.dimension, told.freedoms) == ("trivial", 6, 1)


def test_a_schoenflies_chain_has_a_group_of_four():
    """Five parallel axes and one more turn in one group of dimension 6; slides and parallel axes in one of 4."""
    random = np.random.default_rng(5)
    kinds = {0: "P", 1: "R", 2: "R", 3: "R", 4: "P"}
    chain = SCGraph(5, [(i, (i + 1) % 5) for i in range(5)])
    up = (0.0, 0.0, 1.0)
    places = {
        i: synth.JointPlace(tuple(random.normal(size=3)), (up if kind == "R" else tuple(random.normal(size=3)),))
        for i, kind in kinds.items()
    }
    told = herve_class(configuration_of(synth.JointedLinkage(chain, kinds, places)))
    assert (told.kind, told.dimension, told.freedoms) == ("trivial", 4, 1)


def test_rigid_and_large_linkages_have_none():
    random = np.random.default_rng(3)
    assert herve_class(configuration_of(_ring(random.normal(size=(6, 3)), random.normal(size=(6, 3))))) is None
    large = generate("miura", rows=8, columns=8, fold=radians(40)).mechanism
    assert herve_class(configuration_of(large)) is None


def test_rounded_coordinates_are_given_no_other_class():
    random = np.random.default_rng(0)
    points, ways = random.normal(size=(6, 3)), random.normal(size=(2, 3))
    for decimals in (5, 9, 12):
        told = herve_class(configuration_of(_ring(points.round(decimals), ways[[0, 0, 0, 1, 1, 1]].round(decimals))))
        assert told is None or told.kind == "exceptional"
