from synth.atlas.asked.expression import ExpressionError as ExpressionError, condition_of as condition_of
from synth.atlas.asked.finding import find_type as find_type
from synth.atlas.asked.opened import Atlas as Atlas, open_atlas as open_atlas
from synth.atlas.columns import COLUMNS as COLUMNS
from synth.atlas.made.building import build_atlas as build_atlas
from synth.atlas.made.plan import AtlasPlan as AtlasPlan
from synth.atlas.names import named_types as named_types
