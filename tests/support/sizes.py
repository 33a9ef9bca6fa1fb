"""Cases and sizes of a law: some run with `make test`, the others with `make test-slow` or `make test-night` only."""

import pytest


def slow(*values, **options):
    """Return a case that `make test` leaves out."""
    return pytest.param(*values, marks=pytest.mark.slow, **options)


def night(*values, **options):
    """Return a case that only `make test-night` runs."""
    return pytest.param(*values, marks=(pytest.mark.slow, pytest.mark.night), **options)


def slow_but(quick, cases):
    """Return cases of one argument each; those that are not among the quick ones are slow."""
    return [case if case in quick else slow(case) for case in cases]


def first_quick(number, cases):
    """Return cases of one argument each; all but the first so many are slow."""
    return [case if place < number else slow(case) for place, case in enumerate(cases)]
