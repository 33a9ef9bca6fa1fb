from synth.linkages.surfaces.circuit import (
    Circuits as Circuits,
    LoopSteps as LoopSteps,
    azimuths as azimuths,
    circuits as circuits,
    closing_step as closing_step,
    link_angles as link_angles,
    loop_steps as loop_steps,
)
from synth.linkages.surfaces.linkage_maps import (
    CommonFamily as CommonFamily,
    CommonSurface as CommonSurface,
    LinkageMap as LinkageMap,
    SupplementaryLinkages as SupplementaryLinkages,
    by_sizes as by_sizes,
    common_surfaces as common_surfaces,
    map_linkage as map_linkage,
    supplementary_linkages as supplementary_linkages,
)
from synth.linkages.surfaces.loop_maps import (
    ConeMap as ConeMap,
    ConesOfLoops as ConesOfLoops,
    CylinderMap as CylinderMap,
    cones_of_loops as cones_of_loops,
    map_to_cones as map_to_cones,
    map_to_cylinders as map_to_cylinders,
)
from synth.linkages.surfaces.loop_sums import (
    circumradii as circumradii,
    cone_angles as cone_angles,
    loop_sum as loop_sum,
)
from synth.linkages.surfaces.mapping import FamilyOfCircles as FamilyOfCircles, MappedLoop as MappedLoop
