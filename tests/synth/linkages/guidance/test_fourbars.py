"""Four-bars that guide a body: circuits, branches and order by following the linkage, and the motion itself."""

import numpy as np
import pytest
from cranks import direction, random_orientations
from scipy.spatial.transform import Rotation
from sizes import slow

from graphs.errors import UnsolvableError
from synth.linkages.guidance.dyads import dyad_of, dyads_of_three
from synth.linkages.guidance.fourbars import four_bar_of, four_bars, motion_of
from synth.linkages.guidance.orientations import Orientations, read_orientations
from synth.linkages.guidance.synthesis import dyads_of_five

STEPS = 2000


def third_vertex(g, w, far, near, side):
    """The point at an angle ``far`` from g and ``near`` from w on a side of the arc between them, or None."""
    k = g @ w
    x, y = np.linalg.solve([[1.0, k], [k, 1.0]], np.cos([far, near]))
    square = (1.0 - x * x - y * y - 2.0 * k * x * y) / (1.0 - k * k)
    return None if square < 0.0 else x * g + y * w + side * np.sqrt(square) * np.cross(g, w)


class Linkage:
    """A four-bar with random links, followed step by step."""

    def __init__(self, rng):
        self.g, self.h = direction(rng), direction(rng)
        self.crank, self.coupler, self.rocker = rng.uniform(0.15, np.pi - 0.15, 3)
        across = np.cross(self.g, self.h)
        self.along = np.cross(across, self.g) / np.linalg.norm(across)
        self.across = across / np.linalg.norm(across)

    def body(self, turn, side):
        """Frame of the coupler, W_1 along x, W_2 in the plane of x and y; None where the linkage does not close."""
        out = np.cos(turn) * self.along + np.sin(turn) * self.across
        w = np.cos(self.crank) * self.g + np.sin(self.crank) * out
        v = third_vertex(self.h, w, self.rocker, self.coupler, side)
        if v is None:
            return None
        n = np.cross(w, v) / np.linalg.norm(np.cross(w, v))
        return np.stack([w, np.cross(n, w), n], axis=1)

    @property
    def moving(self):
        return np.array([1.0, 0.0, 0.0]), np.array([np.cos(self.coupler), np.sin(self.coupler), 0.0])

    def closes(self):
        """Whether the arc from H to W_1, at each step, makes a triangle with the other two links."""
        turns = turn_of(np.arange(STEPS))[:, None]
        out = np.cos(turns) * self.along + np.sin(turns) * self.across
        reach = np.arccos((np.cos(self.crank) * self.g + np.sin(self.crank) * out) @ self.h)
        most = self.rocker + self.coupler
        return (reach > abs(self.rocker - self.coupler)) & (reach < min(most, 2.0 * np.pi - most))

    def places(self, closes, n, rng):
        """Random positions at which the linkage closes: steps of the driver, sides, frames of the body."""
        steps = rng.choice(np.flatnonzero(closes), n, replace=False).tolist()
        sides = rng.choice([-1.0, 1.0], n).tolist()
        if rng.random() < 0.6:
            steps.sort(reverse=bool(rng.random() < 0.5))
        if rng.random() < 0.6:
            sides = sides[:1] * n
        return [(step, side, self.body(turn_of(step), side)) for step, side in zip(steps, sides, strict=True)]


def turn_of(step):
    return (step + 0.5) * 2.0 * np.pi / STEPS


def walked(closes):
    """Circuit and branch at each step of the driver on each side, found by walking, and a step that is never taken."""
    if closes.all():
        return {side: np.full(STEPS, k) for k, side in enumerate((1.0, -1.0))}, None
    gap = int(np.flatnonzero(~closes)[0])
    begins = np.diff(np.roll(closes, -gap).astype(int), prepend=0) == 1
    arcs = np.roll(np.cumsum(begins), gap)
    return {1.0: arcs, -1.0: arcs}, gap


def walked_order(steps, gap):
    """Whether steps are taken in order by a driver that goes round, or to and fro without passing the gap."""
    start = steps[0] if gap is None else gap
    ways = np.mod(np.subtract(steps, start), STEPS), np.mod(np.subtract(start, steps), STEPS)
    return any(np.all(np.diff(way) > 0) for way in ways)


def in_order_round(places, gap):
    """Whether a walk round the circuit, along the arc on one side and back on the other, meets the places in order."""
    far = [np.mod(step - (gap or 0), STEPS) for step, *_ in places]
    if gap is not None:
        far = [one if side > 0 else 2 * STEPS - one for one, (_, side, _) in zip(far, places, strict=True)]
    first = far.index(min(far))
    round_, back = far[first:] + far[:first], [*reversed(far[: first + 1]), *reversed(far[first + 1 :])]
    return round_ == sorted(far) or back == sorted(far)


def alike(numbers, others):
    """Whether two lists of numbers part their places in the same way."""
    return len(set(zip(numbers, others, strict=True))) == len(set(numbers)) == len(set(others))


def joined(given, linkage):
    dyads = dyad_of(given, linkage.g, linkage.moving[0]), dyad_of(given, linkage.h, linkage.moving[1])
    return four_bar_of(given, *dyads)


@pytest.mark.parametrize("number", [80, slow(200)])
def test_circuits_branches_and_order_are_those_of_the_linkage(number):
    rng = np.random.default_rng(51)
    swings, told, compared = set(), set(), 0
    while compared < number:
        linkage = Linkage(rng)
        closes = linkage.closes()
        if closes.sum() < 20:
            continue
        circuits, gap = walked(closes)
        places = linkage.places(closes, int(rng.integers(3, 6)), rng)
        one = joined(Orientations.from_matrices([frame for *_, frame in places]), linkage)
        numbers = [circuits[side][step] for step, side, _ in places]
        assert alike(one.circuits, numbers)
        assert alike(one.branches, list(zip(numbers, (side for _, side, _ in places), strict=True)))
        if not one.circuit_defect:
            assert one.order_defect is not walked_order([step for step, *_ in places], gap)
            assert one.in_order_on_circuit is in_order_round(places, gap)
        swings.add((one.kind.grashof, one.kind.input))
        told.add(one.defects)
        compared += 1
    assert {swing for _, swing in swings} == {"crank", "rocker", "0-rocker", "pi-rocker"}
    assert {kind for kind, _ in swings} == {"Grashof", "non-Grashof"}
    assert len(told) >= 5


@pytest.mark.parametrize("wanted", [3, slow(30)])
def test_a_driver_of_a_usable_four_bar_is_in_order_by_the_hoop(wanted):
    """The hoop's verdict is necessary; for a driver that does not turn fully it is not sufficient."""
    rng = np.random.default_rng(52)
    usable, only_hoop = 0, 0
    while usable < wanted:
        given = wandering(5, rng)
        for one in four_bars(given, dyads_of_five(given).dyads):
            if not one.defects:
                usable += 1
                assert one.driver.direction == one.direction
            if one.kind.input == "crank":
                assert one.direction == one.driver.direction
            elif one.driver.in_order and one.order_defect:
                only_hoop += 1
    assert only_hoop > 0


def wandering(n, rng):
    """Orientations not far from each other."""
    steps = Rotation.from_rotvec(0.5 * rng.normal(size=(n, 3)))
    made = [Rotation.from_quat(rng.normal(size=4))]
    for step in steps[1:]:
        made.append(step * made[-1])
    return Orientations.from_rotation(Rotation.concatenate(made))


@pytest.mark.parametrize("wanted", [5, pytest.param(12, marks=pytest.mark.slow)])
def test_the_motion_passes_the_orientations_on_both_dyads(wanted):
    rng = np.random.default_rng(53)
    done = 0
    while done < wanted:
        given = wandering(5, rng)
        for one in four_bars(given, dyads_of_five(given).dyads):
            if one.defects:
                continue
            motion = motion_of(given, one, 40)
            m = Rotation.from_quat(motion.quaternions, scalar_first=True).as_matrix()
            for dyad in (one.driver, one.follower):
                assert np.ptp(m @ dyad.moving @ dyad.fixed) < 1e-9
            at = motion.quaternions[list(motion.keys)]
            assert len(at) == 5
            assert np.allclose(np.abs((at * given.quaternions).sum(axis=1)), 1.0, atol=1e-10)
            steps = np.diff(motion.angles)
            assert np.all(steps > 0) or np.all(steps < 0)
            turned = 2.0 * np.arccos(np.clip((motion.quaternions[1:] * motion.quaternions[:-1]).sum(axis=1), -1, 1))
            assert turned.max() < 1.0  # no jump to another branch
            assert least_transmission(one, m) == pytest.approx(one.transmission, abs=0.02)
            assert least_transmission(one, m) > one.transmission - 1e-9
            done += 1


def least_transmission(one, frames):
    """The angle at W_2 between coupler and follower, or its supplement, measured at each frame."""
    w, v = frames @ one.driver.moving, frames @ one.follower.moving
    normals = np.cross(v, w), np.cross(v, one.follower.fixed)
    cosines = (normals[0] * normals[1]).sum(axis=1) / np.prod([np.linalg.norm(n, axis=1) for n in normals], axis=0)
    return float(np.arccos(np.abs(cosines)).min())


def test_link_angles_are_those_of_the_linkage():
    rng = np.random.default_rng(54)
    linkage = Linkage(rng)
    while linkage.closes().sum() < 20:
        linkage = Linkage(rng)
    given = Orientations.from_matrices([frame for *_, frame in linkage.places(linkage.closes(), 4, rng)])
    found = joined(given, linkage).link_angles
    due = np.array([np.arccos(linkage.g @ linkage.h), linkage.crank, linkage.coupler, linkage.rocker])
    # the ends of the axes may be others: an angle or its supplement
    assert np.allclose(np.minimum(found, np.pi - found), np.minimum(due, np.pi - due))


def test_the_crank_rocker_is_found_again(data):
    given = read_orientations(data / "orientations" / "crank-rocker.json")
    links = 60.0, 20.0, 55.0, 50.0
    found = four_bars(given, dyads_of_five(given).dyads)
    best, other = (
        min(found, key=lambda one: np.abs(np.degrees(one.link_angles) - due).max())
        for due in (links, (60.0, 50.0, 55.0, 20.0))
    )
    assert np.degrees(best.link_angles) == pytest.approx(links, abs=1e-6)
    assert (best.kind.name, best.defects, best.direction) == ("crank-rocker", (), "ccw")
    assert np.degrees(best.angles) == pytest.approx([10.0, 35.0, 65.0, 100.0, 140.0], abs=1e-6)
    assert (other.kind.name, other.defects) == ("rocker-crank", ("branch", "order"))
    assert other.in_order_on_circuit
    with pytest.raises(UnsolvableError, match=r"this four-bar has defects \(branch, order\)"):
        motion_of(given, other)


def test_four_bars_are_ranked():
    given = wandering(5, np.random.default_rng(55))
    found = four_bars(given, dyads_of_five(given).dyads)
    assert len(found) > 1
    order = [(len(one.defects), -one.transmission) for one in found]
    assert order == sorted(order)


def test_three_orientations_give_a_four_bar_for_two_axes():
    given = random_orientations(3, np.random.default_rng(56))
    dyads = dyads_of_three(given, [(1, 2, 3), (-1, 3, 1)])
    assert len(four_bars(given, dyads)) == 2
    assert four_bars(given, [dyads[0], dyads[0]]) == ()
    with pytest.raises(UnsolvableError, match="two of its axes are one"):
        four_bar_of(given, dyads[0], dyads[0])
