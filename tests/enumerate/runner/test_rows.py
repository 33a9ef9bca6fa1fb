"""Rows of a job in Python: in order with any number of workers, and no process left behind."""

import multiprocessing

import pytest
from sizes import slow
from toy_job import Squares

from enumerate.addenda import addenda
from enumerate.chains.jobs import chain_rows
from enumerate.conical.query import ConicalQuery, conical_orders, count_conical_orders
from enumerate.runner._run import rows_of, total_of
from enumerate.sc.jobs import sc_rows
from enumerate.scd.jobs import scd_rows
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph

EIGHT_BAR = tuple(enumerate([(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 7), (7, 0), (0, 3), (4, 7)]))


@pytest.mark.parametrize("workers", [1, 2])
def test_rows_are_dictionaries_in_order(workers):
    rows = list(rows_of(Squares(), workers=workers))
    assert [tuple(row.values()) for row in rows] == [(n, n * n) for n in range(200)]
    assert list(rows[0]) == list(Squares().columns)
    assert total_of(Squares(), workers=workers) == sum(range(200))


def test_workers_end_with_the_generator():
    rows = rows_of(Squares(), workers=2)
    first = next(rows)
    assert tuple(first.values()) == (0, 0)
    assert multiprocessing.active_children()
    rows.close()
    assert not multiprocessing.active_children()


@pytest.mark.parametrize(
    "listing",
    [
        slow(lambda **options: chain_rows(12, 1, symmetry=(8, None), **options)),
        lambda **options: sc_rows(11, 2, symmetry=(4, None), **options),
        lambda **options: scd_rows(8, 1, 3, **options),
        slow(lambda **options: conical_orders(ConicalQuery(EIGHT_BAR), **options)),
    ],
)
def test_listings_are_the_same_with_workers(listing):
    assert list(listing(workers=2)) == list(listing())


def test_addenda_and_numbers_are_the_same_with_workers():
    four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    alone, together = ([addendum.edit.graph for addendum in addenda(four_bar, 1, workers=k)] for k in (1, 2))
    assert [graph.joints for graph in alone] == [graph.joints for graph in together]
    query = ConicalQuery(EIGHT_BAR, (0, 1))
    assert count_conical_orders(query, "orbits", workers=2) == count_conical_orders(query)
