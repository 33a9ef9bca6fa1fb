"""Polyhedron models as native documents."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

from graphs.files.check import Checker
from graphs.files.native.names import count_or_names, head, names, tuple_of, written
from graphs.mechanism.polyhedron import GROUND, PointConstraint, PolyhedronModel, RemoteCentre

__all__ = ["polyhedron_document", "read_polyhedron"]


def read_polyhedron(value: Mapping[str, Any], check: Checker) -> PolyhedronModel:
    """Read a polyhedron model from its document."""
    check.mapping(
        value,
        "",
        ("format", "version", "vertices", "rods"),
        ("centres", "on_line", "on_plane", "scissors", "ground", "links"),
    )
    vertices, coordinates = _vertices(value["vertices"], check)
    rods = [
        tuple_of(rod, f"rods[{i}]", check, 2, "two vertices")
        for i, rod in enumerate(check.list(value["rods"], "rods", what="a list of rods"))
    ]
    centres = [
        _remote_centre(item, f"centres[{i}]", check)
        for i, item in enumerate(check.list(value.get("centres", []), "centres"))
    ]
    scissors = [
        tuple_of(item, f"scissors[{i}]", check, 4, "four vertices")
        for i, item in enumerate(check.list(value.get("scissors", []), "scissors"))
    ]
    ground = None
    if "ground" in value:
        listed = check.list(value["ground"], "ground", what="a list of vertices")
        ground = [check.name(v, f"ground[{i}]") for i, v in enumerate(listed)]
    links: dict[Hashable, tuple[Hashable, ...]] = {}
    for i, item in enumerate(check.list(value.get("links", []), "links")):
        place = f"links[{i}]"
        check.mapping(item, place, ("id", "vertices"))
        links[check.name(item["id"], f"{place}.id")] = tuple_of(item["vertices"], f"{place}.vertices", check)
    return check.build(
        lambda: PolyhedronModel(
            vertices,
            [(rod[0], rod[1]) for rod in rods],
            coordinates=coordinates,
            centres=centres,
            on_line=_constraints(value, "on_line", "line", 2, check),
            on_plane=_constraints(value, "on_plane", "plane", 3, check),
            scissors=scissors,
            ground=ground,
            links=links,
        ),
        lambda part: f"{part[0]}[{part[1]}]",
    )


def _vertices(value: Any, check: Checker) -> tuple[list[Hashable], dict[Hashable, list[float]]]:
    if not isinstance(value, list) or not any(isinstance(item, dict) for item in value):
        return names(value, "vertices", check), {}
    listed: list[Hashable] = []
    coordinates: dict[Hashable, list[float]] = {}
    for i, item in enumerate(value):
        place = f"vertices[{i}]"
        check.mapping(item, place, ("id", "xyz"))
        name = check.name(item["id"], f"{place}.id")
        xyz = check.list(item["xyz"], f"{place}.xyz", 3, "three numbers")
        listed.append(name)
        coordinates[name] = [check.number(x, f"{place}.xyz[{k}]") for k, x in enumerate(xyz)]
    return listed, coordinates


def _remote_centre(item: Any, place: str, check: Checker) -> RemoteCentre:
    check.mapping(item, place, ("k",), ("rods", "name"))
    rods = [
        tuple_of(rod, f"{place}.rods[{i}]", check, 2, "two vertices")
        for i, rod in enumerate(check.list(item.get("rods", []), f"{place}.rods"))
    ]
    name = check.text(item["name"], f"{place}.name") if "name" in item else None
    return RemoteCentre(check.integer(item["k"], f"{place}.k"), tuple((a, b) for a, b in rods), name)


def _constraints(value: Mapping[str, Any], key: str, of: str, size: int, check: Checker) -> list[PointConstraint]:
    constraints = []
    for i, item in enumerate(check.list(value.get(key, []), key)):
        place = f"{key}[{i}]"
        check.mapping(item, place, ("vertex", of))
        vertex = check.name(item["vertex"], f"{place}.vertex", "a vertex")
        spanned: tuple[Hashable, ...] | str = GROUND
        if item[of] != GROUND:
            spanned = tuple_of(item[of], f"{place}.{of}", check, size, f"{size} vertices, or {GROUND!r}")
        constraints.append(PointConstraint(vertex, spanned))
    return constraints


def polyhedron_document(model: PolyhedronModel) -> dict[str, Any]:
    """Return the native document of a polyhedron model."""
    result = head("polyhedron")
    if model.coordinates:
        result["vertices"] = [{"id": written(v), "xyz": list(model.coordinates[v])} for v in model.nodes]
    else:
        result["vertices"] = count_or_names(model.nodes)
    result["rods"] = [list(map(written, rod)) for rod in model.edges]
    if model.centres:
        result["centres"] = [_centre_document(centre) for centre in model.centres]
    for key, of, constraints in (("on_line", "line", model.on_line), ("on_plane", "plane", model.on_plane)):
        if constraints:
            result[key] = [
                {
                    "vertex": written(one.vertex),
                    of: one.of if isinstance(one.of, str) else list(map(written, one.of)),
                }
                for one in constraints
            ]
    if model.scissors:
        result["scissors"] = [list(map(written, four)) for four in model.scissors]
    if model.ground is not None:
        result["ground"] = sorted(map(written, model.ground), key=str)
    if model.links:
        result["links"] = [
            {"id": written(link), "vertices": list(map(written, around))} for link, around in model.links.items()
        ]
    return result


def _centre_document(centre: RemoteCentre) -> dict[str, Any]:
    result: dict[str, Any] = {"k": centre.k}
    if centre.rods:
        result["rods"] = [list(map(written, rod)) for rod in centre.rods]
    if centre.name is not None:
        result["name"] = centre.name
    return result
