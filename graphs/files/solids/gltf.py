"""Meshes that move as glTF 2.0, one file with all in it: a node for each, its motion as an animation.

*glTF 2.0 Specification*, Khronos. Lengths there are metres, and y is up: a node above all others sees to both.
"""

import json
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from graphs.files.solids.meshes import SolidMesh
from graphs.printing import plain
from graphs.types import Floats

_LONGEST = 100  # letters: names are shown in trees of viewers, and may be ids of a thousand letters
_FLOATS = 5126  # number of 32-bit floats in glTF, as in OpenGL
_INDICES = 5125  # number of unsigned 32-bit integers: 16 bits would end at 65 535 corners
_CORNERS = 34962  # part of the buffer that holds corners (ARRAY_BUFFER of OpenGL)
_TRIANGLES = 34963  # part that holds their numbers (ELEMENT_ARRAY_BUFFER)
_METRES = 0.001  # glTF is in metres, meshes are in millimetres
_Y_UP = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]  # a quarter turn about x as a quaternion: in glTF y points up, here z
_MATERIAL = {"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.75, 1.0], "metallicFactor": 0.0}}


@dataclass
class _Buffer:
    """The numbers of a file, and where each row of them is."""

    data: bytearray = field(default_factory=bytearray)
    views: list[dict[str, Any]] = field(default_factory=list)
    accessors: list[dict[str, Any]] = field(default_factory=list)

    def add(self, values: npt.NDArray[Any], kind: str, component: int, *, target: int | None = None) -> int:
        """Put in rows of numbers; return the number of their accessor."""
        raw = np.ascontiguousarray(values, dtype="<f4" if component == _FLOATS else "<u4")
        view: dict[str, Any] = {"buffer": 0, "byteOffset": len(self.data), "byteLength": raw.nbytes}
        self.views.append(view if target is None else view | {"target": target})
        accessor = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(raw), "type": kind}
        if component == _FLOATS:
            rows = raw.reshape(len(raw), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.accessors.append(accessor)
        self.data += raw.tobytes()
        return len(self.accessors) - 1


def gltf_text(
    meshes: Sequence[SolidMesh], turns: Floats, shifts: Floats, *, seconds: float = 4.0, title: str = ""
) -> str:
    """Return meshes, each in its own frame, that move, as glTF text; all in millimetres.

    A corner c of a mesh is at turn @ c + shift, with rotation matrices float[frames, meshes, 3, 3] and shifts
    float[frames, meshes, 3]. `seconds` is from the first frame to the last; a single frame is not animated.
    """
    buffer = _Buffer()
    drawn = [_mesh(mesh, buffer) for mesh in meshes]
    quaternions = _quaternions(turns)
    above = len(meshes)
    nodes: list[dict[str, Any]] = [
        {
            "name": plain(mesh.name, _LONGEST),
            "mesh": number,
            "rotation": quaternions[0, number].tolist(),
            "translation": shifts[0, number].tolist(),
        }
        for number, mesh in enumerate(meshes)
    ]
    nodes.append({"children": list(range(above)), "rotation": _Y_UP, "scale": [_METRES] * 3})
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "synthedra"},
        "scene": 0,
        "scenes": [{"nodes": [above]} | ({"name": plain(title, _LONGEST)} if title else {})],
        "nodes": nodes,
        "meshes": drawn,
        "materials": [_MATERIAL],
    }
    if len(turns) > 1:
        document["animations"] = [_animation(quaternions, shifts, seconds, buffer)]
    uri = "data:application/octet-stream;base64," + b64encode(bytes(buffer.data)).decode("ascii")
    document |= {"accessors": buffer.accessors, "bufferViews": buffer.views}
    document["buffers"] = [{"byteLength": len(buffer.data), "uri": uri}]
    return json.dumps(document, allow_nan=False, separators=(",", ":")) + "\n"


def _mesh(mesh: SolidMesh, buffer: _Buffer) -> dict[str, Any]:
    corners = buffer.add(mesh.corners, "VEC3", _FLOATS, target=_CORNERS)
    indices = buffer.add(mesh.triangles.reshape(-1), "SCALAR", _INDICES, target=_TRIANGLES)
    return {"primitives": [{"attributes": {"POSITION": corners}, "indices": indices, "material": 0}]}


def _quaternions(turns: Floats) -> Floats:
    """Return rotations as quaternions, scalar last; each the nearer of the two that follow the frame before."""
    quaternions: Floats = Rotation.from_matrix(turns.reshape(-1, 3, 3)).as_quat().reshape(*turns.shape[:2], 4)
    for frame in range(1, len(quaternions)):
        against = (quaternions[frame] * quaternions[frame - 1]).sum(axis=-1) < 0
        quaternions[frame, against] *= -1
    return quaternions


def _animation(quaternions: Floats, shifts: Floats, seconds: float, buffer: _Buffer) -> dict[str, Any]:
    """Return the motion of all meshes; between frames turns go round evenly."""
    times = buffer.add(np.linspace(0, seconds, len(shifts)), "SCALAR", _FLOATS)
    samplers, channels = [], []
    for mesh in range(shifts.shape[1]):
        for path, kind, values in (("rotation", "VEC4", quaternions), ("translation", "VEC3", shifts)):
            samplers.append({"input": times, "output": buffer.add(values[:, mesh], kind, _FLOATS)})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": mesh, "path": path}})
    return {"name": "motion", "samplers": samplers, "channels": channels}
