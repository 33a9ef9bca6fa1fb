"""Types with one centre laid on cones: the files lead back to the cone and to the type, and move as it does."""

import json

import numpy as np
import pytest

import synth
from graphs.edit.analogues import planar_analogue, spherical_analogue
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, read_linkage, write
from graphs.identity.chains import chain_id
from synth.catalogue.realisation.on_cone import realise_on_cone
from synth.linkages.surfaces.linkage_maps import by_sizes, map_linkage

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


def test_rows_of_conical_candidates_become_linkages_that_move(tmp_path):
    """From `conical_candidates` to `move_on_surface`: rows, results, linkages and files, of even kites too."""
    rows = list(synth.conical_candidates("k1:Cr", slots=7))
    again = [json.loads(json.dumps(row)) for row in rows]
    laid = [realise_on_cone(row, cone_angle=LAMBDA) for row in rows]
    for row, like, one in zip(rows, again, laid, strict=True):
        places = one.linkage.places()
        order = sorted(range(4), key=lambda joint: places[joint] % (2 * np.pi))
        assert [str(list(one.linkage.chain.joints)[joint]) for joint in order] == row["order"]
        assert one.cone_angle == LAMBDA
        assert one.freedoms == 1
        assert realise_on_cone(like, cone_angle=LAMBDA).linkage.steps == one.linkage.steps
    synth.write(laid[0].linkage, tmp_path / "one.json")
    motions = [synth.move_on_surface(each) for each in (laid[0], laid[0].linkage, tmp_path / "one.json")]
    assert len({round(motion.forward.limit, 6) for motion in motions}) == 1
    cone = synth.Cone(LAMBDA)
    printed = str(synth.move_on_surface(rows[1], surface=cone))
    assert printed == str(synth.move_on_surface(again[1], surface=cone))
    assert len(synth.surface_behaviours(laid[0])) == 1


def test_what_is_no_linkage_on_a_surface_is_refused():
    refused = [
        (lambda: realise_on_cone({"chain": "k1:Cr"}), "realise_on_cone: a mapping without order, loops; expected a row"),
        (lambda: realise_on_cone({"chain": 3, "order": [], "loops": []}), "a mapping whose chain is 3; expected a row"),
        (lambda: realise_on_cone({"chain": "k1:Cr", "order": ["0"], "loops": [], "slots": [0, 1]}), "order of the joints"),
        (lambda: synth.move_on_surface({}), "move_on_surface: a mapping without chain, order, loops"),
        (lambda: synth.move_on_surface("k1:Cr"), "move_on_surface: an object of type SCGraph; expected a SurfaceLinkage"),
        (lambda: synth.map_to_cones({}), "link angles: an object of type dict; expected a list of numbers"),
        (lambda: synth.map_to_cylinders(["a"]), "lengths: an object of type list; expected a list of numbers"),
    ]  # fmt: skip
    for call, text in refused:
        with pytest.raises(synth.SynthedraError) as error:
            call()
        assert text in str(error.value)
    linkage = synth.SurfaceLinkage.loop(np.radians([120, 95, 45, 85]))
    with pytest.raises(UnsolvableError, match=r"lies on 2 cones, lambda 13\.9.*; expected one; try surface="):
        synth.move_on_surface(linkage)
    first, _ = synth.map_linkage(linkage).surfaces
    assert synth.move_on_surface(linkage, surface=first.surface).on_surface.cone_angle == first.surface.angle
