from synth.linkages.guidance._guiding_dyads import GuidingDyads as GuidingDyads, guiding_dyads as guiding_dyads
from synth.linkages.guidance.dyad_tables import DyadTable as DyadTable, dyads_of_sets as dyads_of_sets
from synth.linkages.guidance.dyads import (
    AxisCurve as AxisCurve,
    Dyad as Dyad,
    centre_axes as centre_axes,
    dyad_of as dyad_of,
    dyads_of_four as dyads_of_four,
    dyads_of_three as dyads_of_three,
)
from synth.linkages.guidance.fourbars import (
    BodyMotion as BodyMotion,
    ConicalForm as ConicalForm,
    GuidedFourBar as GuidedFourBar,
    conical_forms as conical_forms,
    four_bar_of as four_bar_of,
    four_bars as four_bars,
    motion_of as motion_of,
)
from synth.linkages.guidance.order import (
    Hoop as Hoop,
    HoopCrossing as HoopCrossing,
    OrderAnalysis as OrderAnalysis,
    analyse_order as analyse_order,
    crank_angles as crank_angles,
    hoop as hoop,
)
from synth.linkages.guidance.orientations import (
    Orientations as Orientations,
    read_orientations as read_orientations,
    write_orientations as write_orientations,
)
from synth.linkages.guidance.propeller import (
    PlanarPositions as PlanarPositions,
    analyse_planar_order as analyse_planar_order,
)
from synth.linkages.guidance.sixbars import (
    GuidedSixBar as GuidedSixBar,
    GuidedSixBars as GuidedSixBars,
    six_bars as six_bars,
)
from synth.linkages.guidance.synthesis import (
    DyadsOfFive as DyadsOfFive,
    dyads_by_least_squares as dyads_by_least_squares,
    dyads_of_five as dyads_of_five,
)
