"""Rounded coordinates moved, within their precision, to ones that fold.

`mended` is the question; `places` says how a linkage depends on its vertices, `angles` which angles are meant to
be alike, `fitting` moves the vertices. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.folding.mending.repair import Mended as Mended
    from synth.folding.mending.repair import flattened as flattened
    from synth.folding.mending.repair import mended as mended
else:
    __getattr__, __dir__, __all__ = offered(__name__, {"repair": "Mended flattened mended"})
