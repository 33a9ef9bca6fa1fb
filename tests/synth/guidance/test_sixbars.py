"""Six-bars that guide a body: traced by the walk of `synth.move`, which knows them by their axes alone."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sizes import slow

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.geometry import angles_between, rotations, unit
from synth.guidance import Orientations, dyads_of_five, four_bars, read_orientations, six_bars
from synth.guidance.sixbars import _coupler, _graphs, _off_curve


def body_by_walking(six_bar, place):
    """The orientation of the body where the driven joint has the angle of an orientation, from orientation 1."""
    joint = 0 if six_bar.driven == "ground" else 1
    motion = synth.move(six_bar.linkage, drive={joint: float(six_bar.inputs[place])}, frames=30)
    end = motion.path.angles[-1]
    assert end[joint] == pytest.approx(six_bar.inputs[place], abs=1e-9)
    steps = np.diff(motion.path.angles[:, joint])
    assert (steps > 0.0).all() or (steps < 0.0).all()
    return rotations(six_bar.axes[0], end[0]) @ rotations(six_bar.axes[1], end[1])


def check_by_walking(six_bar):
    m = six_bar.orientations.matrices
    for place in range(1, 5):
        turned = body_by_walking(six_bar, place) @ m[0]
        assert Rotation.from_matrix(turned.T @ m[place]).magnitude() < 1e-8


def test_a_six_bar_through_the_five_orientations_which_no_four_bar_takes(data):
    five = read_orientations(data / "orientations" / "tipparthi.json")
    assert all(four_bar.defects for four_bar in four_bars(five, dyads_of_five(five).dyads))
    found = six_bars(five)
    [six_bar] = found.six_bars
    assert six_bar.residual < 1e-10
    assert six_bar.transmission > np.radians(3.0)
    assert six_bar.form in ("Stephenson II", "Stephenson III")
    check_by_walking(six_bar)
    keys = six_bar.motion.quaternions[list(six_bar.motion.keys)]
    assert np.abs((keys * five.quaternions).sum(axis=1)).min() > 1.0 - 1e-12


@pytest.mark.parametrize(
    ("driven", "seed"), [slow("ground", 11), slow("body", 11), slow("ground", 59), slow("body", 35)]
)
def test_six_bars_through_random_orientations(driven, seed):
    turned = Rotation.random(5, np.random.default_rng([2026, seed]))
    found = six_bars(Orientations.from_rotation(turned), tries=30, driven=driven)
    for six_bar in found.six_bars:
        assert six_bar.driven == driven
        check_by_walking(six_bar)


def test_the_point_of_a_coupler_is_on_its_curve():
    random = np.random.default_rng(3)
    for _ in range(20):
        fixed, other = unit(random.normal(size=(2, 3)))
        crank = random.uniform(0.3, 2.8)
        a = rotations(fixed, random.uniform(0, 6)) @ (
            np.cos(crank) * fixed + np.sin(crank) * unit(np.cross(fixed, [0.3, 0.2, 0.9]))
        )
        point, c = unit(random.normal(size=(2, 3)))
        ahead, towards = (unit(one - a * (a @ one)) for one in (point, c))
        corner = np.arctan2(np.cross(a, ahead) @ towards, ahead @ towards)
        arcs = [float(angles_between(*pair)) for pair in ((a, point), (a, c), (c, other))]
        az, el = (
            (np.arctan2(axis[1], axis[0]) for axis in (fixed, other)),
            (np.arcsin(axis[2]) for axis in (fixed, other)),
        )
        (az1, az2), (el1, el2) = az, el
        numbers = np.array([az1, el1, az2, el2, crank, arcs[0], arcs[1], corner, arcs[2]])
        side = np.array([np.sign(a @ np.cross(fixed, point))])
        found_a, found_c, _ = _coupler(numbers, point[None], side)
        assert np.allclose([found_a[0], found_c[0]], [a, c], atol=1e-9)
        assert abs(_off_curve(numbers, point[None], side)[0][0]) < 1e-9


def test_ways_pass_the_orientations(data):
    five = read_orientations(data / "orientations" / "tipparthi.json")
    ways = _graphs(five, dyads_of_five(five).dyads, ("ground", "body"))
    assert {way.held.carrier for way in ways} == {way.held.driven for way in ways} == {"ground", "body"}
    for way in ways[::7]:
        matrices = way.held.matrices(way.driven, way.other)
        assert Rotation.from_matrix(np.swapaxes(matrices, 1, 2) @ five.matrices).magnitude().max() < 1e-7
        assert (np.diff(way.driven) > 0).all() or (np.diff(way.driven) < 0).all()


def test_other_than_five_orientations_are_refused():
    turned = Rotation.random(4, np.random.default_rng(1))
    with pytest.raises(UnsolvableError, match="4 orientations; six dyads require 5"):
        six_bars(Orientations.from_rotation(turned))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"driven": "crank"}, "'crank'; expected 'ground' or 'body'"),
        ({"most": 0}, "0; expected 1 or more"),
        ({"tries": -1}, "-1; expected 1 or more"),
    ],
)
def test_options_that_are_none_are_refused(options, message, data):
    five = read_orientations(data / "orientations" / "tipparthi.json")
    with pytest.raises(InvariantError, match=message):
        six_bars(five, **options)
