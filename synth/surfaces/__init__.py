"""Linkages mapped to right cones and cylinders, all joint axes being ruling lines.

A loop is told by its steps: projected angles round the axis (`circuit`). Which cones there are, `cone` says for
one loop, `linkage_cones` for several, and `cyclic` in closed form for a million four-bars at a time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.surfaces.circuit import Circuits as Circuits
    from synth.surfaces.circuit import azimuths as azimuths
    from synth.surfaces.circuit import circuits as circuits
    from synth.surfaces.circuit import closing_step as closing_step
    from synth.surfaces.circuit import table1 as table1
    from synth.surfaces.circuit import wrapped as wrapped
    from synth.surfaces.cone import ConeMap as ConeMap
    from synth.surfaces.cone import link_angles as link_angles
    from synth.surfaces.cone import map_to_cones as map_to_cones
    from synth.surfaces.cone import projected_angles as projected_angles
    from synth.surfaces.cyclic import circumradii as circumradii
    from synth.surfaces.cyclic import cone_angles as cone_angles
    from synth.surfaces.cylinder import CylinderMap as CylinderMap
    from synth.surfaces.cylinder import central_angles as central_angles
    from synth.surfaces.cylinder import map_to_cylinders as map_to_cylinders
    from synth.surfaces.linkage_cones import CommonCone as CommonCone
    from synth.surfaces.linkage_cones import CommonFamily as CommonFamily
    from synth.surfaces.linkage_cones import common_cones as common_cones
    from synth.surfaces.linkages import LinkageMap as LinkageMap
    from synth.surfaces.linkages import by_angles as by_angles
    from synth.surfaces.linkages import map_linkage as map_linkage
    from synth.surfaces.loop_sums import LoopRoots as LoopRoots
    from synth.surfaces.loop_sums import loop_roots as loop_roots
    from synth.surfaces.loop_sums import loop_sum as loop_sum
    from synth.surfaces.mapping import FamilyOfCircles as FamilyOfCircles
    from synth.surfaces.mapping import MappedLoop as MappedLoop
    from synth.surfaces.several_loops import LoopSteps as LoopSteps
    from synth.surfaces.several_loops import link_pairs as link_pairs
    from synth.surfaces.several_loops import loop_steps as loop_steps
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "linkages": "LinkageMap by_angles map_linkage",
            "circuit": "Circuits azimuths circuits closing_step table1 wrapped",
            "cone": "ConeMap link_angles map_to_cones projected_angles",
            "cyclic": "circumradii cone_angles",
            "cylinder": "CylinderMap central_angles map_to_cylinders",
            "linkage_cones": "CommonCone CommonFamily common_cones",
            "loop_sums": "LoopRoots loop_roots loop_sum",
            "mapping": "FamilyOfCircles MappedLoop",
            "several_loops": "LoopSteps link_pairs loop_steps",
        },
    )
