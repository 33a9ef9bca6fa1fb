"""Joints to lock, or panels to crease, so that a mechanism has the required number of freedoms.

`advise` answers (`advice`). Below it: `locks` (the configuration itself if it is regular, else one on the motion
branch that the assignment chooses; sets of joints, cheapest first), `diagonals` (diagonals of panels, what each
does to the closure equations, and the smallest sets of them). Theory: docs/theory/advice.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
