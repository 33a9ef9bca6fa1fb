"""Wishes as JSON: read with the place of whatever is wrong, and the schema, both from one table of kinds.

Angles are degrees, lengths in the unit of the mechanism. Guide: docs/native-json.md.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import radians
from pathlib import Path
from typing import Any

from graphs.errors import FileError, SynthedraError, shown
from graphs.files.text import Checker, load_json
from synth.synthesis.designing.placement import DesignPoint
from synth.synthesis.designing.sizes import (
    BoxSize,
    CellCurvatures,
    EdgeLengths,
    EqualArcs,
    EqualLengths,
    LinkArc,
    PanelCorners,
    SheetArea,
    SizeRatio,
    Symmetry,
)
from synth.synthesis.designing.targets import Formula, Polyline, Target, read_mesh
from synth.synthesis.designing.wishes import (
    POSE,
    Goal,
    JointAngle,
    LinkDirection,
    LinkOrientation,
    PointDistance,
    PointPlace,
    PointsOn,
    TransmissionAngle,
    Wish,
    WishedConfiguration,
    Wishes,
)

FORMAT, VERSION = "synthedra/wishes", 1

_NAME: dict[str, Any] = {"type": ["string", "integer"]}
_NUMBER: dict[str, Any] = {"type": "number"}


def _list(item: Mapping[str, Any], least: int, most: int | None = None) -> dict[str, Any]:
    schema: dict[str, Any] = {"type": "array", "items": dict(item), "minItems": least}
    return schema if most is None else {**schema, "maxItems": most}


@dataclass(frozen=True, slots=True)
class _Value:
    """How a value is read, with a place for errors, and its schema."""

    read: Callable[[Checker, Any, str], Any]
    schema: Mapping[str, Any]


def _name(check: Checker, value: Any, place: str) -> str:
    return str(check.name(value, place))


def _numbers(length: int) -> Callable[[Checker, Any, str], tuple[float, ...]]:
    def read(check: Checker, value: Any, place: str) -> tuple[float, ...]:
        check.list(value, place, length, f"a list of {length} numbers")
        return tuple(check.number(item, where) for where, item in check.items(value, place))

    return read


def _some_numbers(check: Checker, value: Any, place: str) -> tuple[float | None, ...]:
    check.list(value, place, 3, "a list of 3 numbers or null")
    return tuple(None if item is None else check.number(item, where) for where, item in check.items(value, place))


def _names(length: int) -> Callable[[Checker, Any, str], tuple[str, ...]]:
    def read(check: Checker, value: Any, place: str) -> tuple[str, ...]:
        check.list(value, place, length, f"a list of {length} joints")
        return tuple(_name(check, item, where) for where, item in check.items(value, place))

    return read


def _point(check: Checker, value: Any, place: str) -> DesignPoint:
    if isinstance(value, dict) and "vertex" in value:
        check.mapping(value, place, ("vertex",))
        return DesignPoint(vertex=check.integer(value["vertex"], f"{place}.vertex"))
    check.mapping(value, place, ("link", "point"))
    x, y, z = _numbers(3)(check, value["point"], f"{place}.point")
    return DesignPoint(_name(check, value["link"], f"{place}.link"), (x, y, z))


def _points(check: Checker, value: Any, place: str) -> tuple[DesignPoint, ...]:
    return tuple(_point(check, item, where) for where, item in check.items(value, place, "a list of points"))


def _two_points(check: Checker, value: Any, place: str) -> tuple[DesignPoint, ...]:
    check.list(value, place, 2, "two points")
    return _points(check, value, place)


def _target(check: Checker, value: Any, place: str) -> Target:
    check.mapping(value, place, (), ("formula", "file", "path"))
    if len(value) != 1:
        raise FileError(check.path, place, f"{len(value)} targets", "one of formula, file and path")
    if "formula" in value:
        text = check.text(value["formula"], f"{place}.formula")
        return check.build(lambda: Formula(text), place=f"{place}.formula")
    if "file" in value:
        return read_mesh(check.path.parent / check.text(value["file"], f"{place}.file"))
    corners = [_numbers(3)(check, item, where) for where, item in check.items(value["path"], f"{place}.path")]
    if len(corners) < 2:
        raise FileError(check.path, f"{place}.path", f"a path of {len(corners)} points", "2 or more")
    return Polyline(tuple((x, y, z) for x, y, z in corners))


def _arcs(check: Checker, value: Any, place: str) -> tuple[tuple[str, ...], ...]:
    check.list(value, place, 2, "two arcs")
    return tuple(_names(2)(check, item, where) for where, item in check.items(value, place))


def _vertices(length: int) -> Callable[[Checker, Any, str], tuple[int, ...]]:
    def read(check: Checker, value: Any, place: str) -> tuple[int, ...]:
        check.list(value, place, length, f"a list of {length} vertices")
        return tuple(check.integer(item, where) for where, item in check.items(value, place))

    return read


def _many(read: Callable[[Checker, Any, str], Any], what: str) -> Callable[[Checker, Any, str], tuple[Any, ...]]:
    return lambda check, value, place: tuple(
        read(check, item, where) for where, item in check.items(value, place, f"a list of {what}")
    )


def _line(check: Checker, value: Any, place: str) -> tuple[Any, ...]:
    check.list(value, place, 2, "two points of a line")
    return tuple(_numbers(2)(check, item, where) for where, item in check.items(value, place))


def _size(check: Checker, value: Any, place: str) -> str:
    if value not in ("longest", "area", "radius"):
        check.fail(place, value, "longest, area or radius")
    return str(value)


def _object(required: Mapping[str, Any], optional: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Return the schema of an object with these keys and no others."""
    properties = {**required, **(optional or {})}
    return {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}


_POINT_SCHEMA = {
    "oneOf": [
        _object({"vertex": {"type": "integer", "minimum": 0}}),
        _object({"link": _NAME, "point": _list(_NUMBER, 3, 3)}),
    ]
}
_TARGET_SCHEMA = {
    "type": "object",
    "properties": {"formula": {"type": "string"}, "file": {"type": "string"}, "path": _list(_list(_NUMBER, 3, 3), 2)},
    "minProperties": 1,
    "maxProperties": 1,
    "additionalProperties": False,
}
_TEXT = _Value(_name, _NAME)
_LENGTH = _Value(lambda check, value, place: check.number(value, place), _NUMBER)
_ANGLE = _Value(lambda check, value, place: radians(check.number(value, place)), _NUMBER)
_VECTOR = _Value(_numbers(3), _list(_NUMBER, 3, 3))
_POINTS = _Value(_points, _list({"$ref": "#/$defs/point"}, 1))
_SIZE = _Value(_size, {"enum": ["longest", "area", "radius"]})
_VERTEX: dict[str, Any] = {"type": "integer", "minimum": 0}
_EDGES = _Value(_many(_vertices(2), "edges"), _list(_list(_VERTEX, 2, 2), 1))
_CORNERS = _Value(_many(_vertices(3), "corners"), _list(_list(_VERTEX, 3, 3), 1))
_FLAT_POINT = _list(_NUMBER, 2, 2)
_SYMMETRY = {
    "mirror": _Value(_line, _list(_FLAT_POINT, 2, 2)),
    "turns": _Value(lambda check, value, place: check.integer(value, place, 2), {"type": "integer", "minimum": 2}),
    "centre": _Value(_numbers(2), _FLAT_POINT),
}
_LIMITS = ("equals", "at_least", "at_most")


@dataclass(frozen=True, slots=True)
class _Kind:
    """A kind of wish: what makes it, its keys, those that may be left out, and how its limits are read."""

    make: type[Wish]
    keys: Mapping[str, _Value]
    optional: Mapping[str, _Value]
    goal: _Value | None = None
    at: bool = True


_KINDS: Mapping[str, _Kind] = {
    "orientation": _Kind(LinkOrientation, {"link": _TEXT, "quaternion": _Value(_numbers(4), _list(_NUMBER, 4, 4))}, {}),
    "direction": _Kind(LinkDirection, {"link": _TEXT, "vector": _VECTOR, "equals": _VECTOR}, {}),
    "angle": _Kind(JointAngle, {"joint": _TEXT}, {}, _ANGLE),
    "place": _Kind(
        PointPlace,
        {
            "point": _Value(_point, {"$ref": "#/$defs/point"}),
            "equals": _Value(_some_numbers, _list({"type": ["number", "null"]}, 3, 3)),
        },
        {},
    ),
    "distance": _Kind(
        PointDistance, {"points": _Value(_two_points, _list({"$ref": "#/$defs/point"}, 2, 2))}, {}, _LENGTH
    ),
    "on": _Kind(PointsOn, {"target": _Value(_target, _TARGET_SCHEMA)}, {"points": _POINTS}),
    "size": _Kind(BoxSize, {"of": _SIZE}, {"points": _POINTS, "thickness": _LENGTH}, _LENGTH),
    "ratio": _Kind(SizeRatio, {"of": _SIZE, "over": _TEXT}, {"points": _POINTS, "thickness": _LENGTH}, _LENGTH),
    "transmission": _Kind(
        TransmissionAngle, {"near": _TEXT, "joint": _TEXT, "far": _TEXT, "at_least": _ANGLE}, {}
    ),
    "arc": _Kind(LinkArc, {"joints": _Value(_names(2), _list(_NAME, 2, 2))}, {}, _ANGLE, at=False),
    "equal-arcs": _Kind(EqualArcs, {"arcs": _Value(_arcs, _list(_list(_NAME, 2, 2), 2, 2))}, {}, at=False),
    "edges": _Kind(EdgeLengths, {}, {"edges": _EDGES}, _LENGTH, at=False),
    "equal-lengths": _Kind(EqualLengths, {"edges": _EDGES}, {}, at=False),
    "corners": _Kind(PanelCorners, {}, {"corners": _CORNERS}, _ANGLE, at=False),
    "symmetry": _Kind(Symmetry, {}, _SYMMETRY, at=False),
    "curvature": _Kind(CellCurvatures, {"principal": _Value(_numbers(2), _FLAT_POINT)}, {}),
    "area": _Kind(SheetArea, {}, {}, _LENGTH, at=False),
}  # fmt: skip
_RENAMED = {"of": "size_of"}
_TOP = (
    "between", "bounds", "closed_form", "configurations", "driver", "fixed", "flat_foldable", "in_order", "parameters",
    "ranges", "rules",
)  # fmt: skip


def read_wishes(path: str | Path) -> Wishes:
    """Return the wishes of a JSON file.

    Parameters
    ----------
    path : str or Path

    Raises
    ------
    FileError
        If it cannot be read, with the place of what is wrong.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> text = '{"format": "synthedra/wishes", "version": 1, "configurations": [{"name": "open", "inputs": {"0": 40}}],'
    >>> text += '"wishes": [{"kind": "angle", "at": "open", "joint": "3", "equals": 50}]}'
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "wishes.json")
    ...     _ = path.write_text(text)
    ...     print(*read_wishes(path).wishes)
    angle of joint 3 at open
    """
    path = Path(path)
    return wishes_of_document(load_json(path), path)


def wishes_of_document(value: Any, path: Path) -> Wishes:
    """Return the wishes of a parsed document; errors name the file `path`."""
    check = Checker(path)
    check.mapping(value, "", ("format", "version", "wishes"), _TOP)
    if value["format"] != FORMAT:
        raise FileError(path, "format", shown(value["format"]), FORMAT)
    if value["version"] != VERSION or isinstance(value["version"], bool):
        raise FileError(path, "version", shown(value["version"]), str(VERSION))
    configurations = [
        _configuration(check, *item) for item in check.items(value.get("configurations", []), "configurations")
    ]
    for place, item in check.items(value.get("ranges", []), "ranges"):
        configurations += _range(check, place, item)
    wishes, rules = (
        tuple(_wish(check, place, item) for place, item in check.items(value.get(key, []), key))
        for key in ("wishes", "rules")
    )
    fixed = tuple(_name(check, item, place) for place, item in check.items(value.get("fixed", []), "fixed"))
    parameters = value.get("parameters", {})
    check.mapping(parameters, "parameters", (), parameters if isinstance(parameters, dict) else ())
    driver = None if value.get("driver") is None else _name(check, value["driver"], "driver")
    if not wishes:
        raise FileError(path, "wishes", "no wishes", "one or more")
    return check.build(
        lambda: Wishes(
            wishes,
            tuple(configurations),
            rules,
            driver,
            fixed,
            {name: check.number(number, f"parameters.{name}") for name, number in parameters.items()},
            _bounds(check, value.get("bounds", {})),
            _flag(check, value, "flat_foldable", default=False),
            _flag(check, value, "closed_form", default=False),
            _flag(check, value, "in_order", default=True),
            check.integer(value.get("between", 0), "between", 0, _MOST_BETWEEN),
        ),
        place="wishes",
    )


def _bounds(check: Checker, value: Any) -> dict[str, tuple[float, float]]:
    check.mapping(value, "bounds", (), value if isinstance(value, dict) else ())
    pairs = {name: _numbers(2)(check, item, f"bounds.{name}") for name, item in value.items()}
    return {name: (least, most) for name, (least, most) in pairs.items()}


def _flag(check: Checker, value: Mapping[str, Any], key: str, *, default: bool) -> bool:
    if not isinstance(value.get(key, default), bool):
        check.fail(key, value[key], "true or false")
    return bool(value.get(key, default))


def _configuration(check: Checker, place: str, item: Any) -> WishedConfiguration:
    check.mapping(item, place, ("name",), ("inputs",))
    name = check.text(item["name"], f"{place}.name")
    if name == POSE:
        raise FileError(
            check.path, f"{place}.name", f"the name {POSE!r}", "another: it is the configuration of the file"
        )
    inputs = item.get("inputs", {})
    check.mapping(inputs, f"{place}.inputs", (), inputs if isinstance(inputs, dict) else ())
    return WishedConfiguration(
        name, {joint: radians(check.number(angle, f"{place}.inputs.{joint}")) for joint, angle in inputs.items()}
    )


_MOST_OF_RANGE, _MOST_BETWEEN = 100, 10


def _range(check: Checker, place: str, item: Any) -> list[WishedConfiguration]:
    """Return configurations that a joint is to pass, from one angle to another: all of them must close."""
    check.mapping(item, place, ("joint", "from", "to"), ("steps",))
    joint = _name(check, item["joint"], f"{place}.joint")
    first, last = (check.number(item[key], f"{place}.{key}") for key in ("from", "to"))
    steps = check.integer(item.get("steps", 5), f"{place}.steps", 2, _MOST_OF_RANGE)
    between = [first + (last - first) * number / (steps - 1) for number in range(steps)]
    return [WishedConfiguration(f"{joint} at {angle:g}", {joint: radians(angle)}) for angle in between]


def _wish(check: Checker, place: str, item: Any) -> Wish:
    if not isinstance(item, dict):
        check.fail(place, item, "an object")
    name = item.get("kind")
    kind = _KINDS.get(name) if isinstance(name, str) else None
    if kind is None:
        raise FileError(check.path, f"{place}.kind", shown(name), ", ".join(_KINDS))
    limits = _LIMITS if kind.goal is not None else ()
    at = ("at",) if kind.at else ()
    check.mapping(item, place, ("kind", *kind.keys), (*kind.optional, *limits, *at, "weight"))
    values = {
        _RENAMED.get(key, key): value.read(check, item[key], f"{place}.{key}")
        for key, value in (*kind.keys.items(), *kind.optional.items())
        if key in item
    }
    if kind.goal is not None:
        given = {key: kind.goal.read(check, item[key], f"{place}.{key}") for key in limits if key in item}
        values["goal"] = check.build(lambda: Goal(**given), place=place)
    if "at" in item:
        values["at"] = check.text(item["at"], f"{place}.at")
    if "weight" in item:
        values["weight"] = check.number(item["weight"], f"{place}.weight")
    try:
        return kind.make(**values)
    except SynthedraError as error:
        raise FileError(check.path, place, str(error)) from None


def wishes_schema() -> dict[str, Any]:
    """Return the JSON Schema of wishes: graphs/schema/wishes.schema.json.

    >>> sorted(wishes_schema()["$defs"])[:3]
    ['angle', 'arc', 'area']
    """
    definitions: dict[str, Any] = {"point": _POINT_SCHEMA}
    for name, kind in _KINDS.items():
        values = {**kind.keys, **kind.optional}
        properties = {"kind": {"const": name}, **{key: dict(value.schema) for key, value in values.items()}}
        if kind.goal is not None:
            properties |= {key: dict(kind.goal.schema) for key in _LIMITS}
        if kind.at:
            properties["at"] = {"type": "string"}
        properties["weight"] = _NUMBER
        needed = {key: value for key, value in properties.items() if key == "kind" or key in kind.keys}
        definitions[name] = _object(needed, {key: value for key, value in properties.items() if key not in needed})
        if kind.goal is not None:
            definitions[name]["anyOf"] = [{"required": [key]} for key in _LIMITS]
    wish = {"oneOf": [{"$ref": f"#/$defs/{name}"} for name in _KINDS]}
    angles = {"type": "object", "additionalProperties": _NUMBER}
    steps = {"type": "integer", "minimum": 2, "maximum": _MOST_OF_RANGE}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:synthedra:schema:wishes:1",
        "title": "Wishes about a mechanism",
        "description": "What a mechanism is to do at named configurations, and what of it may change, for "
        "`synth design`; angles in degrees, lengths in the unit of the mechanism.",
        **_object(
            {"format": {"const": FORMAT}, "version": {"const": VERSION, "type": "integer"}, "wishes": _list(wish, 1)},
            {
                "configurations": _list(_object({"name": {"type": "string"}}, {"inputs": angles}), 0),
                "ranges": _list(_object({"joint": _NAME, "from": _NUMBER, "to": _NUMBER}, {"steps": steps}), 0),
                "rules": _list(wish, 0),
                "driver": {"type": ["string", "integer", "null"]},
                "fixed": _list(_NAME, 0),
                "parameters": angles,
                "bounds": {"type": "object", "additionalProperties": _list(_NUMBER, 2, 2)},
                "flat_foldable": {"type": "boolean"},
                "closed_form": {"type": "boolean"},
                "in_order": {"type": "boolean"},
                "between": {"type": "integer", "minimum": 0, "maximum": _MOST_BETWEEN},
            },
        ),
        "$defs": definitions,
    }
