"""Precision by digits: fixed decimals, significant digits, single precision, and numbers chosen on purpose."""

import numpy as np
import pytest

from graphs.mechanism.precision import digits_of, precision_of, written_by

RNG = np.random.default_rng(11)
NUMBERS = RNG.uniform(-100.0, 100.0, (60, 2))
WIDE = 10.0 ** RNG.uniform(-3.0, 2.0, 120)


@pytest.mark.parametrize("decimals", [1, 2, 3, 6, 9])
def test_decimals(decimals):
    found = digits_of(NUMBERS.round(decimals), 100.0)
    assert (found.source, found.error) == (f"{decimals} decimals", pytest.approx(0.5 * 10.0**-decimals))


@pytest.mark.parametrize("digits", [6, 7, 10])
def test_significant_digits_are_judged_by_the_largest_number(digits):
    written = [float(f"{x:.{digits}g}") for x in WIDE]
    found = digits_of(written, 50.0)
    assert found.source == f"{digits} significant digits"
    largest = max(written)
    assert 0.5 * largest * 10.0**-digits <= found.error <= 5.0 * largest * 10.0**-digits


@pytest.mark.parametrize("form", ["{!r}", "{:.9g}", "{:.12f}"])
def test_single_precision_in_full_or_to_nine_digits(form):
    single = NUMBERS.astype(np.float32).ravel()
    written = [float(form.format(float(x))) if form != "{!r}" else float(str(x)) for x in single]
    found = digits_of(written, 100.0)
    assert found.source == "single precision"
    assert found.error == pytest.approx(2.0**-24 * max(map(abs, written)), rel=0.01)


def test_numbers_chosen_on_purpose_are_exact():
    for chosen in (RNG.integers(0, 64, (40, 2)) / 16, RNG.integers(0, 9, (40, 2)) / 10, NUMBERS, NUMBERS.round(0)):
        assert digits_of(chosen, np.ptp(chosen) / 2) is None


def test_far_away_single_precision_and_decimals_are_told_from_double():
    whole = np.array([(x, y) for x in range(5) for y in range(5)], dtype=float)
    assert precision_of((whole + 4e6).tolist()).source == "double precision"
    far = precision_of((NUMBERS + 1e8).tolist())
    assert far.size == pytest.approx(2.0**-52 * 1e8 / 100.0, rel=0.2)


def test_where_numbers_are_no_coordinates_nothing_is_said():
    assert written_by(np.zeros((4, 2))) is None
    assert digits_of([1e150, 2e150, 3.7e150], 1e150) is None
    assert digits_of([], 1.0) is None
