"""Motions in which creases that look alike fold alike: those that keep a symmetry of a flat pattern.

`classes` finds which creases look alike, `closure` closes loops with their fold angles equal, `reaching` folds a
pattern until a crease has an angle. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
