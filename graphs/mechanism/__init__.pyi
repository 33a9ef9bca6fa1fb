from graphs.mechanism.drawing import (
    Drawing as Drawing,
    Face as Face,
    FaceKind as FaceKind,
    Rotation as Rotation,
    Side as Side,
)
from graphs.mechanism.polyhedron import (
    PointConstraint as PointConstraint,
    PolyhedronModel as PolyhedronModel,
    RemoteCentre as RemoteCentre,
)
from graphs.mechanism.sc import SCGraph as SCGraph, SpecialGeometry as SpecialGeometry
from graphs.mechanism.scd import FeatureCounts as FeatureCounts, SCDGraph as SCDGraph
from graphs.mechanism.sheet import Sheet as Sheet, sheet_from_model as sheet_from_model
from graphs.mechanism.solids import HingedSolids as HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage as SurfaceLinkage
from graphs.mechanism.vertex_edge import (
    VertexEdgeGraph as VertexEdgeGraph,
    sc_from_vertex_edge as sc_from_vertex_edge,
    vertex_edge_from_sc as vertex_edge_from_sc,
)
