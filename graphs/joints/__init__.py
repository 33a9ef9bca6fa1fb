"""Joints of all kinds, and the chains of revolutes that stand for them.

`JointedLinkage` is a link-joint graph with the kind of each joint; `revolutes_of` makes the mechanism of creases
of it, `recognised` sees such chains in one of creases. Theory: docs/theory/joints.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
