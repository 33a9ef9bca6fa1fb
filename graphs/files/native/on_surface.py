"""Files of linkages on cones and cylinders: a chain with sizes of links, or with steps between its joint axes.

Formats ``synthedra/conical`` and ``synthedra/cylindrical``: the keys of ``synthedra/sc``, and one of

- ``angles``: ``[[joint, joint, degrees], ...]``, link angles between two joints of one link; on a cylinder
  ``lengths``, in any one unit;
- ``steps``: the same, signed projected angles between any two joints, and optionally ``lambda_deg``; on a cylinder
  ``radius``.

Schemas: graphs/schema/conical.schema.json, graphs/schema/cylindrical.schema.json. Guide: docs/native-json.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees, inf, radians
from typing import Any

from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.native.graphs import read_sc, sc_document
from graphs.files.native.names import written
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, Pair, Surface, SurfaceLinkage, as_planar, places_of_steps
from graphs.types import JointId

__all__ = ["linkage_document", "linkage_from_document"]

_KEYS = ("format", "version", "links", "joints", "loops")
_SIZES = {"cone": "angles", "cylinder": "lengths"}
_SURFACE = {"cone": "lambda_deg", "cylinder": "radius"}
_RANGES = {"angles": (0.0, 180.0, " degrees"), "lengths": (0.0, inf, ""), "steps": (-360.0, 360.0, " degrees")}
_FORMATS = {"cone": "synthedra/conical", "cylinder": "synthedra/cylindrical"}


def linkage_from_document(value: Mapping[str, Any], check: Checker) -> SurfaceLinkage:
    """Read a linkage on a cone or a cylinder from its document."""
    path = check.path
    kind = next(kind for kind, name in _FORMATS.items() if name == value["format"])
    sizes, surface = _SIZES[kind], _SURFACE[kind]
    check.mapping(value, "", _KEYS, ("ground", sizes, "steps", surface))
    chain = read_sc({key: value[key] for key in value if key not in (sizes, "steps", surface)}, check)
    if not chain.loops:
        raise FileError(path, "loops", "no loops", f"the loops that lie on the {kind}")
    if kind == "cylinder":
        chain = as_planar(chain)
    if (sizes in value) == ("steps" in value):
        raise FileError(path, "", f"both or neither of '{sizes}' and 'steps'", "one of them")
    if sizes in value:
        if surface in value:
            raise FileError(path, surface, f"a {kind} with {sizes}", f"steps: {sizes} tell the {kind}")
        pairs = _pairs(value[sizes], sizes, chain, check)
        on_cone = kind == "cone"
        return SurfaceLinkage(chain, angles=pairs if on_cone else None, lengths=None if on_cone else pairs)
    steps = _pairs(value["steps"], "steps", chain, check)
    made = SurfaceLinkage(
        chain, steps=steps, surface=_surface(value[surface], surface, check) if surface in value else None
    )
    placed = check.build(lambda: places_of_steps(steps), place="steps")
    missing = [joint for joint in chain.joints if joint not in placed]
    if missing:
        raise FileError(path, "steps", f"no step leads to joint {shown(missing[0])}", "steps to every joint")
    return made


def _surface(value: Any, key: str, check: Checker) -> Surface:
    number = check.number(value, key)
    if key == "radius":
        if not number > 0:
            raise FileError(check.path, key, shown(value), "a number above 0")
        return Cylinder(number)
    if not 0 <= number < 90:
        raise FileError(check.path, key, shown(value), "0 or more, and less than 90")
    return Cone(radians(number))


def _pairs(value: Any, key: str, chain: SCGraph, check: Checker) -> dict[Pair, float]:
    """Read a list of [joint, joint, size]; degrees become radians."""
    found: dict[Pair, float] = {}
    what = f"a list of [joint, joint, {'length' if key == 'lengths' else 'degrees'}]"
    for i, item in enumerate(check.list(value, key, what=what)):
        place = f"{key}[{i}]"
        a, b, number = check.list(item, place, 3, what[10:])
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
        size = check.number(number, f"{place}[2]")
        low, high, unit = _RANGES[key]
        if not low < size < high:
            expected = "a number above 0" if high == inf else f"between {low:g} and {high:g}{unit}"
            raise FileError(check.path, f"{place}[2]", shown(number), expected)
        found[ends[0], ends[1]] = radians(size) if unit else size
    return found


def linkage_document(linkage: SurfaceLinkage) -> dict[str, Any]:
    """Return the native document of a linkage on a cone or a cylinder."""
    document = sc_document(linkage.chain) | {"format": _FORMATS[linkage.kind]}
    for key in ("angles", "lengths", "steps"):
        pairs = getattr(linkage, key)
        if pairs is not None:
            told = _in_file if _RANGES[key][2] else float
            document[key] = [[written(a), written(b), told(x)] for (a, b), x in pairs.items()]
    surface = linkage.surface
    if isinstance(surface, Cone):
        document["lambda_deg"] = _in_file(surface.angle)
    elif surface is not None:
        document["radius"] = float(f"{surface.radius:.13g}")
    return document


def _in_file(angle: float) -> float:
    return round(degrees(angle), 10)
