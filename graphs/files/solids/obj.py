"""Meshes as Wavefront OBJ, an object each."""

from __future__ import annotations

from collections.abc import Sequence

from graphs.files.solids.mesh import Mesh
from graphs.printing import plain

__all__ = ["obj_of_meshes"]

_LONGEST = 100


def obj_of_meshes(meshes: Sequence[Mesh]) -> str:
    """Return meshes as OBJ text, in millimetres."""
    rows, before = ["# millimetres"], 1
    for mesh in meshes:
        rows.append(f"o {plain(mesh.name, _LONGEST).replace(' ', '_')}")
        rows += [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.corners.tolist()]
        rows += [f"f {a} {b} {c}" for a, b, c in (mesh.triangles + before).tolist()]
        before += len(mesh.corners)
    return "\n".join(rows) + "\n"
