from synth.atlas.building import AtlasPlan as AtlasPlan, build_atlas as build_atlas
from synth.atlas.columns import COLUMNS as COLUMNS, named_types as named_types
from synth.atlas.expression import ExpressionError as ExpressionError, condition_of as condition_of
from synth.atlas.finding import find_type as find_type
from synth.atlas.motions import (
    MotionTable as MotionTable,
    NearMotion as NearMotion,
    NearMotions as NearMotions,
    add_motions as add_motions,
    like as like,
    motion_curve as motion_curve,
    planned_motions as planned_motions,
    stored_motions as stored_motions,
)
from synth.atlas.opened import Atlas as Atlas, open_atlas as open_atlas
from synth.atlas.signatures import MotionCurve as MotionCurve
