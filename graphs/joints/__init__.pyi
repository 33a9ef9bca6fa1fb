from graphs.joints.as_points import points_of as points_of
from graphs.joints.as_revolutes import revolutes_of as revolutes_of
from graphs.joints.kinds import JointKind as JointKind, kind_named as kind_named
from graphs.joints.linkage import JointedLinkage as JointedLinkage, JointPlace as JointPlace
from graphs.joints.placing import placed as placed
from graphs.joints.recognising import recognised as recognised
