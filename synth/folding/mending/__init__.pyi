from synth.folding.mending.nearest import (
    Mended as Mended,
    Nearby as Nearby,
    flattened as flattened,
    nearby as nearby,
)
