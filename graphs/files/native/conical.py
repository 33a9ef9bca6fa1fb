"""Files of linkages on cones: a chain with link angles, or with steps between its joint axes and lambda.

Format ``synthedra/conical``: the keys of ``synthedra/sc``, and one of

- ``angles``: ``[[joint, joint, degrees], ...]``, link angles between two joints of one link;
- ``steps``: the same, signed projected angles between any two joints, and optionally ``lambda_deg``.

Schema: graphs/schema/conical.schema.json. Guide: docs/native-json.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees, radians
from typing import Any

from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.native.graphs import read_sc, sc_document
from graphs.files.native.names import written
from graphs.ids import JointId
from graphs.mechanism.conical import ConicalLinkage, Pair, places_of_steps
from graphs.mechanism.sc import SCGraph

__all__ = ["conical_document", "conical_from_document"]

_FORMAT = "synthedra/conical"
_KEYS = ("format", "version", "links", "joints", "loops")
_OPTIONAL = ("ground", "angles", "steps", "lambda_deg")


def conical_from_document(value: Mapping[str, Any], check: Checker) -> ConicalLinkage:
    """Read a linkage on a cone from its document."""
    path = check.path
    check.mapping(value, "", _KEYS, _OPTIONAL)
    chain = read_sc({key: value[key] for key in value if key not in ("angles", "steps", "lambda_deg")}, check)
    if not chain.loops:
        raise FileError(path, "loops", "no loops", "the loops that lie on the cone")
    if ("angles" in value) == ("steps" in value):
        raise FileError(path, "", "both or neither of 'angles' and 'steps'", "one of them")
    if "angles" in value:
        if "lambda_deg" in value:
            raise FileError(
                path, "lambda_deg", "a cone angle with link angles", "steps: link angles tell the cone"
            )
        return ConicalLinkage(chain, angles=_pairs(value["angles"], "angles", chain, check))
    steps = _pairs(value["steps"], "steps", chain, check)
    cone_angle = None
    if "lambda_deg" in value:
        number = check.number(value["lambda_deg"], "lambda_deg")
        if not 0 <= number < 90:
            raise FileError(path, "lambda_deg", shown(value["lambda_deg"]), "0 or more, and less than 90")
        cone_angle = radians(number)
    made = ConicalLinkage(chain, steps=steps, cone_angle=cone_angle)
    placed = check.build(lambda: places_of_steps(steps), place="steps")
    missing = [joint for joint in chain.joints if joint not in placed]
    if missing:
        raise FileError(path, "steps", f"no step leads to joint {shown(missing[0])}", "steps to every joint")
    return made


def _pairs(value: Any, key: str, chain: SCGraph, check: Checker) -> dict[Pair, float]:
    """Read a list of [joint, joint, degrees]."""
    found: dict[Pair, float] = {}
    for i, item in enumerate(check.list(value, key, what="a list of [joint, joint, degrees]")):
        place = f"{key}[{i}]"
        a, b, number = check.list(item, place, 3, "[joint, joint, degrees]")
        ends: list[JointId] = []
        for k, joint in enumerate((a, b)):
            name = check.name(joint, f"{place}[{k}]", "a joint id")
            if name not in chain.joints:
                raise FileError(check.path, f"{place}[{k}]", f"{shown(name)} is no joint", "a joint id")
            ends.append(name)
        if a == b:
            raise FileError(check.path, place, f"joint {shown(a)} twice", "two joints")
        if (a, b) in found or (b, a) in found:
            raise FileError(check.path, place, f"joints {shown(a)} and {shown(b)} again", "each pair once")
        angle = check.number(number, f"{place}[2]")
        low, high = (0.0, 180.0) if key == "angles" else (-360.0, 360.0)
        if not low < angle < high:
            raise FileError(check.path, f"{place}[2]", shown(number), f"between {low:g} and {high:g} degrees")
        found[ends[0], ends[1]] = radians(angle)
    return found


def conical_document(linkage: ConicalLinkage) -> dict[str, Any]:
    """Return the native document of a linkage on a cone."""
    document = sc_document(linkage.chain) | {"format": _FORMAT}
    for key, pairs in (("angles", linkage.angles), ("steps", linkage.steps)):
        if pairs is not None:
            document[key] = [[written(a), written(b), round(degrees(x), 10)] for (a, b), x in pairs.items()]
    if linkage.cone_angle is not None:
        document["lambda_deg"] = round(degrees(linkage.cone_angle), 10)
    return document
