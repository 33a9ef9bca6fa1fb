"""Type synthesis of spherical-system linkages: origami, pop-ups, cartons, conical mechanisms.

Where to begin::

    import synth

    mechanism = synth.read("data/patterns/bird-base.fold")  # any file, or an id: "k1:Cr"
    print(synth.mobility(mechanism))                        # how it moves, and how that is known
    synth.write(synth.reduce(mechanism).graph, "smaller.json")
    for chain in synth.chains(links=8, dof=1): ...          # all kinematic chains of a size
    synth.map_to_cones([2.1, 1.7, 0.8, 1.5])                # cones on which a four-bar lies

Reading and writing: `read`, `write`. Questions: `look`, a first answer; `mobility`, `identify`, `reconstruct`. New
mechanisms of old ones: `reduce`, `convert`, `edit`. All mechanisms of a kind: `chains`, `sc_graphs`, `scd_graphs`,
`strings`, `addenda`, `conical_candidates`, and their numbers: `count_chains`, .... Cones and cylinders:
`map_to_cones`, `map_to_cylinders`, `map_linkage`; of many loops at once, by arrays: `cones_of_loops`; linkages for a
cone: `design_on_cone`; how links leave them: `surface_behaviours`, `move_on_surface`. Guidance of a body:
`Orientations`, `analyse_order`, `guiding_dyads`, `four_bars`, `six_bars`. A type with
coordinates: `realise`, `realise_on_cone`. Motion: `fold`, a crease pattern with rigid panels, frame by frame; `move`,
any linkage; `in_configuration`, a frame of a file, or joints at stated angles; `positions`, all assembly modes at
given inputs; `sweep`, many members of a type, arrays in and out. `explain`: why it moves; `layers`: whether it folds
flat, in how many layer orders; `advise`: what to lock, which panels to crease; `states`: which members bend, and what
springs do; `limits`: where ride-alongs stop joints. Known patterns and linkages: `generate`, by parameters.
Dimensions with which a mechanism moves as wished: `design`; types that can do a task, with dimensions, ranked: `task`.
All types up to a size in a file: `open_atlas`. Models for simulators, with closed loops: `write_model`.
Pictures: `draw`, of any mechanism, and their `save`; templates to cut and fold: `template`, `write_template`; pages
that fold: `view`. In a notebook mechanisms show themselves.

Where a function takes a mechanism it takes what `read` returns, the path of a file, or an id (`MechanismLike`).
Angles are radians. Every answer prints as the command line does, has ``to_json()``, and says how it is known. An
error on purpose is a `SynthedraError`. More is in the rooms: ``docs/architecture.md`` lists them.
"""

from graphs.lazy import offered
from synth.notebook import show_in_this_notebook

__getattr__, __dir__, __all__ = offered(__name__)

show_in_this_notebook()
