"""Noise a hundred times above rounding changes no answer: ids and order of ways, chosen joints, verdicts."""

from dataclasses import replace

import numpy as np
import pytest
from sizes import first_quick

from graphs.errors import SynthedraError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.motion import fold
from synth.analysis.motion.branches import branches_of, first_branch
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.singular.sampling import rates_towards
from synth.analysis.verdict._mobility import mobility
from synth.catalogue.patterns.creases import map_sheet, resch

_NOISE = 1e-13
_SMALL = (
    "realised/chain-RUS",
    "realised/watt",
    "wiener/square-twist",
    "realised/six-bar-with-chain",
    "realised/stephenson",
    "realised/two-centres",
    "wiener/miura-3x3",
)
_HEAVY = ("realised/mesh-4x4-inner-creases", "realised/adjunct-chain")


def noisy(sheet, chance):
    """Return a sheet whose coordinates are off by some 1e-13 of its size; one drawn in the plane stays there."""
    places = np.array(sheet.coordinates)
    off = _NOISE * np.abs(places).max() * chance.uniform(-1.0, 1.0, places.shape)
    return replace(sheet, coordinates=tuple(map(tuple, (places + off).tolist())))


def answers(sheet):
    """Return what is asked of a sheet, without figures: ways in their order, the way and joint taken, verdict."""
    found = configuration_of_sheet(sheet).branches
    ways = [(one.signs, one.freedoms, one.certainty, one.immobile, one.modes) for one in found.branches]
    try:
        folding = fold(sheet, frames=1)
        taken = (folding.branch, tuple(folding.driven))
    except SynthedraError as error:
        taken = type(error)
    said = mobility(sheet).verdict
    verdict = (said.freedoms, said.basis, said.certainty, said.exhaustive, said.immobile_joints, said.clusters)
    return ways, found.exhaustive, found.method, taken, verdict


def differences(path, copies):
    """Return how many noisy copies of a file get another answer, the first of them shown by `assert`."""
    sheet = read(path)
    exact = answers(sheet)
    for number in range(copies):
        chance = np.random.default_rng((sum(path.name.encode()), number))
        assert answers(noisy(sheet, chance)) == exact, f"{path.name}, copy {number}"


@pytest.mark.parametrize("name", first_quick(3, _SMALL))
def test_noise_changes_no_answer(data, name):
    differences(data / f"{name}.fold", copies=2)


@pytest.mark.slow
def test_a_thousand_noisy_copies_get_the_answers_of_the_exact_files(data):
    files = [
        path
        for path in sorted(data.glob("*/*.fold"))
        if not any(path.match(f"{name}.fold") for name in _HEAVY) and read(path).coordinates is not None
    ]
    assert len(files) >= 60
    for path in files:
        differences(path, copies=-(-1000 // len(files)))


def test_a_predicate_is_asked_of_rates_without_noise():
    """Signs of rates that are rounding alone made `first_branch` admit a way on which a joint is immobile."""
    corners = ((0, 0), (1, 0), (0.5, 0.9), (-1, 0), (-0.5, -0.7))
    linkage = linkage_of_sheet(Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners))
    seen = []
    first_branch(linkage, lambda rates: seen.append(rates) or False)
    assert len(seen) == len(branches_of(linkage).branches) == 2
    for rates in seen:
        assert all(rate == 0.0 or abs(rate) > 1e-7 for rate in rates)
        assert next(rate for rate in rates if rate) > 0.0
    assert first_branch(linkage, lambda rates: rates[0] * rates[1] > 0.0).signs == "++-+"


def test_joints_that_do_not_move_on_a_branch_stay_where_they_are():
    """A line of a square grid folds: the creases across it close by squares, which tell angles to seven digits."""
    sheet = map_sheet(3, 3)
    found = configuration_of_sheet(sheet).branches
    for number, branch in enumerate(found.branches):
        assert branch.immobile
        path = fold(sheet, branch=number, frames=3).path
        assert not path.angles[:, list(branch.immobile)].any()
        assert path.errors.max() < 1e-14


def test_branches_are_represented_by_general_rates():
    """The marks of a Resch pattern lead to the apex of a cone, where six creases would begin at rates of rounding."""
    pattern = configuration_of_sheet(resch(1, 1))
    branch = pattern.branches.branches[0]
    for rates in (branch.rates, rates_towards(branch.space, pattern.wanted)):
        assert np.abs(rates).min() > 1e-3
