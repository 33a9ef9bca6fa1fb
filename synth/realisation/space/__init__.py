"""Drawings taken into space: lifts above them, and projective maps by which centres recede to infinity."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.realisation.space.lifting import lifted as lifted
    from synth.realisation.space.receding import receded as receded
else:
    __getattr__, __dir__, __all__ = offered(__name__, {"lifting": "lifted", "receding": "receded"})
