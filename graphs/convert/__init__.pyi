from graphs.convert.conversions import (
    CONVERSIONS as CONVERSIONS,
    Mechanism as Mechanism,
    to_polyhedron as to_polyhedron,
    to_sc as to_sc,
    to_scd as to_scd,
    to_sheet as to_sheet,
    to_vertex_edge as to_vertex_edge,
)
from graphs.convert.duality import SheetMechanism as SheetMechanism, mechanism_of_sheet as mechanism_of_sheet
from graphs.convert.link_joint import sc_from_link_joint_graph as sc_from_link_joint_graph
from graphs.convert.panels import (
    VertexStep as VertexStep,
    oriented_panels as oriented_panels,
    polyhedron_of as polyhedron_of,
    scd_from_panels as scd_from_panels,
    vertex_steps as vertex_steps,
)
from graphs.convert.tracing import trace_sheet as trace_sheet
