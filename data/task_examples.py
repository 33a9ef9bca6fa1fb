"""Tasks: what bodies are to do, of whatever type."""

from __future__ import annotations

from typing import Any

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


APART = [{"roles": ["base", "output"], "number": [2, None]}]
TASKS: dict[str, dict[str, Any]] = {
    "lid": {
        "title": "a lid that takes three orientations about one point",
        "links": 4,
        "types": ["sc", "chains"],
        "system": "spherical",
        "distance": APART,
        "wishes": poses(turned((1, 0, 0), 35), turned((2, 1, 0), 70)),
    }
}


def document(name: str) -> dict[str, Any]:
    """Return the document of a task."""
    return {"format": "synthedra/task", "version": 1, **TASKS[name]}
