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


def document(name: str) -> dict[str, Any]:
    """Return the document of a task."""
    return {"format": "synthedra/task", "version": 1, **TASKS[name]}
