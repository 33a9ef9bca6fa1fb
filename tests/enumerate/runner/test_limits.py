"""Limits of queries: however they are given, they are kept, compared and stored in one way."""

import json
from dataclasses import fields
from typing import get_type_hints

import numpy as np
import pytest

from enumerate.chains.query import ChainOptions, ChainQuery
from enumerate.runner.job import Limits
from enumerate.sc.jobs import count_sc_graphs
from enumerate.sc.query import SCOptions, SCQuery
from enumerate.scd.query import PlacementOptions, PlacementQuery, SCDOptions, SCDQuery
from graphs.errors import InvariantError


@pytest.mark.parametrize("given", [Limits(2, 2), (2, 2), [2, 2], 2])
def test_a_query_keeps_limits(given):
    query = ChainQuery(8, 1, symmetry=given)
    assert query == ChainQuery(8, 1, symmetry=Limits(2, 2))
    assert hash(query)
    assert json.loads(json.dumps(query.key))["symmetry"] == [2, 2]


@pytest.mark.parametrize(
    ("name", "query"),
    [
        ("longest string", lambda wrong: ChainQuery(8, 1, longest_string=wrong)),
        ("longest string", lambda wrong: SCQuery(8, 1, longest_string=wrong)),
        ("centres", lambda wrong: SCQuery(8, 1, centres=wrong)),
        ("symmetry", lambda wrong: SCQuery(8, 1, symmetry=wrong)),
        ("vertices", lambda wrong: PlacementQuery(4, vertices=wrong)),
    ],
)
def test_the_smaller_number_comes_first(name, query):
    with pytest.raises(InvariantError, match=f"the range 4 to 2; expected the smaller number first .{name}"):
        query((4, 2))


@pytest.mark.parametrize(
    ("options", "queries"),
    [
        (ChainOptions, [ChainQuery]),
        (SCOptions, [SCQuery]),
        (PlacementOptions, [PlacementQuery]),
        (SCDOptions, [SCDQuery, PlacementQuery]),
    ],
)
def test_options_are_the_fields_of_the_query(options, queries):
    names = {field.name for query in queries for field in fields(query)}
    assert set(get_type_hints(options)) == names - {"links", "dof", "max_degree", "placements"}


def test_numbers_and_arrays_agree():
    values = np.arange(6)
    for limits in (Limits(), Limits(2), Limits(2, 4), Limits(0, 0)):
        assert limits.admitted(values).tolist() == [value in limits for value in range(6)]


def test_a_ring_has_a_longest_string():
    assert [count_sc_graphs(4, 1, longest_string=limits) for limits in ((0, 0), (0, 3), 4, (5, None))] == [0, 0, 1, 0]
