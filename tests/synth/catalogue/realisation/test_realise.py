"""Types given coordinates: they read back to the same type, move as the type does, and have a shape."""

import networkx as nx
import numpy as np
import pytest

from enumerate.scd.jobs import scd_graphs
from graphs.answer.identity import identify
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, write
from graphs.identity.chains import chain_id
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.loops.loop import Centre
from graphs.mechanism.drawing import FaceKind
from graphs.rank.infinitesimal import infinitesimal_mobility
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.catalogue.realisation._realise import Realisation, realise
from synth.catalogue.realisation.drawing import drawings
from synth.catalogue.realisation.measures import crossings
from synth.catalogue.realisation.pattern import pattern_of

FOUR_BAR = "m1:a-b.ac-.b-d.cd-"
EXPLICIT = "m1:a---b.ac-.bde.cef--.d-g.fg-"
IMPLICIT = "m1:a-b-.a-c-.b-d-.c-d-"
TWO_ABOUT_ONE = "m1:a---b.ac--.b-d-e.cf-g-.d-g-.e-f"
"""Two loops about one vertex, one of them round a hole: two of its panels cannot be convex."""
ROUND_ITS_CENTRE = "m1:a---b.ac-.b-d-e.cf-d-.e-g.fg-"
"""Two panels that share a vertex, and a crease that points to it."""


def _is_explicit(scd):
    return all(scd.drawing.kind_of_face(face.index) is not FaceKind.IMPLICIT for face in scd.faces)


def _read_back(found: Realisation, folder) -> str | None:
    place = folder / "found.fold"
    write(found.sheet, place, force=True)
    return identify(read(place)).drawing


def test_explicit_types_are_flat_sheets_that_fold(tmp_path):
    for code in (FOUR_BAR, EXPLICIT):
        scd = mechanism_from_map_id(code)
        assert _is_explicit(scd)
        found = realise(scd)
        assert _read_back(found, tmp_path) == code
        assert found.folds
        assert found.figures.quality >= 1.0
        assert found.figures.greatest_angle < np.pi
        assert found.freedoms == len(scd.joints) - 2 * len(scd.loops)
        pattern = pattern_of(scd)
        assert crossings(pattern, np.array(found.sheet.coordinates)) == 0


def test_the_letters_are_those_of_a_way_in_which_every_crease_turns():
    found = realise(mechanism_from_map_id(FOUR_BAR))
    signs = "".join("+" if letter == "V" else "-" for letter in found.sheet.assignments if letter in "MV")
    mirrored = signs.translate(str.maketrans("+-", "-+"))
    assert len(signs) == 4
    assert {signs, mirrored} & {branch.signs for branch in configuration_of_sheet(found.sheet).branches.branches}


@pytest.mark.parametrize("code", [TWO_ABOUT_ONE, ROUND_ITS_CENTRE])
def test_creases_point_to_their_centre_across_a_hole(code, tmp_path):
    scd = mechanism_from_map_id(code)
    found = realise(scd, tries=1)
    assert _read_back(found, tmp_path) == code
    assert len(found.bent) == 2
    assert np.pi < found.figures.greatest_angle < 2 * np.pi


def test_in_space_panels_are_plane_and_the_pose_moves_as_the_type_does(tmp_path):
    for code in (EXPLICIT, IMPLICIT):
        found = realise(mechanism_from_map_id(code), kind="space", tries=4)
        assert _read_back(found, tmp_path) == code
        assert found.figures.planarity < 1e-12
        assert found.freedoms == found.mobility == infinitesimal_mobility(found.sheet).dof == 1
        assert "U" not in found.sheet.assignments


def test_an_sc_graph_gets_its_simplest_drawn_type():
    from graphs.loops.loop import Loop
    from graphs.mechanism.sc import SCGraph

    found = realise(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), Centre.FINITE)]))
    assert found.scd.counts.open_edges == 4
    assert "fewest open edges" in found.notes[0]


def test_a_seed_gives_the_same_drawing_and_another_gives_another():
    scd = mechanism_from_map_id(FOUR_BAR)
    same, again, other = (realise(scd, seed=seed, tries=1).sheet for seed in (3, 3, 4))
    assert same == again != other


def test_size_is_the_longer_side_of_the_box():
    found = realise(mechanism_from_map_id(FOUR_BAR), size=70.0, tries=1)
    assert np.ptp(np.array(found.sheet.coordinates), axis=0).max() == pytest.approx(70.0)


@pytest.mark.parametrize("kind", ["sheet", "space"])
def test_the_shape_is_that_of_any_size(kind):
    scd = mechanism_from_map_id(FOUR_BAR)
    of_one = realise(scd, kind=kind, tries=1)
    for size in (1e-48, 1e-9, 1e48):
        found = realise(scd, kind=kind, size=size, tries=1)
        assert np.array(found.sheet.coordinates) / size == pytest.approx(np.array(of_one.sheet.coordinates))
        assert (found.freedoms, found.sheet.assignments) == (of_one.freedoms, of_one.sheet.assignments)


SIZES = [float("nan"), float("inf"), 0.0, -1.0, 1e-49, 1e49, 1e308]


@pytest.mark.parametrize(
    ("options", "what"),
    [*(({"size": size}, "size") for size in SIZES), ({"tries": 0}, "tries"), ({"kind": "cone"}, "kind")],
)
def test_options_out_of_range_are_refused(options, what):
    with pytest.raises(InvariantError, match=what):
        realise(mechanism_from_map_id(FOUR_BAR), **options)


def test_a_closed_surface_is_refused():
    from graphs.convert.panels import scd_from_panels

    cube = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
    with pytest.raises(UnsolvableError, match="without a border"):
        realise(scd_from_panels(cube))


@pytest.mark.slow
@pytest.mark.parametrize(("links", "most"), [(4, 6), (6, 5), (8, 4)])
def test_every_type_of_a_size_is_drawn(links, most):
    for scd in scd_graphs(links, 1, most):
        assert next(drawings(pattern_of(scd), 0, 12), None) is not None, map_id(scd)


def test_a_chain_that_is_not_planar_is_refused():
    with pytest.raises(UnsolvableError, match="not planar"):
        realise(sc_from_link_joint_graph(nx.complete_bipartite_graph(3, 3)))


@pytest.mark.parametrize("code", ["k1:E`hW", "m1:ab.ac.bde.cfg.dg.ef"])
def test_ids_that_rows_hold_are_realised(code, tmp_path):
    """Read back, the panels are of the chain, with as many centres."""
    given, found = read(code), realise(read(code), tries=1)
    again = mechanism_from_map_id(_read_back(found, tmp_path))
    assert chain_id(again) == chain_id(given)
    assert len(again.centre_classes()) == len(given.centre_classes())


@pytest.mark.parametrize("kind", ["sheet", "space"])
def test_it_lies_where_its_sheet_does(kind):
    found = realise(mechanism_from_map_id(FOUR_BAR), kind=kind)
    at, again = found.configuration, configuration_of_sheet(found.sheet)
    assert at.to_json(at.branch(at.chosen)) == again.to_json(again.branch(again.chosen))
    told = found.to_json()["configuration"]
    assert (told["links"], told["loops"], told["branch"]) == (4, 1, None)
