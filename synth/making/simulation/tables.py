"""The motion of a driven joint as a table: joint angles, the moment that loads ask of the driver, errors between rows.

Rows are solved for, each closed to the tolerance of the middle; what interpolation leaves between two rows is
measured at three configurations that are solved for too. The moment of the driver is that of virtual work: what
weight, springs and moments at joints do while it turns.
"""

import csv
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from io import StringIO
from math import degrees

import numpy as np
from scipy.interpolate import CubicSpline

from graphs.errors import UnsolvableError
from graphs.geometry import rotations
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.motion.driven_motion import MotionOptions, driven_from
from synth.analysis.motion.singular.second_order import rates_at
from synth.making.simulation.assembly import Assembly, turns_back
from synth.making.simulation.bodies import Hinge
from synth.making.simulation.connections import Parting

ROWS = 128
"""Intervals of a table."""
_BETWEEN = 4
_GRAVITY = 9.81
_SAFE = 1.5


@dataclass(frozen=True, eq=False)
class MotionTable:
    """Joint angles at even steps of a driven joint.

    Attributes
    ----------
    driver : int
        The driven hinge.
    angles : float[N, hinges]
        Radians, lengths of slides metres.
    torques : float[N]
        Newton metres (of a slide newtons) that hold the driver against weight, along -z, springs and moments at
        joints; not a number where its rates are not determined.
    linear : float
        A bound of the error of linear interpolation, radians, by second differences of the rows between.
    cubic : float
        The largest error of a cubic spline through the rows that was measured between them.
    """

    driver: int
    angles: Floats
    torques: Floats
    linear: float
    cubic: float


@lru_cache(maxsize=4)
def motion_table(assembly: Assembly, rows: int = ROWS) -> MotionTable:
    """Return the motion of the driven joint of an assembly.

    UnsolvableError unless one joint drives one freedom, and never turns back.
    """
    if len(assembly.driven) != 1 or assembly.freedoms != 1:
        freedoms, driven = assembly.freedoms, len(assembly.driven)
        raise UnsolvableError(f"a table requires 1 driven joint and 1 degree of freedom, not {driven} and {freedoms}")
    at, (driver,) = assembly.configuration, assembly.driven
    if turns_back(assembly.path[:, driver]):
        raise UnsolvableError(
            "the driven joint turns back on the way, so other angles are no functions of its angle; try another joint"
        )
    if abs(assembly.path[-1, driver] - assembly.path[0, driver]) <= DOUBLE.same_configuration:
        raise UnsolvableError("a table requires a range, and the driven joint ends where it begins")
    values = np.linspace(assembly.path[0, driver], assembly.path[-1, driver], _BETWEEN * rows + 1)
    lengths = np.where([hinge.slide for hinge in assembly.hinges], assembly.size, 1.0)
    given = assembly.options
    joint = assembly.hinges[driver].joint
    end = {joint: float(values[-1] / lengths[driver])}
    wanted = MotionOptions(
        given.drive and end, branch=given.branch, frames=len(values) - 1, values=values[1:, None] / lengths[driver]
    )
    fine = driven_from(at, wanted).path.angles
    if len(fine) != len(values):
        raise UnsolvableError("the driven joint cannot be followed along its range in small steps")
    fine = fine * lengths
    angles = fine[::_BETWEEN]
    steps = np.arange(len(fine)) / _BETWEEN
    base = steps.astype(int).clip(max=rows - 1)
    part = (steps - base)[:, None]
    between = angles[base] * (1.0 - part) + angles[base + 1] * part
    curved = np.abs(np.diff(fine, 2, axis=0)).max(initial=0.0)
    linear = float(np.abs(between - fine).max() + _SAFE * curved / 8.0)
    cubic = float(np.abs(CubicSpline(np.arange(rows + 1), angles)(steps) - fine).max())
    torques = np.array([_torque(assembly, driver, row / lengths) for row in angles])
    return MotionTable(driver, angles, torques, linear, cubic)


def _torque(assembly: Assembly, driver: int, angles: Floats) -> float:
    """Return the moment of the driver against weight, springs and moments at joints, by virtual work."""
    at, size = assembly.configuration, assembly.size
    rates = rates_at(at.closure, angles, at.tolerances.singular)
    if rates.shape[1] != 1 or not rates[driver, 0]:
        return float("nan")
    slides = np.array([hinge.slide for hinge in assembly.hinges])
    lengths = np.where(slides, size, 1.0)
    rates = rates[:, 0] * lengths / (rates[driver, 0] * lengths[driver])
    hinges, centres = placed(assembly, angles)
    of_tree = np.array([joint.hinge for joint in assembly.tree])
    parting = Parting(hinges, assembly.tree, len(assembly.bodies), size)
    in_extents = np.where(slides[of_tree], rates[of_tree] / size, rates[of_tree])
    twists = parting.twists(in_extents)
    heights = (twists[:, 3:] + np.cross(twists[:, :3], centres))[:, 2]
    masses = np.array([body.properties.mass for body in assembly.bodies])
    turned = angles * lengths
    moments = (h.stiffness * (turned[n] - h.rest) - h.moment for n, h in enumerate(assembly.hinges))
    springs = sum(moment * rate for moment, rate in zip(moments, rates, strict=True))
    return float(_GRAVITY * masses @ heights + springs)


def placed(assembly: Assembly, angles: Floats) -> tuple[Sequence[Hinge], Floats]:
    """Return the hinges of the tree and the centres of mass, float[bodies, 3], at joint angles, with the base fixed."""
    rotation, shift = motions(assembly, angles)
    hinges = [
        replace(
            hinge, point=rotation[hinge.first] @ hinge.point + shift[hinge.first],
            direction=rotation[hinge.first] @ hinge.direction,
        )
        for hinge in assembly.hinges
    ]  # fmt: skip
    centres = np.array([body.properties.centre for body in assembly.bodies])
    return hinges, (rotation @ centres[..., None])[..., 0] + shift


def motions(assembly: Assembly, angles: Floats) -> tuple[Floats, Floats]:
    """Return how bodies have moved to other joint angles, along the tree: float[bodies, 3, 3], float[bodies, 3].

    Angles are radians, lengths of slides in extents, as for `Configuration`.
    """
    count = len(assembly.bodies)
    rotation, shift = np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3))
    for joint in assembly.tree:
        hinge = assembly.hinges[joint.hinge]
        value = angles[joint.hinge] * (assembly.size if hinge.slide else 1.0) - hinge.angle
        value *= joint.sense
        step = np.eye(3) if hinge.slide else rotations(hinge.direction, value)
        along = value * hinge.direction if hinge.slide else hinge.point - step @ hinge.point
        rotation[joint.child] = rotation[joint.parent] @ step
        shift[joint.child] = rotation[joint.parent] @ along + shift[joint.parent]
    return rotation, shift


def csv_bytes(assembly: Assembly) -> bytes:
    """Return the table of a motion as CSV: degrees, metres, newton metres."""
    table = motion_table(assembly)
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    columns = [f"{hinge.name}_{'m' if hinge.slide else 'deg'}" for hinge in assembly.hinges]
    order = [table.driver, *(number for number in range(len(columns)) if number != table.driver)]
    writer.writerow([*(columns[number] for number in order), "driver_moment"])
    for row, torque in zip(table.angles.tolist(), table.torques.tolist(), strict=True):
        cells = [row[number] if assembly.hinges[number].slide else degrees(row[number]) for number in order]
        writer.writerow([*(cell + 0.0 for cell in cells), "" if np.isnan(torque) else torque])
    return stream.getvalue().encode()


def lost_as_table(assembly: Assembly) -> tuple[str, ...]:
    """Return what a table does not hold."""
    linear = motion_table(assembly).linear
    return ("bodies and joints, but for their angles", f"angles between rows, but to {linear:.1e} by interpolation")
