"""Pictures of mechanisms: crease patterns, folded sheets, chains, SC and SCD graphs, polyhedron models."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.drawing.mechanisms.chains import chain_scene as chain_scene
    from synth.drawing.mechanisms.creases import crease_scene as crease_scene
    from synth.drawing.mechanisms.pictures import draw as draw
    from synth.drawing.mechanisms.sc_graphs import sc_scene as sc_scene
    from synth.drawing.mechanisms.space import folded_scene as folded_scene
    from synth.drawing.mechanisms.space import model_scene as model_scene
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "chains": "chain_scene",
            "creases": "crease_scene",
            "pictures": "draw",
            "sc_graphs": "sc_scene",
            "space": "folded_scene model_scene",
        },
    )
