"""Special geometry: members of a type that move although counts say no.

`search` tries the `families` one after the other, flat sheets and axes in space (`axes`), and follows each member
by a finite motion. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
