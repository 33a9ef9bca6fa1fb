"""Linkages that move with known freedoms, and have flexes beside that close to first order only."""

from math import radians

import numpy as np
import pytest
from sizes import slow

from graphs.errors import InvariantError
from graphs.tolerances import DOUBLE
from synth.analysis.motion.singular import freedoms_at
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import GENERATORS, generate
from tests.support.shaky import with_flat_triangles

SOLIDS = (
    "bennett", "goldberg", "myard", "bricard-line-symmetric", "bricard-plane-symmetric",
    "bricard-trihedral", "kaleidocycle", "scissor-ring",
)  # fmt: skip
COUPLED = ("scissor-prism",)
"""Their flexes are part of the loops that move."""
SHEETS = ("sarrus", "miura", "huffman-grid", "miura-tube", "chickenwire")
FAMILIES = (*SOLIDS, *SOLIDS, *COUPLED, *SOLIDS, *SHEETS)
MOST_COUNT = {"scissor-prism": 3}
BESIDE = 2e-7
"""Radians along flexes, at which loops are open by the square of it."""


def some(name, chance):
    """Return a member of a family by random parameters, well within their ranges."""
    for _ in range(50):
        given = {}
        for one in GENERATORS[name].parameters:
            if one.unit == "count":
                given[one.name] = int(chance.integers(one.least, min(one.most, MOST_COUNT.get(name, 8)) + 1))
            else:
                most = min(one.most, 4 * one.default or 1.0)
                given[one.name] = one.least + (most - one.least) * chance.uniform(0.1, 0.9)
        try:
            fold = radians(chance.uniform(20, 100)) if GENERATORS[name].foldable else None
            return generate(name, fold=fold, **given)
        except InvariantError:
            continue
    raise AssertionError(name)


def check(number):
    chance = np.random.default_rng(number)
    name = FAMILIES[number % len(FAMILIES)]
    made = some(name, chance)
    at = configuration_of(made.mechanism)
    if name in SOLIDS:
        at = configuration_of(with_flat_triangles(made.mechanism, int(chance.integers(1, 4)), chance))
    ways = at.branches.branches
    moving = [way for way in ways if way.certainty != "not known"]
    assert moving, (number, name, dict(made.values))
    assert all(way.freedoms != 0 for way in moving), (number, name, dict(made.values))
    beside = [freedoms_at(at.linkage, at.closure, beside_branch(at, way, chance)) for way in moving]
    assert beside == [way.freedoms for way in moving], (number, name, dict(made.values))
    return name, made.freedoms, [way.freedoms for way in ways]


def beside_branch(at, way, chance):
    """Return a configuration that is as closed as those of a path, beside the branch along its flexes."""
    rates = rates_at(at.closure, way.sample)
    moved = way.sample + BESIDE * rates @ chance.normal(size=rates.shape[1])
    assert at.closure.error(moved) <= DOUBLE.closed
    return moved


@pytest.mark.parametrize("number", [0, 1, slow(6), 7, 27])
def test_what_moved_has_the_freedoms_of_its_source(number):
    name, freedoms, ways = check(number)
    assert freedoms in ways, name


@pytest.mark.slow
def test_of_two_hundred_none_has_no_freedom_after_it_moved():
    agree = [freedoms in ways for name, freedoms, ways in map(check, range(200))]
    assert sum(agree) >= 198
