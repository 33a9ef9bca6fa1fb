"""The native JSON files: SC and SCD graphs, models, vertex-edge graphs, linkages on surfaces, hinged solids, ...

The formats are published as JSON Schemas in ``graphs/schema/``. Guide: docs/native-json.md.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from pathlib import Path
from typing import Any

from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.native.graphs import read_sc, read_scd, sc_document
from graphs.files.native.joints import joints_document, joints_from_document
from graphs.files.native.models import polyhedron_document, read_polyhedron
from graphs.files.native.names import VERSION, head, tuple_of, written
from graphs.files.native.on_surface import linkage_document, linkage_from_document
from graphs.files.native.solids import solids_document, solids_from_document
from graphs.files.text import json_text
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.mechanism.vertex_edge import VertexEdgeGraph

__all__ = ["FORMATS", "NativeObject", "document", "dumps", "from_document"]

NativeObject = (
    SCGraph | SCDGraph | PolyhedronModel | VertexEdgeGraph | SurfaceLinkage | HingedSolids | JointedLinkage
)


def from_document(value: Any, path: Path) -> NativeObject:
    """Build the object that a parsed native document describes; a FileError names the path."""
    check = Checker(path)
    if not isinstance(value, dict):
        check.fail("", value, "an object with the key 'format'")
    kind = value.get("format")
    if kind == "synthedra/orientations":
        told = "orientations of a body, which `synth order`, `dyads`, `fourbar` and `draw` take"
        raise FileError(path, "format", told, "a mechanism")
    if not isinstance(kind, str) or kind not in FORMATS:
        raise FileError(
            path, "format", "missing" if kind is None else shown(kind), "one of " + ", ".join(sorted(FORMATS))
        )
    if value.get("version") != VERSION or isinstance(value.get("version"), bool):
        raise FileError(path, "version", shown(value.get("version")), str(VERSION))
    return FORMATS[kind](value, check)


def document(thing: NativeObject) -> dict[str, Any]:
    """Return the native document of an object; UnsolvableError if an id is neither text nor an integer."""
    if isinstance(thing, VertexEdgeGraph):
        return _vertex_edge_document(thing)
    if isinstance(thing, SurfaceLinkage):
        return linkage_document(thing)
    if isinstance(thing, HingedSolids):
        return solids_document(thing)
    if isinstance(thing, JointedLinkage):
        return joints_document(thing)
    return polyhedron_document(thing) if isinstance(thing, PolyhedronModel) else sc_document(thing)


def dumps(thing: NativeObject) -> str:
    """Return the text of a native file."""
    return json_text(document(thing))


def _read_vertex_edge(value: Mapping[str, Any], check: Checker) -> VertexEdgeGraph:
    check.mapping(value, "", ("format", "version", "vertices"))
    vertices: dict[Hashable, tuple[Hashable, ...]] = {}
    for i, item in enumerate(check.list(value["vertices"], "vertices", what="a list of vertices")):
        place = f"vertices[{i}]"
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
