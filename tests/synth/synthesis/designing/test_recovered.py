"""Mechanisms off by 10 % are found again from the motion of two of their links."""

from time import process_time

import numpy as np
import pytest
from sizes import slow
from wished import KINDS, wished

from synth.synthesis.designing.designs import judged
from synth.synthesis.designing.search import found_from, seeded

STARTS = 16


def recovered(kind, seed):
    """The first design that meets all wishes, the starts it took, and the processor time; None without one."""
    case = wished(kind, seed)
    begun = process_time()
    for start in range(STARTS):
        rng = seeded(f"{kind} {seed}", start)
        off = 0.05 * start * case.problem.family.scales * rng.normal(size=len(case.start))
        found = found_from(case.problem, np.clip(case.start + off, *case.problem.family.bounds), rng)
        if found is not None and found.error <= 1e-12 and found.miss < 1e-9:
            one = judged(case.problem, found, start)
            if one.moves:
                return one, start + 1, process_time() - begun
    return None, STARTS, process_time() - begun


@pytest.mark.parametrize("kind", ["four-bar", "Watt", "on a cone", "bennett"])
def test_a_mechanism_is_found_again(kind):
    one, _, _ = recovered(kind, 0)
    assert one is not None
    assert one.error <= 1e-12
    assert (
        max(figure.miss for figure in one.figures) < 1e-7
    )  # the angle of a rotation by its matrix has half the digits


@pytest.mark.parametrize("count", [slow(300)])
def test_of_three_hundred_mechanisms_most_are_found_again(count):
    kinds = [KINDS[number % len(KINDS)] for number in range(count)]
    results = [recovered(kind, number) for number, kind in enumerate(kinds)]
    found = [one is not None for one, _, _ in results]
    times = np.array([seconds for _, _, seconds in results])
    lines = [
        f"{kind}: {sum(f for f, k in zip(found, kinds, strict=True) if k == kind)} of {kinds.count(kind)}"
        for kind in KINDS
    ]
    print("\n".join(lines), f"median {np.median(times):.2f} s of processor time", sep="\n")
    assert np.mean(found) >= 0.95, lines
    assert np.median(times) < 5.0
