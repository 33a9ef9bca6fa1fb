"""One kind of mechanism made of another; `graphs.convert.table` says which of which."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.convert.by_name import convert as convert
    from graphs.convert.duality import SheetMechanism as SheetMechanism
    from graphs.convert.duality import mechanism_of_sheet as mechanism_of_sheet
    from graphs.convert.link_joint import sc_from_link_joint_graph as sc_from_link_joint_graph
    from graphs.convert.panels import oriented_panels as oriented_panels
    from graphs.convert.panels import scd_from_panels as scd_from_panels
    from graphs.convert.reconstruction import VertexStep as VertexStep
    from graphs.convert.reconstruction import polyhedron_of as polyhedron_of
    from graphs.convert.reconstruction import vertex_steps as vertex_steps
    from graphs.convert.table import CONVERSIONS as CONVERSIONS
    from graphs.convert.table import Mechanism as Mechanism
    from graphs.convert.table import to_polyhedron as to_polyhedron
    from graphs.convert.table import to_sc as to_sc
    from graphs.convert.table import to_scd as to_scd
    from graphs.convert.table import to_sheet as to_sheet
    from graphs.convert.table import to_vertex_edge as to_vertex_edge
    from graphs.convert.tracing import trace_sheet as trace_sheet
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "by_name": "convert",
            "duality": "SheetMechanism mechanism_of_sheet",
            "link_joint": "sc_from_link_joint_graph",
            "panels": "oriented_panels scd_from_panels",
            "reconstruction": "VertexStep polyhedron_of vertex_steps",
            "table": "CONVERSIONS Mechanism to_polyhedron to_sc to_scd to_sheet to_vertex_edge",
            "tracing": "trace_sheet",
        },
    )
