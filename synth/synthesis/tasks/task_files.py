"""Tasks as JSON: read with the place of whatever is wrong, and the schema beside that of wishes.

Guide: docs/native-json.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE, Limits
from graphs.errors import FileError, shown
from graphs.files.text import Checker, load_json
from graphs.joints.linkage import JointKind
from synth.catalogue.patterns.generators import GENERATORS
from synth.synthesis.designing.wish_files import FORMAT as WISHES_FORMAT, VERSION as WISHES_VERSION, wishes_of_document
from synth.synthesis.tasks.record import FORMS, LINKS, ROLES, SOURCES, SYSTEMS, RolePair, Task, names_in

FORMAT, VERSION = "synthedra/task", 1
_LIMITS = {
    "links": LINKS,
    "loops": ANY_NUMBER,
    "centres": ANY_NUMBER,
    "symmetry": ONE_OR_MORE,
    "open_edges": ANY_NUMBER,
    "explicit_centres": ANY_NUMBER,
    "implicit_centres": ANY_NUMBER,
}
_PAIRS = {"relative_mobility": "mobilities", "distance": "distances"}
_OPTIONAL = (
    "title", "roles", "degrees_of_freedom", *_LIMITS, "system", "form", "types", "generators", "joints",
    "spatial_loops", "centres_at_infinity", *_PAIRS, "wishes",
)  # fmt: skip
_HEAD = {"format": WISHES_FORMAT, "version": WISHES_VERSION}
"""What the wishes of a task leave out of a file of wishes."""


def read_task(path: str | Path) -> Task:
    """Return the task of a JSON file.

    Parameters
    ----------
    path : str or Path

    Raises
    ------
    FileError
        If it cannot be read, or contradicts itself, with the place of what is wrong.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "task.json")
    ...     _ = path.write_text('{"format": "synthedra/task", "version": 1, "links": 4}')
    ...     read_task(path).links
    Limits(least=4, most=4)
    """
    path = Path(path)
    return task_of_document(load_json(path), path)


def task_of_document(value: Any, path: Path) -> Task:
    """Return the task of a parsed document; errors name the file `path`."""
    check = Checker(path)
    check.mapping(value, "", ("format", "version"), _OPTIONAL)
    if value["format"] != FORMAT:
        raise FileError(path, "format", shown(value["format"]), FORMAT)
    if value["version"] != VERSION or isinstance(value["version"], bool):
        raise FileError(path, "version", shown(value["version"]), str(VERSION))
    fields: dict[str, Any] = {"place": path}
    fields |= {key: _limits(check, value[key], key) for key in _LIMITS if key in value}
    for key, field in _PAIRS.items():
        fields[field] = tuple(_pair(check, item, place) for place, item in check.items(value.get(key, []), key))
    for key, field, words in (("system", "system", SYSTEMS), ("form", "form", FORMS)):
        if key in value:
            fields[field] = _word(check, value[key], key, words)
    if "title" in value:
        fields["title"] = check.text(value["title"], "title")
    for key, field, words in (
        ("roles", "roles", ROLES),
        ("types", "sources", SOURCES),
        ("joints", "joints", tuple(kind.value for kind in JointKind)),
    ):
        if key in value:
            fields[field] = tuple(_word(check, item, place, words) for place, item in check.items(value[key], key))
    if "degrees_of_freedom" in value:
        fields["freedoms"] = check.integer(value["degrees_of_freedom"], "degrees_of_freedom", 1)
    fields["spatial"] = check.integer(value.get("spatial_loops", 0), "spatial_loops")
    infinite = value.get("centres_at_infinity", False)
    if not isinstance(infinite, bool):
        check.fail("centres_at_infinity", infinite, "true or false")
    fields["infinite"] = infinite
    if value.get("generators") is not None:
        fields["generators"] = _generators(check, value["generators"])
    if value.get("wishes") is not None:
        fields["wishes"] = _wishes(check, value["wishes"], fields.get("roles", Task.roles))
    return check.build(lambda: Task(**fields), lambda part: str(part[0]))


def _limits(check: Checker, value: Any, place: str) -> Limits:
    """Return limits: a number, or the least and the greatest, null where there is none."""
    if not isinstance(value, list):
        number = check.integer(value, place)
        return Limits(number, number)
    check.list(value, place, 2, "the least and the greatest number, null for none")
    least = check.integer(value[0], f"{place}[0]")
    most = None if value[1] is None else check.integer(value[1], f"{place}[1]")
    if most is not None and most < least:
        raise FileError(check.path, place, f"{least} to {most}", "the smaller number first")
    return Limits(least, most)


def _word(check: Checker, value: Any, place: str, words: tuple[str, ...]) -> str:
    if value not in words:
        check.fail(place, value, "one of " + ", ".join(words))
    return str(value)


def _pair(check: Checker, value: Any, place: str) -> RolePair:
    check.mapping(value, place, ("roles", "number"))
    check.list(value["roles"], f"{place}.roles", 2, "two roles")
    first, second = (_word(check, item, where, ROLES) for where, item in check.items(value["roles"], f"{place}.roles"))
    return check.build(
        lambda: RolePair((first, second), _limits(check, value["number"], f"{place}.number")), place=place
    )


def _generators(check: Checker, value: Any) -> dict[str, dict[str, float]]:
    """Return generators with the values of their parameters, as a file of wishes states them."""
    check.mapping(value, "generators", (), GENERATORS)
    chosen: dict[str, dict[str, float]] = {}
    for name, values in value.items():
        place = f"generators.{name}"
        check.mapping(values, place, (), values if isinstance(values, dict) else ())
        numbers = {key: check.number(item, f"{place}.{key}") for key, item in values.items()}
        check.build(lambda name=name, numbers=numbers: GENERATORS[name].values(numbers), place=place)  # type: ignore[misc]
        chosen[name] = numbers
    return chosen


def _wishes(check: Checker, value: Any, roles: tuple[str, ...]) -> dict[str, Any]:
    """Return the wishes of a task; their links must be roles, and their joints pairs of roles."""
    check.mapping(value, "wishes", ("wishes",), value if isinstance(value, dict) else ())
    for place, kind, name in names_in(value):
        if kind == "link" and name not in roles:
            raise FileError(
                check.path, place, f"the link {shown(name)}", "a role: " + (", ".join(roles) or "none is named")
            )
        ends = name.split("-")
        if kind == "joint" and (len(ends) != 2 or ends[0] == ends[1] or not set(ends) <= set(roles)):
            expected = "two roles with a hyphen between them, such as base-input"
            raise FileError(check.path, place, f"the joint {shown(name)}", expected)
    try:
        wishes_of_document({**_HEAD, **value}, check.path)
    except FileError as error:
        raise FileError(check.path, f"wishes.{error.place}", error.found, error.expected) from None
    return dict(value)


def wishes_document(wishes: Mapping[str, Any]) -> dict[str, Any]:
    """Return wishes of a task as a document of a file of wishes."""
    return {**_HEAD, **wishes}


def task_schema() -> dict[str, Any]:
    """Return the JSON Schema of tasks: graphs/schema/task.schema.json.

    Returns
    -------
    dict

    Examples
    --------
    >>> task_schema()["required"]
    ['format', 'version']
    """
    whole = {"type": "integer", "minimum": 0}
    most = {"type": ["integer", "null"], "minimum": 0}
    limits = {
        "oneOf": [whole, {"type": "array", "prefixItems": [whole, most], "items": False, "minItems": 2}],
        "description": "a number, or the least and the greatest, null where there is none",
    }
    role = {"enum": list(ROLES)}
    pair = {
        "type": "object",
        "properties": {
            "roles": {"type": "array", "items": role, "minItems": 2, "maxItems": 2},
            "number": {"$ref": "#/$defs/limits"},
        },
        "required": ["roles", "number"],
        "additionalProperties": False,
    }
    letters = [kind.value for kind in JointKind]
    properties: dict[str, Any] = {
        "format": {"const": FORMAT},
        "version": {"const": VERSION, "type": "integer"},
        "title": {"type": "string"},
        "roles": {"type": "array", "items": role, "uniqueItems": True},
        "degrees_of_freedom": {"type": "integer", "minimum": 1},
        **{key: {"$ref": "#/$defs/limits"} for key in _LIMITS},
        "system": {"enum": list(SYSTEMS)},
        "form": {"enum": list(FORMS)},
        "types": {"type": "array", "items": {"enum": list(SOURCES)}, "minItems": 1},
        "generators": {
            "type": ["object", "null"],
            "additionalProperties": {"type": "object", "additionalProperties": {"type": "number"}},
        },
        "joints": {"type": "array", "items": {"enum": letters}, "minItems": 1},
        "spatial_loops": whole,
        "centres_at_infinity": {"type": "boolean"},
        **{key: {"type": "array", "items": {"$ref": "#/$defs/pair"}} for key in _PAIRS},
        "wishes": {
            "type": ["object", "null"],
            "description": "as urn:synthedra:schema:wishes:1 without format and version; links are roles, joints two "
            "roles with a hyphen between them",
            "required": ["wishes"],
        },
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:synthedra:schema:task:1",
        "title": "A task",
        "description": "What a mechanism is to do, of whatever type: roles of its bodies, requirements on the type, "
        "and wishes about their motion, for `synth task`; angles in degrees, lengths in any unit.",
        "type": "object",
        "properties": properties,
        "required": ["format", "version"],
        "additionalProperties": False,
        "$defs": {"limits": limits, "pair": pair},
    }
