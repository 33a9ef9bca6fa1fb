"""Known sheets made thick: folded to 179 degrees, or to the angle at which two panels meet, or the reason in a line."""

import numpy as np
import pytest
from fans import fan
from overlaps import volume_in_common

import synth
from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from synth.analysis.folding.symmetric_motion import folded_towards
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.thickening import hinge_heights
from synth.making.thickening.heights import of_motion


def opened_kresling_cell():
    """The generator's cell, cut along one crease and laid out in the plane, with the assignment of its fold angles."""
    cell = synth.generate("kresling").mechanism
    at = configuration_of(cell)
    turned = {frozenset(cell.edges[joint]): angle for joint, angle in zip(at.joints, at.linkage.angles, strict=True)}
    places = np.array(cell.coordinates)
    a, b, c = cell.faces[0]
    x, y = beside(*places[[a, b, c]])
    corners, number = [(0.0, 0.0), (float(np.linalg.norm(places[b] - places[a])), 0.0), (x, y)], {a: 0, b: 1, c: 2}
    faces, edges, marks = [(0, 1, 2)], [], ""
    for before, face in zip(cell.faces, cell.faces[1:], strict=False):
        a, b = (v for v in before if v in face)
        (apart,), (new,) = set(before) - set(face), set(face) - set(before)
        along, across = beside(*places[[a, b, new]])
        start, end, off = (np.array(corners[number[v]]) for v in (a, b, apart))
        unit = (end - start) / np.linalg.norm(end - start)
        left = np.array([-unit[1], unit[0]])
        there = start + along * unit - np.sign((off - start) @ left) * across * left
        edges.append((number[a], number[b]))
        marks += "V" if turned[frozenset((a, b))] > 0 else "M"
        number[new] = len(corners)
        corners.append(tuple(there.tolist()))
        faces.append(tuple(number[v] for v in face))
    return Sheet(len(corners), tuple(edges), marks, tuple(faces), tuple(corners))


def beside(start, end, point):
    """How far a point is along a line from its start, and across it."""
    along = (end - start) / np.linalg.norm(end - start)
    part = float((point - start) @ along)
    return part, float(np.linalg.norm(point - start - part * along))


def generated(name, **options):
    return lambda: synth.generate(name, **options).mechanism


def marked_map():
    """The map of 3 x 3 panels folded into three across its columns, then into three."""
    sheet = synth.generate("map", rows=3, columns=3).mechanism
    letters = list(sheet.assignments)
    places = np.array(sheet.coordinates)[:, :2]
    lines = sorted({round(float(x), 9) for x in places[:, 0]})
    for number, (a, b) in enumerate(sheet.edges):
        if letters[number] not in "MVU":
            continue
        upright = abs(places[a, 0] - places[b, 0]) < 1e-9
        if not upright:
            column = lines.index(round(float(min(places[a, 0], places[b, 0])), 9))
            first = places[a, 1] == sorted({float(y) for y in places[:, 1]})[1]
            letters[number] = "VM"[(column + first) % 2]
        else:
            letters[number] = "VM"[lines.index(round(float(places[a, 0]), 9)) % 2]
    return Sheet(sheet.vertices, sheet.edges, "".join(letters), sheet.faces, sheet.coordinates)


def realised(name):
    """A type of data/realised: drawn in the plane by `synth realise`, with nine decimals."""
    return lambda: synth.read(f"data/realised/{name}.fold")


FOLDED = {
    "waterbomb strip": generated("waterbomb", rows=1, columns=2),
    "waterbomb tessellation": generated("waterbomb", rows=2, columns=2),
    "chickenwire": generated("chickenwire"),
    **{name: realised(name) for name in (
        "chain-R", "chain-RR", "fig1", "fortune-teller", "ride-along", "table3-row1", "two-centres", "watt",
    )},
}  # fmt: skip
MEETING = {
    "Kresling cell": (opened_kresling_cell, (1, 3), 165.36),
    "map": (marked_map, (1, 3), 165.20),
    "yoshimura": (generated("yoshimura"), (1, 3), 133.98),
    **{
        name: (realised(name), panels, angle)
        for name, panels, angle in (
            ("adjunct-chain", (0, 7), 120.10), ("chain-RPR", (0, 3), 165.22), ("chain-RPS", (0, 2), 165.30),
            ("chain-RPU", (0, 4), 105.05), ("chain-RS", (0, 3), 165.20), ("chain-RSR", (1, 4), 110.35),
            ("double-strip", (2, 6), 120.04), ("six-bar-loop-spherical", (1, 2), 109.47),
        )
    },
}  # fmt: skip


def thick_by_extent(sheet):
    extent = float(np.ptp(np.array(sheet.coordinates), axis=0).max())
    return synth.thicken(sheet, thickness=0.01 * extent)


def check_until_meeting(thick):
    pytest.importorskip("manifold3d")
    for frame in range(len(thick.angles)):
        if frame < thick.collisions.meeting.place or thick.collisions.meeting.panels is None:
            assert thick.collisions.overlaps[frame] <= 1e-9 * thick.plates.volume
            assert volume_in_common(thick, frame) <= 1e-9 * thick.plates.volume


@pytest.mark.slow
@pytest.mark.parametrize("name", FOLDED)
def test_sheets_that_fold_to_179_degrees(name):
    thick = thick_by_extent(FOLDED[name]())
    assert thick.keeps_angles, name
    assert thick.collisions.meeting.panels is None
    assert np.degrees(thick.collisions.meeting.angle) > 178.999
    assert all(thick.hinge_lines.values())
    check_until_meeting(thick)


@pytest.mark.slow
@pytest.mark.parametrize("name", MEETING)
def test_sheets_that_fold_until_two_panels_meet(name):
    make, panels, angle = MEETING[name]
    thick = thick_by_extent(make())
    assert thick.collisions.meeting.panels == panels
    assert np.degrees(thick.collisions.meeting.angle) == pytest.approx(angle, abs=0.1)
    check_until_meeting(thick)


@pytest.mark.parametrize(
    ("sheet", "words"),
    [
        (generated("map", rows=3, columns=3), r"crease \d+ has the assignment U; expected M or V"),
        (generated("preliminary-base"), r"crease 1 has the assignment U; expected M or V"),
        (generated("kresling"), "the sheet is folded; expected a flat one"),
        (lambda: fan(np.radians([100, 120, 140]), "MVV"), "vertex 0 has 3 creases; expected 4, 5 or 6"),
        (realised("eight-bar"), "vertex 0: opposite sectors add up to 151.261 degrees; expected 180"),
        (realised("creased-four-bar"), "vertex 5 of 5 creases suits no linkage; expected sectors of Myard's linkage"),
        (realised("hybrid-ten-bar"), "vertex 7 of 6 creases suits no linkage; expected sectors and assignment"),
        (realised("fig12-scd"), "the loop of creases 3, 2, 1, 0 is not round a vertex; expected no holes"),
    ],
)
def test_the_reason_why_a_sheet_has_no_heights(sheet, words):
    with pytest.raises(UnsolvableError, match=words):
        synth.thicken(sheet(), thickness=0.01, collisions=False)


def test_six_creases_move_along_the_one_path_that_their_heights_choose():
    for angles in ([45, 90, 45], [40, 60, 80], [30, 85, 65]):
        sheet = fan(np.radians([*angles, *angles[::-1]]), "MVVMVV")
        assert "3 degrees of freedom" in str(synth.mobility(sheet).verdict)
        thick = synth.thicken(sheet, thickness=0.01, collisions=False)
        assert [one.linkage for one in thick.heights.vertices] == ["Bricard"]
        assert "1 degree of freedom" in str(thick.verdict)
        # A finite motion, at whose angles the thin sheet closes too: images of each other fold alike.
        assert thick.keeps_angles
        assert thick.residual < 1e-12
        assert np.degrees(abs(thick.angles).max()) > 60.0
        final = thick.angles[-1]
        assert np.allclose(final[[1, 2]], final[[5, 4]], atol=1e-9)


@pytest.mark.parametrize("name", ["double-strip", "fig1", "ride-along", "table3-row1", "watt"])
def test_rounded_coordinates_keep_the_fold_angles_of_the_thin_sheet(name):
    thick = synth.thicken(realised(name)(), thickness=0.01, collisions=False)
    assert thick.keeps_angles
    assert thick.residual < 1e-12
    assert thick.heights.residual < 1e-12
    assert np.degrees(abs(thick.angles).max()) > 178.999


def test_the_waterbomb_tessellation_moves_along_the_symmetric_motion_with_one_freedom():
    """Vertices of six creases that share creases agree on a motion if their heights do.

    At small angles with v the rate of valleys, D the mountains in a base fold by v cos 45 and W the borders of bases by
    3 v cos 45 degrees; moments of rates about the vertex between two bases vanish if D - W = -2 (V - W), V being valleys there.
    """
    sheet = synth.generate("waterbomb", rows=2, columns=2).mechanism
    thick = synth.thicken(sheet, thickness=0.1, collisions=False)
    assert thick.heights.of_motion
    assert thick.freedoms == 1
    assert thick.keeps_angles
    assert thick.residual < 1e-12
    assert np.degrees(abs(thick.angles).max()) > 178.999
    assert abs(thick.angles[-1]).min() > np.radians(140.0)  # every crease folds
    heights = thick.heights.hinges
    between = next(one for one in thick.heights.vertices if one.vertex == 4)
    middle, up, left_up, left, left_down, down = (heights[joint] for joint in between.joints)
    assert up == pytest.approx(down) == pytest.approx(left)
    assert left_up == pytest.approx(left_down)
    assert middle - left == pytest.approx(-2.0 * (left_up - left))
    # With each vertex by itself, mountains at one height and valleys at another, that motion does not close.
    at = configuration_of(sheet)
    alone = hinge_heights(at.sheet, at.mechanism, at.tolerances).hinges
    axes = {joint: ((x, y, alone[int(joint)] * 0.1), along) for joint, ((x, y, _), along) in thick.solids.axes.items()}
    closure = configuration_of(HingedSolids(thick.solids.chain, axes)).closure
    assert abs(closure.at(thick.angles[-1])[0]).max() > 1e-3
    # The file moves on its own, along the same motion.
    motion = synth.move(thick.solids, frames=3)
    assert motion.freedoms == 1
    assert np.degrees(abs(motion.path.angles[-1]).max()) == pytest.approx(179.0)
    assert motion.beside_thin()[1] < 1e-12


@pytest.mark.parametrize("how", ["mirrored", "rounded", "clockwise"])
def test_heights_of_a_motion_are_those_of_the_pattern_however_it_is_written(how):
    sheet = synth.generate("waterbomb", rows=2, columns=2).mechanism
    heights = synth.thicken(sheet, thickness=0.1, collisions=False).heights.hinges
    places, faces = np.array(sheet.coordinates)[:, :2], sheet.faces
    turn = np.array([[np.cos(0.5), np.sin(0.5)], [-np.sin(0.5), np.cos(0.5)]])
    if how == "mirrored":
        places = places * np.array([-1.0, 1.0])
    elif how == "rounded":
        places = (places @ turn).round(4)
    else:
        faces = tuple(face[::-1] for face in faces)
    other = Sheet(sheet.vertices, sheet.edges, sheet.assignments, faces, tuple(map(tuple, places.tolist())))
    thick = synth.thicken(other, thickness=0.1, collisions=False)
    assert thick.freedoms == 1
    assert thick.residual < 1e-12
    assert np.allclose([thick.heights.hinges[joint] for joint in heights], list(heights.values()), atol=1e-9)


def test_stretched_waterbombs_have_no_heights_that_keep_the_symmetric_motion():
    sheet = synth.generate("waterbomb", rows=2, columns=2).mechanism
    assert "no heights keep" not in str(synth.thicken(sheet, thickness=0.1, collisions=False))
    stretched = tuple((1.3 * x, y) for x, y, *_ in sheet.coordinates)
    wide = Sheet(sheet.vertices, sheet.edges, sheet.assignments, sheet.faces, stretched)
    thick = synth.thicken(wide, thickness=0.1, collisions=False)
    assert "no heights keep the symmetric motion of the thin sheet" in str(thick)
    assert thick.freedoms is None
    # At the vertex between two bases all heights have to be equal along that motion.
    at = configuration_of(wide)
    motion = folded_towards(at.sheet, np.radians(120.0), 12)
    between = next(one for one in thick.heights.vertices if one.vertex == 4)
    assert len(of_motion(between, list(at.mechanism.sc.joints), motion.path.angles).rows) == 5


def test_a_vertex_of_eight_creases_keeps_a_motion():
    thick = synth.thicken(realised("fortune-teller")(), thickness=0.01, collisions=False)
    assert sorted(one.linkage for one in thick.heights.vertices) == ["", *["Bennett"] * 4]
    assert thick.keeps_angles
    assert thick.residual < 1e-12
    assert "4 Bennett vertices, 1 other vertex" in str(thick)
