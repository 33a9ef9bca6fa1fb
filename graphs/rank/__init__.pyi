from graphs.rank.closure import (
    Closure as Closure,
    closure_of as closure_of,
    independent_cycles as independent_cycles,
)
from graphs.rank.fields import PRIMES as PRIMES, Field as Field, PrimeField as PrimeField, Reals as Reals
from graphs.rank.general_member import (
    Incidence as Incidence,
    Realisation as Realisation,
    incidence_of as incidence_of,
    realise as realise,
)
from graphs.rank.generic import ExactMobility as ExactMobility, exact_mobility as exact_mobility
from graphs.rank.overconstraint import (
    Diagnosis as Diagnosis,
    diagnose as diagnose,
    mobility_without as mobility_without,
)
from graphs.rank.pose import (
    PoseMobility as PoseMobility,
    pose_mobility as pose_mobility,
    pose_mobility_of_axes as pose_mobility_of_axes,
    pose_mobility_of_model as pose_mobility_of_model,
)
from graphs.rank.rods import exact_mobility_of_model as exact_mobility_of_model
from graphs.rank.singular_values import Spectrum as Spectrum, spectrum as spectrum
from graphs.rank.spaces import (
    Inertia as Inertia,
    Split as Split,
    inertia as inertia,
    null_space as null_space,
    rank_of as rank_of,
    row_space as row_space,
    split as split,
)
