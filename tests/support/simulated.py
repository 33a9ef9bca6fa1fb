"""Models of MuJoCo run: the rank of its constraint Jacobian, and angles while a joint is driven slowly."""

from dataclasses import dataclass

import numpy as np
import pytest

from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from synth.analysis.motion.closure import corrected, exactly_held
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.simulation.assembly import AssemblyOptions, assembly_of
from synth.making.simulation.mjcf import STEP, mjcf_bytes

SECONDS = 10.0
BESIDE = 0.05
"""Part of the range that is left out at its ends: turning points of the driver, flat and folded states."""


def mujoco_or_skip():
    """Return MuJoCo, whose warnings are printed: by default it adds them to MUJOCO_LOG.TXT in the working directory."""
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed; try make test-simulators")
    mujoco.set_mju_user_warning(print)
    return mujoco


class Simulated:
    """A mechanism as a model of MuJoCo; skips without it."""

    def __init__(self, mechanism, *, step=STEP, **options):
        mujoco = mujoco_or_skip()
        self.mujoco = mujoco
        self.at = configuration_of(mechanism, slides=True)
        self.assembly = assembly_of(mechanism, AssemblyOptions(**options))
        self.model = mujoco.MjModel.from_xml_string(mjcf_bytes(self.assembly).decode())
        self.model.opt.timestep, self.model.eq_solref[:, 0] = step, 2.0 * step
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        names = [hinge.name for hinge in self.assembly.hinges]
        self.places = [names.index(self.model.joint(number).name) for number in range(self.model.njnt)]

    @property
    def rows(self):
        """The equality rows of the constraint Jacobian, float[rows, joints of the tree]."""
        self.model.opt.jacobian = 0  # dense
        self.mujoco.mj_forward(self.model, self.data)
        return np.reshape(self.data.efc_J, (self.data.nefc, -1))[: self.data.ne]

    @property
    def freedoms(self):
        """Degrees of freedom by the rank of these rows."""
        if not self.data.ne:
            return self.model.nv
        values = np.linalg.svd(self.rows, compute_uv=False)
        return self.model.nv - int((values > 1e-6 * values[0]).sum())

    @property
    def freedoms_of_loops(self):
        """Degrees of freedom by the rank of our closure equations, of whole loops, at the same configuration."""
        assembly = self.assembly
        angles = np.array([hinge.angle / (assembly.size if hinge.slide else 1.0) for hinge in assembly.hinges])
        values = np.linalg.svd(self.at.closure.dense(angles), compute_uv=False)
        return len(angles) - int((values > 1e-6 * values.max(initial=0.0)).sum())

    @property
    def residual(self):
        """How far the connected points are apart, in extents."""
        return float(np.abs(self.data.efc_pos[: self.data.ne]).max(initial=0.0)) / self.assembly.size

    def driven(self, seconds=SECONDS, samples=40):
        """Drive the joint over its range, eased in and out, to one end and to the other; return what happened."""
        (driver,) = self.assembly.driven
        values = self.assembly.path[:, driver]
        start, span = self.data.ctrl[0] if self.data.time else self.assembly.hinges[driver].angle, np.ptp(values)
        away = BESIDE * span * np.sign(values[-1] - values[0])
        goals = [values[-1] - away, *([values[0] + away] if abs(start - values[0]) > DOUBLE.parallel else [])]
        states, residual = [], 0.0
        for goal in goals:
            steps = int(seconds / self.model.opt.timestep / len(goals))
            for step in range(1, steps + 1):
                self.data.ctrl[0] = start + (goal - start) * (1.0 - np.cos(np.pi * step / steps)) / 2.0
                self.mujoco.mj_step(self.model, self.data)
                residual = max(residual, self.residual)
                if step % (steps // samples) == 0:
                    states.append(self.data.qpos.copy())
            start = goal
        return Driven(self, np.array(states), residual)


@dataclass
class Driven:
    """Joint angles of the tree, float[samples, joints], while it was driven, and the largest residual, in extents."""

    simulated: Simulated
    states: np.ndarray
    residual: float

    @property
    def error(self):
        """The largest difference between its angles and ours, where ours have the same angle of the driven joint."""
        simulated = self.simulated
        lengths = np.ones(len(simulated.assembly.hinges))
        lengths[list(simulated.at.linkage.slides)] = simulated.assembly.size
        path, places = simulated.assembly.path / lengths, simulated.places
        (driver,) = simulated.assembly.driven
        fine = np.concatenate([np.linspace(a, b, 20) for a, b in zip(path, path[1:], strict=False)])
        worst = 0.0
        for state in self.states / lengths[places]:
            near = fine[np.abs(fine[:, places] - state).max(axis=1).argmin()].copy()
            near[driver] = state[places.index(driver)]
            pose = corrected(simulated.at.closure, near, [driver])
            pose = exactly_held(simulated.at.closure, pose, [driver], near[[driver]])
            assert pose.closed
            worst = max(worst, float(np.abs(pose.angles[places] - state).max()))
        return worst


def crossing(one, radius, other, other_radius, side):
    """Return where two circles cross, to the left of the line between their middles for side 1."""
    apart = np.linalg.norm(other - one)
    along = (other - one) / apart
    x = (apart**2 + radius**2 - other_radius**2) / (2 * apart)
    return one + x * along + side * np.sqrt(radius**2 - x**2) * np.array([-along[1], along[0]])


def planar(links, joints, points):
    """Return a linkage in the plane by the points of its joints, which begin the names of these."""
    axes = {joint: ((*points[joint[0]], 0.0), (0.0, 0.0, 1.0)) for joint in joints}
    return HingedSolids(SCGraph(links, joints, ground="ground"), axes)


def planar_four_bar(a=(0.0, 0.1), coupler=0.4, rocker=0.3, base=0.4):
    """Return a four-bar; by default a crank of 0.1, a coupler of 0.4, a rocker of 0.3, a base of 0.4: Grashof."""
    a, d = np.array(a), np.array([base, 0.0])
    b = crossing(a, coupler, d, rocker, 1)
    joints = {
        "O": ("ground", "crank"),
        "A": ("crank", "coupler"),
        "B": ("coupler", "rocker"),
        "D": ("rocker", "ground"),
    }
    return planar(("ground", "crank", "coupler", "rocker"), joints, {"O": (0.0, 0.0), "A": a, "B": b, "D": d})


def planar_parallelogram():
    """Return a four-bar whose opposite sides are equal: all angles go in proportion."""
    return planar_four_bar((0.06, 0.08), 0.3, 0.1, 0.3)
