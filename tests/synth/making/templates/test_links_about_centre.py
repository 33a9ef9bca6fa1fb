"""Templates of spherical linkages: pieces have the angles of their links, and close where joints are taped."""

from itertools import combinations

import numpy as np
import pytest
import shapely

import synth
from graphs.errors import UnsolvableError
from graphs.files.formats import mechanism_of_id
from graphs.geometry import angles_between, unit
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.catalogue.patterns._generate import generate
from synth.making.templates.template import template_of_axes
from synth.making.templates.unfolding import Panels, panels_about_centre

CHAINS = ("k1:Cr", "k1:E`hW", "k1:E@zO")


def random_linkage(code, seed, shift=0.0):
    chain = mechanism_of_id(code)
    rng = np.random.default_rng(seed)
    centre = shift * rng.normal(size=3)
    axes = {}
    for joint in chain.joints:
        direction = rng.normal(size=3)
        axes[joint] = (tuple(centre + shift * rng.normal() * direction), tuple(direction))
    return HingedSolids(chain, axes)


def cone_angles(corners):
    """The angles at the first corner of triangles."""
    return angles_between(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


@pytest.mark.parametrize("code", CHAINS)
@pytest.mark.parametrize("shift", [0.0, 3.0])
def test_panels_lie_between_the_axes_of_their_links(code, shift):
    linkage = random_linkage(code, 3, shift)
    sheet, joints = panels_about_centre(linkage)
    directions = {joint: unit(axis) for joint, (_, axis) in linkage.axes.items()}
    places = np.array(sheet.coordinates)
    for (centre, tip), joint in joints.items():
        assert np.linalg.norm(np.cross(places[tip] - places[centre], directions[joint])) < 1e-9
    of_link = {centre: {joints[edge] for edge in joints if edge[0] == centre} for centre, _ in joints}
    at_link = [{joint for joint, ends in linkage.chain.joints.items() if link in ends} for link in linkage.chain]
    assert sorted(map(sorted, of_link.values())) == sorted(map(sorted, at_link))
    for centre, here in of_link.items():  # a triangle, or all sides of a pyramid
        assert sum(face[0] == centre for face in sheet.faces) == (1 if len(here) == 2 else len(here))


@pytest.mark.parametrize("code", CHAINS)
def test_points_that_are_the_centre_but_for_rounding_make_no_tiny_panels(code):
    linkage = random_linkage(code, 3)
    rng = np.random.default_rng(1)
    axes = {joint: (tuple(1e-17 * rng.normal(size=3)), axis) for joint, (_, axis) in linkage.axes.items()}
    exact, rounded = (
        np.array(panels_about_centre(one)[0].coordinates) for one in (linkage, HingedSolids(linkage.chain, axes))
    )
    np.testing.assert_allclose(rounded, exact, atol=1e-12)


@pytest.mark.parametrize("code", CHAINS)
def test_ends_are_those_nearest_to_each_other(code):
    """No other choice of the ends of axes has a smaller sum of the angles in links."""
    linkage = random_linkage(code, 5)
    sheet, joints = panels_about_centre(linkage)
    places = np.array(sheet.coordinates)
    tips = {joint: unit(places[tip] - places[centre]) for (centre, tip), joint in joints.items()}
    pairs = [
        (a, b)
        for link in linkage.chain
        for a, b in combinations([joint for joint, ends in linkage.chain.joints.items() if link in ends], 2)
    ]

    def total(signs):
        return sum(float(angles_between(signs[a] * tips[a], signs[b] * tips[b])) for a, b in pairs)

    least = total(dict.fromkeys(tips, 1.0))
    rng = np.random.default_rng(0)
    for _ in range(100):
        assert least <= total(dict(zip(tips, rng.choice([-1.0, 1.0], len(tips)), strict=True))) + 1e-9


@pytest.mark.parametrize("code", CHAINS)
def test_pieces_have_the_area_and_the_names_of_their_links(code):
    linkage = random_linkage(code, 4)
    pieces, sheet = template_of_axes(linkage, size=150.0, tabs=0.0)
    assert len(pieces.pieces) == len(linkage.chain)
    size = pieces.scale
    panels = Panels(sheet, np.array(sheet.coordinates) * size)
    angles = cone_angles(panels.places[np.array(sheet.faces)])
    area = sum(shapely.area(shape) for piece in pieces.pieces for shape in [piece.covered])
    np.testing.assert_allclose(area, 0.5 * size**2 * np.sin(angles).sum(), rtol=1e-6)
    written = [{text.words for text in piece.texts if text.words.startswith("J")} for piece in pieces.pieces]
    wanted = [{f"J{joint}" for joint, ends in linkage.chain.joints.items() if link in ends} for link in linkage.chain]
    assert sorted(map(sorted, written)) == sorted(map(sorted, wanted))
    assert pieces.steps[-1].startswith("Tape edges of the same name, J0 to J")


def test_a_design_becomes_a_template_in_one_call(tmp_path):
    """From a wish to paper: a four-bar whose follower turns by 50 degrees while the crank turns by 40."""
    linkage = generate("four-bar").mechanism
    result = synth.template(linkage, size=120)
    assert len(result.pieces) == 4
    assert result.configuration is not None
    assert result.picture is not None
    synth.write_template(result, tmp_path / "four-bar.pdf")
    assert (tmp_path / "four-bar.pdf").stat().st_size > 1000


def test_what_has_no_template_says_why():
    with pytest.raises(UnsolvableError, match="only those whose axes meet in one point have a template"):
        synth.template(generate("bennett").mechanism)
    door = HingedSolids(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    with pytest.raises(UnsolvableError, match="only those whose axes meet"):
        synth.template(door)
    with pytest.raises(UnsolvableError, match="require panels or a type"):
        synth.template(generate("four-bar").mechanism, kind="sheet")
