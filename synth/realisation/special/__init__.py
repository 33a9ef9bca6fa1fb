"""Special geometry: members of a type that move although counts say no.

`search` tries families one after the other: flat sheets with special lines and vertices (`sheets`), axes in space
(`families`, with `conditions`, `symmetries`, and `solving` by least squares). `judging` follows each member by a
finite motion; `answer` says what was tried and found. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
