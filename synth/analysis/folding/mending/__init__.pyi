from synth.analysis.folding.mending.near_mechanisms import (
    MendedPattern as MendedPattern,
    NearbyPatterns as NearbyPatterns,
    flattened as flattened,
    nearby as nearby,
)
