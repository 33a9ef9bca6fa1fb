"""Layouts: where links and joints are drawn, without crossings if that can be, mirrored if that can be too."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.drawing.layout.mechanisms import Layout as Layout
    from synth.drawing.layout.mechanisms import layout_of as layout_of
else:
    __getattr__, __dir__, __all__ = offered(__name__, {"mechanisms": "Layout layout_of"})
