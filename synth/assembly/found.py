"""All positions of a spherical linkage whose driven joints have given angles. Theory: docs/theory/positions.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import isfinite

import numpy as np

from graphs.arrays import Floats
from graphs.canonical import canonical_order
from graphs.errors import InvariantError, SynthedraError, shown
from graphs.given import check_given
from graphs.ids import JointId
from graphs.tolerances import DOUBLE
from synth.assembly.answer import Position, Positions
from synth.assembly.circuits import members_of_circuits
from synth.assembly.family import SMALL, Family, Followed, family_of
from synth.assembly.general import GeneralPositions, apart, general_positions
from synth.assembly.kernel import CLOSED, Complexes
from synth.motion.linkage import PosedLinkage
from synth.moving.made import Movable, configuration_of

__all__ = ["positions", "solutions"]

_POLISHED = 4
_SURER = (SMALL, SMALL / 30, SMALL / 1000)
"""Corrections that are allowed: less, where two paths came to one place or one was lost."""


def positions(
    thing: Movable, drive: Mapping[JointId, float], *, circuits: bool = True, seed: int = 0
) -> Positions:
    """Find all positions of a spherical linkage at given angles of as many joints as it has freedoms.

    Parameters
    ----------
    thing : Mechanism or PosedLinkage
        With coordinates; all loops about finite centres, which need not be one.
    drive : mapping of joint id to float
        Radians; of creases fold angles, of other joints from the pose given.
    circuits : bool, optional
        Tell the circuits and branches of a linkage of one freedom.
    seed : int, optional
        Of the general member that is begun from.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, or a loop without a finite centre; if the driven joints are not as many as the
        freedoms by count, or do not determine the others.
    InvariantError
        If a driven joint is in no loop, or an angle is no number.
    NumericalError
        If the positions of a general member could not be counted.

    Examples
    --------
    A four-bar has two:

    >>> from math import radians
    >>> from synth.patterns import generate
    >>> found = positions(generate("four-bar").mechanism, {0: radians(10)})
    >>> len(found.positions), found.general, found.exhaustive
    (2, 2, True)
    """
    check_given("positions", thing, Movable)
    at = configuration_of(thing)
    linkage = at.linkage
    for joint, angle in drive.items():
        if not isfinite(angle):
            raise InvariantError("angle", f"the angle of joint {shown(joint)} is {angle}", "a finite number")
    family, axes = family_of(linkage, list(drive))
    general = general_positions(family, seed)
    names = list(linkage.graph.joints)
    zero = linkage.angles[[names.index(joint) for joint in drive]]
    member = np.concatenate([axes, np.array(list(drive.values())) - zero])
    values, far, lost = solutions(family, general, member, seed)
    real = np.abs(values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    found = _in_order([_angles(linkage, family, member, one) for one in values.real[real]])
    answer = Positions(
        at,
        tuple(names),
        dict(drive),
        tuple(Position(one) for one in found),
        len(general.values),
        int((~real).sum()),
        far,
        lost,
        general.curves,
    )
    return _with_circuits(answer) if circuits and len(drive) == 1 else answer


def solutions(
    family: Family, general: GeneralPositions, member: Floats, seed: int = 0
) -> tuple[Complexes, int, int]:
    """Return all positions of one member, real or not, by following those of a general one.

    Returns the positions, complex[N, U], each once; how many have gone to infinity; and how many are not known,
    since they were lost on the way or have come together with others. The seed is for the curve of parameters.
    """
    random = np.random.default_rng(seed)
    count = len(general.values)
    best = None
    for small in _SURER:
        bend = random.uniform(-1.0, 1.0, len(member)) + 1j * random.uniform(-1.0, 1.0, len(member))
        start, end, bent = (np.tile(one, (count, 1)) for one in (general.parameters, member.astype(complex), bend))
        found = family.followed((start, end, bent), general.values, small)
        apart_now = apart(_polished(family, end, found))
        lost = count - int(found.far.sum()) - len(apart_now)
        if best is None or lost < best[2]:
            best = apart_now, int(found.far.sum()), lost
        if not lost:
            break
    assert best is not None
    return best


def _polished(family: Family, parameters: Complexes, found: Followed) -> Complexes:
    """Return where paths arrived, real ones with angles that are so to the last digit."""
    values = found.values[found.arrived]
    real = np.abs(values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    near = np.where(real[:, None], values.real, values)
    sharp, errors = family.corrected(parameters[found.arrived], near, _POLISHED)
    return np.where((errors <= CLOSED)[:, None], sharp, values)


def _angles(linkage: PosedLinkage, family: Family, member: Floats, unknowns: Floats) -> Floats:
    """Return the angles of all joints, above -180 and up to 180 degrees; joints in no loop stay as they are."""
    names = list(linkage.graph.joints)
    whole = linkage.angles.copy()
    inputs = member[2 * len(family.joints) :]
    for joint, column in zip(family.joints, family.column.tolist(), strict=True):
        whole[names.index(joint)] += unknowns[column] if column >= 0 else inputs[-1 - column]
    half_turn = np.pi + DOUBLE.parallel  # 180 degrees but for rounding, and not -180
    return np.asarray(half_turn - np.remainder(half_turn - whole, 2 * np.pi))


def _in_order(found: list[Floats]) -> list[Floats]:
    """Return positions in an order that does not depend on how they were found."""
    return [found[place] for place in canonical_order(found)]


def _with_circuits(answer: Positions) -> Positions:
    """Add circuits and branches, or say why they are not told."""
    driver = answer.joints.index(next(iter(answer.driven)))
    try:
        members = members_of_circuits(
            answer.configuration.closure, [one.angles for one in answer.positions], driver
        )
    except SynthedraError as error:
        return replace(answer, notes=(*answer.notes, f"circuits are not told: {error}"))
    found = tuple(
        replace(position, circuit=circuit, branch=branch)
        for position, (circuit, branch) in zip(answer.positions, members.places, strict=True)
    )
    return replace(answer, positions=found, notes=(*answer.notes, *members.notes))
