from synth.guidance.dyads import (
    AxisCurve as AxisCurve,
    Dyad as Dyad,
    centre_axes as centre_axes,
    dyad_of as dyad_of,
    dyads_of_four as dyads_of_four,
    dyads_of_three as dyads_of_three,
)
from synth.guidance.fourbars import (
    BodyMotion as BodyMotion,
    ConicalForm as ConicalForm,
    GuidedFourBar as GuidedFourBar,
    conical_forms as conical_forms,
    four_bar_of as four_bar_of,
    four_bars as four_bars,
    motion_of as motion_of,
)
from synth.guidance.guiding import GuidingDyads as GuidingDyads, guiding_dyads as guiding_dyads
from synth.guidance.many import DyadTable as DyadTable, dyads_of_sets as dyads_of_sets
from synth.guidance.order import (
    Hoop as Hoop,
    HoopCrossing as HoopCrossing,
    OrderAnalysis as OrderAnalysis,
    analyse_order as analyse_order,
    crank_angles as crank_angles,
    hoop as hoop,
)
from synth.guidance.orientations import (
    Orientations as Orientations,
    read_orientations as read_orientations,
    write_orientations as write_orientations,
)
from synth.guidance.propeller import PlanarPositions as PlanarPositions, analyse_planar_order as analyse_planar_order
from synth.guidance.sixbars import GuidedSixBar as GuidedSixBar, GuidedSixBars as GuidedSixBars, six_bars as six_bars
from synth.guidance.synthesis import (
    DyadsOfFive as DyadsOfFive,
    dyads_by_least_squares as dyads_by_least_squares,
    dyads_of_five as dyads_of_five,
)
