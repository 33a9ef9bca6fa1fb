"""Type synthesis of spherical-system linkages: origami, pop-ups, cartons, conical mechanisms.

Where to begin::

    import synth

    mechanism = synth.read("data/patterns/bird-base.fold")  # any file, or an id: "k1:Cr"
    print(synth.mobility(mechanism))                        # how it moves, and how that is known
    synth.write(synth.reduce(mechanism).graph, "smaller.json")
    for chain in synth.chains(links=8, dof=1): ...          # all kinematic chains of a size
    synth.map_to_cones([2.1, 1.7, 0.8, 1.5])                # cones on which a four-bar lies

Reading and writing: `read`, `write`. Questions: `mobility`, `identify`, `reconstruct`. New mechanisms of old ones:
`reduce`, `convert`; edits are in `graphs.edit`. All mechanisms of a kind: `chains`, `sc_graphs`, `scd_graphs`,
`strings`, and `count_chains`, `count_sc_graphs`, `count_scd_graphs`. Cones and cylinders: `map_to_cones`,
`map_to_cylinders`, `map_linkage`. Guidance of a body: `Orientations`, `analyse_order`, `guiding_dyads`,
`four_bars`. A type as a thing: `realise`, panels with coordinates; `realise_on_cone`. Motion: `fold`, a crease
pattern with rigid panels, frame by frame; `move`, any linkage; `positions`, all at given inputs. `explain`: why it
moves; `advise`: what to lock, which panels to crease; `states`: which members bend, and what springs do. Known
patterns and linkages: `generate`, by parameters. All types up to a size in a file: `open_atlas`.
Pictures: `draw`, of any mechanism; `synth.drawing.save_scene` writes them. In a notebook mechanisms show
themselves.

Angles are radians. Every answer prints as the command line does, has ``to_json()``, and says how it is known. An
error on purpose is a `SynthedraError`. More is in the rooms: ``docs/architecture.md`` lists them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered
from synth.notebook import show_in_this_notebook

if TYPE_CHECKING:
    from enumerate.chains.kinematic import chains as chains
    from enumerate.chains.kinematic import count_chains as count_chains
    from enumerate.sc.graphs import count_sc_graphs as count_sc_graphs
    from enumerate.sc.graphs import sc_graphs as sc_graphs
    from enumerate.scd.graphs import count_scd_graphs as count_scd_graphs
    from enumerate.scd.graphs import scd_graphs as scd_graphs
    from enumerate.strings.panel_strings import strings as strings
    from graphs.answer.identity import identify as identify
    from graphs.answer.reconstruction import reconstruct as reconstruct
    from graphs.convert.by_name import convert as convert
    from graphs.errors import FileError as FileError
    from graphs.errors import InvariantError as InvariantError
    from graphs.errors import SynthedraError as SynthedraError
    from graphs.errors import UnsolvableError as UnsolvableError
    from graphs.files.formats import read as read
    from graphs.files.formats import write as write
    from graphs.loops.loop import Centre as Centre
    from graphs.loops.loop import Loop as Loop
    from graphs.mechanism.conical import ConicalLinkage as ConicalLinkage
    from graphs.mechanism.polyhedron import PolyhedronModel as PolyhedronModel
    from graphs.mechanism.sc import SCGraph as SCGraph
    from graphs.mechanism.scd import SCDGraph as SCDGraph
    from graphs.mechanism.sheet import Sheet as Sheet
    from graphs.mechanism.vertex_edge import VertexEdgeGraph as VertexEdgeGraph
    from graphs.reduce.ride_alongs import reduce as reduce
    from synth.advice.advised import advise as advise
    from synth.assembly.found import positions as positions
    from synth.atlas.asked.opened import open_atlas as open_atlas
    from synth.compliance.stated import states as states
    from synth.drawing.mechanisms.pictures import draw as draw
    from synth.folding.motion import fold as fold
    from synth.guidance.fourbars import four_bars as four_bars
    from synth.guidance.order import analyse_order as analyse_order
    from synth.guidance.orientations import Orientations as Orientations
    from synth.guidance.synthesis import guiding_dyads as guiding_dyads
    from synth.moving.motion import move as move
    from synth.notebook import load_ipython_extension as load_ipython_extension
    from synth.overconstraint.explained import explain as explain
    from synth.patterns.generated import generate as generate
    from synth.realisation.forms.on_cone import realise_on_cone as realise_on_cone
    from synth.realisation.realised import realise as realise
    from synth.surfaces.cone import map_to_cones as map_to_cones
    from synth.surfaces.cylinder import map_to_cylinders as map_to_cylinders
    from synth.surfaces.linkages import map_linkage as map_linkage
    from synth.verdict.judged import mobility as mobility
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "enumerate.chains.kinematic": "chains count_chains",
            "enumerate.sc.graphs": "count_sc_graphs sc_graphs",
            "enumerate.scd.graphs": "count_scd_graphs scd_graphs",
            "enumerate.strings.panel_strings": "strings",
            "graphs.answer.identity": "identify",
            "graphs.answer.reconstruction": "reconstruct",
            "graphs.convert.by_name": "convert",
            "graphs.errors": "FileError InvariantError SynthedraError UnsolvableError",
            "graphs.files.formats": "read write",
            "graphs.loops.loop": "Centre Loop",
            "graphs.mechanism.conical": "ConicalLinkage",
            "graphs.mechanism.polyhedron": "PolyhedronModel",
            "graphs.mechanism.sc": "SCGraph",
            "graphs.mechanism.scd": "SCDGraph",
            "graphs.mechanism.sheet": "Sheet",
            "graphs.mechanism.vertex_edge": "VertexEdgeGraph",
            "graphs.reduce.ride_alongs": "reduce",
            "synth.advice.advised": "advise",
            "synth.atlas.asked.opened": "open_atlas",
            "synth.assembly.found": "positions",
            "synth.compliance.stated": "states",
            "synth.drawing.mechanisms.pictures": "draw",
            "synth.folding.motion": "fold",
            "synth.verdict.judged": "mobility",
            "synth.guidance.fourbars": "four_bars",
            "synth.guidance.order": "analyse_order",
            "synth.guidance.orientations": "Orientations",
            "synth.guidance.synthesis": "guiding_dyads",
            "synth.moving.motion": "move",
            "synth.notebook": "load_ipython_extension",
            "synth.overconstraint.explained": "explain",
            "synth.patterns.generated": "generate",
            "synth.realisation.forms.on_cone": "realise_on_cone",
            "synth.realisation.realised": "realise",
            "synth.surfaces.cone": "map_to_cones",
            "synth.surfaces.cylinder": "map_to_cylinders",
            "synth.surfaces.linkages": "map_linkage",
        },
    )

show_in_this_notebook()
