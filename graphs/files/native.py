"""The native JSON files: SC and SCD graphs, models, vertex-edge graphs, linkages, hinged solids, orientations.

The formats are published as JSON Schemas in ``graphs/schema/``. Guide: docs/native-json.md.
"""

import json
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from math import degrees, inf, radians
from pathlib import Path
from typing import Any

from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.text import Checker, json_text, load_json
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, kind_named
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.polyhedron import GROUND, PointConstraint, PolyhedronModel, RemoteCentre
from graphs.mechanism.sc import SCGraph, SpecialGeometry
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.solids import Axis, HingedSolids, LinkShape, Vector
from graphs.mechanism.surfaces import Cone, Cylinder, Pair, Surface, SurfaceLinkage, as_planar, places_of_steps
from graphs.mechanism.vertex_edge import VertexEdgeGraph
from graphs.types import JointId, LinkId

VERSION = 1  # of our own JSON files; others are refused, so it is raised only when old files would be misread


def head(kind: str) -> dict[str, Any]:
    """Return the keys every native document starts with."""
    return {"format": f"synthedra/{kind}", "version": VERSION}


def written(name: Hashable) -> str | int:
    """Return a name as it is written in a file; UnsolvableError if it is neither text nor an integer."""
    if isinstance(name, bool) or not isinstance(name, str | int):
        raise UnsolvableError(f"the id {shown(name)} cannot be written: ids in files are text or integers")
    return name


def is_count(listed: Iterable[Hashable]) -> bool:
    """Return whether names are just 0, 1, 2, ..."""
    return all(type(name) is int and name == i for i, name in enumerate(listed))


def count_or_names(listed: Iterable[Hashable]) -> int | list[str | int]:
    """Return how many names there are if they are 0, 1, 2, ..., else the names."""
    every = list(listed)
    return len(every) if is_count(every) else [written(name) for name in every]


def names(value: Any, key: str, check: Checker) -> list[Hashable]:
    """Read a list of names, or how many there are."""
    if isinstance(value, list):
        return [check.name(name, place) for place, name in check.items(value, key)]
    if isinstance(value, bool) or not isinstance(value, int):
        check.fail(key, value, "a list of names, or how many")
    return list(range(check.how_many(value, key)))


def tuple_of(
    value: Any, place: str, check: Checker, length: int | None = None, what: str = "a list of vertices"
) -> tuple[Hashable, ...]:
    """Read a list of names; `length` is how many there must be, None for any number."""
    listed = check.list(value, place, length, what)
    return tuple(check.name(v, f"{place}[{i}]", "a name (text or an integer)") for i, v in enumerate(listed))


_CHAIN_KEYS = ("format", "version", "links", "joints", "loops")
"""Keys that every file of a chain of links and joints has."""
_SC_KEYS = ("ground", "closing", "special")


def read_sc(value: Mapping[str, Any], check: Checker) -> SCGraph:
    """Read an SC graph from its document."""
    check.mapping(value, "", _CHAIN_KEYS, _SC_KEYS)
    parts = _ScParts(value, check)
    return check.build(lambda: SCGraph(**parts.arguments()), parts.place_of)


def read_scd(value: Mapping[str, Any], check: Checker) -> SCDGraph:
    """Read an SCD graph from its document."""
    check.mapping(value, "", (*_CHAIN_KEYS, "rotation"), (*_SC_KEYS, "outer"))
    parts = _ScParts(value, check)
    if not isinstance(value["rotation"], dict):
        check.fail("rotation", value["rotation"], "an object: link to its sides")
    of_text = {str(link): link for link in parts.links}
    rotation: dict[LinkId, list[JointId | None]] = {}
    for text, sides in value["rotation"].items():
        place = f"rotation[{json.dumps(text[:40])}]"
        if text not in of_text:
            raise FileError(check.path, place, f"{shown(text)} is no link", "the links")
        rotation[of_text[text]] = [
            None if side is None else parts.joint(side, at, "a joint id, or null for an open edge")
            for at, side in check.items(sides, place, "a list of sides")
        ]
    outer = None
    if "outer" in value:
        face = check.mapping(value["outer"], "outer", ("joint", "side"))
        outer = (parts.joint(face["joint"], "outer.joint"), check.text(face["side"], "outer.side"))
    return check.build(lambda: SCDGraph(**parts.arguments(), rotation=rotation, outer=outer), parts.place_of)


class _ScParts:
    """What SC and SCD files have in common."""

    def __init__(self, value: Mapping[str, Any], check: Checker) -> None:
        self.check = check
        self.links = names(value["links"], "links", check)
        self.joints = self._joints(value["joints"])
        self.loops = self._loops(value["loops"], "loops")
        self.closing = self._loops(value.get("closing", []), "closing")
        self.ground = check.name(value["ground"], "ground", "a link") if "ground" in value else None
        check.counted(self.ground, "ground", self.links, "link")
        self.special = self._special(value["special"]) if "special" in value else None
        self.index = {joint: i for i, joint in enumerate(self.joints)}

    def arguments(self) -> dict[str, Any]:
        """Return the arguments that SC and SCD graphs have in common."""
        keys = ("links", "joints", "loops", "closing", "ground", "special")
        return {key: getattr(self, key) for key in keys}

    def _special(self, value: Any) -> SpecialGeometry:
        self.check.mapping(value, "special", ("freedoms", "conditions"))
        freedoms = self.check.integer(value["freedoms"], "special.freedoms", 1)
        listed = self.check.items(value["conditions"], "special.conditions", "a list of texts")
        texts = [self.check.text(text, place) for place, text in listed]
        return self.check.build(lambda: SpecialGeometry(freedoms, texts), lambda _: "special.conditions", "special")

    def _joints(self, value: Any) -> dict[JointId, tuple[LinkId, LinkId]]:
        joints: dict[JointId, tuple[LinkId, LinkId]] = {}
        for place, item in self.check.items(value, "joints", "a list of joints"):
            joint: str | int = len(joints)
            ends = item
            if isinstance(item, dict):
                self.check.mapping(item, place, ("id", "links"))
                joint, ends = self.check.name(item["id"], f"{place}.id"), item["links"]
            pair = self.check.list(ends, place, 2, "two links")
            if joint in joints:
                raise FileError(self.check.path, place, f"the id {shown(joint)} occurs twice", "distinct ids")
            first, second = (self.check.name(end, f"{place}[{k}]", "a link") for k, end in enumerate(pair))
            joints[joint] = (first, second)
            for k, end in enumerate((first, second)):
                self.check.counted(end, f"{place}[{k}]", self.links, "link")
        return joints

    def joint(self, value: Any, place: str, what: str = "a joint id") -> str | int:
        """Read the id of a joint; refuse a number beyond those that are counted."""
        joint = self.check.name(value, place, what)
        self.check.counted(joint, place, list(self.joints), "joint")
        return joint

    def _loops(self, value: Any, key: str) -> list[Loop]:
        return [self._loop(item, place) for place, item in self.check.items(value, key, "a list of loops")]

    def _loop(self, item: Any, place: str) -> Loop:
        self.check.mapping(item, place, ("joints", "centre"), ("name", "at"))
        around = self.check.items(item["joints"], f"{place}.joints", "a list of joint ids")
        ids = tuple(self.joint(joint, at) for at, joint in around)
        if item["centre"] not in [centre.value for centre in Centre]:
            self.check.fail(f"{place}.centre", item["centre"], "finite, infinite or none")
        name, centre_at = (self.check.text(item[k], f"{place}.{k}") if k in item else None for k in ("name", "at"))
        return self.check.build(lambda: Loop(ids, Centre(item["centre"]), name, centre_at), self.place_of, place)

    def place_of(self, part: tuple[str, object]) -> str:
        """Return the JSON path of a part of the graph."""
        key, which = part
        if key == "joints":
            return f"joints[{self.index[which]}]"
        if key in ("loops", "closing"):
            return f"{key}[{which}]"
        return f"rotation[{json.dumps(str(which)[:40])}]" if key == "rotation" else key


def sc_document(sc: SCGraph) -> dict[str, Any]:
    """Return the native document of an SC or SCD graph."""
    result = head("scd" if isinstance(sc, SCDGraph) else "sc") | {
        "links": count_or_names(sc.nodes),
        "joints": _joint_list(sc),
        "loops": list(map(_loop_document, sc.loops)),
    }
    special = sc.special and {"freedoms": sc.special.freedoms, "conditions": list(sc.special.conditions)}
    result |= _known(closing=list(map(_loop_document, sc.closing)), ground=_or_none(sc.ground), special=special)
    if isinstance(sc, SCDGraph):
        rows = sc.rotation.items()
        result["rotation"] = {str(written(link)): list(map(_or_none, sides)) for link, sides in rows}
        if sc.outer is not None:
            result["outer"] = {"joint": written(sc.outer[0]), "side": sc.outer[1]}
    return result


def _or_none(name: Hashable | None) -> str | int | None:
    return None if name is None else written(name)


def _known(**items: Any) -> dict[str, Any]:
    """Return the items that are neither None nor an empty list."""
    return {key: value for key, value in items.items() if value is not None and value != []}


def _joint_list(sc: SCGraph) -> list[Any]:
    if is_count(sc.joints):
        return [[written(a), written(b)] for a, b in sc.joints.values()]
    return [{"id": written(j), "links": [written(a), written(b)]} for j, (a, b) in sc.joints.items()]


def _loop_document(loop: Loop) -> dict[str, Any]:
    centred = {"joints": list(map(written, loop.joints)), "centre": loop.centre.value}
    return centred | _known(name=loop.name, at=loop.at)


def read_polyhedron(value: Mapping[str, Any], check: Checker) -> PolyhedronModel:
    """Read a polyhedron model from its document."""
    check.mapping(
        value,
        "",
        ("format", "version", "vertices", "rods"),
        ("centres", "on_line", "on_plane", "scissors", "ground", "links", "outer"),
    )
    vertices, coordinates = _vertices(value["vertices"], check)
    rods = _rods(value["rods"], "rods", check, "a list of rods")
    for number, rod in enumerate(rods):
        for k, vertex in enumerate(rod):
            check.counted(vertex, f"rods[{number}][{k}]", vertices, "vertex")
    centres = [_remote_centre(item, place, check) for place, item in check.items(value.get("centres", []), "centres")]
    scissors = [
        tuple_of(item, place, check, 4, "four vertices")
        for place, item in check.items(value.get("scissors", []), "scissors")
    ]
    ground = tuple_of(value["ground"], "ground", check) if "ground" in value else None
    links: dict[Hashable, tuple[Hashable, ...]] = {}
    for place, item in check.items(value.get("links", []), "links"):
        check.mapping(item, place, ("id", "vertices"))
        links[check.name(item["id"], f"{place}.id")] = tuple_of(item["vertices"], f"{place}.vertices", check)
    return check.build(
        lambda: PolyhedronModel(
            vertices,
            rods,
            coordinates=coordinates,
            centres=centres,
            on_line=_constraints(value, "on_line", "line", 2, check),
            on_plane=_constraints(value, "on_plane", "plane", 3, check),
            scissors=scissors,
            ground=ground,
            links=links,
            outer=tuple_of(value["outer"], "outer", check) if "outer" in value else None,
        ),
        lambda part: f"{part[0]}[{part[1]}]",
    )


def _vertices(value: Any, check: Checker) -> tuple[list[Hashable], dict[Hashable, list[float]]]:
    if not isinstance(value, list) or not any(isinstance(item, dict) for item in value):
        return names(value, "vertices", check), {}
    listed: list[Hashable] = []
    coordinates: dict[Hashable, list[float]] = {}
    for place, item in check.items(value, "vertices"):
        check.mapping(item, place, ("id", "xyz"))
        name = check.name(item["id"], f"{place}.id")
        listed.append(name)
        coordinates[name] = list(_vector(item["xyz"], f"{place}.xyz", check))
    return listed, coordinates


def _rods(value: Any, key: str, check: Checker, what: str = "a list") -> list[tuple[Hashable, Hashable]]:
    rods = [tuple_of(rod, place, check, 2, "two vertices") for place, rod in check.items(value, key, what)]
    return [(a, b) for a, b in rods]


def _remote_centre(item: Any, place: str, check: Checker) -> RemoteCentre:
    check.mapping(item, place, ("k",), ("rods", "name", "at", "centre"))
    rods = _rods(item.get("rods", []), f"{place}.rods", check)
    name, at = (check.text(item[key], f"{place}.{key}") if key in item else None for key in ("name", "at"))
    kind = item.get("centre", "finite")
    if kind not in ("finite", "infinite"):
        check.fail(f"{place}.centre", kind, "finite or infinite")
    return RemoteCentre(check.integer(item["k"], f"{place}.k"), tuple(rods), name, at, kind == "infinite")


def _constraints(value: Mapping[str, Any], key: str, of: str, size: int, check: Checker) -> list[PointConstraint]:
    constraints = []
    for place, item in check.items(value.get(key, []), key):
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
    links = model.links.items()
    result |= _known(
        centres=[
            {"k": centre.k}
            | _known(
                rods=[list(map(written, rod)) for rod in centre.rods],
                name=centre.name,
                at=centre.at,
                centre="infinite" if centre.infinite else None,
            )
            for centre in model.centres
        ],
        on_line=_constraint_list(model.on_line, "line"),
        on_plane=_constraint_list(model.on_plane, "plane"),
        scissors=[list(map(written, four)) for four in model.scissors],
    )
    if model.ground is not None:
        result["ground"] = sorted(map(written, model.ground), key=str)
    return result | _known(
        links=[{"id": written(link), "vertices": list(map(written, vs))} for link, vs in links],
        outer=None if model.outer is None else list(map(written, model.outer)),
    )


def _constraint_list(constraints: Iterable[PointConstraint], of: str) -> list[dict[str, Any]]:
    return [
        {"vertex": written(x.vertex), of: x.of if isinstance(x.of, str) else list(map(written, x.of))}
        for x in constraints
    ]


_SIZES = {"cone": "angles", "cylinder": "lengths"}
_SURFACE = {"cone": "lambda_deg", "cylinder": "radius"}
_RANGES = {"angles": (0.0, 180.0, " degrees"), "lengths": (0.0, inf, ""), "steps": (-360.0, 360.0, " degrees")}
_FORMATS = {"cone": "synthedra/conical", "cylinder": "synthedra/cylindrical"}


def linkage_from_document(value: Mapping[str, Any], check: Checker) -> SurfaceLinkage:
    """Read a linkage on a cone or a cylinder from its document."""
    path = check.path
    kind = next(kind for kind, name in _FORMATS.items() if name == value["format"])
    sizes, surface = _SIZES[kind], _SURFACE[kind]
    own = (sizes, "steps", surface, "azimuth_deg")
    check.mapping(value, "", _CHAIN_KEYS, ("ground", *own))
    chain = read_sc({key: value[key] for key in value if key not in own}, check)
    if not chain.loops:
        raise FileError(path, "loops", "no loops", f"the loops that lie on the {kind}")
    if kind == "cylinder":
        chain = as_planar(chain)
    if (sizes in value) == ("steps" in value):
        raise FileError(path, "", f"both or neither of '{sizes}' and 'steps'", "one of them")
    if sizes in value:
        if surface in value:
            raise FileError(path, surface, f"a {kind} with {sizes}", f"steps: {sizes} determine the {kind}")
        if "azimuth_deg" in value:
            raise FileError(path, "azimuth_deg", f"an azimuth with {sizes}", "an azimuth with steps")
        pairs = _pairs(value[sizes], sizes, chain, check)
        on_cone = kind == "cone"
        return SurfaceLinkage(chain, angles=pairs if on_cone else None, lengths=None if on_cone else pairs)
    steps = _pairs(value["steps"], "steps", chain, check)
    on_surface = _surface(value[surface], surface, check) if surface in value else None
    azimuth = radians(check.number(value.get("azimuth_deg", 0), "azimuth_deg"))
    linkage = SurfaceLinkage(chain, steps=steps, surface=on_surface, azimuth=azimuth)
    placed = check.build(lambda: places_of_steps(steps), place="steps")
    missing = [joint for joint in chain.joints if joint not in placed]
    if missing:
        raise FileError(path, "steps", f"no step leads to joint {shown(missing[0])}", "steps to every joint")
    return linkage


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
    sizes: dict[Pair, float] = {}
    row = f"[joint, joint, {'length' if key == 'lengths' else 'degrees'}]"
    for place, item in check.items(value, key, f"a list of {row}"):
        *ends, number = check.list(item, place, 3, row)
        a, b = (_joint_of(chain, joint, f"{place}[{k}]", check) for k, joint in enumerate(ends))
        if a == b:
            raise FileError(check.path, place, f"joint {shown(a)} twice", "two joints")
        if (a, b) in sizes or (b, a) in sizes:
            raise FileError(check.path, place, f"joints {shown(a)} and {shown(b)} again", "each pair once")
        size = check.number(number, f"{place}[2]")
        low, high, unit = _RANGES[key]
        if not low < size < high:
            expected = "a number above 0" if high == inf else f"between {low:g} and {high:g}{unit}"
            raise FileError(check.path, f"{place}[2]", shown(number), expected)
        sizes[a, b] = radians(size) if unit else size
    return sizes


def _joint_of(chain: SCGraph, value: Any, place: str, check: Checker) -> JointId:
    """Read the id of a joint of a chain."""
    joint = check.name(value, place, "a joint id")
    check.counted(joint, place, list(chain.joints), "joint")
    if joint not in chain.joints:
        raise FileError(check.path, place, f"{shown(joint)} is no joint", "a joint id")
    return joint


def linkage_document(linkage: SurfaceLinkage) -> dict[str, Any]:
    """Return the native document of a linkage on a cone or a cylinder."""
    document = sc_document(linkage.chain) | {"format": _FORMATS[linkage.kind]}
    for key in ("angles", "lengths", "steps"):
        pairs = getattr(linkage, key)
        if pairs is not None:
            number_of = _in_file if _RANGES[key][2] else float
            document[key] = [[written(a), written(b), number_of(x)] for (a, b), x in pairs.items()]
    if linkage.steps is not None and _in_file(linkage.azimuth):
        document["azimuth_deg"] = _in_file(linkage.azimuth)
    surface = linkage.surface
    if isinstance(surface, Cone):
        document["lambda_deg"] = _in_file(surface.angle)
    elif surface is not None:
        document["radius"] = float(f"{surface.radius:.13g}")
    return document


def _in_file(angle: float) -> float:
    """Return an angle in degrees, to the digits that files keep."""
    return round(degrees(angle), 10)


def solids_from_document(value: Mapping[str, Any], check: Checker) -> HingedSolids:
    """Read hinged solids from their document."""
    check.mapping(value, "", (*_CHAIN_KEYS, "axes"), ("ground", "special", "shapes"))
    chain = read_sc({key: value[key] for key in value if key not in ("axes", "shapes")}, check)
    axes = _axes(value["axes"], chain, check)
    shapes = tuple(
        _shape(item, place, check) for place, item in check.items(value.get("shapes", []), "shapes", "a list of shapes")
    )
    place_of = {joint: f"axes[{place}]" for place, joint in enumerate(axes)}

    def where(part: Any) -> str:
        return f"shapes[{part[1]}]" if part[0] == "shapes" else place_of.get(part[1], "axes")

    return check.build(lambda: HingedSolids(chain, axes, shapes=shapes), where, "axes")


def _shape(item: Any, place: str, check: Checker) -> LinkShape:
    check.mapping(item, place, ("link", "corners", "triangles"), ("name",))
    link = check.name(item["link"], f"{place}.link", "a link")
    name = check.text(item["name"], f"{place}.name") if "name" in item else ""
    corners = tuple(_vector(one, at, check) for at, one in check.items(item["corners"], f"{place}.corners", "points"))
    triangles = []
    for at, one in check.items(item["triangles"], f"{place}.triangles", "a list of triangles"):
        a, b, c = (check.integer(corner, f"{at}[{k}]", 0) for k, corner in enumerate(check.list(one, at, 3)))
        triangles.append((a, b, c))
    return LinkShape(link, name, corners, tuple(triangles))


def _axes(value: Any, chain: SCGraph, check: Checker) -> dict[JointId, Axis]:
    axes: dict[JointId, Axis] = {}
    for place, item in check.items(value, "axes", "a list of axes"):
        check.mapping(item, place, ("joint", "point", "direction"))
        joint = _joint_of(chain, item["joint"], f"{place}.joint", check)
        if joint in axes:
            raise FileError(check.path, place, f"joint {shown(joint)} again", "one axis for each joint")
        point, direction = (_vector(item[key], f"{place}.{key}", check) for key in ("point", "direction"))
        axes[joint] = point, direction
    return axes


def _vector(value: Any, place: str, check: Checker) -> Vector:
    x, y, z = _numbers(value, place, 3, check)
    return x, y, z


def solids_document(solids: HingedSolids) -> dict[str, Any]:
    """Return the native document of hinged solids."""
    return sc_document(solids.chain) | {
        "format": "synthedra/solids",
        "axes": [
            {"joint": written(joint), "point": list(point), "direction": list(direction)}
            for joint, (point, direction) in solids.axes.items()
        ],
        **({"shapes": [_shape_document(shape) for shape in solids.shapes]} if solids.shapes else {}),
    }


def _shape_document(shape: LinkShape) -> dict[str, Any]:
    return {
        "link": written(shape.link), **({"name": shape.name} if shape.name else {}),
        "corners": list(map(list, shape.corners)), "triangles": list(map(list, shape.triangles)),
    }  # fmt: skip


def joints_from_document(value: Mapping[str, Any], check: Checker) -> JointedLinkage:
    """Read a linkage with joints of all kinds from its document."""
    check.mapping(value, "", _CHAIN_KEYS[:-1], ("loops", "closing", "ground"))
    items = check.list(value["joints"], "joints", what="a list of joints")
    chain = read_sc({"loops": [], **value, "joints": [_bare(item) for item in items]}, check)
    kinds: dict[JointId, JointKind] = {}
    places: dict[JointId, JointPlace] = {}
    for number, (joint, item) in enumerate(zip(chain.joints, items, strict=True)):
        place = f"joints[{number}]"
        keys = item if isinstance(item, dict) else {}
        check.mapping(keys, place, (), ("id", "links", "type", "point", "axes"))
        if "type" in keys:
            kinds[joint] = _kind(keys["type"], f"{place}.type", check)
        if "point" in keys:
            places[joint] = _place(keys, place, check)
        elif "axes" in keys:
            raise FileError(check.path, place, "axes without a point", "both")
    number_of = {joint: number for number, joint in enumerate(chain.joints)}
    return check.build(lambda: JointedLinkage(chain, kinds, places), lambda part: f"joints[{number_of[part[1]]}]")


def _bare(item: Any) -> Any:
    """Return a joint without the keys that an SC graph does not have; other values than objects as they are."""
    if not isinstance(item, dict):
        return item
    return {key: item[key] for key in item if key not in ("type", "point", "axes")}


def _kind(value: Any, place: str, check: Checker) -> JointKind:
    return check.build(lambda: kind_named(check.text(value, place)), place=place)


def _place(item: Mapping[str, Any], place: str, check: Checker) -> JointPlace:
    point = _vector(item["point"], f"{place}.point", check)
    axes = check.items(item.get("axes", []), f"{place}.axes", "a list of directions")
    return JointPlace(point, tuple(_vector(axis, at, check) for at, axis in axes))


def joints_document(linkage: JointedLinkage) -> dict[str, Any]:
    """Return the native document of a linkage with joints of all kinds."""
    joints = []
    for joint, ends in linkage.chain.joints.items():
        item: dict[str, Any] = {"id": written(joint), "links": [written(end) for end in ends]}
        item["type"] = linkage.kinds[joint].value
        if place := linkage.places.get(joint):
            item |= {"point": list(place.point), "axes": [list(axis) for axis in place.axes]}
        joints.append(item)
    document = sc_document(linkage.chain) | {"format": "synthedra/joints", "joints": joints}
    if not document["loops"]:
        del document["loops"]
    return document


KIND = "synthedra/orientations"

Rows = tuple[tuple[float, ...], ...]
"""Quaternions, four numbers each, or matrices, nine numbers each, row by row."""


def orientation_rows(path: str | Path) -> tuple[str, Rows]:
    """Return the key, ``"quaternions"`` (scalar first) or ``"matrices"``, and the rows of such a file."""
    path = Path(path)
    return rows_from_document(load_json(path), path)


def holds_orientations(path: str | Path) -> bool:
    """Say whether a file is a JSON document of orientations by its format; what it lists is not read."""
    if Path(path).suffix.lower() != ".json":
        return False
    try:
        document = load_json(Path(path))
    except FileError:  # whoever reads it reports why
        return False
    return isinstance(document, dict) and document.get("format") == KIND


def rows_from_document(value: Any, path: Path) -> tuple[str, Rows]:
    """Return the key and the rows of a parsed document of orientations; see :func:`orientation_rows`."""
    check = Checker(path)
    check.mapping(value, "", ("format", "version"), ("quaternions", "matrices"))
    if value["format"] != KIND:
        raise FileError(path, "format", shown(value["format"]), KIND)
    _check_version(value, path)
    if ("quaternions" in value) == ("matrices" in value):
        which = "both" if "quaternions" in value else "neither"
        raise FileError(path, "", f"{which} of 'quaternions' and 'matrices'", "one of them")
    if "quaternions" in value:
        items = check.items(value["quaternions"], "quaternions", "a list of quaternions")
        return "quaternions", tuple(_numbers(quaternion, place, 4, check) for place, quaternion in items)
    items = check.items(value["matrices"], "matrices", "a list of matrices")
    return "matrices", tuple(_matrix(matrix, place, check) for place, matrix in items)


def _check_version(value: Mapping[str, Any], path: Path) -> None:
    Checker(path).mapping(value, "", ["version"], value)
    if value["version"] != VERSION or isinstance(value["version"], bool):
        raise FileError(path, "version", shown(value["version"]), str(VERSION))


def orientations_document(quaternions: Sequence[Sequence[float]]) -> dict[str, Any]:
    """Return the native document of orientations, quaternions with the scalar first."""
    return head("orientations") | {"quaternions": [[float(x) for x in q] for q in quaternions]}


def _numbers(value: Any, place: str, size: int, check: Checker) -> tuple[float, ...]:
    words = {3: "three numbers", 4: "four numbers, the scalar first"}[size]
    return tuple(check.number(x, f"{place}[{k}]") for k, x in enumerate(check.list(value, place, size, words)))


def _matrix(value: Any, place: str, check: Checker) -> tuple[float, ...]:
    rows = check.list(value, place, 3, "three rows")
    return tuple(x for k, row in enumerate(rows) for x in _numbers(row, f"{place}[{k}]", 3, check))


NativeObject = SCGraph | SCDGraph | PolyhedronModel | VertexEdgeGraph | SurfaceLinkage | HingedSolids | JointedLinkage


def from_document(value: Any, path: Path) -> NativeObject:
    """Build the object that a parsed native document describes; a FileError names the path."""
    check = Checker(path)
    if not isinstance(value, dict):
        check.fail("", value, "an object with the key 'format'")
    kind = value.get("format")
    if kind == "synthedra/orientations":
        wrong = "orientations of a body, which `synth order`, `dyads`, `fourbar` and `draw` take"
        raise FileError(path, "format", wrong, "a mechanism")
    if not isinstance(kind, str) or kind not in FORMATS:
        wrong = "missing" if kind is None else shown(kind)
        raise FileError(path, "format", wrong, "one of " + ", ".join(sorted(FORMATS)))
    _check_version(value, path)
    return FORMATS[kind](value, check)


def document(mechanism: NativeObject) -> dict[str, Any]:
    """Return the native document of an object; UnsolvableError if an id is neither text nor an integer."""
    if isinstance(mechanism, VertexEdgeGraph):
        return _vertex_edge_document(mechanism)
    if isinstance(mechanism, SurfaceLinkage):
        return linkage_document(mechanism)
    if isinstance(mechanism, HingedSolids):
        return solids_document(mechanism)
    if isinstance(mechanism, JointedLinkage):
        return joints_document(mechanism)
    return polyhedron_document(mechanism) if isinstance(mechanism, PolyhedronModel) else sc_document(mechanism)


def dumps(mechanism: NativeObject) -> str:
    """Return the text of a native file."""
    return json_text(document(mechanism))


def _read_vertex_edge(value: Mapping[str, Any], check: Checker) -> VertexEdgeGraph:
    check.mapping(value, "", ("format", "version", "vertices"))
    vertices: dict[Hashable, tuple[Hashable, ...]] = {}
    for place, item in check.items(value["vertices"], "vertices", "a list of vertices"):
        check.mapping(item, place, ("id", "creases"))
        name = check.name(item["id"], f"{place}.id")
        if name in vertices:
            raise FileError(check.path, place, f"vertex {shown(name)} occurs twice", "distinct vertices")
        vertices[name] = tuple_of(item["creases"], f"{place}.creases", check, what="a list of creases")
    return check.build(lambda: VertexEdgeGraph(vertices), lambda part: part[0])


def _vertex_edge_document(graph: VertexEdgeGraph) -> dict[str, Any]:
    return head("vertex-edge") | {
        "vertices": [
            {"id": written(v), "creases": list(map(written, creases))} for v, creases in graph.vertices.items()
        ]
    }


FORMATS: dict[str, Callable[[Mapping[str, Any], Checker], NativeObject]] = {
    "synthedra/sc": read_sc,
    "synthedra/scd": read_scd,
    "synthedra/polyhedron": read_polyhedron,
    "synthedra/vertex-edge": _read_vertex_edge,
    "synthedra/conical": linkage_from_document,
    "synthedra/cylindrical": linkage_from_document,
    "synthedra/solids": solids_from_document,
    "synthedra/joints": joints_from_document,
}
