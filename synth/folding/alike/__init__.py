"""Motions in which creases that look alike fold alike: those that keep a symmetry of a flat pattern.

`classes` finds which creases look alike, `closure` closes loops with their fold angles equal, `reaching` folds a
pattern until a crease has an angle. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.folding.alike.classes import alike_classes as alike_classes
    from synth.folding.alike.closure import AlikeClosure as AlikeClosure
    from synth.folding.alike.reaching import Reached as Reached
    from synth.folding.alike.reaching import fold_to as fold_to
else:
    __getattr__, __dir__, __all__ = offered(
        __name__, {"classes": "alike_classes", "closure": "AlikeClosure", "reaching": "Reached fold_to"}
    )
