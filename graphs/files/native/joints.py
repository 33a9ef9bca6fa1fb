"""Files of linkages with joints of all kinds: a chain, the type of each joint, and perhaps its place.

Format ``synthedra/joints``: the keys of ``synthedra/sc``, ``loops`` left out if none has a centre (where that is
infinite, of slides and planar joints too), and in ``joints`` objects with ``id``, ``links`` and

- ``type``: R, P, U, S, C, E, or the word (revolute, prismatic, universal, spherical, cylindrical, planar); left
  out it is R;
- ``point`` and ``axes``: its place, of all joints or of none.

Schema: graphs/schema/joints.schema.json. Guide: docs/native-json.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphs.errors import FileError, InvariantError
from graphs.files.check import Checker
from graphs.files.native.graphs import read_sc, sc_document
from graphs.files.native.names import written
from graphs.joints.kinds import JointKind, kind_named
from graphs.joints.linkage import JointedLinkage, JointPlace, Vector
from graphs.types import JointId

__all__ = ["joints_document", "joints_from_document"]

_KEYS = ("format", "version", "links", "joints")


def joints_from_document(value: Mapping[str, Any], check: Checker) -> JointedLinkage:
    """Read a linkage with joints of all kinds from its document."""
    check.mapping(value, "", _KEYS, ("loops", "closing", "ground"))
    items = check.list(value["joints"], "joints", what="a list of joints")
    chain = read_sc({"loops": [], **value, "joints": [_bare(item) for item in items]}, check)
    kinds: dict[JointId, JointKind] = {}
    places: dict[JointId, JointPlace] = {}
    for number, (joint, item) in enumerate(zip(chain.joints, items, strict=True)):
        place = f"joints[{number}]"
        told = item if isinstance(item, dict) else {}
        check.mapping(told, place, (), ("id", "links", "type", "point", "axes"))
        if "type" in told:
            kinds[joint] = _kind(told["type"], f"{place}.type", check)
        if "point" in told:
            places[joint] = _place(told, place, check)
        elif "axes" in told:
            raise FileError(check.path, place, "axes without a point", "both")
    number_of = {joint: number for number, joint in enumerate(chain.joints)}
    return check.build(lambda: JointedLinkage(chain, kinds, places), lambda part: f"joints[{number_of[part[1]]}]")


def _bare(item: Any) -> Any:
    """Return a joint as an SC graph has it; what is no object is left to its reader."""
    if not isinstance(item, dict):
        return item
    return {key: item[key] for key in item if key not in ("type", "point", "axes")}


def _kind(value: Any, place: str, check: Checker) -> JointKind:
    try:
        return kind_named(check.text(value, place))
    except InvariantError as error:
        raise FileError(check.path, place, error.offender, error.expected) from None


def _place(item: Mapping[str, Any], place: str, check: Checker) -> JointPlace:
    axes = check.list(item.get("axes", []), f"{place}.axes", what="a list of directions")
    return JointPlace(
        _vector(item["point"], f"{place}.point", check),
        tuple(_vector(axis, f"{place}.axes[{i}]", check) for i, axis in enumerate(axes)),
    )


def _vector(value: Any, place: str, check: Checker) -> Vector:
    x, y, z = check.list(value, place, 3, "three numbers")
    return check.number(x, f"{place}[0]"), check.number(y, f"{place}[1]"), check.number(z, f"{place}[2]")


def joints_document(linkage: JointedLinkage) -> dict[str, Any]:
    """Return the native document of a linkage with joints of all kinds."""
    joints = []
    for joint, ends in linkage.chain.joints.items():
        item: dict[str, Any] = {
            "id": written(joint),
            "links": [written(end) for end in ends],
            "type": linkage.kinds[joint].value,
        }
        if joint in linkage.places:
            place = linkage.places[joint]
            item |= {"point": list(place.point), "axes": [list(axis) for axis in place.axes]}
        joints.append(item)
    document = sc_document(linkage.chain) | {"format": "synthedra/joints", "joints": joints}
    if not document["loops"]:
        del document["loops"]
    return document
