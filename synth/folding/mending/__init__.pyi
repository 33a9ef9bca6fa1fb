from synth.folding.mending.nearest import (
    MendedPattern as MendedPattern,
    NearbyPatterns as NearbyPatterns,
    flattened as flattened,
    nearby as nearby,
)
