"""What to lock, or which panels to crease, so that a mechanism has as many freedoms as are wanted.

`advise` answers. Below it: `general_pose` (where it is asked: the pose given if it is regular, else one on the way
that the marks choose), `locks` (sets of joints, cheapest first), `diagonals` (diagonals of panels, and what each
does to the closure equations), `search` (smallest sets of them), `advised` (both together). Theory:
docs/theory/advice.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.advice.advised import advise as advise
    from synth.advice.answer import Advice as Advice
    from synth.advice.answer import Creased as Creased
    from synth.advice.answer import Locked as Locked
    from synth.advice.diagonals import Diagonal as Diagonal
    from synth.advice.general_pose import GeneralPose as GeneralPose
    from synth.advice.locks import cheapest_sets as cheapest_sets
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "advised": "advise",
            "answer": "Advice Creased Locked",
            "diagonals": "Diagonal",
            "general_pose": "GeneralPose",
            "locks": "cheapest_sets",
        },
    )
