from graphs.rank.exact import (
    Diagnosis as Diagnosis,
    ExactMobility as ExactMobility,
    diagnose as diagnose,
    exact_mobility as exact_mobility,
    mobility_without as mobility_without,
    relative_mobilities as relative_mobilities,
)
from graphs.rank.infinitesimal import (
    InfinitesimalMobility as InfinitesimalMobility,
    infinitesimal_mobility as infinitesimal_mobility,
    infinitesimal_mobility_of_axes as infinitesimal_mobility_of_axes,
    infinitesimal_mobility_of_model as infinitesimal_mobility_of_model,
)
from graphs.rank.rods import exact_mobility_of_model as exact_mobility_of_model
from graphs.rank.singular_values import Spectrum as Spectrum
