"""Compliance states: members that bend or rest, mobility with these rigid and those released; springs and masses.

`states` answers (`compliance_states`). Below it: `members` (the linkage that is left, and its freedoms), `springs`
(energy on the closed configurations, balance, load paths, modes and frequencies). `limits` finds where ride-alongs go
straight (`joint_limits`). Theory: docs/theory/compliance.md, docs/theory/activating-constraints.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
