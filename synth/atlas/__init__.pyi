from synth.atlas.building import AtlasPlan as AtlasPlan, build_atlas as build_atlas
from synth.atlas.columns import COLUMNS as COLUMNS, named_types as named_types
from synth.atlas.finding import find_type as find_type
from synth.atlas.motions import add_motions as add_motions, like as like
from synth.atlas.opened import Atlas as Atlas, open_atlas as open_atlas
