"""Folding crease patterns: closed forms, rigid panels, limits, files, the command line, bad input."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commands import run
from creased import is_zigzag
from sizes import slow

import synth
from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import FileError, InvariantError, SynthedraError, UnsolvableError
from graphs.files.formats import read, read_all
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, sides_of_face
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.motion import fold
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes, linkage_of_sheet
from synth.analysis.motion.path import PathOptions, driven_path
from synth.catalogue.patterns.creases import fan, miura
from synth.making.drawing.space.motion_files import write_motion

ROOT = Path(__file__).resolve().parents[4]
VERTEX = fan(np.radians([0, 60, 180, 300]), "MVVV")


@pytest.mark.parametrize(
    ("rows", "columns", "sector"),
    [
        (2, 2, 60),
        slow(3, 4, 35),
        pytest.param(4, 3, 80, marks=pytest.mark.slow),
        pytest.param(10, 10, 60, marks=pytest.mark.slow),
    ],
)
def test_a_miura_sheet_folds_by_its_formula(rows, columns, sector):
    sheet = miura(rows, columns, np.radians(sector))
    joints = tuple(mechanism_of_sheet(sheet).sc.joints)
    zigzag = is_zigzag(sheet, joints)
    driven = joints[int(np.flatnonzero(zigzag)[0])]
    sign = 1.0 if sheet.assignments[driven] == "V" else -1.0
    folded = fold(sheet, drive={driven: sign * np.radians(179)}, frames=179)
    assert folded.path.stopped == ""
    assert folded.closure < 1e-12
    assert folded.apart < 1e-12 * len(joints)
    a = np.radians(np.arange(180.0))[:, None]
    b = 2.0 * np.arctan(np.cos(np.radians(sector)) * np.tan(a / 2))
    expected = np.where(zigzag, a, b) * [1.0 if sheet.assignments[joint] == "V" else -1.0 for joint in joints]
    assert np.abs(folded.path.angles - expected).max() < 1e-11


def test_a_file_without_coordinates_in_its_first_frame_folds_from_the_next(tmp_path):
    """As `move` and the command do."""
    file = tmp_path / "series.fold"
    places = [[*map(float, place)] for place in VERTEX.coordinates]
    document = {
        "vertices_edges": [[] for _ in places],
        "edges_vertices": VERTEX.edges,
        "edges_assignment": list(VERTEX.assignments),
        "faces_vertices": VERTEX.faces,
        "file_frames": [{"frame_parent": 0, "frame_inherit": True, "vertices_coords": places}],
    }
    file.write_text(json.dumps(document))
    sheet = read(file)
    assert sheet.coordinates is None
    driven = {0: np.radians(-30.0)}
    expected = fold(VERTEX, drive=driven, frames=2).path.angles
    np.testing.assert_array_equal(fold(sheet, drive=driven, frames=2).path.angles, expected)
    np.testing.assert_array_equal(synth.move(sheet, drive=driven, frames=2).path.angles, expected)


def test_panels_stay_rigid(data):
    sheet = read(data / "patterns" / "bird-base.fold")
    folded = fold(sheet, frames=6)
    assert folded.apart < 1e-12
    assert folded.freedoms == 5
    flat = np.zeros((sheet.vertices, 3))
    flat[:, :2] = sheet.coordinates
    for frame in folded.places:
        for face in sheet.faces:
            for a, b in sides_of_face(face):
                assert np.linalg.norm(frame[a] - frame[b]) == pytest.approx(
                    np.linalg.norm(flat[a] - flat[b]), abs=1e-12
                )
    last = folded.frames()[-1]
    column = {joint: place for place, joint in enumerate(folded.joints)}
    again = linkage_of_sheet(last)
    assert again.angles == pytest.approx(folded.path.angles[-1], abs=1e-9)
    assert last.fold_angles[folded.joints[0]] == pytest.approx(folded.path.angles[-1][column[folded.joints[0]]])


def test_signs_of_the_file_choose_the_branch():
    for letters in ("MVVV", "VMMM"):
        folded = fold(fan(np.radians([0, 60, 180, 300]), letters), frames=2)
        signs = [1 if letter == "V" else -1 for letter in letters]
        assert np.sign(folded.path.angles[-1]).tolist() in (signs, [-s for s in signs])
    both = [np.sign(fold(VERTEX, branch=k, frames=1).path.angles[-1]).tolist() for k in range(2)]
    assert both[0] not in (both[1], [-s for s in both[1]])


def test_several_creases_are_driven_together():
    star = fan(np.radians([0, 50, 130, 180, 250, 310]), "VVVVVV")
    asked = {0: np.radians(20), 2: np.radians(35), 4: np.radians(-15)}
    folded = fold(star, drive=asked, frames=4)
    assert folded.path.stopped == ""
    assert {joint: folded.path.angles[-1][joint] for joint in asked} == pytest.approx(asked, abs=1e-12)
    closure = ClosureEquations(folded.linkage)
    assert max(closure.error(angles) for angles in folded.path.angles) == folded.closure < 1e-12
    assert folded.apart < 1e-11


def test_a_direction_is_followed_straight_on():
    """Six creases have three freedoms: two rates that are given leave one, which is as little as may be."""
    star = fan(np.radians([0, 50, 130, 180, 250, 310]), "VVVVVV")
    folded = fold(star, along={0: 2.0, 3: -1.0}, frames=40)
    begun = folded.path.angles[1]
    assert begun[3] / begun[0] == pytest.approx(-0.5, abs=0.02)
    chords = np.diff(folded.path.angles, axis=0)
    chords /= np.linalg.norm(chords, axis=1, keepdims=True)
    assert (chords[1:] * chords[:-1]).sum(axis=1).min() > 0.99
    assert folded.closure < 1e-12
    assert folded.apart < 1e-11


def test_a_direction_chooses_the_way_that_points_along_it():
    sheet = miura(3, 3, 1.0)
    ways = configuration_of_sheet(sheet).branches.branches
    joints = tuple(mechanism_of_sheet(sheet).sc.joints)
    for number, way in enumerate(ways):
        along = {joint: rate for joint, rate in zip(joints, way.rates.tolist(), strict=True) if abs(rate) > 1e-7}
        assert fold(sheet, along=along, frames=1).branch == number


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({"along": {9: 1.0}}, "9 is no joint"),
        ({"along": {0: 0.0}}, "expected finite ones, not all zero"),
        ({"along": {0: float("nan")}}, "expected finite ones, not all zero"),
        ({"along": {0: 1.0}, "drive": {1: 1.0}}, "rates or angles, not both"),
        ({"along": {0: 1.0, 1: 1.0, 2: 5.0, 3: 1.0}}, "cannot begin to turn in these proportions"),
    ],
)
def test_directions_that_are_none_are_refused(asked, told):
    with pytest.raises(SynthedraError, match=told):
        fold(VERTEX, **asked)


def test_angles_that_one_freedom_cannot_reach_together_are_refused(data):
    sheet = read(data / "realised" / "two-centres.fold")
    with pytest.raises(SynthedraError, match="cannot begin to turn in these proportions on this branch"):
        fold(sheet, drive={2: 1.0, 0: -0.8})


def test_a_joint_turns_back_where_it_must():
    """A planar crank and rocker: the rocker's end is where crank and coupler lie in line."""
    graph = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    places = [(0, 0, 0), (0, 1, 0), (3.0, 2.5, 0), (4, 0, 0)]
    linkage = linkage_of_axes(graph, {j: (places[j], (0, 0, 1)) for j in range(4)})
    crank, coupler = 1.0, np.hypot(3.0, 1.5)
    rocker, ground = np.hypot(1.0, 2.5), 4.0
    closure = ClosureEquations(linkage)
    path = driven_path(closure, linkage.angles, [3], np.radians(np.arange(1, 120)))
    assert "turns back" in path.stopped
    start = np.arctan2(2.5, -1.0)
    reached = start - path.angles[:, 3].max()  # the joint's second link is the ground
    at_end = [
        np.pi - np.arccos((ground**2 + rocker**2 - reach**2) / (2 * ground * rocker))
        for reach in (coupler - crank, coupler + crank)
    ]
    assert min(abs(end - reached) for end in at_end) < np.radians(1.5)


def test_panels_do_not_pass_each_other():
    folded = fold(VERTEX, drive={1: np.pi}, frames=5)
    assert np.abs(folded.path.angles).max() <= np.pi + 1e-8
    linkage = linkage_of_sheet(VERTEX)
    options = PathOptions(folded.branches.branches[folded.branch].rates, np.ones(4, dtype=bool))
    path = driven_path(ClosureEquations(linkage), linkage.angles, [0], [-3.0, -3.2], options=options)
    assert path.stopped


@pytest.mark.parametrize(("off", "frames"), [(0.0, 4), (1e-13, 4), (1e-5, 1)])
def test_panels_that_do_not_hold_together_are_not_answered(off, frames, monkeypatch):
    """Two panels with a crease of two pieces, in line or a little bent: then, if left so, they hinge on neither."""
    monkeypatch.setattr("synth.analysis.folding.configuration._mended", lambda written: written)
    places = ((0, -1), (0 + off, 0), (0, 1), (-1, 1), (-1, -1), (1, -1), (1, 1))
    folded = fold(Sheet(7, ((0, 1), (1, 2)), "VV", ((0, 1, 2, 3, 4), (0, 5, 6, 2, 1)), places), frames=3)
    assert len(folded.path.angles) == len(folded.places) == frames
    assert folded.apart <= 1e-10
    assert ("panels come apart" in folded.path.stopped) == (frames == 1)


def test_the_sides_of_slits_come_apart():
    """A card with two slits across its fold and a strip between them: two ways from flat, of one freedom each."""
    places = ((0, 0), (2, 0), (4, 0), (4, 4), (2, 4), (0, 4), (1, 1), (2, 1), (3, 1), (1, 2), (2, 2), (3, 2))
    faces = ((0, 1, 7, 6, 9, 10, 4, 5), (1, 2, 3, 4, 10, 11, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10))
    edges = ((1, 7), (10, 4), (6, 9), (8, 11), (7, 10), (6, 7), (7, 8), (9, 10), (10, 11))
    folded = fold(Sheet(12, edges, "UUUUUCCCC", faces, places), drive={0: 1.0}, branch=0, frames=4)
    assert [branch.freedoms for branch in folded.branches.branches] == [1, 1]
    assert folded.configuration.sheet.vertices == 14
    assert folded.path.stopped == ""
    assert max(folded.apart, folded.closure) < 1e-12
    heights = [np.ptp(folded.places[-1][[first, second]], axis=0).max() for first, second in ((7, 12), (10, 13))]
    other = fold(Sheet(12, edges, "UUUUUCCCC", faces, places), drive={0: 1.0}, branch=1, frames=4)
    assert max(heights) > 0.1 or np.ptp(other.places[-1][[7, 12]], axis=0).max() > 0.1


def test_what_cannot_be_folded_is_refused(data):
    with pytest.raises(UnsolvableError, match="no motion begins"):
        fold(fan(np.radians([0, 30, 70, 100])))
    with pytest.raises(UnsolvableError, match="no creases"):
        fold(Sheet(3, (), "", ((0, 1, 2),), ((0, 0), (1, 0), (0, 1))))
    with pytest.raises(UnsolvableError, match=r"the sheet has none; try `synth realise`, in Python synth\.realise"):
        fold(Sheet(3, (), "", ((0, 1, 2),)))
    with pytest.raises(InvariantError, match="9 is no joint"):
        fold(VERTEX, drive={9: 1.0})
    with pytest.raises(InvariantError, match="between -180 and 180"):
        fold(VERTEX, drive={1: 4.0})
    with pytest.raises(InvariantError, match="no branch 7; expected one from 0 to 1"):
        fold(VERTEX, branch=7)
    with pytest.raises(InvariantError, match="no branch has the signs"):
        fold(VERTEX, branch="++++")
    bent = fan(np.radians([0, 60, 180, 300]))
    raised = Sheet(
        5, bent.edges, bent.assignments, bent.faces, tuple((*p, 0.1 * k) for k, p in enumerate(bent.coordinates))
    )
    assert fold(raised, drive={0: float(linkage_of_sheet(raised).angles[0]) + 0.05}, frames=1).closure < 1e-12


def test_a_no_for_rounded_coordinates_says_so():
    """Nine panels of which two inner corners were moved are rigid, but for what rounding may hide."""
    sheet = miura(3, 3, np.radians(50))
    places = [(round(x, 5), round(y, 5)) for x, y in sheet.coordinates]
    places[5], places[10] = (0.77137, 1.64113), (1.50231, 1.90417)
    with pytest.raises(
        UnsolvableError,
        match=r"no motion begins .* within the drawing.s precision, .*; the nearest rigid-foldable pattern .* times",
    ):
        fold(replace(sheet, coordinates=tuple(places)))
    with pytest.raises(UnsolvableError, match=r"no motion begins at this configuration \(proved: .*\)$"):
        fold(fan(np.radians([0, 30, 70, 100])))


def test_files_hold_every_pose(tmp_path):
    folded = synth.fold(VERTEX, drive={1: np.radians(90)}, frames=3)
    [place] = write_motion(folded, tmp_path / "folded.fold")
    sheet = read(place)
    assert sheet.frames.others == 4
    pose = sheet.frames.frame(4)
    np.testing.assert_allclose(pose.coordinates, folded.places[-1], atol=1e-12)
    assert pose.fold_angles[1] == pytest.approx(np.pi / 2)
    assert synth.mobility(sheet, frame=4).infinitesimal.dof == 1
    assert [p.name for p in write_motion(folded, tmp_path / "f.obj")] == [f"f-{k:03d}.obj" for k in range(4)]
    assert len(list(read_all(tmp_path / "f-003.obj"))) == 1
    with pytest.raises(FileError, match="exists already"):
        write_motion(folded, tmp_path / "folded.fold")
    with pytest.raises(
        FileError, match=r"files ending in '.txt' are not known; expected one of .fold .obj .gif .png .svg"
    ):
        write_motion(folded, tmp_path / "folded.txt")


def test_the_command_line(tmp_path, data):
    bird = data / "patterns" / "bird-base.fold"
    listed = run("fold", bird, "--branches", "--frames", 2).stdout
    assert "16 folding branches from the flat state (" in listed
    told = json.loads(run("fold", bird, "--drive", "0=20", "--branch", 3, "--frames", 2, "--json").stdout)
    assert {"freedoms", "branches", "exhaustive", "frames", "closure", "stopped"} <= set(told)
    assert (told["freedoms"], len(told["branches"]), told["frames"], told["branch"]) == (5, 16, 3, 3)
    assert told["joint_angles_deg"]["0"] == pytest.approx([0, 10, 20])
    out = tmp_path / "out.fold"
    run("fold", data / "patterns" / "four-bar-vertex.fold", "--frames", 2, "-o", out)
    assert read(out).frames.others == 3
    assert "frames after the first." in run("fold", "--help").stdout
    assert "'99' is no joint" in run("fold", bird, "--drive", "99=1", code=2).stderr
    assert "JOINT=DEGREES" in run("fold", bird, "--drive", "1", code=2).stderr
    assert "exclude each other" in run("fold", bird, "--drive", "1=5", "--all", code=2).stderr
    assert "requires coordinates" in run("fold", data / "wiener" / "watt.json", code=2).stderr


def test_all_is_what_is_done_without_drive():
    vertex = ROOT / "data" / "patterns" / "four-bar-vertex.fold"
    answers = [json.loads(run("fold", vertex, *more, "--frames", 2, "--json").stdout) for more in ([], ["--all"])]
    assert answers[0] == answers[1]
    assert max(abs(angles[-1]) for angles in answers[0]["joint_angles_deg"].values()) == pytest.approx(179)


@pytest.mark.parametrize("name", ["f.gif", "f.png"])
def test_pictures_of_foldings(tmp_path, monkeypatch, name):
    vertex = ROOT / "data" / "patterns" / "four-bar-vertex.fold"
    run("fold", vertex, "--frames", 2, "-o", tmp_path / name)
    assert (tmp_path / name).read_bytes()[:4] in (b"GIF8", b"\x89PNG")
    assert "exists already" in run("fold", vertex, "--frames", 2, "-o", tmp_path / name, code=2).stderr
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    told = run("fold", vertex, "--frames", 2, "-o", tmp_path / f"other-{name}", code=2).stderr
    assert told.strip() == f"{name[2:].upper()} requires matplotlib; try pip install 'synthedra[draw]'"
