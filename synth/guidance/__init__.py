"""A body guided through orientations: the order a crank takes them in, dyads, and four-bars of two dyads.

Of three orientations any axis has its dyad (`dyads`), four leave a curve (`four`), five at most six dyads
(`five`), more are met by least squares (`many`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.guidance.dyads import Dyad as Dyad
    from synth.guidance.dyads import dyad_of as dyad_of
    from synth.guidance.dyads import dyads_of_three as dyads_of_three
    from synth.guidance.five import DyadsOfFive as DyadsOfFive
    from synth.guidance.five import dyads_of_five as dyads_of_five
    from synth.guidance.four import AxisCurve as AxisCurve
    from synth.guidance.four import centre_axes as centre_axes
    from synth.guidance.four import dyads_of_four as dyads_of_four
    from synth.guidance.fourbars import BodyMotion as BodyMotion
    from synth.guidance.fourbars import GuidedFourBar as GuidedFourBar
    from synth.guidance.fourbars import four_bar_of as four_bar_of
    from synth.guidance.fourbars import four_bars as four_bars
    from synth.guidance.fourbars import motion_of as motion_of
    from synth.guidance.hoop_method import Crossing as Crossing
    from synth.guidance.hoop_method import Hoop as Hoop
    from synth.guidance.hoop_method import hoop as hoop
    from synth.guidance.many import dyads_by_least_squares as dyads_by_least_squares
    from synth.guidance.on_cones import ConicalForm as ConicalForm
    from synth.guidance.on_cones import conical_forms as conical_forms
    from synth.guidance.order import OrderAnalysis as OrderAnalysis
    from synth.guidance.order import analyse_order as analyse_order
    from synth.guidance.order import crank_angles as crank_angles
    from synth.guidance.orientations import Orientations as Orientations
    from synth.guidance.orientations import read_orientations as read_orientations
    from synth.guidance.orientations import unit_vector as unit_vector
    from synth.guidance.orientations import write_orientations as write_orientations
    from synth.guidance.synthesis import GuidingDyads as GuidingDyads
    from synth.guidance.synthesis import guiding_dyads as guiding_dyads
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "synthesis": "GuidingDyads guiding_dyads",
            "dyads": "Dyad dyad_of dyads_of_three",
            "five": "DyadsOfFive dyads_of_five",
            "four": "AxisCurve centre_axes dyads_of_four",
            "fourbars": "BodyMotion GuidedFourBar four_bar_of four_bars motion_of",
            "hoop_method": "Crossing Hoop hoop",
            "many": "dyads_by_least_squares",
            "on_cones": "ConicalForm conical_forms",
            "order": "OrderAnalysis analyse_order crank_angles",
            "orientations": "Orientations read_orientations unit_vector write_orientations",
        },
    )
