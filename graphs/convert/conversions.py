"""From any object that a file may hold to any other; by the names of kinds and forms: `graphs.answer.convert`."""

import re
from collections import Counter
from collections.abc import Callable

import networkx as nx

from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.convert.models import scd_of_model
from graphs.convert.panels import oriented_panels, polyhedron_of, scd_of_placed_panels
from graphs.edit.analogues import generalised_form, planar_analogue, spherical_analogue
from graphs.errors import UnsolvableError
from graphs.joints.linkage import JointedLinkage
from graphs.joints.revolutes import recognised, revolutes_of
from graphs.mechanism.attributes import carries_loops
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import in_space
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet, sheet_from_model, sides_of_face
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.mechanism.vertex_edge import VertexEdgeGraph, sc_from_vertex_edge, vertex_edge_from_sc
from graphs.types import JointId

Mechanism = SCGraph | PolyhedronModel | VertexEdgeGraph | Sheet | SurfaceLinkage | HingedSolids | JointedLinkage
"""Any object that a file may hold (an SCDGraph is an SCGraph)."""


def kind_in_words(mechanism: object) -> str:
    """Return the kind of a mechanism as messages name it, from the name of its class.

    Examples
    --------
    >>> kind_in_words(SCGraph(2, [(0, 1)]))
    'SC graph'
    """
    words = re.findall(r"[A-Z]+(?![a-z])|[A-Z][a-z]+", type(mechanism).__name__)
    return " ".join(word if word.isupper() else word.lower() for word in words)


def without_coordinates(mechanism: object) -> UnsolvableError:
    """Return the error of a mechanism that cannot move since its coordinates are not known.

    Examples
    --------
    >>> print(without_coordinates(SCGraph(2, [(0, 1)])))
    motion requires coordinates, and the SC graph has none; try `synth realise`, in Python synth.realise
    """
    what = f"motion requires coordinates, and the {kind_in_words(mechanism)} has none"
    return UnsolvableError(f"{what}; try `synth realise`, in Python synth.realise")


def to_sc(mechanism: Mechanism) -> SCGraph:
    """Return the SC graph of a mechanism; for a linkage on a cone, or hinged solids, the chain.

    Parameters
    ----------
    mechanism : Mechanism
        The errors of a polyhedron model are those of `to_scd`.

    Examples
    --------
    >>> print(to_sc(VertexEdgeGraph({"O": ("a", "b", "c", "d")})))
    SCGraph with 4 links, 4 joints, 1 centred and 0 spatial loops
    """
    if isinstance(mechanism, SCDGraph):
        return mechanism.sc_graph()
    if isinstance(mechanism, SCGraph):
        return mechanism
    if isinstance(mechanism, VertexEdgeGraph):
        return sc_from_vertex_edge(mechanism)
    if isinstance(mechanism, Sheet):
        return mechanism_of_sheet(mechanism).sc
    if isinstance(mechanism, SurfaceLinkage | HingedSolids):
        return mechanism.chain
    if isinstance(mechanism, JointedLinkage):
        return revolutes_of(mechanism).chain
    return to_scd(mechanism).sc_graph()


def mechanism_of_graph(graph: nx.Graph) -> SCGraph | PolyhedronModel:
    """Return the mechanism that a graph of networkx is.

    Parameters
    ----------
    graph : networkx.Graph
        An SC or SCD graph or a polyhedron model, what networkx made of one, with the same attributes, or a bare
        link-joint graph: each face of a drawing of that gets a finite centre. InvariantError if the attributes are
        those of a mechanism no more, as of a subgraph that cuts a loop.

    Examples
    --------
    >>> mechanism_of_graph(nx.cycle_graph(4)).centres_assumed
    True
    """
    if isinstance(graph, SCGraph | PolyhedronModel):
        return graph
    if "polyhedron" in graph.graph:
        return PolyhedronModel(graph)
    if any("sides" in data for _, data in graph.nodes(data=True)):
        return SCDGraph(graph)
    return SCGraph(graph) if carries_loops(graph) else sc_from_link_joint_graph(graph)


def graph_of(mechanism: Mechanism | nx.Graph) -> SCGraph:
    """Return an SC or SCD graph itself, or the SC graph of a mechanism; the errors are those of `to_sc`.

    A graph of networkx is read as by `mechanism_of_graph`.
    """
    if isinstance(mechanism, nx.Graph):
        mechanism = mechanism_of_graph(mechanism)
    return mechanism if isinstance(mechanism, SCGraph) else to_sc(mechanism)


def to_scd(mechanism: Mechanism) -> SCDGraph:
    """Return the SCD graph of an SCD graph, a sheet of plain panels, or a model of panels and implicit centres.

    Parameters
    ----------
    mechanism : Mechanism
        UnsolvableError if the order of the sides of its links is not known, or a model has more than panels. Links
        that a model does not declare are those that triangles of its rods show.

    Examples
    --------
    >>> to_scd(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)))).rotation[0]
    (None, None, 0)
    """
    if isinstance(mechanism, SCDGraph):
        return mechanism
    if isinstance(mechanism, Sheet):
        return scd_of_placed_panels(_checked_panels(mechanism))
    if isinstance(mechanism, PolyhedronModel):
        return scd_of_model(mechanism)
    raise UnsolvableError(
        "the order of the sides of the links is not known; `synth enumerate scd --of FILE --max-degree D` lists the "
        "SCD graphs with up to D sides per link, `synth convert --max-degree D` takes the one if there is only one"
    )


def to_polyhedron(mechanism: Mechanism) -> PolyhedronModel:
    """Return the polyhedron model; a sheet's coordinates go with it.

    Parameters
    ----------
    mechanism : Mechanism
        The errors are those of `to_scd`.

    Examples
    --------
    >>> model = to_polyhedron(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3))))
    >>> len(model), model.number_of_edges()
    (4, 5)
    """
    if isinstance(mechanism, PolyhedronModel):
        return mechanism
    scd = to_scd(mechanism)
    model = polyhedron_of(scd)
    if not isinstance(mechanism, Sheet) or mechanism.coordinates is None:
        return model
    panels = oriented_panels(dict(enumerate(mechanism.faces)))
    places = {}
    for link, vertices in scd.vertices.items():
        for i, vertex in enumerate(vertices):  # vertex i lies after side i, which starts at panel vertex i
            place = mechanism.coordinates[panels[link][(i + 1) % len(vertices)]]
            places[vertex] = (*place, 0.0)[:3]
    return PolyhedronModel(
        model.nodes, model.edges, coordinates=places, centres=model.centres, links=dict(model.links), outer=model.outer
    )


def to_sheet(mechanism: Mechanism) -> Sheet:
    """Return the sheet of a sheet, an SCD graph or a model that knows its links.

    Parameters
    ----------
    mechanism : Mechanism
        The errors are those of `to_scd`; UnsolvableError also if a model does not know its links.

    Examples
    --------
    >>> two = PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (3, 2)], links={0: (0, 1, 2), 1: (1, 3, 2)})
    >>> to_sheet(two).faces
    ((0, 1, 2), (1, 3, 2))
    """
    if isinstance(mechanism, Sheet):
        return mechanism
    model = to_polyhedron(mechanism)
    if not model.links:
        raise UnsolvableError("the polyhedron model does not say which vertices make up a link")
    return sheet_from_model(model)


def to_vertex_edge(mechanism: Mechanism) -> VertexEdgeGraph:
    """Return the vertex-edge graph.

    Parameters
    ----------
    mechanism : Mechanism
        UnsolvableError if it has no SC graph, or not that of a sheet of finite centres.

    Examples
    --------
    Four triangles round a vertex: one centre with four creases.

    >>> fan = Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)))
    >>> len(to_vertex_edge(fan).vertices), len(to_vertex_edge(fan).creases)
    (1, 4)
    """
    return mechanism if isinstance(mechanism, VertexEdgeGraph) else vertex_edge_from_sc(to_sc(mechanism))


def to_solids(mechanism: Mechanism) -> HingedSolids:
    """Return a mechanism of revolutes with the axes of its joints; UnsolvableError if there are no axes.

    A joint of another kind becomes the chain of revolutes that stands for it, a crease the axis on which it lies.
    """
    if isinstance(mechanism, HingedSolids):
        return mechanism
    if isinstance(mechanism, JointedLinkage):
        return revolutes_of(mechanism)
    if not isinstance(mechanism, Sheet):
        raise UnsolvableError(f"solids hinged at edges need the axes of their joints, and {mechanism!r} has none")
    return _solids_of_sheet(mechanism)


def to_joints(mechanism: Mechanism) -> JointedLinkage:
    """Return a linkage with joints of all kinds, in which chains of revolutes are the joints they stand for."""
    return mechanism if isinstance(mechanism, JointedLinkage) else recognised(to_solids(mechanism))


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


def _checked_panels(sheet: Sheet) -> Sheet:
    """Return a sheet; refuse one whose faces are not its links: flat folds merged, cuts, split hinges."""
    mechanism = mechanism_of_sheet(sheet)
    if len(mechanism.panels) < len(sheet.faces):
        raise UnsolvableError("the sheet has flat edges: its links are more than one face each")
    faces_at = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    if sum(number == 2 for number in faces_at.values()) != len(mechanism.sc.joints):
        raise UnsolvableError("the sheet has cuts between faces or hinges in several pieces")
    return sheet


def _solids_of_sheet(sheet: Sheet) -> HingedSolids:
    """Return a crease pattern without its panels: each crease becomes an axis."""
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


FORMS = {"planar": planar_analogue, "spherical": spherical_analogue, "general": generalised_form}
"""Name of a form to the function that changes the centres."""
