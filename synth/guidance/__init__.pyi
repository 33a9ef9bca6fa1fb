from synth.guidance.dyads import Dyad as Dyad, dyad_of as dyad_of, dyads_of_three as dyads_of_three
from synth.guidance.five import DyadsOfFive as DyadsOfFive, dyads_of_five as dyads_of_five
from synth.guidance.four import AxisCurve as AxisCurve, centre_axes as centre_axes, dyads_of_four as dyads_of_four
from synth.guidance.fourbars import (
    BodyMotion as BodyMotion,
    GuidedFourBar as GuidedFourBar,
    four_bar_of as four_bar_of,
    four_bars as four_bars,
    motion_of as motion_of,
)
from synth.guidance.hoop_method import Crossing as Crossing, Hoop as Hoop, hoop as hoop
from synth.guidance.many import dyads_by_least_squares as dyads_by_least_squares
from synth.guidance.on_cones import ConicalForm as ConicalForm, conical_forms as conical_forms
from synth.guidance.order import (
    OrderAnalysis as OrderAnalysis,
    analyse_order as analyse_order,
    crank_angles as crank_angles,
)
from synth.guidance.orientations import (
    Orientations as Orientations,
    read_orientations as read_orientations,
    unit_vector as unit_vector,
    write_orientations as write_orientations,
)
from synth.guidance.synthesis import GuidingDyads as GuidingDyads, guiding_dyads as guiding_dyads
