from graphs.mechanism.surfaces import joint_axes as joint_axes
from synth.linkages.conformed.behaviours import (
    Behaviour as Behaviour,
    TableRow as TableRow,
    Way as Way,
    behaviour as behaviour,
    icrl as icrl,
    instant_centres as instant_centres,
    table4 as table4,
    table_row as table_row,
)
from synth.linkages.conformed.dihedrals import dihedral_angles as dihedral_angles
from synth.linkages.conformed.linkage_behaviour import (
    ArcChoice as ArcChoice,
    LinkageBehaviour as LinkageBehaviour,
    OnSurface as OnSurface,
    linkage_on_surfaces as linkage_on_surfaces,
    loop_of_steps as loop_of_steps,
    loop_on_cones as loop_on_cones,
    loop_on_cylinders as loop_on_cylinders,
    surface_behaviours as surface_behaviours,
)
from synth.linkages.conformed.outward_rate import (
    OutwardRate as OutwardRate,
    joint_rates as joint_rates,
    outward_rates as outward_rates,
)
from synth.linkages.conformed.rates import (
    ConformedChain as ConformedChain,
    FirstOrder as FirstOrder,
    first_order as first_order,
)
from synth.linkages.conformed.rates_over_angles import (
    Allowed as Allowed,
    LinksInLayers as LinksInLayers,
    OverAngles as OverAngles,
    links_in_layers as links_in_layers,
    never_singular as never_singular,
    over_angles as over_angles,
)
