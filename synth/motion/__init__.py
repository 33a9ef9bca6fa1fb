"""How a mechanism moves from a configuration: links rigid, all loops closed.

`linkage` holds links and axes, `closure` the equations and their derivatives, `newton` corrects,
`walk` takes steps along a path and says what it meets, `path` drives joints, `second_order` and `branches` find
the ways to move from a singular configuration such as a flat sheet, `singular` what these rest on and proofs that
nothing moves, `beginning` which way is taken, `placement` where links are; `derivatives` and `bodies` say how a
configuration changes with what the mechanism is made of. Theory: docs/theory/folding.md,
docs/theory/derivatives.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.motion.bodies import BodyTree as BodyTree
    from synth.motion.branches import Branch as Branch
    from synth.motion.branches import Branches as Branches
    from synth.motion.branches import Search as Search
    from synth.motion.branches import branches_of as branches_of
    from synth.motion.branches import first_branch as first_branch
    from synth.motion.closure import ClosureEquations as ClosureEquations
    from synth.motion.derivatives import AxisChange as AxisChange
    from synth.motion.derivatives import AxisDependence as AxisDependence
    from synth.motion.derivatives import Sensitivity as Sensitivity
    from synth.motion.derivatives import dependence_on_axes as dependence_on_axes
    from synth.motion.derivatives import derivatives_by_parameters as derivatives_by_parameters
    from synth.motion.derivatives import sensitivities as sensitivities
    from synth.motion.derivatives import spatial as spatial
    from synth.motion.linkage import PosedLinkage as PosedLinkage
    from synth.motion.linkage import linkage_of_axes as linkage_of_axes
    from synth.motion.linkage import linkage_of_sheet as linkage_of_sheet
    from synth.motion.path import Path as Path
    from synth.motion.path import PathOptions as PathOptions
    from synth.motion.path import driven_path as driven_path
    from synth.motion.placement import link_motions as link_motions
    from synth.motion.singular.rigidity import Rigidity as Rigidity
    from synth.motion.singular.rigidity import rigidity_of as rigidity_of
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "bodies": "BodyTree",
            "branches": "Branch Branches Search branches_of first_branch",
            "closure": "ClosureEquations",
            "derivatives": (
                "AxisChange AxisDependence Sensitivity dependence_on_axes derivatives_by_parameters sensitivities "
                "spatial"
            ),
            "linkage": "PosedLinkage linkage_of_axes linkage_of_sheet",
            "path": "Path PathOptions driven_path",
            "placement": "link_motions",
            "synth.motion.singular.rigidity": "Rigidity rigidity_of",
        },
    )
