"""The linkage of a configuration as `synth.mobility` counts it, and the joints of the file for its own."""

from collections.abc import Mapping
from dataclasses import dataclass

from graphs.answer.mobility_of_joints import chain_with_centres
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.solids import HingedSolids
from graphs.types import JointId
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.linkage import Linkage, LinkageLoop, linkage_of_axes
from synth.analysis.moving.elements import serial_linkage
from synth.analysis.overconstraint import redundancy


@dataclass(frozen=True, slots=True)
class CountedLinkage:
    """A linkage whose loops have the equations that the count has, and the joint of the file for each of its own."""

    linkage: Linkage
    joint_of: Mapping[JointId, JointId]

    def joints_of(self, loop: LinkageLoop) -> tuple[JointId, ...]:
        """Return the joints of the file that a loop passes, each once."""
        names = list(self.linkage.graph.joints)
        return tuple(dict.fromkeys(self.joint_of[names[place]] for place in loop.joints))

    def tolerances(self, order: redundancy.FirstOrderClosure) -> tuple[redundancy.Tolerance, ...]:
        """Return how far each joint of the file may err: as far as the first of its axes, least first."""
        least: dict[JointId, redundancy.Tolerance] = {}
        for axis in redundancy.axis_tolerances(self.linkage, order):
            joint = self.joint_of[axis.joint]
            known = least.get(joint, axis)
            least[joint] = redundancy.Tolerance(joint, min(known.turn, axis.turn), min(known.shift, axis.shift))
        return tuple(least.values())


def linkage_as_counted(at: Configuration) -> CountedLinkage:
    """Return the linkage of a configuration as `synth.mobility` counts it: loops planar here are planar loops."""
    given = at.given
    if isinstance(given, JointedLinkage):
        serial = serial_linkage(given)
        return CountedLinkage(serial.linkage, serial.joint_of)
    linkage = at.linkage
    if isinstance(given, HingedSolids):
        linkage = linkage_of_axes(chain_with_centres(given), given.axes)
    return CountedLinkage(linkage, {joint: joint for joint in linkage.graph.joints})
