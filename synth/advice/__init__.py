"""What to lock, or which panels to crease, so that a mechanism has as many freedoms as are wanted.

`advise` answers. Below it: `general_pose` (where it is asked: the pose given if it is regular, else one on the way
that the marks choose), `locks` (sets of joints, cheapest first), `diagonals` (diagonals of panels, and what each
does to the closure equations), `search` (smallest sets of them), `advised` (both together). Theory:
docs/theory/advice.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
