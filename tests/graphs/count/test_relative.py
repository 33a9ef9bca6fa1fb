"""Every relative equation gives the difference of the two counts (Wiener 2016, Eqs. 5 to 7)."""

from hypothesis import given, strategies as st
from strategies import scd_graphs

from graphs.count.equations import (
    modified_cgk,
    overconstraint,
    polyhedron_equation,
    relative_cgk,
    relative_polyhedron,
    relative_spherical_system,
    spherical_system,
)
from graphs.count.report import mobility_report

counts = st.integers(0, 10**6)


@given(counts, counts, counts, counts, st.sampled_from([3, 6]))
def test_relative_cgk_is_a_difference(n, j, dn, dj, space):
    after, before = modified_cgk(n + dn, j + dj, space), modified_cgk(n, j, space)
    assert relative_cgk(dn, dj, space) == after - before


@given(counts, counts, counts, counts)
def test_relative_spherical_system_is_a_difference(n, j, dn, dj):
    assert relative_spherical_system(dn, dj) == spherical_system(n + dn, j + dj) - spherical_system(n, j)


@given(scd_graphs, scd_graphs)
def test_relative_polyhedron_is_a_difference_between_mechanisms(one, two):
    a, b = one.counts, two.counts
    before, after = (polyhedron_equation(c.vertices, c.implicit_centres, c.edges) for c in (a, b))
    change = relative_polyhedron(b.vertices - a.vertices, b.implicit_centres - a.implicit_centres, b.edges - a.edges)
    assert change == after - before == mobility_report(two).mobility - mobility_report(one).mobility


@given(counts, counts)
def test_overconstraint_is_what_is_left(actual, generic):
    assert overconstraint(actual, generic) + generic == actual
