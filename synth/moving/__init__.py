"""Linkages of any kind moved: solids hinged at edges, polyhedron models, conical linkages, guided four-bars.

`configuration_of` makes a mechanism at a configuration of anything that has coordinates, `move` drives its joints,
`circuit_through` goes round past dead points, `move_on_cone` says what conical linkages do all along. What it
stands on is in `synth.folding`. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.motion.walk.circuits import circuit_through as circuit_through
    from synth.moving.conical import ConicalMotion as ConicalMotion
    from synth.moving.conical import move_on_cone as move_on_cone
    from synth.moving.made import configuration_of as configuration_of
    from synth.moving.made import linkage_on_cone as linkage_on_cone
    from synth.moving.motion import move as move
    from synth.moving.rods import linkage_of_rods as linkage_of_rods
    from synth.moving.tables import table_text as table_text
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "synth.motion.walk.circuits": "circuit_through",
            "conical": "ConicalMotion move_on_cone",
            "made": "configuration_of linkage_on_cone",
            "motion": "move",
            "rods": "linkage_of_rods",
            "tables": "table_text",
        },
    )
