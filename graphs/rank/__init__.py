"""Mobility by rank: exact for a general member of a type, numerical at a pose.

A general member is placed over a prime field (`general_member`), its loops close (`closure`) or its rods keep
their lengths (`rods`), and the rank of these equations is found modulo primes (`generic`) or in real numbers
(`pose`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.rank.closure import Closure as Closure
    from graphs.rank.closure import closure_of as closure_of
    from graphs.rank.closure import independent_cycles as independent_cycles
    from graphs.rank.fields import PRIMES as PRIMES
    from graphs.rank.fields import Field as Field
    from graphs.rank.fields import PrimeField as PrimeField
    from graphs.rank.fields import Reals as Reals
    from graphs.rank.general_member import Incidence as Incidence
    from graphs.rank.general_member import Realisation as Realisation
    from graphs.rank.general_member import incidence_of as incidence_of
    from graphs.rank.general_member import realise as realise
    from graphs.rank.generic import ExactMobility as ExactMobility
    from graphs.rank.generic import exact_mobility as exact_mobility
    from graphs.rank.overconstraint import Diagnosis as Diagnosis
    from graphs.rank.overconstraint import diagnose as diagnose
    from graphs.rank.overconstraint import mobility_without as mobility_without
    from graphs.rank.pose import PoseMobility as PoseMobility
    from graphs.rank.pose import pose_mobility as pose_mobility
    from graphs.rank.pose import pose_mobility_of_axes as pose_mobility_of_axes
    from graphs.rank.pose import pose_mobility_of_model as pose_mobility_of_model
    from graphs.rank.rods import exact_mobility_of_model as exact_mobility_of_model
    from graphs.rank.singular_values import Spectrum as Spectrum
    from graphs.rank.singular_values import spectrum as spectrum
    from graphs.rank.spaces import Inertia as Inertia
    from graphs.rank.spaces import Split as Split
    from graphs.rank.spaces import inertia as inertia
    from graphs.rank.spaces import null_space as null_space
    from graphs.rank.spaces import rank_of as rank_of
    from graphs.rank.spaces import row_space as row_space
    from graphs.rank.spaces import split as split
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "closure": "Closure closure_of independent_cycles",
            "fields": "Field PRIMES PrimeField Reals",
            "general_member": "Incidence Realisation incidence_of realise",
            "generic": "ExactMobility exact_mobility",
            "overconstraint": "Diagnosis diagnose mobility_without",
            "pose": "PoseMobility pose_mobility pose_mobility_of_axes pose_mobility_of_model",
            "rods": "exact_mobility_of_model",
            "singular_values": "Spectrum spectrum",
            "spaces": "Inertia Split inertia null_space rank_of row_space split",
        },
    )
