"""Tasks: what bodies are to do, of whatever type."""

from __future__ import annotations

from typing import Any

from orientation_tasks import CORRECTED
from scipy.spatial.transform import Rotation


def turned(axis: tuple[float, float, float], degrees: float) -> list[float]:
    """Return the quaternion of a rotation, scalar first, with nine decimals."""
    size = sum(x * x for x in axis) ** 0.5
    turn = Rotation.from_rotvec([degrees * x / size for x in axis], degrees=True)
    return [round(x, 9) for x in turn.as_quat(scalar_first=True).tolist()]


def poses(*quaternions: list[float]) -> dict[str, Any]:
    """Return wishes for the output: from where it is through further orientations."""
    names = [f"pose {number}" for number, _ in enumerate(quaternions, 2)]
    return {
        "configurations": [{"name": name} for name in names],
        "wishes": [
            {"kind": "orientation", "at": name, "link": "output", "quaternion": one}
            for name, one in zip(names, quaternions, strict=True)
        ],
    }


def at_inputs(angles: list[float], quaternions: list[list[float]]) -> dict[str, Any]:
    """Return wishes for the output: an orientation for each angle of the driven joint."""
    wishes = poses(*quaternions)
    for one, angle in zip(wishes["configurations"], angles, strict=True):
        one["inputs"] = {"base-input": angle}
    return {"driver": "base-input", **wishes}


def from_the_first(quaternions: list[tuple[float, float, float, float]]) -> list[list[float]]:
    """Return orientations from the first of several on, as rotations from it, with nine decimals."""
    first, *others = (Rotation.from_quat(one, scalar_first=True) for one in quaternions)
    return [[round(x, 9) for x in (turn * first.inv()).as_quat(scalar_first=True).tolist()] for turn in others]


FAMILIES = ("bennett", "goldberg", "myard", "sarrus", "bricard-line-symmetric", "bricard-plane-symmetric")
APART = [{"roles": ["base", "output"], "number": [2, None]}]
TASKS: dict[str, dict[str, Any]] = {
    "lid": {
        "title": "a lid that takes three orientations about one point",
        "links": 4,
        "types": ["sc", "chains"],
        "system": "spherical",
        "distance": APART,
        "wishes": poses(turned((1, 0, 0), 35), turned((2, 1, 0), 70)),
    },
    "five-orientations": {
        "title": "the five orientations of Tipparthi and Larochelle",
        "types": ["sc", "chains"],
        "system": "spherical",
        "distance": APART,
        "wishes": poses(*from_the_first(CORRECTED)),
    },
    "skew-axes": {
        "title": "four links between two skew axes",
        "roles": ["base", "input", "output"],
        "links": 4,
        "system": "spatial",
        "types": ["chains", "generators"],
        "generators": {name: {} for name in FAMILIES},
        "distance": [{"roles": ["base", "input"], "number": 1}, {"roles": ["base", "output"], "number": 1}],
        "relative_mobility": [{"roles": ["base", "output"], "number": 1}],
        "wishes": {
            "driver": "base-input",
            "configurations": [{"name": "turned", "inputs": {"base-input": 30}}],
            "wishes": [
                {"kind": "arc", "joints": ["base-input", "base-output"], "equals": 50},
                {"kind": "angle", "at": "turned", "joint": "base-output", "equals": -45},
            ],
        },
    },
    "straight-lift": {
        "title": "a platform that rises and does not turn",
        "links": 6,
        "system": "spatial",
        "types": ["generators"],
        "generators": {name: {} for name in FAMILIES},
        "distance": [{"roles": ["base", "output"], "number": 3}],
        "wishes": {
            "configurations": [{"name": "lower"}],
            "wishes": [
                {"kind": "orientation", "at": "lower", "link": "output", "quaternion": [1, 0, 0, 0]},
                {
                    "kind": "place",
                    "at": "lower",
                    "point": {"link": "output", "point": [0, 0, 0]},
                    "equals": [0, 0, -0.2],
                },
            ],
        },
    },
    "packing": {
        "title": "a sheet with one degree of freedom that packs to half its area",
        "roles": [],
        "links": 4,
        "form": "sheet",
        "types": ["generators"],
        "generators": {name: {"rows": 2, "columns": 2} for name in ("miura", "map", "chickenwire")},
        "wishes": {
            "configurations": [{"name": "packed"}],
            "wishes": [{"kind": "ratio", "at": "packed", "of": "area", "over": "pose", "at_most": 0.5}],
        },
    },
}

TASKS |= {
    "four-fingers": {
        "title": "a sheet with five degrees of freedom that opens in two ways: panels across its middle turn apart "
        "about either of two axes",
        "links": [8, 16],
        "degrees_of_freedom": 5,
        "form": "sheet",
        "types": ["generators"],
        "symmetry": [4, None],
        "distance": [{"roles": ["base", "output"], "number": [4, None]}],
        "wishes": {**poses(turned((1, 0, 0), 90), turned((0, 1, 0), 90)), "in_order": False},
    },
    "on-a-cone": {
        "title": "a linkage on a cone that takes a panel through two orientations at two angles of its crank",
        "roles": ["base", "input", "output"],
        "form": "cone",
        "distance": [{"roles": ["base", "input"], "number": 1}, {"roles": ["base", "output"], "number": 2}],
        "wishes": at_inputs([30, 60], [turned((6, 1, 0), 36), turned((5, 2, 0), 68)]),
    },
    "pop-up": {
        "title": "a panel that stays parallel to one half of a card while the card is closed",
        "roles": ["base", "input", "output"],
        "links": 4,
        "form": "sheet",
        "types": ["scd", "generators"],
        "centres_at_infinity": True,
        "distance": [{"roles": ["base", "output"], "number": 2}, {"roles": ["input", "output"], "number": 1}],
        "wishes": at_inputs([45, 90], [[1, 0, 0, 0], [1, 0, 0, 0]]),
    },
    "carton": {
        "title": "a carton: a panel of its floor goes down while the wall beside it is turned outward",
        "roles": ["base", "input", "output"],
        "links": 8,
        "system": "hybrid",
        "centres": 3,
        "symmetry": [4, None],
        "types": ["generators", "sc"],
        "centres_at_infinity": True,
        "distance": [{"roles": ["base", "input"], "number": 1}, {"roles": ["base", "output"], "number": 1}],
        "wishes": {
            "configurations": [{"name": "wider"}],
            "wishes": [
                {"kind": "orientation", "at": "wider", "link": "input", "quaternion": turned((0, 0, 1), 15)},
                {"kind": "orientation", "at": "wider", "link": "output", "quaternion": turned((1, 0, 0), 20)},
            ],
        },
    },
}


def document(name: str) -> dict[str, Any]:
    """Return the document of a task."""
    return {"format": "synthedra/task", "version": 1, **TASKS[name]}
