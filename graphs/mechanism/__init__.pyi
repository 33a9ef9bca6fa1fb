from graphs.mechanism.drawing import Drawing as Drawing, FaceKind as FaceKind
from graphs.mechanism.on_surface import SurfaceLinkage as SurfaceLinkage
from graphs.mechanism.polyhedron import (
    PointConstraint as PointConstraint,
    PolyhedronModel as PolyhedronModel,
    RemoteCentre as RemoteCentre,
)
from graphs.mechanism.rotation import Corner as Corner, Face as Face, Rotation as Rotation, Side as Side
from graphs.mechanism.rules import (
    check_rules as check_rules,
    points_of_joints as points_of_joints,
    points_of_links as points_of_links,
)
from graphs.mechanism.sc import SCGraph as SCGraph
from graphs.mechanism.scd import FeatureCounts as FeatureCounts, SCDGraph as SCDGraph
from graphs.mechanism.sheet import Sheet as Sheet, sheet_from_model as sheet_from_model
from graphs.mechanism.solids import HingedSolids as HingedSolids
from graphs.mechanism.special import SpecialGeometry as SpecialGeometry
from graphs.mechanism.vertex_edge import (
    VertexEdgeGraph as VertexEdgeGraph,
    sc_from_vertex_edge as sc_from_vertex_edge,
    vertex_edge_from_sc as vertex_edge_from_sc,
)
