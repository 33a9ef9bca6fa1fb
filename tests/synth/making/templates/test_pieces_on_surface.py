"""Links of conical linkages as flat pieces, rolled up again: on the cone, in their layers, without meeting."""

from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest
import shapely
import shapely.affinity
from commands import run
from conical import FOUR_BAR, STEPHENSON, WATT
from sizes import first_quick

from graphs.errors import UnsolvableError
from graphs.mechanism.surfaces import Cone, Cylinder, SurfaceLinkage
from synth.linkages.conformed.linkage_behaviour import OnSurface, loop_of_steps
from synth.making.templates.on_surface import LayeredLinkage, TemplateSizes, surface_of, template_on_surface
from synth.making.templates.pages import Paper, laid_out, nested, pages_of
from synth.making.templates.template import linkage_on_a_surface
from synth.synthesis.candidates.job import CandidateJob

LAMBDA = np.radians(28)
SIZES = TemplateSizes(size=90, thickness=0.4)
CHAINS = {"watt": WATT, "stephenson": STEPHENSON}


@cache
def candidates(name):
    """Every candidate of a chain, evenly spaced."""
    chain = CHAINS[name]
    job = CandidateJob(chain)
    return [OnSurface(chain, job.places(row).tolist(), LAMBDA) for row in job.rows()]


def rolled_up(points, layer):
    """Azimuths (from the middle of the piece on), lengths and heights where paper lies that is rolled to its cone.

    By the cone of the layer alone, not by what drew the piece: it lies as far outside as layers are apart, its
    apex therefore further along the axis; lengths along ruling lines stay, turns in the plane become azimuths.
    """
    height = 3 * SIZES.thickness * layer
    radius = np.hypot(*points.T)
    azimuth = np.arctan2(-points[:, 0], points[:, 1]) / np.cos(LAMBDA)
    apex = height / np.cos(LAMBDA)
    across, along_axis = radius * np.cos(LAMBDA), apex - radius * np.sin(LAMBDA)
    # back to the ruling lines of the reference cone, whose apex is the origin
    length = across * np.cos(LAMBDA) - along_axis * np.sin(LAMBDA)
    off = across * np.sin(LAMBDA) + along_axis * np.cos(LAMBDA)
    return np.column_stack([azimuth, length]), off


def check_pieces(linkage):
    made = LayeredLinkage(linkage, Cone(LAMBDA), SIZES)
    pieces = template_on_surface(linkage, Cone(LAMBDA), SIZES).pieces[1:]
    assert len(pieces) == len(linkage.chain)
    joints = {
        str(joint): place % (2 * np.pi) for joint, place in zip(linkage.chain.joints, linkage.places, strict=True)
    }
    taken, ends = {}, {}
    for link, piece in zip(made.links, pieces, strict=True):
        strokes = np.array([(one.start, one.end) for one in piece.strokes])
        flat, off = rolled_up(strokes.reshape(-1, 2), link.layer)
        np.testing.assert_allclose(off, 3 * SIZES.thickness * link.layer, atol=1e-9)  # on the cone of its layer
        middle = link.start + link.width / 2
        area = rolled_area(piece, link.layer)
        taken.setdefault(link.layer, []).append((middle, area))
        rulings = [middle + one[0, 0] for one in flat.reshape(-1, 2, 2) if np.ptp(one[:, 0]) < 1e-9]
        ends[link.name] = rulings
        own = [str(joint) for joint, pair in linkage.chain.joints.items() if link.name in map(str, pair)]
        for joint in own:  # each has a line where the joint's axis is
            assert min(abs(np.angle(np.exp(1j * (joints[joint] - one)))) for one in rulings) < 1e-9
    for layer in taken.values():
        for (one, first), (other, second) in combinations(layer, 2):
            for turn in (-2, -1, 0, 1, 2):
                moved = shapely.affinity.translate(second, other - one + 2 * np.pi * turn, 0)
                assert first.intersection(moved).area < 1e-6
    for joining in made.joinings:
        between = sorted((made.links[joining.tabbed].layer, made.links[joining.other].layer))
        for layer in range(between[0] + 1, between[1]):
            line = shapely.LineString([(0, SIZES.tab_ends[0]), (0, SIZES.tab_ends[1])])
            for middle, area in taken[layer]:
                for turn in (-1, 0, 1):
                    at = joints[joining.joint] - middle + 2 * np.pi * turn
                    assert not area.intersects(shapely.affinity.translate(line, at, 0))
    return made


def rolled_area(piece, layer):
    """The part of the ruling lines that a piece takes without its tabs, as azimuths and lengths."""
    folds = [np.array([one.start, one.end]) for one in piece.strokes if one.kind not in ("CUT", "MARKS")]
    whole = shapely.transform(piece.covered, lambda points: rolled_up(points, layer)[0])
    for fold in folds:
        (at, _), _ = rolled_up(fold, layer)
        tab = shapely.box(at[0], 0, at[0] + np.sign(at[0]) * 10, 1e3)
        whole = whole.difference(tab)
    return whole


@pytest.mark.parametrize("name", first_quick(1, CHAINS))
def test_pieces_of_candidates_rolled_up_lie_on_the_cone_in_their_layers_without_meeting(name):
    made = [check_pieces(linkage) for linkage in candidates(name)[::34]]
    assert max(link.layer for one in made for link in one.links) >= 2
    assert any(link.slots for one in made for link in one.links)


@pytest.mark.slow
@pytest.mark.parametrize("name", CHAINS)
def test_pieces_of_every_candidate_lie_on_the_cone_in_their_layers_without_meeting(name):
    for linkage in candidates(name):
        check_pieces(linkage)
        rng = np.random.default_rng(int(1e6 * sum(linkage.places)))
        varied = np.array(linkage.places) + rng.uniform(-0.2, 0.2, len(linkage.places))
        check_pieces(OnSurface(linkage.chain, varied.tolist(), LAMBDA))


def test_a_tab_lies_on_the_link_that_it_is_glued_to_and_off_all_other_tabs():
    for linkage in candidates("watt")[::16]:
        made = LayeredLinkage(linkage, Cone(LAMBDA), SIZES)
        spans = []
        for one in made.joinings:
            if not one.side:
                continue
            other, at = made.links[one.other], made.places[one.joint]
            side = -one.side if one.folded else one.side
            first, last = sorted((at, at + side * made.tab))
            spans.append((first, last))
            along = (first - other.start + 1e-9) % (2 * np.pi)
            assert along + made.tab <= other.width + 1e-6
        for (a, b), (c, d) in combinations(spans, 2):
            assert all(min(b, d + turn) <= max(a, c + turn) for turn in (-2 * np.pi, 0, 2 * np.pi))


def test_the_surface_is_a_sector_whose_arc_is_the_circle_that_it_becomes():
    linkage = candidates("stephenson")[0]
    surface = template_on_surface(linkage, Cone(LAMBDA), SIZES).pieces[0]
    radius = np.hypot(*np.array([one.start for one in surface.strokes if one.kind == "CUT"]).T)
    outer = [one for one in surface.strokes if min(np.hypot(*one.start), np.hypot(*one.end)) > radius.max() - 1e-6]
    length = sum(np.hypot(*np.subtract(one.end, one.start)) for one in outer if one.kind == "CUT")
    height = -3 * SIZES.thickness  # below the links
    rim = (SIZES.size * np.cos(LAMBDA) + height * np.sin(LAMBDA)) * 2 * np.pi
    assert length == pytest.approx(rim, abs=0.05)
    assert sum(one.kind == "MARKS" for one in surface.strokes) == len(linkage.places)


def test_on_a_cylinder_pieces_are_as_wide_as_their_arcs_in_their_layers():
    linkage = loop_of_steps(np.radians([40, 50, 50]))
    made = LayeredLinkage(linkage, Cylinder(30.0), SIZES)
    _, *pieces = template_on_surface(linkage, surface_of(linkage, 30.0), SIZES).pieces
    for link, piece in zip(made.links, pieces, strict=True):
        tabs = sum(one.side != 0 and one.tabbed == made.links.index(link) for one in made.joinings)
        radius = 30 + 3 * SIZES.thickness * link.layer
        assert piece.size[0] == pytest.approx(radius * (link.width + tabs * made.tab), abs=1e-6)
        assert piece.size[1] == pytest.approx(SIZES.ends[1] - SIZES.ends[0])


def test_a_row_of_candidates_prints_with_the_angle_that_is_asked_for(tmp_path, data):
    run("enumerate", "conical", "--chain", data / "wiener" / "watt.json", "-o", tmp_path / "watt.jsonl", "--quiet")
    words = ("template", tmp_path / "watt.jsonl", "--row", 5, "--size", 90, "-o", tmp_path / "a.svg")
    assert "--lambda" in run(*words, code=2).stderr
    assert "of linkages on cones only" not in run(*words, "--lambda", 25).stderr
    assert (tmp_path / "a-note.svg").exists()
    assert "--as are for types" in run(*words, "--as", "space", "--force", code=2).stderr
    assert "--slots: for panels only" in run(*words, "--slots", "--force", code=2).stderr


def test_of_several_cones_one_has_to_be_asked_for():
    arcs = np.radians([120, 95, 45, 85])
    pairs = [tuple(pair) for pair in ("CO", "OA", "AB", "BC")]
    two = SurfaceLinkage(FOUR_BAR, angles=dict(zip(pairs, arcs.tolist(), strict=True)))
    with pytest.raises(UnsolvableError, match=r"lies on 2 cones, .*: --cone is required"):
        linkage_on_a_surface(two)
    assert linkage_on_a_surface(two, number=2).cone_angle != linkage_on_a_surface(two, number=1).cone_angle
    with pytest.raises(UnsolvableError, match="expected --cone of 2 at most, got 3"):
        linkage_on_a_surface(two, number=3)


def test_joints_on_one_ruling_line_have_no_room():
    with pytest.raises(UnsolvableError, match="on one ruling line"):
        LayeredLinkage(loop_of_steps(np.radians([40, -40, 90])), Cone(LAMBDA), SIZES)


def test_pages_hold_every_piece_and_the_note_every_joint():
    linkage = candidates("watt")[3]
    template = template_on_surface(linkage, Cone(LAMBDA), SIZES, "watt")
    pages = pages_of(template, Paper(210, 297))
    words = [text.words for text in pages[-1].texts]
    for joint in linkage.chain.joints:
        assert sum(f"Joint {joint}:" in word for word in words) == 1
    assert pages[-1].picture is not None
    named = [text.words for page in pages[:-1] for text in page.texts]
    for link in linkage.chain:
        assert sum(word.startswith(f"{link}, layer") for word in named) == 1


def test_pieces_of_a_linkage_lie_in_each_others_bays_where_that_saves_a_page():
    """All on one page, 6 mm apart and within its window, where rows of boxes take two."""
    chain = OnSurface(FOUR_BAR, np.radians([0, 80, 280, 190]).tolist(), np.radians(65))
    template = template_on_surface(chain, Cone(np.radians(65)), TemplateSizes(size=90))
    window = Paper(210, 297).window
    pieces = [piece.at_origin() for piece in template.pieces]
    assert len(list(laid_out(pieces, *window))) == 2
    (laid,) = nested(pieces, *window)
    placed = [piece.moved(right, up) for piece, right, up in laid]
    assert len(placed) == len(pieces)
    for piece in placed:
        left, low, right, high = piece.box
        assert min(left, low) > -1e-9
        assert right <= window[0] + 1e-9
        assert high <= window[1] + 1e-9
    assert all(one.covered.distance(other.covered) >= 6.0 - 1e-9 for one, other in combinations(placed, 2))
    assert len(pages_of(replace(template, steps=()), Paper(210, 297))) == 1
