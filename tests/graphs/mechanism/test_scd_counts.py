"""The SCD rules let through as many graphs as the design counts, by plain enumeration."""

import pytest
from scd_oracle import scd_codes

FOUR_BAR = [(0, 1), (1, 2), (2, 3), (3, 0)]
WATT = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
STEPHENSON = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)]


@pytest.mark.parametrize(
    ("joints", "most", "count"),
    [(FOUR_BAR, 3, 1), (FOUR_BAR, 4, 7), (WATT, 3, 1), (STEPHENSON, 3, 0)],
    ids=["four-bar D=3", "four-bar D=4", "Watt D=3", "Stephenson D=3"],
)
def test_counts_of_the_design(joints, most, count):
    assert len(scd_codes(joints, most)) == count
