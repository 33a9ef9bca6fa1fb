"""Models that MuJoCo runs: freedoms by the rank of its own Jacobian, and closed loops that hold while they are driven.

The second method is `synth.move`, with closure equations of whole loops; MuJoCo has trees and soft connections.
"""

import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from simulated import Simulated, crossing, mujoco_or_skip, planar, planar_four_bar
from sizes import slow_but

from graphs.mechanism.solids import HingedSolids
from synth.analysis.compliance.springs import Springs
from synth.catalogue.patterns._generate import generate
from synth.catalogue.patterns.generators import GENERATORS
from synth.making.simulation.mjcf import mjcf_bytes
from synth.making.simulation.writing import write_model

LINKAGES = sorted(Path(__file__).parents[4].glob("data/linkages/*.*"))
QUICK = ("miura", "bennett", "goldberg", "four-bar", "sarrus", "crash-lock")
ONE_FREEDOM = [name for name in GENERATORS if generate(name).freedoms == 1]
SHAKY = {"scissor-cube": 3, "scissor-prism": 2}
"""Mechanisms of one freedom that have more infinitesimal ones all along their motion."""
KILOHERTZ = 0.001
RIGID = "wampler-cube-locked.json"


@pytest.mark.parametrize("name", slow_but(QUICK, ONE_FREEDOM))
def test_freedoms_of_generators(name):
    simulated = Simulated(generate(name).mechanism)
    assert simulated.freedoms == simulated.freedoms_of_loops == SHAKY.get(name, 1)
    assert simulated.residual < 1e-12


@pytest.mark.parametrize("path", LINKAGES, ids=lambda path: path.name)
def test_freedoms_of_linkages(path):
    simulated = Simulated(path)
    branches = simulated.at.branches
    freedoms = {branch.freedoms for branch in branches.branches} if branches.branches else {2}
    assert simulated.freedoms == simulated.freedoms_of_loops
    assert simulated.freedoms in freedoms
    assert (path.name == RIGID) == (not branches.branches)  # two infinitesimal ones, and no motion
    assert simulated.assembly.residual < 1e-12


@pytest.mark.parametrize("name", slow_but(QUICK, ONE_FREEDOM))
def test_generators_driven_over_their_range(name):
    if name in SHAKY:
        pytest.skip("more than one freedom where loops are soft")
    driven = Simulated(generate(name).mechanism).driven()
    assert driven.residual < 1e-6
    assert driven.error < 1e-3


@pytest.mark.parametrize("mechanism", [generate("miura").mechanism, planar_four_bar()], ids=["miura", "four-bar"])
def test_the_program_of_the_guide(mechanism, tmp_path):
    """It drives the model over nine tenths of its range, and its loops hold."""
    mujoco_or_skip()
    drive = {"O": 6.28} if isinstance(mechanism, HingedSolids) else {}
    write_model(mechanism, tmp_path / "a.xml", "mjcf", size=300.0, drive=drive)
    program = Path(__file__).parents[4] / "docs" / "programs" / "drive.py"
    ran = subprocess.run([sys.executable, program, "a.xml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    *ends, told = ran.stdout.splitlines()
    first, last = (float(line.split()[2]) for line in ends)
    model = ET.parse(tmp_path / "a.xml").getroot()
    low, high = (np.degrees(float(end)) for end in model.find("actuator/position").get("ctrlrange").split())
    assert abs(first - (low + 0.05 * (high - low))) < 0.1
    assert abs(last - (high - 0.05 * (high - low))) < 0.1
    assert float(told.split()[5]) < 1e-8


@pytest.mark.parametrize("path", slow_but((), LINKAGES), ids=lambda path: getattr(path, "name", None))
def test_linkages_driven_over_their_range(path):
    simulated = Simulated(path)
    if simulated.freedoms != 1 or not simulated.assembly.driven:
        pytest.skip("several freedoms, or none")
    driven = simulated.driven()
    assert driven.residual < 1e-6
    assert driven.error < 1e-3


@pytest.mark.parametrize(("seconds", "apart"), [(10.0, 1.1e-7), (1.0, 1.1e-5)])
def test_a_four_bar_stays_together(seconds, apart):
    simulated = Simulated(planar_four_bar(), drive={"O": 2 * np.pi}, step=KILOHERTZ)
    driven = simulated.driven(seconds)
    assert driven.residual * simulated.assembly.size < apart
    turned = driven.states[:, simulated.places.index(0)]
    rocker = simulated.assembly.hinges[3]
    assert rocker.name == "joint_D"
    assert turned.max() > 0.9 * 2 * np.pi
    # Freudenstein's equation for the angle between crank and rocker, from the positions of the bodies
    for state in driven.states:
        a = 0.1 * np.array([-np.sin(state[simulated.places.index(0)]), np.cos(state[simulated.places.index(0)])])
        b = crossing(a, 0.4, np.array([0.4, 0.0]), 0.3, 1)
        was = crossing(np.array([0.0, 0.1]), 0.4, np.array([0.4, 0.0]), 0.3, 1)
        angles = [np.arctan2(*(point - (0.4, 0.0))[::-1]) for point in (was, b)]
        if 3 in simulated.places:
            swung = -(angles[1] - angles[0])  # the base turns against the rocker
            assert abs(state[simulated.places.index(3)] - swung) < 1e-5


LEG = {"a": 38.0, "b": 41.5, "c": 39.3, "d": 40.1, "e": 55.8, "f": 39.4, "g": 36.7, "h": 65.7, "i": 49.0, "j": 50.0,
       "k": 61.9, "l": 7.8, "m": 15.0}  # fmt: skip
"""Jansen's numbers, centimetres."""


def leg_points(crank):
    """Return the points of Jansen's leg with the crank at an angle, centimetres, by crossing circles."""
    n = LEG
    o, p = np.zeros(2), np.array([-n["a"], -n["l"]])
    a = n["m"] * np.array([np.cos(crank), np.sin(crank)])
    b = crossing(a, n["j"], p, n["b"], -1)
    d = crossing(b, n["e"], p, n["d"], -1)
    c = crossing(a, n["k"], p, n["c"], 1)
    e = crossing(d, n["f"], c, n["g"], -1)
    foot = crossing(e, n["h"], c, n["i"], -1)
    return {"O": o, "P": p, "A": a, "B": b, "C": c, "D": d, "E": e, "F": foot}


def jansens_leg():
    """Jansen's leg: eight links and ten hinges, two at each of A, P and C."""
    at, joints = leg_points(0.0), {
        "O": ("ground", "crank"), "A1": ("crank", "j"), "A2": ("crank", "k"), "B": ("j", "upper"),
        "P1": ("ground", "upper"), "P2": ("ground", "c"), "C1": ("k", "c"), "C2": ("c", "lower"), "D": ("upper", "f"),
        "E": ("f", "lower"),
    }  # fmt: skip
    return planar(("ground", "crank", "j", "k", "upper", "c", "f", "lower"), joints, at)


def test_jansens_leg_walks():
    simulated = Simulated(jansens_leg(), drive={"O": 2 * np.pi}, scale=10.0, step=KILOHERTZ)
    assert simulated.freedoms == 1
    driven = simulated.driven()
    assert driven.residual * simulated.assembly.size < 1e-6
    assert driven.error < 1e-5


def test_the_foot_of_jansens_leg():
    """The path of the foot, by the bodies of MuJoCo and by circles that cross."""
    simulated = Simulated(jansens_leg(), drive={"O": 2 * np.pi}, scale=10.0, step=KILOHERTZ)
    mujoco, model, data = simulated.mujoco, simulated.model, simulated.data
    lower = model.body("link_lower").id
    foot = np.array([*leg_points(0.0)["F"] / 100.0, 0.0]) - data.xpos[lower]
    for step in range(5000):
        data.ctrl[0] = 3.0 * (1.0 - np.cos(np.pi * step / 5000)) / 2.0
        mujoco.mj_step(model, data)
        if step % 250 == 0:
            turned = data.qpos[simulated.places.index(0)]
            here = data.xpos[lower] + data.xmat[lower].reshape(3, 3) @ foot
            assert np.abs(here[:2] - leg_points(turned)["F"] / 100.0).max() < 1e-6


def test_moments_act_on_joints():
    """The force of MuJoCo at each joint is our moment, whichever way the tree passes it."""
    moments = {joint: 0.1 + joint for joint in range(5)}
    simulated = Simulated(generate("goldberg").mechanism, drive={0: 0.4}, springs=Springs(moments=moments))
    simulated.data.ctrl[0] = simulated.data.qpos[simulated.places.index(0)]
    simulated.mujoco.mj_forward(simulated.model, simulated.data)
    expected = [moments[simulated.assembly.hinges[place].joint] for place in simulated.places]
    assert np.allclose(simulated.data.qfrc_actuator, expected, atol=1e-12)


def test_slides():
    """A slider-crank: the slide is in the tree, and its length is that of the closed form."""
    simulated = Simulated(Path(__file__).parents[4] / "data" / "joints" / "slider-crank-placed.json")
    assert simulated.freedoms == 1
    assert [hinge.slide for hinge in simulated.assembly.hinges].count(True) == 1
    driven = simulated.driven()
    assert driven.residual < 1e-6
    assert driven.error < 1e-4


@pytest.mark.parametrize("name", ["miura", "bennett", "square-twist"])
def test_inertia_is_that_of_the_shapes(name):
    """MuJoCo integrates over the shapes, with corners as 32-bit numbers, what we have in closed form."""
    simulated = Simulated(generate(name).mechanism)
    model = simulated.mujoco.MjSpec.from_string(mjcf_bytes(simulated.assembly).decode())
    model.compiler.inertiafromgeom = 1
    again = model.compile()
    assert np.allclose(again.body_mass, simulated.model.body_mass, rtol=1e-4)
    assert np.allclose(again.body_ipos, simulated.model.body_ipos, atol=1e-4 * simulated.assembly.size)
    assert np.allclose(np.sort(again.body_inertia), np.sort(simulated.model.body_inertia), rtol=1e-4)
