"""Bodies and trees: mass and inertia by a second method, which hinges are cut, what is refused."""

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from commands import run

import synth
from graphs.errors import FileError, InvariantError, SynthedraError, UnsolvableError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.moving._configuration_of import configuration_of
from synth.exporters import EXPORTERS
from synth.making.simulation.assembly import AssemblyOptions, assembly_of, driven_inertia, spanning_tree
from synth.making.simulation.bodies import Bar, MassProperties, Plate
from synth.making.simulation.mjcf import convex_parts
from synth.making.templates.unfolding import Plane

L_SHAPE = np.array([(0, 0, 0), (3, 0, 1), (3, 1, 1), (1, 1, 1 / 3), (1, 2, 1 / 3), (0, 2, 0)], dtype=float)


def by_points(points, weights):
    """Return the properties of masses at points."""
    mass, centre = weights.sum(), weights @ points / weights.sum()
    arms = points - centre
    inertia = np.eye(3) * (weights * (arms**2).sum(axis=1)).sum() - (weights * arms.T) @ arms
    return MassProperties(mass, centre, inertia)


def agree(one, other, part):
    assert one.mass == pytest.approx(other.mass, rel=part)
    assert np.abs(one.centre - other.centre).max() < part
    assert np.abs(one.inertia - other.inertia).max() < part * np.abs(other.inertia).max()


def test_a_plate_by_its_convex_parts():
    """Tetrahedra of prisms, each with four masses (a rule exact to second order), against sums over sides."""
    plate = Plate(Plane(L_SHAPE, 0), 0.3)
    points, weights = [], []
    near, far = (5 - np.sqrt(5)) / 20, (5 + 3 * np.sqrt(5)) / 20
    parts = convex_parts(plate)
    assert len(parts) > 1
    for corners in parts:
        low, high = corners.reshape(2, -1, 3)
        (a, b, c), (d, e, f) = low, high
        for tetrahedron in ((a, b, c, d), (b, c, d, e), (c, d, e, f)):
            corners_of = np.array(tetrahedron)
            volume = abs(np.linalg.det(corners_of[1:] - corners_of[0])) / 6
            points += [near * corners_of.sum(axis=0) + (far - near) * corner for corner in corners_of]
            weights += [volume * 700.0 / 4] * 4
    agree(plate.properties(700.0), by_points(np.array(points), np.array(weights)), 1e-12)


def test_a_bar_by_slices():
    bar = Bar(np.array([1.0, 0.0, 2.0]), np.array([2.0, 2.0, 0.0]), 0.4)
    along = (bar.end - bar.start) / 3.0
    side = np.cross(along, [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    other = np.cross(along, side)
    nodes, weights = np.polynomial.legendre.leggauss(4)
    turns = np.arange(8) * np.pi / 4
    points, masses = [], []
    for x, w in zip(nodes, weights, strict=True):
        for r, v in zip(nodes, weights, strict=True):
            radius = bar.radius * (r + 1) / 2
            for turn in turns:
                points.append(
                    (bar.start + bar.end) / 2 + 1.5 * x * along + radius * (np.cos(turn) * side + np.sin(turn) * other)
                )
                masses.append(w / 2 * 3.0 * v / 2 * bar.radius * radius * 2 * np.pi / 8)
    agree(bar.properties(1.0), by_points(np.array(points), np.array(masses)), 1e-12)


@pytest.mark.parametrize("name", ["miura", "goldberg", "scissor-ring", "crash-lock"])
def test_the_tree_spans(name):
    assembly = assembly_of(synth.generate(name).mechanism)
    tree = nx.DiGraph((joint.parent, joint.child) for joint in assembly.tree)
    assert nx.is_arborescence(tree)
    assert len(tree) == len(assembly.bodies)
    within = {joint.hinge for joint in assembly.tree}
    assert set(assembly.driven) <= within
    assert {cut.hinge for cut in assembly.cuts} == set(range(len(assembly.hinges))) - within


def test_springs_and_driven_joints_are_in_the_tree():
    mechanism = synth.generate("goldberg").mechanism
    for joint in mechanism.axes:
        other = (joint + 2) % 5
        options = AssemblyOptions(drive={joint: 0.4}, springs=synth.Springs({other: 2.0}, {other: 0.1}))
        assembly = assembly_of(mechanism, options)
        within = {assembly.hinges[each.hinge].joint for each in assembly.tree}
        assert {joint, other} <= within


def test_driven_inertia_of_a_pendulum():
    """A door: the inertia about its hinge."""
    door = HingedSolids(SCGraph(2, [(0, 1)], ground=0), {0: ((0, 0, 0), (0, 0, 1))})
    assembly = assembly_of(door, AssemblyOptions(drive={0: 1.0}))
    part = assembly.bodies[1].properties
    arm = part.centre - assembly.hinges[0].point
    about = part.inertia[2, 2] + part.mass * (arm[0] ** 2 + arm[1] ** 2)
    assert driven_inertia(assembly, 0) == pytest.approx(about, rel=1e-12)


def test_the_size():
    sheet = synth.generate("miura").mechanism
    small = assembly_of(sheet, AssemblyOptions(size=200.0, thickness=2.0))
    whole = assembly_of(sheet)
    factor = small.size / whole.size
    assert np.allclose([hinge.point for hinge in small.hinges], np.array([h.point for h in whole.hinges]) * factor)
    corners = np.array(sheet.coordinates)
    assert np.ptp(corners, axis=0).max() * factor == pytest.approx(0.2)
    assert small.bodies[0].shapes[0].thickness == 0.002


def test_a_file_is_one_document(tmp_path):
    notes = synth.write_model(
        synth.generate("kresling").mechanism, tmp_path / "a.xml", "mjcf", springs=synth.Springs({1: 1.0})
    )
    root = ET.fromstring((tmp_path / "a.xml").read_bytes())
    joints = {joint.get("name"): joint for joint in root.iter("joint")}
    connects = [connect.get("name").rpartition("_")[0] for connect in root.iter("connect")]
    assert not set(joints) & set(connects)
    assert joints["joint_1"].get("stiffness") == "1"
    assert not list(root.iter("general"))
    assert any("of cut hinges" in note for note in notes)


@pytest.mark.parametrize("name", ["mjcf", "urdf", "sdf", "usd", "step"])
def test_springs_and_moments_that_a_format_does_not_hold(name, tmp_path):
    bennett, springs = synth.generate("bennett").mechanism, synth.Springs({1: 1.0}, moments={1: 2.0, 3: 0.5})
    lost = " ".join(
        synth.write_model(bennett, tmp_path / f"a{EXPORTERS['models'][name].suffix}", name, springs=springs)
    )
    assert ("1 spring" in lost) == (name not in ("mjcf", "sdf"))
    assert ("2 moments" in lost) == (name != "mjcf")


def test_names_of_any_kind(tmp_path):
    names = ('a "b" <c> & --', "d\n\x07", "\u03b1")
    joints = {"--": names[:2], "]]>": names[1:], 7: (names[2], names[0])}
    axes = {"--": ((0, 0, 0), (0, 0, 1)), "]]>": ((1, 0, 0), (0, 0, 1)), 7: ((0, 1, 0), (0, 0, 1))}
    synth.write_model(HingedSolids(SCGraph(names, joints), axes), tmp_path / "a.xml", "mjcf")
    root = ET.fromstring((tmp_path / "a.xml").read_bytes())
    names = {body.get("name") for body in root.iter("body")}
    assert len(names) == 3
    assert not any(" " in name for name in names)  # MuJoCo splits lists of names there


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"thickness": 0.0}, "thickness 0.0; expected a positive number"),
        ({"density": float("nan")}, "density nan"),
        ({"size": 3.0, "scale": 1.0}, "both a scale and a size"),
    ],
)
def test_options_out_of_range(options, message):
    with pytest.raises(InvariantError, match=message):
        AssemblyOptions(**options)


def test_what_is_refused(tmp_path):
    bennett = synth.generate("bennett").mechanism
    with pytest.raises(InvariantError, match="there is no format 'stl'"):
        synth.write_model(bennett, tmp_path / "a.xml", "stl")
    with pytest.raises(FileError, match=r"expected \.xml"):
        synth.write_model(bennett, tmp_path / "a.json", "mjcf")
    with pytest.raises(UnsolvableError, match="requires coordinates"):
        synth.write_model("k1:Cr", tmp_path / "a.xml", "mjcf")
    with pytest.raises(InvariantError, match="no joint"):
        synth.write_model(bennett, tmp_path / "a.xml", "mjcf", drive={9: 1.0})
    with pytest.raises(UnsolvableError, match="the driven joints form a loop"):
        spanning_tree(configuration_of(bennett), assembly_of(bennett).hinges, range(4))
    assert not list(tmp_path.iterdir())


MODELS = EXPORTERS["models"]
SOLIDS = {"format": "synthedra/solids", "version": 1, "loops": []}
NOTHING = {
    "no links": SOLIDS | {"links": 0, "joints": [], "axes": []},
    "one link": SOLIDS | {"links": 1, "joints": [], "axes": []},
    "no joints": SOLIDS | {"links": 4, "joints": [], "axes": []},
}
BORDER = {"edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], "edges_assignment": [*"BBBBM"]}
FACES = BORDER | {"faces_vertices": [[0, 1, 2], [0, 2, 3]]}
PANELS = {
    "no panels": (
        BORDER | {"edges_assignment": [*"MVMVM"], "vertices_coords": [[0, 0], [1, 0], [2, 0], [3, 0]]},
        "face",
    ),
    "vertices alone": ({"vertices_coords": [[0, 0], [1, 0]]}, "faces_vertices: missing"),
    "a panel without area": (FACES | {"vertices_coords": [[0, 0], [1, 0], [2, 0], [0, 1]]}, "panel 0 has no area"),
    "all in one point": (FACES | {"vertices_coords": [[1, 1]] * 4}, "no area"),
}


def refused(file, name, *words):
    """The one line with which a command refuses a file; nothing is written."""
    out = file.parent / f"out{EXPORTERS['models'][name].suffix}"
    result = run("convert", file, out, "--as", name, *words, code=2)
    assert not list(file.parent.glob("out*"))
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"{file}: ")
    with pytest.raises(SynthedraError):
        synth.write_model(file, out, name, **{words[at][2:]: float(words[at + 1]) for at in range(0, len(words), 2)})
    return line


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("case", NOTHING)
def test_nothing_solid(case, name, tmp_path):
    (tmp_path / "a.json").write_text(json.dumps(NOTHING[case]))
    assert "nothing is solid: links without panels get their shape from their joints" in refused(
        tmp_path / "a.json", name
    )


@pytest.mark.parametrize("name", ["mjcf", "step"])
@pytest.mark.parametrize("case", PANELS)
def test_no_panels(case, name, tmp_path):
    document, message = PANELS[case]
    (tmp_path / "a.fold").write_text(json.dumps(document))
    assert message in refused(tmp_path / "a.fold", name)


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize(
    "file", ["linkages/bennett.json", "surfaces/fig11-stephenson.json", "patterns/four-bar-vertex.fold"]
)
def test_no_thickness(file, name, tmp_path, data):
    """Bars, shells and panels: 0, and what is 0 beside the size."""
    copied = tmp_path / Path(file).name
    copied.write_bytes((data / file).read_bytes())
    assert "thickness 0.0; expected a positive number" in refused(copied, name, "--thickness", "0")
    line = refused(copied, name, "--size", "300", "--thickness", "1e-9")
    assert "nothing is solid: the thickness is 1e-09 mm at an extent of " in line


@pytest.mark.parametrize(
    ("surface", "message"),
    [
        ({"lambda_deg": 90}, "lambda_deg: 90; expected 0 or more, and less than 90"),
        ({"lambda_deg": 89.9999999}, "links are thicker than the surface is wide"),
        ({"format": "synthedra/cylindrical", "lambda_deg": None, "radius": 0}, "radius: 0; expected a number above 0"),
    ],
)
def test_cones_and_cylinders_of_no_width(surface, message, tmp_path, data):
    document = json.loads((data / "surfaces" / "fig11-stephenson.json").read_text()) | surface
    (tmp_path / "a.json").write_text(json.dumps({key: value for key, value in document.items() if value is not None}))
    assert message in refused(tmp_path / "a.json", "step")


def test_a_link_without_joints(tmp_path, data):
    """Its shape is not known: a note says what stands for it."""
    document = json.loads((data / "linkages" / "bennett.json").read_text())
    (tmp_path / "a.json").write_text(json.dumps(document | {"links": document["links"] + 1}))
    notes = synth.write_model(tmp_path / "a.json", tmp_path / "a.xml", "mjcf")
    assert notes == ("1 link without joints: of unknown shape, a bar in the file",)


def test_too_small_for_a_format(tmp_path, data):
    copied = tmp_path / "a.json"
    copied.write_bytes((data / "linkages" / "bennett.json").read_bytes())
    light = refused(copied, "mjcf", "--size", "0.1")
    assert re.search(
        r"link_\d has a mass of \S+ kg and a moment of inertia of \S+ kg m², and MuJoCo requires 1e-15", light
    )
    assert "the thickness is 1e-08 mm, and STEP files are accurate to 1e-07 mm" in refused(
        copied, "step", "--size", "0.0001", "--thickness", "1e-8"
    )


def test_a_panel_alone(tmp_path):
    """No joints, and yet a solid; no joints are lost, and no motion."""
    square = {"vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]], "faces_vertices": [[0, 1, 2, 3]]}
    (tmp_path / "a.fold").write_text(json.dumps(square))
    for name, written in MODELS.items():
        if name != "table":
            notes = synth.write_model(tmp_path / "a.fold", tmp_path / f"a{written.suffix}", name)
            assert notes[0] == "no joints: nothing moves"
            assert not any("joint" in note or "motion" in note for note in notes[1:])


def test_what_does_not_move():
    """A triangle of three hinges: bodies without actuators, and why."""
    assembly = assembly_of(Path(__file__).parents[4] / "data" / "linkages" / "wampler-cube-locked.json")
    assert not assembly.driven
    assert "no motion begins" in " ".join(assembly.notes)


def test_notes_are_not_among_what_is_lost(tmp_path, data):
    """A mechanism that does not move: the file holds all there is, and a note says why it has no actuators."""
    file = data / "linkages" / "wampler-cube-locked.json"
    lines = run("convert", file, tmp_path / "a.sdf", "--as", "sdf").output.splitlines()
    assert [line.split(":")[0] for line in lines] == ["written", "note"]
    assert "no motion begins" in lines[1]


def test_the_unit_of_a_file_and_what_is_improbably_large(tmp_path, data):
    """A FOLD file that names its unit needs no scale; without one, coordinates in millimetres stand out."""
    file = tmp_path / "vertex.fold"
    content = json.loads((data / "patterns" / "four-bar-vertex.fold").read_text(encoding="utf-8"))
    content["vertices_coords"] = [[100.0 * x for x in corner] for corner in content["vertices_coords"]]
    file.write_text(json.dumps(content), encoding="utf-8")
    large = assembly_of(file)
    assert "coordinates are taken as metres: an extent of" in large.notes[-1]
    file.write_text(json.dumps(content | {"frame_unit": "cm"}), encoding="utf-8")
    small = assembly_of(file)
    assert small.size == pytest.approx(large.size / 100)
    assert not any("metres" in note for note in small.notes)
    run("convert", file, tmp_path / "unit.xml", "--as", "mjcf")
    run("convert", file, tmp_path / "scale.xml", "--as", "mjcf", "--scale", "10")
    assert (tmp_path / "unit.xml").read_bytes() == (tmp_path / "scale.xml").read_bytes()
    stated = assembly_of(file, AssemblyOptions(scale=1000.0))
    assert stated.size == pytest.approx(large.size)
    assert not any("metres" in note for note in stated.notes)


def test_the_command(tmp_path, data):
    file, out = data / "patterns" / "four-bar-vertex.fold", tmp_path / "a.xml"
    told = run("convert", file, out, "--as", "mjcf", "--drive", "2=90", "--stiffness", "4=0.5", "--size", "100")
    root = ET.fromstring(out.read_bytes())
    assert [each.get("joint") for each in root.iter("position")] == ["joint_2"]
    assert "written:" in told.output
    wrong = run("convert", file, tmp_path / "b.fold", "--density", "3", code=2)
    assert "only with --as" in wrong.output
    wrong = run("convert", file, tmp_path / "b.xml", "--as", "mjcf", "--gap", "3", code=2)
    assert "not with --as" in wrong.output


def test_joints_of_solid_panels_turn_to_one_side(tmp_path):
    """Valleys of panels below their axes go from 0 to 180 degrees, mountains the other way; thin panels both ways."""
    sheet = synth.generate("miura", rows=2, columns=2).mechanism
    thick = synth.thicken(sheet, thickness=0.05, collisions=False)
    for hinge in assembly_of(thick.solids).hinges:
        assert hinge.limits == ((0.0, np.pi) if hinge.joint in thick.valleys else (-np.pi, 0.0))
    assert {hinge.limits for hinge in assembly_of(sheet).hinges} == {(-np.pi, np.pi)}
    synth.write_model(thick.solids, tmp_path / "thick.urdf", "urdf")
    text = (tmp_path / "thick.urdf").read_text()
    limits = re.findall(r'lower="(.*?)" upper="(.*?)"', text)
    assert limits
    assert all(sorted(map(float, pair)) in ([0.0, np.pi], [-np.pi, 0.0]) for pair in limits)
