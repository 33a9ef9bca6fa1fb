"""Six-bars that guide a body: traced by the walk of `synth.move`, which knows them by their axes alone."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sizes import slow

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.geometry import angles_between, rotations, unit
from synth.linkages.guidance import Orientations, dyads_of_five, four_bars, read_orientations, six_bars
from synth.linkages.guidance.sixbars import _bars, _beside, _drawn, _moved, _only, _placed, _Population, _Wanted


def body_by_walking(six_bar, place):
    """The orientation of the body where the driven joint has the angle of an orientation, from orientation 1."""
    motion = synth.move(six_bar.linkage, drive={0: float(six_bar.inputs[place])}, frames=30)
    end = motion.path.angles[-1]
    assert end[0] == pytest.approx(six_bar.inputs[place], abs=1e-9)
    steps = np.diff(motion.path.angles[:, 0])
    assert (steps > 0.0).all() or (steps < 0.0).all()
    along = rotations(six_bar.axes[0], end[0]) @ rotations(six_bar.axes[1], end[1]) @ rotations(six_bar.axes[2], end[2])
    return along if six_bar.driven == "ground" else along.T


def check_by_walking(six_bar):
    m = six_bar.orientations.matrices
    for place in range(1, 5):
        turned = body_by_walking(six_bar, place) @ m[0]
        assert Rotation.from_matrix(turned.T @ m[place]).magnitude() < 1e-8


@pytest.mark.slow
def test_a_six_bar_through_the_five_orientations_which_no_four_bar_takes(data):
    five = read_orientations(data / "orientations" / "tipparthi.json")
    assert all(four_bar.defects for four_bar in four_bars(five, dyads_of_five(five).dyads))
    found = six_bars(five)
    [six_bar] = found.six_bars
    assert six_bar.residual < 1e-10
    assert six_bar.transmission > np.radians(3.0)
    check_by_walking(six_bar)
    keys = six_bar.motion.quaternions[list(six_bar.motion.keys)]
    assert np.abs((keys * five.quaternions).sum(axis=1)).min() > 1.0 - 1e-12


@pytest.mark.parametrize(("driven", "seed"), [slow("ground", 1), slow("body", 4), slow("ground", 12), slow("body", 24)])
def test_six_bars_through_random_orientations(driven, seed):
    turned = Rotation.random(5, np.random.default_rng([2026, seed]))
    found = six_bars(Orientations.from_rotation(turned), tries=10, driven=driven, most=2)
    assert found.six_bars
    for six_bar in found.six_bars:
        assert six_bar.driven == driven
        check_by_walking(six_bar)


@pytest.mark.parametrize("anchor", [1, 4])
@pytest.mark.parametrize("seed", range(2))
def test_chains_take_the_orientations_and_so_do_their_bars(seed, anchor):
    random = np.random.default_rng(seed)
    m = Rotation.random(5, random).as_matrix()
    wanted = _Wanted(m, "ground", anchor)
    chains = _only(_drawn(wanted, random), np.arange(40))
    placed, takes = _placed(wanted, chains)
    assert takes.all()
    for one, other, arc in ((placed.fixed[:, None], placed.second, 0), (placed.second, placed.third, 1)):
        assert np.allclose(angles_between(one, other), chains.arcs[:, arc, None], atol=1e-9)
    assert np.allclose(placed.third, np.einsum("iab,nb->nia", m, chains.moving))
    first = rotations(placed.fixed[:, None], placed.inputs)
    assert np.allclose(np.einsum("niab,nb->nia", first, placed.second[:, 0]), placed.second, atol=1e-9)
    over, under = _bars(wanted, placed)
    assert ((over.sine > -1.0) & (under.sine > -1.0)).any()
    reach = np.abs(over.cosines(np.broadcast_to(over.carried[:, None], placed.second.shape), placed.second))
    assert (reach[over.sine > -1.0] < 1.0 + 1e-9).all()


@pytest.mark.parametrize("anchor", [1, 4])
def test_solved_chains_close_at_the_orientations(anchor):
    m = Rotation.random(5, np.random.default_rng([2026, 25])).as_matrix()
    wanted = _Wanted(m, "ground", anchor)
    population = _Population(wanted, np.random.default_rng(2))
    population.keep(60)
    for _ in range(12):
        population.step()
    placed, _ = _placed(wanted, population.chains)
    bars = _bars(wanted, placed)
    good = (bars[0].sine > 0.0) & (bars[1].sine > 0.0)
    assert good.any()
    _, body = _moved(wanted, placed, bars, placed.inputs)
    assert Rotation.from_matrix((np.swapaxes(m, 1, 2) @ body[good]).reshape(-1, 3, 3)).magnitude().max() < 1e-7


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_point_at_two_arcs_from_two_points(side):
    random = np.random.default_rng(8)
    one, other, point = unit(random.normal(size=(3, 50, 3)))
    arcs = np.stack([angles_between(one, point), angles_between(other, point)], axis=-1)
    sides = side * np.sign((np.cross(one, other) * point).sum(axis=-1))
    found, room = _beside(one, other, arcs, sides)
    assert (room > 0.0).all()
    mirrored = point - 2.0 * (np.cross(one, other) * point).sum(-1, keepdims=True) * np.cross(one, other) / (
        np.cross(one, other) ** 2
    ).sum(-1, keepdims=True)
    assert np.allclose(found, point if side > 0.0 else mirrored, atol=1e-9)


def test_other_than_five_orientations_are_refused():
    turned = Rotation.random(4, np.random.default_rng(1))
    with pytest.raises(UnsolvableError, match="4 orientations; six-bars are found for 5"):
        six_bars(Orientations.from_rotation(turned))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"driven": "crank"}, "'crank'; expected 'ground' or 'body'"),
        ({"most": 0}, "0; expected 1 or more"),
        ({"tries": -1}, "-1; expected 1 or more"),
        ({"first": -1}, "-1; expected 0 or more"),
    ],
)
def test_options_that_are_none_are_refused(options, message, data):
    five = read_orientations(data / "orientations" / "tipparthi.json")
    with pytest.raises(InvariantError, match=message):
        six_bars(five, **options)
