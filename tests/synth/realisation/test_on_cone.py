"""Types with one centre laid on cones: the files lead back to the cone and to the type, and move as it does."""

import numpy as np
import pytest

from graphs.edit.analogues import planar_analogue, spherical_analogue
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, read_linkage, write
from graphs.identity.chains import chain_id
from synth.realisation.on_cone import realise_on_cone
from synth.surfaces.linkages import by_sizes, map_linkage

LAMBDA = np.radians(25.0)


@pytest.fixture
def stephenson(data):
    return read(data / "hyatt" / "fig11-stephenson.json")


def test_the_file_leads_back_to_the_cone_by_steps_and_by_arcs(stephenson, tmp_path):
    found = realise_on_cone(stephenson, cone_angle=LAMBDA)
    write(found.linkage, tmp_path / "on-cone.json")
    linkage = read_linkage(tmp_path / "on-cone.json")
    assert map_linkage(linkage).surfaces[0].surface.angle == pytest.approx(LAMBDA, abs=1e-11)
    (cone,) = map_linkage(by_sizes(linkage)).surfaces
    assert cone.surface.angle == pytest.approx(LAMBDA, abs=1e-9)
    assert cone.circuits == found.circuits == ("open", "open")
    assert found.cones == 1
    assert chain_id(linkage.chain) == chain_id(stephenson)
    assert [set(loop.joints) for loop in linkage.chain.loops] == [set(loop.joints) for loop in stephenson.loops]


def test_axes_meet_in_one_point_at_the_arcs_that_are_told(stephenson):
    found = realise_on_cone(stephenson, cone_angle=LAMBDA)
    t = np.array(found.linkage.places())
    axes = np.column_stack([np.cos(LAMBDA) * np.sin(t), np.full(len(t), -np.sin(LAMBDA)), np.cos(LAMBDA) * np.cos(t)])
    number = {joint: place for place, joint in enumerate(stephenson.joints)}
    arcs = [np.arccos(axes[number[a]] @ axes[number[b]]) for a, b in found.arcs]
    assert arcs == pytest.approx(list(found.arcs.values()), abs=1e-12)


def test_it_moves_as_its_type_does(data, stephenson):
    six_bar = read(data / "wiener" / "six-bar-loop-spherical.json")
    watt = spherical_analogue(read(data / "wiener" / "watt.json"))
    for chain, mobility in ((stephenson, 1), (six_bar, 3), (watt, 1)):
        found = realise_on_cone(chain)
        assert found.freedoms == found.mobility == mobility
        assert found.clear >= np.radians(15.0)


def test_no_two_arcs_are_alike():
    arcs = list(realise_on_cone(read("k1:Cr")).arcs.values())
    assert np.abs(np.subtract.outer(arcs, arcs))[np.triu_indices(4, 1)].min() > np.radians(0.1)


def test_a_seed_gives_the_same_linkage_and_another_gives_another():
    same, again, other = (realise_on_cone(read("k1:Cr"), seed=seed).linkage.steps for seed in (3, 3, 4))
    assert same == again != other


def test_what_has_not_one_centre_is_refused(data):
    watt = read(data / "wiener" / "watt.json")
    for mechanism, why in (
        (watt, "2 centres"),
        (planar_analogue(watt), "at infinity"),
        (read(data / "wiener" / "hybrid-ten-bar.json"), "1 loop without a centre"),
        (read(data / "wiener" / "chain-UPS.json"), "no loops"),
    ):
        with pytest.raises(UnsolvableError, match=why):
            realise_on_cone(mechanism)


@pytest.mark.parametrize("angle", [0.0, -0.3, np.pi / 2, float("nan"), float("inf")])
def test_a_cone_angle_out_of_range_is_refused(angle, stephenson):
    with pytest.raises(InvariantError, match="lambda is"):
        realise_on_cone(stephenson, cone_angle=angle)
