from synth.linkages.fourbar.closing import (
    FourBarKind as FourBarKind,
    can_close as can_close,
    grashof_class as grashof_class,
    kind_of_planar as kind_of_planar,
    kind_of_spherical as kind_of_spherical,
    minimal_supplementary as minimal_supplementary,
    planar_differences as planar_differences,
    spherical_differences as spherical_differences,
    supplementary as supplementary,
)
from synth.linkages.fourbar.position import (
    input_limits_spherical as input_limits_spherical,
    output_planar as output_planar,
    output_spherical as output_spherical,
    transmission_spherical as transmission_spherical,
)
