"""Singular configurations: equations of second order, proofs of rigidity, branches followed.

`second_order` makes an equation of each self-stress, finds the rates that agree with all of them, and proves
rigidity; `complete` finds all points that equations leave, by all paths (`homotopy`) with certificates (`certificate`)
or by `elimination`; `immobile` takes out joints that a few loops hold; `joint_order` is the order of the joints in
which branches are searched for, `sampling` follows a branch, `nearest` finds one motion of linkages that are too large
for all. Theory: docs/theory/branches.md, docs/theory/folding.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
