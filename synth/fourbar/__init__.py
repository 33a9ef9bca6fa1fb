"""Four-bars, spherical and planar: which lengths close, and the positions they take."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.fourbar.closing import FourBarKind as FourBarKind
    from synth.fourbar.closing import can_close as can_close
    from synth.fourbar.closing import checked_link_angles as checked_link_angles
    from synth.fourbar.closing import checked_link_lengths as checked_link_lengths
    from synth.fourbar.closing import grashof_class as grashof_class
    from synth.fourbar.closing import kind_of_planar as kind_of_planar
    from synth.fourbar.closing import kind_of_spherical as kind_of_spherical
    from synth.fourbar.closing import planar_differences as planar_differences
    from synth.fourbar.closing import spherical_differences as spherical_differences
    from synth.fourbar.joint_lines import in_a_hemisphere as in_a_hemisphere
    from synth.fourbar.joint_lines import minimal_supplementary as minimal_supplementary
    from synth.fourbar.joint_lines import supplementary as supplementary
    from synth.fourbar.position import input_limits_planar as input_limits_planar
    from synth.fourbar.position import input_limits_spherical as input_limits_spherical
    from synth.fourbar.position import output_planar as output_planar
    from synth.fourbar.position import output_spherical as output_spherical
    from synth.fourbar.position import transmission_planar as transmission_planar
    from synth.fourbar.position import transmission_spherical as transmission_spherical
    from synth.fourbar.rounding import rounding_of as rounding_of
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "closing": (
                "FourBarKind can_close checked_link_angles checked_link_lengths grashof_class "
                "kind_of_planar kind_of_spherical planar_differences spherical_differences"
            ),
            "position": (
                "input_limits_planar input_limits_spherical output_planar output_spherical "
                "transmission_planar transmission_spherical"
            ),
            "rounding": "rounding_of",
            "joint_lines": "in_a_hemisphere minimal_supplementary supplementary",
        },
    )
