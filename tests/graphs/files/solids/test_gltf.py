"""Motions as glTF: viewers turn from pose to pose by quaternions, whose sign is not that of the rotation."""

import base64
import json
from math import cos, radians, sin

import numpy as np

from graphs.files.solids.gltf import gltf_text
from graphs.files.solids.meshes import SolidMesh

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def about(axis, angle):
    cross = np.cross(axis, np.eye(3)).T
    return np.eye(3) + sin(angle) * cross + (1 - cos(angle)) * cross @ cross


def test_two_whole_turns_go_on_the_same_way():
    axis = np.array([2, -1, 2]) / 3
    turns = np.array([[about(axis, radians(angle))] for angle in range(0, 721, 40)])
    document = json.loads(gltf_text([SolidMesh("a", CORNERS, TRIANGLES)], turns, np.zeros((len(turns), 1, 3))))
    output = document["animations"][0]["samplers"][0]["output"]
    view = document["bufferViews"][document["accessors"][output]["bufferView"]]
    raw = base64.b64decode(document["buffers"][0]["uri"].partition(",")[2])
    found = np.frombuffer(raw, "<f4", 4 * len(turns), view["byteOffset"]).reshape(-1, 4)
    halves = np.radians(np.arange(0, 721, 40)) / 2
    wanted = np.column_stack([np.outer(np.sin(halves), axis), np.cos(halves)])
    np.testing.assert_allclose(found, wanted, atol=1e-6)
