from synth.analysis.motion.path import circuit_through as circuit_through
from synth.analysis.moving._configuration_of import (
    configuration_of as configuration_of,
    linkage_of_rods as linkage_of_rods,
    posed_on_surface as posed_on_surface,
)
from synth.analysis.moving.motion import (
    FilePoses as FilePoses,
    in_configuration as in_configuration,
    move as move,
    poses_of_file as poses_of_file,
    table_text as table_text,
)
from synth.analysis.moving.on_surface import (
    InstantAxis as InstantAxis,
    LinkPoint as LinkPoint,
    SurfaceMotion as SurfaceMotion,
    move_on_surface as move_on_surface,
)
