"""URDF with its loops beside it, and SDF: read by parsers and solvers that know nothing of us."""

import json
import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from simulated import planar_parallelogram
from sizes import slow_but

import synth
from graphs.errors import FileError
from synth.catalogue.patterns.generators import GENERATORS

LINKAGES = Path(__file__).parents[4] / "data" / "linkages"
ONE_FREEDOM = [name for name in GENERATORS if synth.generate(name).freedoms == 1 and not name.startswith("scissor")]
QUICK = ("miura", "bennett", "four-bar", "crash-lock")


def numbers(text):
    return np.array(text.split(), dtype=float)


def solver(urdf, loops):
    """Close the loops of a URDF by the file beside it alone: a function from guesses and held joints to angles."""
    joints = [j for j in ET.parse(urdf).iter("joint") if j.get("type") != "fixed"]
    names = [j.get("name") for j in joints]
    ends = [(j.find("parent").get("link"), j.find("child").get("link")) for j in joints]
    origins = np.array([numbers(j.find("origin").get("xyz")) for j in joints])
    axes = np.array([numbers(j.find("axis").get("xyz")) for j in joints])

    def open_by(angles):
        placed = {}
        for (parent, child), origin, axis, angle in zip(ends, origins, axes, angles, strict=True):
            turn, place = placed.get(parent, (np.eye(3), np.zeros(3)))
            placed[child] = (turn @ Rotation.from_rotvec(axis * angle).as_matrix(), place + turn @ origin)
        off = []
        for loop in loops:
            (r, p), (s, q) = (placed.get(link, (np.eye(3), np.zeros(3))) for link in loop["links"])
            along = np.array(loop["axis"]) * loop["length"]
            for step in (0.0, 0.5, -0.5):
                off.append(r @ (loop["points"][0] + step * along) + p - s @ (loop["points"][1] + step * along) - q)
        return np.concatenate(off)

    def close(guess, held):
        angles, free = np.array(guess), [n for n, name in enumerate(names) if name != held]
        for _ in range(20):
            now = open_by(angles)
            slopes = np.array([(open_by(angles + 1e-6 * np.eye(len(angles))[n]) - now) / 1e-6 for n in free]).T
            angles[free] -= np.linalg.lstsq(slopes, now, rcond=1e-7)[0]
        return angles, np.abs(open_by(angles)).max()

    return names, close


@pytest.mark.parametrize("name", slow_but(QUICK, ONE_FREEDOM))
def test_loops_of_urdf_close_by_the_file_beside(name, tmp_path):
    synth.write_model(synth.generate(name).mechanism, tmp_path / "a.urdf", "urdf")
    beside = json.loads((tmp_path / "a.loops.json").read_text())
    names, close = solver(tmp_path / "a.urdf", beside["loops"])
    assert beside["freedoms"] == 1
    assert set(beside["about"]) <= set(beside)
    [driver] = beside["driven"]
    functions = beside["functions"]
    table = np.array([functions["angles"][name] for name in names]).T
    for row in (32, 64, 96):
        angles, error = close(table[row] + np.where(np.array(names) == driver, 0.0, 1e-4), driver)
        assert error < 1e-9
        assert np.abs(angles - table[row]).max() < 1e-6


@pytest.mark.parametrize("name", ["miura", "bennett", "stewart", "kresling"])
def test_urdf_is_a_tree_for_another_parser(name, tmp_path):
    parser = pytest.importorskip("urdf_parser_py.urdf", reason="urdf-parser-py is not installed")
    mechanism = synth.generate(name).mechanism
    synth.write_model(mechanism, tmp_path / "a.urdf", "urdf")
    robot = parser.URDF.from_xml_string((tmp_path / "a.urdf").read_bytes())
    assert robot.get_root() in {link.name for link in robot.links}
    assert len(robot.links) == len(robot.joints) + 1
    for link in robot.links:
        assert len(robot.get_chain(robot.get_root(), link.name)) % 2 == 1


@pytest.mark.skipif(shutil.which("check_urdf") is None, reason="check_urdf is not installed; try make test-simulators")
@pytest.mark.parametrize(
    "name", slow_but(("miura", "bennett"), [name for name in GENERATORS if not name.startswith("scissor")])
)
def test_check_urdf_accepts_the_tree(name, tmp_path):
    """The parser of ROS lists the bodies that hang on each body: all of them, once, below one root."""
    synth.write_model(synth.generate(name).mechanism, tmp_path / "a.urdf", "urdf")
    checked = subprocess.run(["check_urdf", tmp_path / "a.urdf"], capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "Successfully Parsed XML" in checked.stdout
    below = re.findall(r"child\(\d+\):\s+(\S+)", checked.stdout)
    links = {link.get("name") for link in ET.parse(tmp_path / "a.urdf").getroot().findall("link")}
    (root,) = re.findall(r"root Link: (\S+) has", checked.stdout)
    assert sorted([root, *below]) == sorted(links)


def test_joints_in_proportion_mimic_the_driver(tmp_path):
    synth.write_model(planar_parallelogram(), tmp_path / "a.urdf", "urdf", drive={"O": 1.0})
    joints = {joint.get("name"): joint for joint in ET.parse(tmp_path / "a.urdf").iter("joint")}
    mimics = {name: joint.find("mimic") for name, joint in joints.items() if joint.find("mimic") is not None}
    assert len(mimics) == len(joints) - 1
    for mimic in mimics.values():
        assert mimic.get("joint") == "joint_O"
        assert abs(float(mimic.get("multiplier"))) == pytest.approx(1.0, abs=1e-12)


def test_every_mesh_of_urdf_is_there(tmp_path):
    synth.write_model(synth.generate("miura").mechanism, tmp_path / 'a "b".urdf', "urdf")
    files = {mesh.get("filename") for mesh in ET.parse(tmp_path / 'a "b".urdf').iter("mesh")}
    assert len(files) == 9
    assert all((tmp_path / name).exists() for name in files)
    with pytest.raises(FileError, match="exists already"):
        synth.write_model(synth.generate("miura").mechanism, tmp_path / 'a "b".urdf', "urdf")


@pytest.mark.parametrize("name", ["miura", "bennett", "goldberg"])
def test_sdf_has_all_joints(name, tmp_path):
    mechanism = synth.generate(name).mechanism
    springs = synth.Springs({2: 1.5}, {2: 0.25})
    synth.write_model(mechanism, tmp_path / "a.sdf", "sdf", springs=springs)
    model = ET.parse(tmp_path / "a.sdf").find("model")
    at = synth.making.simulation.assembly_of(mechanism)
    joints = {joint.get("name"): joint for joint in model.iter("joint") if joint.get("type") == "revolute"}
    assert len(joints) == len(at.hinges)
    poses = {link.get("name"): numbers(link.find("pose").text)[:3] for link in model.iter("link")}
    for hinge in at.hinges:
        joint = joints[hinge.name]
        place = poses[joint.find("child").text] + numbers(joint.find("pose").text)[:3]
        assert np.abs(place - hinge.point).max() < 1e-12
        assert np.abs(np.cross(numbers(joint.find("axis/xyz").text), hinge.direction)).max() < 1e-12
        assert {joint.find("parent").text, joint.find("child").text} == {
            at.bodies[n].name for n in (hinge.first, hinge.second)
        }
    spring = joints["joint_2"].find("axis/dynamics")
    assert float(spring.find("spring_stiffness").text) == 1.5
    assert (
        float(spring.find("spring_reference").text)
        == 0.25 - at.hinges[[h.name for h in at.hinges].index("joint_2")].angle
    )
