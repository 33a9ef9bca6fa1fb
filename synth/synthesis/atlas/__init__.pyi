from synth.synthesis.atlas.atlas_file import Atlas as Atlas, open_atlas as open_atlas
from synth.synthesis.atlas.building import AtlasPlan as AtlasPlan, build_atlas as build_atlas
from synth.synthesis.atlas.columns import COLUMNS as COLUMNS, named_types as named_types
from synth.synthesis.atlas.finding import find_type as find_type
from synth.synthesis.atlas.motions import add_motions as add_motions, like as like
