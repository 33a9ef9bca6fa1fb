"""From any object that a file may hold to any other.

One function a target; each says what stands in the way where there is no road. The roads themselves are in
:mod:`graphs.convert.reconstruction`, :mod:`graphs.convert.panels`, :mod:`graphs.mechanism.sheet` and
:mod:`graphs.mechanism.vertex_edge`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import networkx as nx

from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.convert.panels import oriented_panels, scd_from_panels, scd_of_placed_panels
from graphs.convert.reconstruction import polyhedron_of
from graphs.errors import UnsolvableError
from graphs.joints.as_revolutes import revolutes_of
from graphs.joints.linkage import JointedLinkage
from graphs.joints.recognising import recognised
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import in_space
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet, sheet_from_model, sides_of_face
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.mechanism.vertex_edge import VertexEdgeGraph, sc_from_vertex_edge, vertex_edge_from_sc
from graphs.types import JointId

__all__ = [
    "CONVERSIONS",
    "Mechanism",
    "graph_of",
    "to_joints",
    "to_polyhedron",
    "to_sc",
    "to_scd",
    "to_sheet",
    "to_solids",
    "to_vertex_edge",
]

Mechanism = SCGraph | PolyhedronModel | VertexEdgeGraph | Sheet | SurfaceLinkage | HingedSolids | JointedLinkage
"""What a file may hold (an SCDGraph is an SCGraph)."""


def to_sc(thing: Mechanism) -> SCGraph:
    """Return the SC graph of anything that has one.

    Parameters
    ----------
    thing : Mechanism
        Whatever a file may hold.

    Returns
    -------
    SCGraph
        Of a linkage on a cone, or of hinged solids, the chain.

    Raises
    ------
    UnsolvableError
        As of `to_scd`, for a polyhedron model.

    Examples
    --------
    >>> print(to_sc(VertexEdgeGraph({"O": ("a", "b", "c", "d")})))
    SCGraph with 4 links, 4 joints, 1 centred and 0 spatial loops
    """
    if isinstance(thing, SCDGraph):
        return thing.sc_graph()
    if isinstance(thing, SCGraph):
        return thing
    if isinstance(thing, VertexEdgeGraph):
        return sc_from_vertex_edge(thing)
    if isinstance(thing, Sheet):
        return mechanism_of_sheet(thing).sc
    if isinstance(thing, SurfaceLinkage | HingedSolids):
        return thing.chain
    if isinstance(thing, JointedLinkage):
        return revolutes_of(thing).chain
    return to_scd(thing).sc_graph()


def graph_of(thing: Mechanism | nx.Graph) -> SCGraph:
    """Return the SC or SCD graph that something is, or the SC graph that it has; the errors are those of `to_sc`.

    A plain networkx graph is a link-joint graph: each face of a drawing of it gets a finite centre.

    >>> graph_of(nx.cycle_graph(4)), graph_of(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3))))
    (<SCGraph: 4 links, 4 joints, 1 centre>, <SCGraph: 2 links, 1 joint, 0 centres>)
    """
    if isinstance(thing, SCGraph):
        return thing
    if isinstance(thing, nx.Graph) and not isinstance(thing, PolyhedronModel):
        return sc_from_link_joint_graph(thing)
    return to_sc(thing)


def to_scd(thing: Mechanism) -> SCDGraph:
    """Return the SCD graph of an SCD graph, a sheet of plain panels, or a model that knows its links.

    Parameters
    ----------
    thing : Mechanism
        Whatever a file may hold.

    Returns
    -------
    SCDGraph

    Raises
    ------
    UnsolvableError
        If it does not tell the sides of its links, or a model has more than panels.

    Examples
    --------
    >>> to_scd(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)))).rotation[0]
    (None, None, 0)
    """
    if isinstance(thing, SCDGraph):
        return thing
    if isinstance(thing, Sheet):
        return scd_of_placed_panels(_plain(thing))
    if isinstance(thing, PolyhedronModel):
        if not thing.links:
            raise UnsolvableError("the polyhedron model does not say which vertices make up a link")
        if thing.centres or thing.on_line or thing.on_plane or thing.scissors or thing.ground is not None:
            raise UnsolvableError("the polyhedron model has more than panels (remote centres, points, ground)")
        return scd_from_panels(thing.links)
    raise UnsolvableError("the order of the sides of the links is not known: write an SCD graph or a sheet")


def to_polyhedron(thing: Mechanism) -> PolyhedronModel:
    """Return the polyhedron model; a sheet's coordinates go with it.

    Parameters
    ----------
    thing : Mechanism
        Whatever a file may hold.

    Returns
    -------
    PolyhedronModel

    Raises
    ------
    UnsolvableError
        As of `to_scd`.

    Examples
    --------
    >>> model = to_polyhedron(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3))))
    >>> len(model), model.number_of_edges()
    (4, 5)
    """
    if isinstance(thing, PolyhedronModel):
        return thing
    scd = to_scd(thing)
    model = polyhedron_of(scd)
    if not isinstance(thing, Sheet) or thing.coordinates is None:
        return model
    panels = oriented_panels(dict(enumerate(thing.faces)))
    old = {}
    for link, vertices in scd.vertices.items():
        for i, vertex in enumerate(vertices):  # vertex i lies after side i, which starts at panel vertex i
            old[vertex] = panels[link][(i + 1) % len(vertices)]
    places = {vertex: (*thing.coordinates[v], 0.0)[:3] for vertex, v in old.items()}
    return PolyhedronModel(
        model.nodes, model.edges, coordinates=places, centres=model.centres, links=dict(model.links)
    )


def to_sheet(thing: Mechanism) -> Sheet:
    """Return the sheet of a sheet, an SCD graph or a model that knows its links.

    Parameters
    ----------
    thing : Mechanism
        Whatever a file may hold.

    Returns
    -------
    Sheet

    Raises
    ------
    UnsolvableError
        As of `to_scd`; also if a model does not know its links.

    Examples
    --------
    >>> two = PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (3, 2)], links={0: (0, 1, 2), 1: (1, 3, 2)})
    >>> to_sheet(two).faces
    ((0, 1, 2), (1, 3, 2))
    """
    if isinstance(thing, Sheet):
        return thing
    model = to_polyhedron(thing)
    if not model.links:
        raise UnsolvableError("the polyhedron model does not say which vertices make up a link")
    return sheet_from_model(model)


def to_vertex_edge(thing: Mechanism) -> VertexEdgeGraph:
    """Return the vertex-edge graph.

    Parameters
    ----------
    thing : Mechanism
        Whatever a file may hold.

    Returns
    -------
    VertexEdgeGraph

    Raises
    ------
    UnsolvableError
        If it has no SC graph, or not that of a sheet of finite centres.

    Examples
    --------
    Four triangles round a vertex: one centre with four creases.

    >>> fan = Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)))
    >>> len(to_vertex_edge(fan).vertices), len(to_vertex_edge(fan).creases)
    (1, 4)
    """
    return thing if isinstance(thing, VertexEdgeGraph) else vertex_edge_from_sc(to_sc(thing))


def to_solids(thing: Mechanism) -> HingedSolids:
    """Return a mechanism of revolutes with the axes of its joints; UnsolvableError if there are no axes.

    Each joint of a linkage with joints of all kinds becomes the chain of revolutes that stands for it, each crease
    of a pattern the axis on which it lies; the panels are dropped.

    >>> corners = ((0, 0), (1, 0), (1, 1), (0, 1), (0, -1), (1, -1))
    >>> book = Sheet(6, ((0, 1),), "V", ((0, 1, 2, 3), (1, 0, 4, 5)), corners)
    >>> dict(to_solids(book).axes)
    {0: ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))}
    """
    if isinstance(thing, HingedSolids):
        return thing
    if isinstance(thing, JointedLinkage):
        return revolutes_of(thing)
    if not isinstance(thing, Sheet):
        raise UnsolvableError(f"solids hinged at edges need the axes of their joints, and {thing!r} has none")
    return _solids_of_sheet(thing)


def to_joints(thing: Mechanism) -> JointedLinkage:
    """Return a linkage with joints of all kinds, in which chains of revolutes are the joints that they stand for.

    Raise UnsolvableError if there are no axes by which to recognise them.

    >>> from graphs.joints.kinds import JointKind
    >>> ball = JointedLinkage(SCGraph(2, [(0, 1)]), {0: JointKind.SPHERICAL})
    >>> to_solids(ball), to_joints(to_solids(ball))
    (<HingedSolids: <SCGraph: 4 links, 3 joints, 0 centres>>, <JointedLinkage: 2 links, 1 joint: S, placed>)
    """
    return thing if isinstance(thing, JointedLinkage) else recognised(to_solids(thing))


CONVERSIONS: dict[str, Callable[[Mechanism], Mechanism]] = {
    "sc": to_sc,
    "scd": to_scd,
    "polyhedron": to_polyhedron,
    "vertex-edge": to_vertex_edge,
    "sheet": to_sheet,
    "solids": to_solids,
    "joints": to_joints,
}
"""Name of a kind to the function that makes it."""


def _plain(sheet: Sheet) -> Sheet:
    """Refuse a sheet whose faces are not its links: flat folds merged, cuts, split hinges."""
    mechanism = mechanism_of_sheet(sheet)
    if len(mechanism.panels) < len(sheet.faces):
        raise UnsolvableError("the sheet has flat edges: its links are more than one face each")
    faces_at = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    if sum(number == 2 for number in faces_at.values()) != len(mechanism.sc.joints):
        raise UnsolvableError("the sheet has cuts between faces or hinges in several pieces")
    return sheet


def _solids_of_sheet(sheet: Sheet) -> HingedSolids:
    """Return what a crease pattern is without its panels: each crease lies on an axis."""
    if sheet.coordinates is None:
        raise UnsolvableError("solids hinged at edges need the axes of their joints: the sheet has no coordinates")
    mechanism = mechanism_of_sheet(sheet)
    corners = in_space(sheet.coordinates)
    axes: dict[JointId, Axis] = {}
    for joint, (a, b) in mechanism.hinges.items():
        x, y, z = corners[a].tolist()
        u, v, w = (corners[b] - corners[a]).tolist()
        axes[joint] = (x, y, z), (u, v, w)
    return HingedSolids(mechanism.sc, axes)
