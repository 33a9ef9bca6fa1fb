"""Meshes as binary STL: 80 bytes for people, then triangles as 32-bit numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphs.files.solids.mesh import Mesh
from graphs.geometry import unit

__all__ = ["stl_bytes"]

_HEAD = b"binary STL, millimetres".ljust(80)
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def stl_bytes(meshes: Sequence[Mesh]) -> bytes:
    """Return meshes as one binary STL file, which does not tell them apart."""
    corners = np.concatenate([mesh.corners[mesh.triangles] for mesh in meshes])
    rows = np.zeros(len(corners), dtype=_TRIANGLE)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    rows["normal"] = unit(normals)
    rows["corners"] = corners
    return _HEAD + len(rows).to_bytes(4, "little") + rows.tobytes()
