"""Linkages in the conformed position: rates there, which way links can go, and what holds over all angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.conformed.all_angles import Allowed as Allowed
    from synth.conformed.all_angles import OverAngles as OverAngles
    from synth.conformed.all_angles import never_singular as never_singular
    from synth.conformed.all_angles import over_angles as over_angles
    from synth.conformed.behaviours import Behaviour as Behaviour
    from synth.conformed.behaviours import Way as Way
    from synth.conformed.behaviours import behaviour as behaviour
    from synth.conformed.behaviours import behaviour_of_motion as behaviour_of_motion
    from synth.conformed.behaviours import icrl as icrl
    from synth.conformed.behaviours import instant_centres as instant_centres
    from synth.conformed.behaviours import link_arcs as link_arcs
    from synth.conformed.four_bar_poses import FourBarPoses as FourBarPoses
    from synth.conformed.four_bar_poses import poses_from_conformed as poses_from_conformed
    from synth.conformed.layers import LinksInLayers as LinksInLayers
    from synth.conformed.layers import links_in_layers as links_in_layers
    from synth.conformed.linkages import LinkageBehaviour as LinkageBehaviour
    from synth.conformed.linkages import OnCone as OnCone
    from synth.conformed.linkages import linkage_on_cones as linkage_on_cones
    from synth.conformed.linkages import loop_of_steps as loop_of_steps
    from synth.conformed.linkages import loop_on_cones as loop_on_cones
    from synth.conformed.outward import OutwardRate as OutwardRate
    from synth.conformed.outward import joint_rates as joint_rates
    from synth.conformed.outward import outward_rates as outward_rates
    from synth.conformed.pose import PoseCheck as PoseCheck
    from synth.conformed.pose import check_pose as check_pose
    from synth.conformed.pose import dihedral_angles as dihedral_angles
    from synth.conformed.pose import joint_axes as joint_axes
    from synth.conformed.pose import measured_dihedral_angles as measured_dihedral_angles
    from synth.conformed.rates import ConformedChain as ConformedChain
    from synth.conformed.rates import FirstOrder as FirstOrder
    from synth.conformed.rates import first_order as first_order
    from synth.conformed.twelve_cases import TableRow as TableRow
    from synth.conformed.twelve_cases import table4 as table4
    from synth.conformed.twelve_cases import table_row as table_row
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "linkages": "LinkageBehaviour OnCone linkage_on_cones loop_of_steps loop_on_cones",
            "all_angles": "Allowed OverAngles never_singular over_angles",
            "behaviours": "Behaviour Way behaviour behaviour_of_motion icrl instant_centres link_arcs",
            "four_bar_poses": "FourBarPoses poses_from_conformed",
            "layers": "LinksInLayers links_in_layers",
            "outward": "OutwardRate joint_rates outward_rates",
            "pose": "PoseCheck check_pose dihedral_angles joint_axes measured_dihedral_angles",
            "rates": "ConformedChain FirstOrder first_order",
            "twelve_cases": "TableRow table4 table_row",
        },
    )
