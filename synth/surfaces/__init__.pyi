from synth.surfaces.circuit import (
    Circuits as Circuits,
    azimuths as azimuths,
    circuits as circuits,
    closing_step as closing_step,
    table1 as table1,
    wrapped as wrapped,
)
from synth.surfaces.common import (
    CommonFamily as CommonFamily,
    CommonSurface as CommonSurface,
    common_surfaces as common_surfaces,
)
from synth.surfaces.cone import (
    ConeMap as ConeMap,
    link_angles as link_angles,
    map_to_cones as map_to_cones,
    projected_angles as projected_angles,
)
from synth.surfaces.cyclic import circumradii as circumradii, cone_angles as cone_angles
from synth.surfaces.cylinder import (
    CylinderMap as CylinderMap,
    central_angles as central_angles,
    map_to_cylinders as map_to_cylinders,
)
from synth.surfaces.linkages import LinkageMap as LinkageMap, by_sizes as by_sizes, map_linkage as map_linkage
from synth.surfaces.loop_sums import LoopRoots as LoopRoots, loop_roots as loop_roots, loop_sum as loop_sum
from synth.surfaces.mapping import FamilyOfCircles as FamilyOfCircles, MappedLoop as MappedLoop
from synth.surfaces.several_loops import LoopSteps as LoopSteps, link_pairs as link_pairs, loop_steps as loop_steps
from synth.surfaces.supplementary import (
    SupplementaryLinkages as SupplementaryLinkages,
    supplementary_linkages as supplementary_linkages,
)
