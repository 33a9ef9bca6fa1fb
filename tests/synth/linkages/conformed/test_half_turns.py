"""Links that span half a turn: either arc, one at a time, against motions on cylinders and Table 4."""

import json

import numpy as np
import pytest
from commands import run
from sizes import slow, slow_but

from graphs.errors import InvariantError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cylinder
from synth.analysis.moving.on_surface import move_on_surface
from synth.linkages.conformed.behaviours import Way, table_row
from synth.linkages.conformed.linkage_behaviour import OnSurface, loop_of_steps

STEPS = {
    "open": (40, 50, 90),
    "open, other way round": (-40, -50, -90),
    "crossed": (90, -50, 140),
    "a diagonal": (180, 60, -150),
}


def begins(choice, chain):
    """The option for a choice of arcs."""
    return {str(chain.links[link]): str(chain.joints[arc[0]]) for link, arc in choice.arcs.items()}


@pytest.mark.parametrize("ground", [1, slow(2)])
@pytest.mark.parametrize("name", slow_but(["crossed", "a diagonal"], STEPS))
def test_both_arcs_do_what_they_do_on_a_cylinder(name, ground):
    """All links keep to one side in a small true motion exactly where the choice of arcs says so."""
    given = loop_of_steps(np.radians(STEPS[name]), Cylinder(2.0))
    linkage = OnSurface(given.chain, given.places, given.surface)  # a sign chooses no arc
    behaviour = linkage.behaviour(ground)
    choices = behaviour.choices()
    assert len(choices) in (1, 2, 4)
    for choice in choices:
        motion = move_on_surface(linkage.curved(begins(choice, behaviour.chain)), ground=ground)
        first = {sense.one_way[0] for sense in (motion.backward, motion.forward) if sense.one_way}
        assert (choice.intramobile, choice.extramobile) == (Way.INWARD in first, Way.OUTWARD in first)
    row = behaviour.table_row()
    assert row is not None
    assert behaviour.mobile() == (row.intramobile, row.extramobile)


@pytest.mark.parametrize("number", [20, slow(60)])
def test_table_4_is_what_one_arc_or_the_other_allows(number, rng):
    """Starred entries: four-bars with a chord that is a diameter, in all orders of their joints, each link fixed."""
    seen = set()
    for _ in range(number):
        places = np.array([0.0, np.pi, *rng.uniform(0.1, 2 * np.pi - 0.1, 2)])[rng.permutation(4)]
        steps = np.diff(places, append=places[0])
        linkage = loop_of_steps(np.remainder(steps + np.pi, 2 * np.pi) - np.pi)
        linkage = OnSurface(linkage.chain, linkage.places)
        for ground in linkage.chain:
            behaviour = linkage.behaviour(ground)
            row = behaviour.table_row()
            assert behaviour.mobile() == (row.intramobile, row.extramobile)
            seen.add((row.case, row.configuration, row.column, row.special))
    assert {key for key in seen if key[3]} >= {
        (1, "open", "A", True), (1, "crossed 2", "B", True), (2, "crossed 1", "A", True), (2, "crossed 2", "A", True),
    }  # fmt: skip
    assert table_row(np.radians([40, 90, 180, 0])).special


def test_arcs_are_rows_and_an_option_or_a_sign_chooses():
    out = run("cone", "behaviour", "--steps", "40,50,90").stdout
    assert "can be extramobile with link 4 from 1 to 4; transmobile with link 4 from 4 to 1" in out
    assert "4, from 1 to 4" in out
    assert "4, from 4 to 1" in out
    told = {
        words: json.loads(run("cone", "behaviour", "--steps", *words, "--json").stdout)["linkages"][0]
        for words in (
            ("40,50,90",), ("40,50,90,180",), ("40,50,90,-180",),
            ("40,50,90", "--arc", "4=1"), ("40,50,90", "--arc", "4=4"),
        )
    }  # fmt: skip
    arcs = {words: [link["arc"] for link in one["links"]] for words, one in told.items()}
    assert list(arcs.values()) == [
        [None, None, None, ["1", "4"], ["4", "1"]],
        [None, None, None, ["4", "1"]], [None, None, None, ["1", "4"]],
        [None, None, None, ["1", "4"]], [None, None, None, ["4", "1"]],
    ]  # fmt: skip
    assert [one["extramobile"] for one in told.values()] == [True, False, True, True, False]
    assert not any(one["intramobile"] for one in told.values())
    assert [choice["arcs"] for choice in told["40,50,90",]["choices"]] == [{"4": ["1", "4"]}, {"4": ["4", "1"]}]


def test_arcs_that_cannot_be_chosen_are_refused():
    linkage = loop_of_steps(np.radians([40, 50, 90]))
    with pytest.raises(InvariantError, match="link 2 does not span half a turn"):
        linkage.curved({"2": "2"})
    with pytest.raises(InvariantError, match=r"one from joint '(1|4)' or '(1|4)'"):
        linkage.curved({"4": "2"})
    assert "is not LINK=JOINT" in run("cone", "behaviour", "--steps", "40,50,90", "--arc", "4", code=2).output


def test_a_ternary_link_half_a_turn_from_its_fixed_joint_is_not_intramobile():
    """Its arc is no choice, for it has a third joint; the far joint goes outward all the same."""
    chain = SCGraph(
        6,
        {"O": (0, 1), "A": (1, 2), "B": (2, 3), "C": (3, 0), "D": (3, 4), "E": (4, 5), "F": (5, 2)},
        [Loop(tuple("OABC")), Loop(tuple("BDEF"))],
    )
    rng = np.random.default_rng(5)
    found = []
    while len(found) < 5:
        t = np.radians(rng.uniform(0, 180, 7))
        t[3], t[4] = 0.0, np.pi  # C, fixed, and D on link 3, with B between
        behaviour = OnSurface(chain, t.tolist(), Cylinder(1.0)).behaviour(0)
        if behaviour.behaviour.motion.freedoms == 1 and behaviour.behaviour.one_way:
            found.append(behaviour)
    assert [one.mobile() for one in found] == [(False, True)] * 5
    for turn in (1e-3, -1e-3):  # C at (0, 1), D at (0, -1)
        assert np.hypot(2 * np.sin(turn), 1 - 2 * np.cos(turn)) > 1
