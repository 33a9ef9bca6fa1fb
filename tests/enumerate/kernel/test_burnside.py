"""What Burnside's lemma gives is a whole number, or somebody hears of it."""

import numpy as np
import pytest

from enumerate.conical.rounds import Rounds, count_rounds_by_burnside
from enumerate.kernel._compiled import number_of_orbits


def test_a_remainder_is_a_fault():
    assert number_of_orbits(12, 4) == 3
    with pytest.raises(ArithmeticError, match="no whole number"):
        number_of_orbits(13, 4)


def test_symmetries_that_are_no_group_are_a_fault():
    with pytest.raises(ArithmeticError, match="no group"):
        count_rounds_by_burnside(Rounds(4, 4, 4), np.array([[0, 1, 2, 3], [0, 1, 3, 2], [0, 1, 3, 2]]))
