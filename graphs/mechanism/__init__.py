"""What a mechanism is: SC and SCD graphs, polyhedron models, vertex-edge graphs, sheets, linkages on cones.

An SCD graph is an SC graph with a drawing; the rules say which drawings are valid. Nothing here counts or ranks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.mechanism.conical import ConicalLinkage as ConicalLinkage
    from graphs.mechanism.drawing import Drawing as Drawing
    from graphs.mechanism.drawing import FaceKind as FaceKind
    from graphs.mechanism.polyhedron import PointConstraint as PointConstraint
    from graphs.mechanism.polyhedron import PolyhedronModel as PolyhedronModel
    from graphs.mechanism.polyhedron import RemoteCentre as RemoteCentre
    from graphs.mechanism.rotation import Corner as Corner
    from graphs.mechanism.rotation import Face as Face
    from graphs.mechanism.rotation import Rotation as Rotation
    from graphs.mechanism.rotation import Side as Side
    from graphs.mechanism.rules import check_rules as check_rules
    from graphs.mechanism.rules import points_of_joints as points_of_joints
    from graphs.mechanism.rules import points_of_links as points_of_links
    from graphs.mechanism.sc import SCGraph as SCGraph
    from graphs.mechanism.scd import FeatureCounts as FeatureCounts
    from graphs.mechanism.scd import SCDGraph as SCDGraph
    from graphs.mechanism.sheet import Sheet as Sheet
    from graphs.mechanism.sheet import sheet_from_model as sheet_from_model
    from graphs.mechanism.solids import HingedSolids as HingedSolids
    from graphs.mechanism.vertex_edge import VertexEdgeGraph as VertexEdgeGraph
    from graphs.mechanism.vertex_edge import sc_from_vertex_edge as sc_from_vertex_edge
    from graphs.mechanism.vertex_edge import vertex_edge_from_sc as vertex_edge_from_sc
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "conical": "ConicalLinkage",
            "drawing": "Drawing FaceKind",
            "polyhedron": "PointConstraint PolyhedronModel RemoteCentre",
            "rotation": "Corner Face Rotation Side",
            "rules": "check_rules points_of_joints points_of_links",
            "sc": "SCGraph",
            "scd": "FeatureCounts SCDGraph",
            "sheet": "Sheet sheet_from_model",
            "solids": "HingedSolids",
            "vertex_edge": "VertexEdgeGraph sc_from_vertex_edge vertex_edge_from_sc",
        },
    )
