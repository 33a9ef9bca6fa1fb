import random

import pytest
from hypothesis import given
from sizes import slow
from strategies import randoms, sc_graphs, scd_graphs

from graphs.convert.panels import scd_from_panels
from graphs.count.equations import relative_polyhedron
from graphs.edit.edits import (
    add_crease,
    add_loop,
    add_ride_along,
    crease_link,
    fresh,
    lock_hinge,
    lock_joint,
    make_explicit,
    make_implicit,
    ride_along,
)
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.sc import SCGraph
from graphs.reduce.ride_alongs import reduce

SIX = SCGraph(6, [(i, (i + 1) % 6) for i in range(6)], [Loop(range(6))])
FAN = scd_from_panels([(0, k, k % 5 + 1) for k in range(1, 6)])
(CENTRE,) = set.intersection(*map(set, FAN.vertices.values()))


def confirmed(edit):
    """The prediction is the difference of the counts, and by Eq. 7 it is that of the features."""
    assert edit.counted == edit.predicted
    if edit.equation == "Eq. 7":
        a, b = edit.before.counts, edit.graph.counts
        assert edit.predicted == relative_polyhedron(
            b.vertices - a.vertices, b.implicit_centres - a.implicit_centres, b.edges - a.edges
        )
    return edit


def unless_centres_clash(make):
    """Confirm an edit, unless it would make a finite and an infinite centre one."""
    try:
        confirmed(make())
    except InvariantError as error:
        assert error.rule == "centre classes"


@given(sc_graphs, randoms)
def test_edits_of_sc_graphs_are_predicted(sc, rng):
    joint = rng.choice(list(sc.joints)) if sc.joints else None
    link = rng.choice(list(sc.nodes))
    here = [j for j, ends in sc.joints.items() if link in ends]
    moved = rng.sample(here, rng.randint(0, len(here)))
    unless_centres_clash(lambda: add_crease(sc, link, moved))
    if joint is None:
        return
    a, b = sc.joints[joint]
    for k in range(5):
        confirmed(add_loop(sc, a, b, k, through=[joint]))
        confirmed(add_loop(sc, a, b, k, through=[joint], centre="none"))
    if len(sc[a][b]) == 1:
        confirmed(add_ride_along(sc, a, b))
        unless_centres_clash(lambda: lock_joint(sc, joint))
    else:
        with pytest.raises(UnsolvableError, match="joints between them"):
            add_ride_along(sc, a, b)
        with pytest.raises(UnsolvableError, match="joins the same two links"):
            lock_joint(sc, joint)


def some_edits(scd, rng: random.Random):
    """Every kind of edit that a random SCD graph allows, as thunks."""
    link = rng.choice(list(scd.nodes))
    around = scd.vertices[link]
    yield lambda: crease_link(scd, link, rng.choice(around))
    if len(around) > 3:
        i = rng.randrange(len(around))
        yield lambda: crease_link(scd, link, around[i], around[(i + 2) % len(around)])
    for joint in scd.joints:
        yield lambda joint=joint: ride_along(scd, joint, (rng.randint(3, 5), rng.randint(3, 5)))
        yield lambda joint=joint: lock_hinge(scd, joint)
    for index in range(len(scd.loops)):
        yield lambda index=index: make_implicit(scd, index)
        yield lambda index=index: make_explicit(scd, index)
        yield lambda index=index: make_explicit(make_implicit(scd, index).graph, index)


@given(scd_graphs, randoms)
def test_edits_of_scd_graphs_are_predicted(scd, rng):
    for make in some_edits(scd, rng):
        try:
            edit = make()
        except (InvariantError, UnsolvableError):
            continue
        confirmed(edit)


@pytest.mark.parametrize("number", [60, slow(300)])
def test_random_scd_graphs_allow_every_edit(number):
    from strategies import random_scd

    done = set()
    for seed in range(number):
        rng = random.Random(seed)
        for make in some_edits(random_scd(rng), rng):
            try:
                done.add(make().what.split()[0])
            except (InvariantError, UnsolvableError):
                continue
    assert done == {"crease", "ride-along", "lock", "implicit", "explicit"}


def test_what_is_added_can_be_taken_off():
    edit = confirmed(ride_along(FAN, 0))
    assert [step.removed for step in reduce(edit.graph).steps] == [(5, 6)]
    assert reduce(edit.graph).graph.is_identical(FAN)
    twice = ride_along(edit.graph, 6)
    (chain,) = reduce(twice.graph).chains()
    assert len(chain) == 2
    assert reduce(add_ride_along(SIX, 2, 3).graph).graph.is_identical(SIX)


def test_a_crease_and_its_lock_cancel():
    assert lock_joint(add_crease(SIX, 0, [0]).graph, 6).graph.is_identical(SIX)
    # On a triangle the crease ends in the middle of a side, and that point stays a vertex.
    creased = crease_link(FAN, 0, CENTRE)
    back = confirmed(lock_hinge(creased.graph, len(FAN.joints))).graph
    assert (back.counts.vertices, len(back)) == (FAN.counts.vertices + 1, len(FAN))


def test_a_centre_goes_and_comes_back():
    away = confirmed(make_implicit(FAN, 0))
    assert away.graph.drawing.kind_of_face(away.graph.drawing.face_loops.index(0)) is FaceKind.IMPLICIT
    assert confirmed(make_explicit(away.graph, 0)).graph.is_identical(FAN)


def test_a_lock_splits_a_loop_that_then_passes_a_link_twice():
    """A four-bar loop and a chord-like second loop: locking the chord's joint pinches the big loop."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)]
    sc = SCGraph(4, joints, [Loop((0, 1, 2, 3)), Loop((0, 1, 4))])
    edit = confirmed(lock_joint(sc, 4))
    assert sorted(len(loop.joints) for loop in edit.graph.loops) == [2, 2]


def test_edits_return_new_graphs():
    assert len(add_ride_along(SIX, 0, 1).graph) == 8
    assert len(add_loop(SIX, 0, 3, 2, through=[0, 1, 2]).graph) == 8
    assert len(add_crease(SIX, 0, [0]).graph) == 7
    assert len(lock_joint(SIX, 0).graph) == 5
    assert type(lock_hinge(FAN, 0).graph) is type(FAN)
    assert len(ride_along(FAN, 0).graph) == 7
    assert len(crease_link(FAN, 0, CENTRE).graph) == 6
    assert make_explicit(make_implicit(FAN, 0).graph, 0).graph.is_identical(FAN)
    assert len(SIX) == 6


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: add_ride_along(SIX, 0, 3), "links 0 and 3 have 0 joints between them"),
        (lambda: add_ride_along(SIX, 0, 9), "9 is no link"),
        (lambda: add_ride_along(SIX, 0, 0), "link 0 is named twice"),
        (lambda: add_loop(SIX, 0, 1, -1), "a chain of -1 links"),
        (lambda: add_loop(SIX, 0, 3, 1, through=[0, 1]), "loop '0 1 6 7' meets link"),
        (lambda: add_crease(SIX, 0, [3]), "joint 3 is not at link 0"),
        (lambda: lock_joint(SIX, 9), "9 is no joint"),
        (lambda: crease_link(FAN, 0, 99), "99 is no vertex of link 0; expected one of"),
        (lambda: crease_link(FAN, 9, 0), "9 is no link"),
        (lambda: crease_link(FAN, 0, *FAN.vertices[0][:2]), "are neighbours or equal; expected a diagonal"),
        (lambda: make_explicit(FAN, 0), "is not implicit"),
        (lambda: make_implicit(FAN, 1), "there is no loop 1; expected 0 to 0"),
        (lambda: ride_along(FAN, 9), "9 is no joint"),
        (lambda: ride_along(FAN, 0, (2, 3)), "a link of 2 sides"),
        (lambda: lock_hinge(FAN, 9), "9 is no joint"),
        (lambda: ride_along(ride_along(FAN, 0).graph, 0), "no room for a ride-along at joint 0: no open edges"),
    ],
)
def test_edits_that_cannot_be(make, message):
    with pytest.raises((InvariantError, UnsolvableError), match=message):
        make()


def test_fresh_ids_avoid_texts():
    assert fresh(["0", 1, "x"], 3) == [3, 4, 5]
    assert fresh([3, "4", 5], 2) == [6, 7]
