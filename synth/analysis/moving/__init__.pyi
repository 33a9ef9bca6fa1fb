from synth.analysis.motion.path import circuit_through as circuit_through
from synth.analysis.moving._configuration_of import (
    configuration_of as configuration_of,
    linkage_of_closed_form as linkage_of_closed_form,
    linkage_of_rods as linkage_of_rods,
)
from synth.analysis.moving.motion import (
    FileConfigurations as FileConfigurations,
    configurations_of_file as configurations_of_file,
    in_configuration as in_configuration,
    move as move,
    table_text as table_text,
)
from synth.analysis.moving.on_surface import (
    InstantAxis as InstantAxis,
    LinkPoint as LinkPoint,
    SurfaceMotion as SurfaceMotion,
    move_on_surface as move_on_surface,
)
