"""Files of solids hinged at edges: a chain, and for each joint a point of its axis and the direction.

Format ``synthedra/solids``: the keys of ``synthedra/sc``, and

- ``axes``: ``[{"joint": id, "point": [x, y, z], "direction": [x, y, z]}, ...]``, one for each joint.

Schema: graphs/schema/solids.schema.json. Guide: docs/native-json.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.native.graphs import read_sc, sc_document
from graphs.files.native.names import written
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis, HingedSolids, Vector
from graphs.types import JointId

__all__ = ["solids_document", "solids_from_document"]

_KEYS = ("format", "version", "links", "joints", "loops", "axes")


def solids_from_document(value: Mapping[str, Any], check: Checker) -> HingedSolids:
    """Read hinged solids from their document."""
    check.mapping(value, "", _KEYS, ("ground", "special"))
    chain = read_sc({key: value[key] for key in value if key != "axes"}, check)
    axes = _axes(value["axes"], chain, check)
    place_of = {joint: f"axes[{place}]" for place, joint in enumerate(axes)}
    return check.build(lambda: HingedSolids(chain, axes), lambda part: place_of.get(part[1], "axes"), "axes")


def _axes(value: Any, chain: SCGraph, check: Checker) -> dict[JointId, Axis]:
    axes: dict[JointId, Axis] = {}
    for i, item in enumerate(check.list(value, "axes", what="a list of axes")):
        place = f"axes[{i}]"
        check.mapping(item, place, ("joint", "point", "direction"))
        joint = check.name(item["joint"], f"{place}.joint", "a joint id")
        if joint not in chain.joints:
            raise FileError(check.path, f"{place}.joint", f"{shown(joint)} is no joint", "a joint id")
        if joint in axes:
            raise FileError(check.path, place, f"joint {shown(joint)} again", "one axis for each joint")
        axes[joint] = (_vector(item, "point", place, check), _vector(item, "direction", place, check))
    return axes


def _vector(item: Mapping[str, Any], key: str, place: str, check: Checker) -> Vector:
    x, y, z = check.list(item[key], f"{place}.{key}", 3, "three numbers")
    return (
        check.number(x, f"{place}.{key}[0]"),
        check.number(y, f"{place}.{key}[1]"),
        check.number(z, f"{place}.{key}[2]"),
    )


def solids_document(solids: HingedSolids) -> dict[str, Any]:
    """Return the native document of hinged solids."""
    return sc_document(solids.chain) | {
        "format": "synthedra/solids",
        "axes": [
            {"joint": written(joint), "point": list(point), "direction": list(direction)}
            for joint, (point, direction) in solids.axes.items()
        ],
    }
