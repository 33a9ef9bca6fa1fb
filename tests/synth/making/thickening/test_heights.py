"""Heights of hinges: Bennett's linkage at random vertices, contradictions named."""

import numpy as np
import pytest
from fans import fan

import synth
from graphs.errors import UnsolvableError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.thickening import hinge_heights, thick_vertices


def random_vertex(random):
    """A flat-foldable vertex of four creases, its assignment, and the rates of its creases on that branch."""
    while True:
        a, b = random.uniform(0.2, np.pi - 0.2, 2)
        first = int(random.integers(4))
        at = np.cumsum([0.0, a, b, np.pi - a])
        d = np.roll(np.column_stack([np.cos(at), np.sin(at)]), -first, axis=0)
        p, q = d[2] - d[0], d[1] + d[3]
        if min(abs(a - b), abs(a + b - np.pi)) > 0.1 and -p @ q > 0:
            ratio = -(p @ q) / (q @ q)
            rates = np.roll([-1.0, ratio, 1.0, ratio], first)
            return fan([a, b, np.pi - a, np.pi - b], "".join("V" if w > 0 else "M" for w in rates)), rates


def thick(sheet, change=0.0):
    """The thick linkage of a vertex, and that with one offset changed by a part of it."""
    at = configuration_of(sheet)
    heights = hinge_heights(at.sheet, at.mechanism, at.tolerances).hinges
    spread = max(heights.values()) - min(heights.values())
    axes = {}
    for place, joint in enumerate(at.mechanism.sc.joints):
        (x, y), up = at.linkage.points[place, :2] * at.linkage.extent + at.linkage.middle[:2], heights[joint]
        axes[joint] = (x, y, 0.1 * (up + (change * spread if joint == 0 else 0.0))), tuple(at.linkage.directions[place])
    return HingedSolids(SCGraph(at.mechanism.sc.nodes, at.mechanism.sc.joints), axes)


def check_vertices(number):
    random = np.random.default_rng(46)
    for _ in range(number):
        sheet, rates = random_vertex(random)
        closure = configuration_of(thick(sheet)).closure
        # The tangents of half the fold angles of a flat-foldable vertex of four creases keep their ratios.
        for driven in np.linspace(0.01, np.pi - 0.01, 12):
            angles = 2 * np.arctan(rates / abs(rates).max() * np.tan(driven / 2))
            assert abs(closure.at(angles)[0]).max() < 1e-9
        flat = np.linalg.svd(closure.at(np.zeros(4))[1].toarray(), compute_uv=False)
        assert (flat > 1e-9 * flat[0]).sum() == 3
        wrong = configuration_of(thick(sheet, 0.01)).closure
        spectrum = np.linalg.svd(wrong.at(np.zeros(4))[1].toarray(), compute_uv=False)
        assert (spectrum > 1e-9 * spectrum[0]).sum() == 4


def test_random_vertices_keep_the_fold_angles_of_the_thin_ones():
    check_vertices(25)


@pytest.mark.slow
def test_a_thousand_random_vertices_keep_the_fold_angles_of_the_thin_ones():
    check_vertices(1000)


@pytest.mark.parametrize("name", ["miura", "square-twist", "huffman-grid"])
def test_panels_leave_room_for_valleys_over_mountains(name):
    at = configuration_of(synth.generate(name).mechanism)
    heights = hinge_heights(at.sheet, at.mechanism, at.tolerances)
    assert heights.residual < 1e-12
    for joint, panels in at.mechanism.sc.joints.items():
        for panel in panels:
            above = heights.hinges[joint] - heights.undersides[panel]
            assert above > 1 - 1e-9 if at.sheet.assignments[joint] == "V" else above < 1e-9


def test_one_offset_wrong_by_a_percent_is_proved_rigid():
    random = np.random.default_rng(7)
    for _ in range(4):
        verdict = synth.mobility(thick(random_vertex(random)[0], 0.01)).verdict
        assert repr(verdict) == "<Verdict: 0 degrees of freedom, proved>"


def test_a_symmetric_vertex_of_six_creases_has_one_freedom_instead_of_three():
    sheet = fan([np.pi / 4, np.pi / 2, np.pi / 4] * 2, "MVVMVV")
    at = configuration_of(sheet)
    assert [one.linkage for one in thick_vertices(at.sheet, at.mechanism, at.tolerances)] == ["Bricard"]
    thin, solid = synth.mobility(sheet).verdict, synth.mobility(thick(sheet)).verdict
    assert "3 degrees of freedom" in str(thin)
    assert "1 degree of freedom" in str(solid)


def test_myards_vertex_of_five_creases_moves():
    last = np.radians(80.0)
    side = (np.pi - last) / 2
    for letters in ("VMMMM", "MVVVV", "VMVVM", "MVMMV"):
        sheet = fan([side, np.pi / 2, last, np.pi / 2, side], letters)
        assert "1 degree of freedom" in str(synth.mobility(thick(sheet)).verdict)


@pytest.mark.parametrize(
    ("sectors", "letters", "words"),
    [
        ([80, 70, 110, 100], "MVVV", "vertex 0: opposite sectors add up to 190 degrees"),
        ([80, 70, 100, 110], "MMVV", "vertex 0: 2 mountains of 4 creases; expected 1 or 3"),
        ([60, 70, 80, 75, 75], "MVVVV", "vertex 0 of 5 creases suits no linkage; expected sectors of Myard"),
        ([100, 120, 140], "MVV", "vertex 0 has 3 creases"),
    ],
)
def test_vertices_of_no_overconstrained_linkage_are_named(sectors, letters, words):
    with pytest.raises(UnsolvableError, match=words):
        thick(fan(np.radians(sectors), letters))


def test_conditions_that_exclude_each_other_are_named():
    at = configuration_of(synth.generate("map", rows=3, columns=3).mechanism)
    with pytest.raises(UnsolvableError, match=r"conditions of vertices 5, 10 and of panels .* exclude each other"):
        hinge_heights(at.sheet, at.mechanism, at.tolerances)
