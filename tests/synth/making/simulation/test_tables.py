"""Tables of motions: angles by closed forms, moments by differences of energy."""

import csv
import json
import xml.etree.ElementTree as ET
from math import radians

import numpy as np
import pytest
from commands import run
from simulated import planar_four_bar

import synth
from graphs.errors import UnsolvableError
from synth.making.simulation.assembly import AssemblyOptions, assembly_of
from synth.making.simulation.tables import motion_table, placed


def energy(assembly, angles):
    """Weight times height, what springs hold, and less what moments have done, at joint angles."""
    _, centres = placed(assembly, angles)
    masses = np.array([body.properties.mass for body in assembly.bodies])
    springs = sum(
        h.stiffness * (a - h.rest) ** 2 / 2 - h.moment * a for h, a in zip(assembly.hinges, angles, strict=True)
    )
    return 9.81 * masses @ centres[:, 2] + springs


@pytest.mark.parametrize("name", ["miura", "bennett", "four-bar", "sarrus"])
def test_moments_are_slopes_of_energy(name):
    mechanism = synth.generate(name).mechanism
    joint, *_, other = (hinge.joint for hinge in assembly_of(mechanism).hinges)
    springs = synth.Springs({joint: 0.5}, {joint: 0.2}, {other: -0.3})
    assembly = assembly_of(mechanism, AssemblyOptions(size=500.0, springs=springs))
    table = motion_table(assembly)
    driver = table.angles[:, table.driver]
    energies = np.array([energy(assembly, row) for row in table.angles])
    inside = slice(8, -8)
    slopes = (
        (energies[:-4] - 8 * energies[1:-3] + 8 * energies[3:-1] - energies[4:]) / (12 * (driver[1] - driver[0]))
    )[6:-6]
    scale = np.abs(slopes).max()
    assert np.abs(slopes - table.torques[inside]).max() < 2e-3 * scale


def test_errors_between_rows():
    """The bound of linear interpolation holds at angles that are solved for anew, and is no wild guess."""
    assembly = assembly_of(planar_four_bar(), AssemblyOptions(drive={"O": 2 * np.pi}))
    table = motion_table(assembly)
    rows = np.arange(0.1, 128.0, 0.7)
    driver = np.interp(rows, np.arange(129), table.angles[:, table.driver])
    path = synth.move(planar_four_bar(), drive={"O": 2 * np.pi}, frames=129 * 7 - 7).path.angles
    worst = 0.0
    for angles in path[3::5]:
        line = [np.interp(angles[0], table.angles[:, 0], column) for column in table.angles.T]
        worst = max(worst, np.abs(line - angles).max())
    assert 0.3 * table.linear < worst < table.linear
    assert table.cubic < table.linear / 50
    assert driver[0] < driver[-1]


def test_a_table_as_csv(tmp_path):
    synth.write_model(synth.generate("bennett").mechanism, tmp_path / "a.csv", "table", drive={0: 2.0})
    head, *rows = csv.reader((tmp_path / "a.csv").read_text().splitlines())
    assert head[0] == "joint_0_deg"
    assert head[-1] == "driver_moment"
    path = synth.move(synth.generate("bennett").mechanism, drive={0: 2.0}, frames=128).path.angles
    assert len(rows) == 129
    for row, angles in zip(rows, path, strict=True):
        assert np.allclose([radians(float(cell)) for cell in row[:-1]], angles, atol=1e-10)


def test_a_load_at_the_rocker(tmp_path, data):
    """A moment at the rocker, and what the crank needs: in the ratio of their rates, by closed form."""
    springs = synth.Springs(moments={"D": 2.0})
    table, without = (
        motion_table(assembly_of(planar_four_bar(), AssemblyOptions(drive={"O": 2 * np.pi}, springs=each)))
        for each in (springs, synth.Springs())
    )
    crank, rocker = table.angles[:, table.driver], table.angles[:, 3]
    slopes = np.gradient(rocker, crank[1] - crank[0], edge_order=2)
    assert np.abs(without.torques).max() < 1e-12  # its axes are along the weight
    assert np.abs(table.torques + 2.0 * slopes).max() < 3e-3
    file, out = data / "linkages" / "bennett.json", tmp_path / "a.csv"
    run(
        "convert",
        file,
        out,
        "--as",
        "table",
        "--drive",
        "0=90",
        "--moment",
        "2=2",
        "--stiffness",
        "1=0.5",
        "--rest",
        "1=30",
    )
    rows = list(csv.DictReader(out.read_text().splitlines()))
    given = synth.Springs({1: 0.5}, {1: radians(30)}, {2: 2.0})
    again = motion_table(assembly_of(file, AssemblyOptions(drive={0: radians(90)}, springs=given)))
    assert np.allclose([float(row["driver_moment"]) for row in rows], again.torques, atol=1e-12)


def test_a_driver_that_turns_back(tmp_path):
    """A loop of seven hinges in space, whose driven joint turns back on the way: no table, and a note of the model."""
    rng = np.random.default_rng(7)
    points, directions = rng.uniform(-1.0, 1.0, (2, 7, 3)).tolist()
    joints = dict(enumerate([(0, 1), (0, 6), (1, 2), (2, 3), (3, 4), (4, 5), (5, 6)]))
    ring = synth.HingedSolids(synth.SCGraph(7, joints), dict(enumerate(zip(points, directions, strict=True))))
    with pytest.raises(
        UnsolvableError, match="the driven joint turns back on the way, so other angles are no functions"
    ):
        synth.write_model(ring, tmp_path / "a.csv", "table")
    assert "the driven joint turns back on the way" in synth.write_model(ring, tmp_path / "a.urdf", "urdf")[0]
    assert "functions" not in json.loads((tmp_path / "a.loops.json").read_text())


def test_a_driver_that_is_held(tmp_path):
    """A range of nothing: no table, and a servo without one."""
    bennett = synth.generate("bennett").mechanism
    with pytest.raises(UnsolvableError, match="a table requires a range, and the driven joint ends where it begins"):
        synth.write_model(bennett, tmp_path / "a.csv", "table", drive={0: 0.0})
    synth.write_model(bennett, tmp_path / "a.xml", "mjcf", drive={0: 0.0})
    (servo,) = ET.parse(tmp_path / "a.xml").getroot().iter("position")
    assert servo.get("joint") == "joint_0"
    assert servo.get("ctrlrange") is None


def test_what_has_no_table(tmp_path):
    with pytest.raises(UnsolvableError, match="1 driven joint and 1 degree of freedom, not 1 and 2"):
        synth.write_model(synth.generate("five-bar").mechanism, tmp_path / "a.csv", "table")
