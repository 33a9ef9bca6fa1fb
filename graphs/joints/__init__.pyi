from graphs.joints.joint_places import placed as placed
from graphs.joints.linkage import (
    JointedLinkage as JointedLinkage,
    JointKind as JointKind,
    JointPlace as JointPlace,
    kind_named as kind_named,
)
from graphs.joints.revolutes import recognised as recognised, revolutes_of as revolutes_of
from graphs.joints.rods_and_points import points_of as points_of
