"""Mobility by count: the equations, their differences, and which of them apply to a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.count.equations import closed_surface as closed_surface
    from graphs.count.equations import loop_form as loop_form
    from graphs.count.equations import mobility_of_model as mobility_of_model
    from graphs.count.equations import modified_cgk as modified_cgk
    from graphs.count.equations import overconstraint as overconstraint
    from graphs.count.equations import polyhedron_equation as polyhedron_equation
    from graphs.count.equations import spherical_system as spherical_system
    from graphs.count.equations import traditional_cgk as traditional_cgk
    from graphs.count.equations import wampler_ground_free as wampler_ground_free
    from graphs.count.equations import wampler_points as wampler_points
    from graphs.count.equations import wampler_remote as wampler_remote
    from graphs.count.equations import wampler_rods as wampler_rods
    from graphs.count.equations import wampler_scissors as wampler_scissors
    from graphs.count.relative import relative_cgk as relative_cgk
    from graphs.count.relative import relative_polyhedron as relative_polyhedron
    from graphs.count.relative import relative_spherical_system as relative_spherical_system
    from graphs.count.report import EquationResult as EquationResult
    from graphs.count.report import MobilityReport as MobilityReport
    from graphs.count.report import mechanism_class as mechanism_class
    from graphs.count.report import mobility_report as mobility_report
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "equations": (
                "closed_surface loop_form mobility_of_model modified_cgk overconstraint "
                "polyhedron_equation spherical_system traditional_cgk wampler_ground_free "
                "wampler_points wampler_remote wampler_rods wampler_scissors"
            ),
            "relative": "relative_cgk relative_polyhedron relative_spherical_system",
            "report": "EquationResult MobilityReport mechanism_class mobility_report",
        },
    )
