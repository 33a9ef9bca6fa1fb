from synth.folding.mending.nearest import Nearby as Nearby, nearby as nearby
from synth.folding.mending.repair import Mended as Mended, flattened as flattened
