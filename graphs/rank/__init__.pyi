from graphs.rank.exact import (
    Closure as Closure,
    Diagnosis as Diagnosis,
    ExactMobility as ExactMobility,
    closure_of as closure_of,
    diagnose as diagnose,
    exact_mobility as exact_mobility,
    independent_cycles as independent_cycles,
    mobility_without as mobility_without,
)
from graphs.rank.pose import (
    PoseMobility as PoseMobility,
    pose_mobility as pose_mobility,
    pose_mobility_of_axes as pose_mobility_of_axes,
    pose_mobility_of_model as pose_mobility_of_model,
)
from graphs.rank.realisation import (
    PRIMES as PRIMES,
    Field as Field,
    Incidence as Incidence,
    PrimeField as PrimeField,
    Realisation as Realisation,
    Reals as Reals,
    incidence_of as incidence_of,
    realise as realise,
)
from graphs.rank.rods import exact_mobility_of_model as exact_mobility_of_model
from graphs.rank.singular_values import (
    Inertia as Inertia,
    Spectrum as Spectrum,
    Split as Split,
    inertia as inertia,
    null_space as null_space,
    rank_of as rank_of,
    row_space as row_space,
    spectrum as spectrum,
    split as split,
)
