"""How crease patterns and other linkages move: panels rigid, all loops closed, frame by frame.

`fold` takes a crease pattern along one of its branches. Below it: `linkage` (links and axes at a pose), `closure`
(the equations and their derivatives), `newton`, `path` (joints driven), `second_order` and `branches` (ways to
move from a singular pose, such as a flat sheet), `singular` (what these rest on; proofs that nothing moves),
`placement` (where panels and vertices are), `prepared` and `mending` (coordinates made ready), `verdict` (how a
mechanism moves, in a sentence). Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.folding.branches import Branch as Branch
    from synth.folding.branches import Branches as Branches
    from synth.folding.branches import Search as Search
    from synth.folding.branches import branches_of as branches_of
    from synth.folding.branches import first_branch as first_branch
    from synth.folding.closure import ClosureEquations as ClosureEquations
    from synth.folding.linkage import PosedLinkage as PosedLinkage
    from synth.folding.linkage import linkage_of_axes as linkage_of_axes
    from synth.folding.linkage import linkage_of_sheet as linkage_of_sheet
    from synth.folding.motion import Folding as Folding
    from synth.folding.motion import fold as fold
    from synth.folding.path import DrivenPath as DrivenPath
    from synth.folding.path import PathOptions as PathOptions
    from synth.folding.path import driven_path as driven_path
    from synth.folding.placement import link_motions as link_motions
    from synth.folding.singular.rigidity import Rigidity as Rigidity
    from synth.folding.singular.rigidity import rigidity_of as rigidity_of
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "branches": "Branch Branches Search branches_of first_branch",
            "closure": "ClosureEquations",
            "linkage": "PosedLinkage linkage_of_axes linkage_of_sheet",
            "motion": "Folding fold",
            "path": "DrivenPath PathOptions driven_path",
            "placement": "link_motions",
            "synth.folding.singular.rigidity": "Rigidity rigidity_of",
        },
    )
