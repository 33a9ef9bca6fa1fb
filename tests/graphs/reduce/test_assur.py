from itertools import combinations

import pytest
from rigidity import chains_by_geng

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import exact_mobility
from graphs.reduce.assur import assur_groups, reduce_assur


def one_centre(graph):
    """The spherical mechanism of a chain: all loops about one point."""
    sc = sc_from_link_joint_graph(graph)
    return SCGraph(sc.nodes, sc.joints, [Loop(loop.joints, at="O") for loop in sc.loops])


def positioned_sets(sc, ground, inputs):
    """All sets of moving links that are positioned by themselves: as many freedoms as their joints take, none elsewhere."""
    moving = [link for link in sc if link != ground]
    found = set()
    for size in range(len(moving) + 1):
        for chosen in combinations(moving, size):
            inside = {ground, *chosen}
            held = sum(3 if j in inputs else 2 for j, ends in sc.joints.items() if set(ends) <= inside)
            if held == 3 * size:
                found.add(frozenset(chosen))
    return found


@pytest.mark.parametrize(("links", "dof"), [(4, 1), (6, 1), (8, 1), (5, 2), (7, 2)])
def test_groups_are_the_smallest_steps(links, dof):
    """Against all subsets of links: what is positioned by itself is exactly what the groups say, hung together."""
    checked = 0
    for graph in chains_by_geng(links, dof):
        sc = one_centre(graph)
        for ground in list(sc)[:3]:
            for inputs in list(combinations(sc.joints, dof))[:6]:
                try:
                    groups = assur_groups(sc, ground, inputs)
                except UnsolvableError:
                    assert frozenset(set(sc) - {ground}) not in positioned_sets(sc, ground, inputs) or dof > 1
                    continue
                sets = positioned_sets(sc, ground, set(inputs))
                needs = []
                for i, group in enumerate(groups):
                    assert 3 * len(group.links) == 2 * len(group.joints) + len(group.inputs)
                    ends = {end for joint in group.joints for end in sc.joints[joint]}
                    needs.append({k for k in range(i) if ends & set(groups[k].links)})
                closed = set()
                for size in range(len(groups) + 1):
                    for taken in combinations(range(len(groups)), size):
                        if all(needs[i] <= set(taken) for i in taken):
                            closed.add(frozenset(link for i in taken for link in groups[i].links))
                assert closed == sets
                checked += 1
    assert checked >= 3


@pytest.mark.parametrize(("links", "dof"), [(6, 1), (8, 1), (7, 2)])
def test_reduction_keeps_mobility(links, dof):
    for graph in chains_by_geng(links, dof):
        sc = one_centre(graph)
        for inputs in list(combinations(sc.joints, dof))[:4]:
            try:
                reduction = reduce_assur(sc, 0, inputs)
            except UnsolvableError:
                continue
            told = reduction.to_json()
            assert told["after"]["mobility"] == told["before"]["mobility"] == dof
            assert exact_mobility(reduction.graph).mobility == dof
            assert set(inputs) <= set(reduction.graph.joints)
            assert sum(len(g.links) for g in reduction.removed) == len(sc) - len(reduction.graph)


def test_watt_and_stephenson():
    watt = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    sc = SCGraph(6, watt, [Loop((0, 1, 2, 3), at="O"), Loop((3, 4, 5, 6), at="O")])
    assert [group.links for group in assur_groups(sc, 0, [0])] == [(1,), (2, 3), (4, 5)]
    assert [group.links for group in assur_groups(sc, 2, [1])] == [(1,), (0, 3), (4, 5)]
    assert list(reduce_assur(sc, 0, [0]).graph) == [0, 1]
    far = reduce_assur(sc, 0, [5])  # driven between two floating links
    assert [group.inputs for group in far.groups if group.inputs] == [(5,)]


def test_odd_questions(data):
    four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    with pytest.raises(InvariantError, match="ground 9 is no link"):
        assur_groups(four_bar, 9, [0])
    with pytest.raises(InvariantError, match="input 9 is no joint"):
        assur_groups(four_bar, 0, [9])
    with pytest.raises(UnsolvableError, match="2 inputs for 1 degree of freedom; expected 1"):
        assur_groups(four_bar, 0, [0, 1])
    watt = SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)],
                   [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))])  # fmt: skip
    with pytest.raises(UnsolvableError, match="need one centre"):
        assur_groups(watt, 0, [0])
