"""Known sheets made thick: folded to 179 degrees, or to the angle at which two panels meet, or the reason in a line."""

import numpy as np
import pytest
from fans import fan
from overlaps import volume_in_common

import synth
from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet


def opened_kresling_cell(sides=3):
    """Triangles of a storey of Kresling's pattern side by side in the plane: all its vertices are on the border."""
    low = [(float(i), 0.0) for i in range(sides + 1)]
    high = [(i + 0.5, 0.8) for i in range(sides + 1)]
    top = sides + 1
    faces = [face for i in range(sides) for face in ((i, i + 1, top + i), (i + 1, top + i + 1, top + i))]
    diagonals = [(i + 1, top + i) for i in range(sides)]
    uprights = [(i + 1, top + i + 1) for i in range(sides - 1)]
    marks = "M" * sides + "V" * (sides - 1)
    return Sheet(2 * top, (*diagonals, *uprights), marks, tuple(faces), (*low, *high))


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


FOLDED = [
    ("waterbomb strip", generated("waterbomb", rows=1, columns=2)),
    ("Kresling cell", opened_kresling_cell),
    ("chickenwire", generated("chickenwire")),
    *((f"chain-{name}", lambda name=name: synth.read(f"data/realised/chain-{name}.fold")) for name in ("R", "RR")),
]
MEETING = {
    "map": (marked_map, (1, 3), 165.20),
    "yoshimura": (generated("yoshimura"), (0, 3), 135.14),
    **{
        f"chain-{name}": (lambda name=name: synth.read(f"data/realised/chain-{name}.fold"), panels, angle)
        for name, panels, angle in (
            ("RPR", (0, 3), 165.22), ("RPS", (0, 2), 165.30), ("RPU", (0, 4), 105.05), ("RS", (0, 3), 165.20),
            ("RSR", (1, 4), 110.35),
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
@pytest.mark.parametrize(("name", "make"), FOLDED, ids=[name for name, _ in FOLDED])
def test_sheets_that_fold_to_179_degrees(name, make):
    thick = thick_by_extent(make())
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
