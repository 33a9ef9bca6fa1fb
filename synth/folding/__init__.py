"""Crease patterns folded: what only sheets have, panels above all.

`fold` takes a crease pattern along one of its branches. `configuration` makes coordinates ready: opened along
cuts (`opened`), mended where rounding stopped them (`mending`). `vertices` says where vertices are, `collisions`
which panels pass through each other, `alike` keeps a symmetry, `derivatives` says how a folded sheet changes with
its vertices. How anything moves is in `synth.motion`. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.folding.derivatives import SheetDerivatives as SheetDerivatives
    from synth.folding.motion import fold as fold
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "derivatives": "SheetDerivatives",
            "motion": "fold",
        },
    )
