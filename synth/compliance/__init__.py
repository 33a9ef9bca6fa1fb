"""Compliance states: members that bend or rest, mobility with these rigid and those released; springs and masses.

`states` answers. Below it: `members` (the linkage that is left), `freedoms` (of each set of active members),
`springs` (energy on the closed poses), `equilibrium` (balance, load paths), `small_motions` (modes and
frequencies), `stated`, `answer`. `limits` tells where ride-alongs go straight: `limited`, `limits_answer`.
Theory: docs/theory/compliance.md, docs/theory/activating-constraints.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
