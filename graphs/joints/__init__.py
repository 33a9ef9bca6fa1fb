"""Joints of all kinds, and the chains of revolutes that stand for them.

`JointedLinkage` is a link-joint graph with the kind of each joint; `revolutes_of` makes the mechanism of creases
of it, `recognised` sees such chains in one of creases. Theory: docs/theory/joints.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.joints.as_revolutes import revolutes_of as revolutes_of
    from graphs.joints.kinds import JointKind as JointKind
    from graphs.joints.kinds import kind_named as kind_named
    from graphs.joints.linkage import JointedLinkage as JointedLinkage
    from graphs.joints.linkage import JointPlace as JointPlace
    from graphs.joints.placing import placed as placed
    from graphs.joints.recognising import recognised as recognised
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "as_revolutes": "revolutes_of",
            "kinds": "JointKind kind_named",
            "linkage": "JointPlace JointedLinkage",
            "placing": "placed",
            "recognising": "recognised",
        },
    )
