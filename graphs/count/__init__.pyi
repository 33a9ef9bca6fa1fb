from graphs.count.applicability import (
    EQUATIONS as EQUATIONS,
    Equation as Equation,
    EquationResult as EquationResult,
    mechanism_class as mechanism_class,
)
from graphs.count.equations import (
    closed_surface as closed_surface,
    loop_form as loop_form,
    mobility_of_model as mobility_of_model,
    modified_cgk as modified_cgk,
    overconstraint as overconstraint,
    polyhedron_equation as polyhedron_equation,
    relative_cgk as relative_cgk,
    relative_polyhedron as relative_polyhedron,
    relative_spherical_system as relative_spherical_system,
    spherical_system as spherical_system,
    traditional_cgk as traditional_cgk,
    wampler_ground_free as wampler_ground_free,
    wampler_points as wampler_points,
    wampler_remote as wampler_remote,
    wampler_rods as wampler_rods,
    wampler_scissors as wampler_scissors,
)
from graphs.count.report import MobilityReport as MobilityReport, mobility_report as mobility_report
