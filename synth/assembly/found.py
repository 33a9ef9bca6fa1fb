"""All positions of a linkage whose driven joints have given angles. Theory: docs/theory/positions.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from graphs.errors import InvariantError, SynthedraError, check_argument, shown
from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE, EPSILON, canonical_order
from graphs.types import Flags, Floats, JointId
from synth.assembly.answer import Position, Positions
from synth.assembly.circuits import members_of_circuits
from synth.assembly.family import SMALL, Family, Followed, family_of
from synth.assembly.general import GeneralPositions, apart, as_real, general_positions, same
from synth.assembly.kernel import CLOSED, Complexes
from synth.motion.linkage import PosedLinkage
from synth.moving.made import Movable, configuration_of

__all__ = ["Solutions", "positions", "solutions"]

_POLISHED = 4
_TOWARDS_SINGULAR, _LEVENBERG = 30, 1e-3
"""Steps of Newton's method towards a singular position, regularised by a share of what does not close."""
_NEAR_END = 1e-2
"""A path that could not go on ended so near to a singular position, radians and units of the extent."""
_SURER = (SMALL, SMALL / 30, SMALL / 1000)
"""Corrections that are allowed: less, where two paths came to one place or one was lost."""


def positions(
    thing: Movable, drive: Mapping[JointId, float], *, circuits: bool = True, seed: int = 0
) -> Positions:
    """Find all positions of a spherical or planar linkage at given angles of as many joints as it has freedoms.

    Parameters
    ----------
    thing : Mechanism or PosedLinkage
        With coordinates. The axes of each loop meet in a point, which need not be the same for all, or are
        parallel; prismatic joints slide across them.
    drive : mapping of joint id to float
        Radians; of creases fold angles, of other joints from the pose given. Of prismatic joints lengths, in the
        unit of the coordinates. Empty for a linkage of mobility 0, whose assemblies are found.
    circuits : bool, optional
        Tell the circuits and branches of a linkage of one freedom.
    seed : int, optional
        Of the general member that is begun from.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, or a spatial loop; if the driven joints are not as many as the
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
    check_argument("positions", thing, Movable)
    at = configuration_of(thing, slides=True)
    linkage = at.linkage
    for joint, angle in drive.items():
        if not isfinite(angle):
            raise InvariantError("angle", f"the angle of joint {shown(joint)} is {angle}", "a finite number")
    family, axes = family_of(linkage, list(drive))
    general = general_positions(family, seed)
    names = list(linkage.graph.joints)
    places = [names.index(joint) for joint in drive]
    units = _units(linkage)
    inputs = np.array(list(drive.values()), dtype=float) / units[places]
    member = np.concatenate([axes, inputs - linkage.angles[places]])
    ends = solutions(family, general, member, seed)
    real = np.abs(ends.values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    angles = [_angles(linkage, family, member, one) for one in ends.values.real[real]]
    order = canonical_order(angles)
    answer = Positions(
        at,
        tuple(names),
        dict(drive),
        tuple(Position(angles[place] * units, bool(ends.regular[real][place])) for place in order),
        len(general.values),
        int((~real).sum()),
        ends.far,
        ends.singular,
        ends.lost,
        general.curves,
    )
    return _with_circuits(answer) if circuits and len(drive) == 1 else answer


@dataclass(frozen=True, slots=True)
class Solutions:
    """Where the positions of a general member came to in one member.

    Attributes
    ----------
    values : complex[N, U]
        Unknowns of the positions, real or not, each once.
    regular : bool[N]
        Whether the closure equations are independent there, so that the position is rigid at its inputs.
    far : int
        Paths that went to infinity.
    singular : int
        Paths that end where closure equations depend on each other: where the linkage moves though its inputs are
        held, or positions come together.
    lost : int
        Paths whose ends are not known.
    """

    values: Complexes
    regular: Flags
    far: int
    singular: int
    lost: int


def solutions(family: Family, general: GeneralPositions, member: Floats, seed: int = 0) -> Solutions:
    """Return all positions of one member, real or not, by following those of a general one.

    The seed is for the curve of parameters.
    """
    random = np.random.default_rng(seed)
    count = len(general.values)
    best = None
    for small in _SURER:
        bend = random.uniform(-1.0, 1.0, len(member)) + 1j * random.uniform(-1.0, 1.0, len(member))
        start, end, bent = (np.tile(one, (count, 1)) for one in (general.parameters, member.astype(complex), bend))
        followed = family.followed((start, end, bent), general.values, small)
        ends = _ends(family, end, followed)
        if best is None or ends.lost < best.lost:
            best = ends
        if not ends.lost:
            break
    assert best is not None
    return best


def _ends(family: Family, end: Complexes, followed: Followed) -> Solutions:
    """Return where paths ended."""
    polished, parameters = _polished(family, end, followed), end[0]
    values = apart(polished, family.turning)
    regular = np.array([_is_regular(family, parameters, one) for one in values], dtype=bool)
    paths = np.array([int(same(polished, one, family.turning).sum()) for one in values], dtype=int)
    stopped = followed.values[~(followed.arrived | followed.far)]
    singular = int((paths - 1)[~regular].sum()) + sum(_is_singular(family, parameters, one) for one in stopped)
    far = int(followed.far.sum())
    return Solutions(values, regular, far, singular, len(end) - far - len(values) - singular)


def _is_regular(family: Family, parameters: Complexes, values: Complexes, zero: float = DOUBLE.zero) -> bool:
    """Return whether the closure equations are independent of each other."""
    parts = as_real(family.derivatives(parameters, values))
    return bool(rank_of(parts, zero) == min(parts.shape))


def _is_singular(family: Family, parameters: Complexes, start: Complexes) -> bool:
    """Return whether a singular position is near, where a path could not go on."""
    values = start.copy()
    for _ in range(_TOWARDS_SINGULAR):
        residual, derivatives = family.at(parameters, values)
        gram = derivatives @ derivatives.conj().T
        regular = max(_LEVENBERG * float(np.abs(residual).max()), EPSILON * float(np.abs(gram).max()))
        values = values - derivatives.conj().T @ np.linalg.solve(gram + regular * np.eye(len(gram)), residual)
    residual, _ = family.at(parameters, values)
    near = float(np.abs(values - start).max()) <= _NEAR_END
    closed = bool(np.abs(residual).max() <= CLOSED)
    return near and closed and not _is_regular(family, parameters, values, DOUBLE.singular)


def _polished(family: Family, parameters: Complexes, found: Followed) -> Complexes:
    """Return where paths arrived, real ones with angles that are so to the last digit."""
    values = found.values[found.arrived]
    real = np.abs(values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    near = np.where(real[:, None], values.real, values)
    sharp, errors = family.corrected(parameters[found.arrived], near, _POLISHED)
    return np.where((errors <= CLOSED)[:, None], sharp, values)


def _angles(linkage: PosedLinkage, family: Family, member: Floats, unknowns: Floats) -> Floats:
    """Return the angles of all joints, above -180 and up to 180 degrees; joints in no loop stay as they are.

    Joints that slide have lengths, in units of the extent.
    """
    names = list(linkage.graph.joints)
    whole = linkage.angles.copy()
    inputs = member[2 * len(family.axes) :]
    for joint, column in zip(family.joints, family.column.tolist(), strict=True):
        whole[names.index(joint)] += unknowns[column] if column >= 0 else inputs[-1 - column]
    half_turn = np.pi + DOUBLE.parallel  # 180 degrees but for rounding, and not -180
    wrapped = np.asarray(half_turn - np.remainder(half_turn - whole, 2 * np.pi))
    slides = list(linkage.slides)
    wrapped[slides] = whole[slides]
    return wrapped


def _units(linkage: PosedLinkage) -> Floats:
    """Return what joint angles and lengths are multiplied by to be in the unit of the coordinates: float[J]."""
    units = np.ones(len(linkage.angles))
    units[list(linkage.slides)] = linkage.extent
    return units


def _with_circuits(answer: Positions) -> Positions:
    """Add circuits and branches, or say why they are not told."""
    driver = answer.joints.index(next(iter(answer.driven)))
    try:
        members = members_of_circuits(
            answer.configuration.closure,
            [one.angles / _units(answer.configuration.linkage) for one in answer.positions],
            driver,
        )
    except SynthedraError as error:
        return replace(answer, notes=(*answer.notes, f"circuits unknown: {error}"))
    found = tuple(
        replace(position, circuit=circuit, branch=branch)
        for position, (circuit, branch) in zip(answer.positions, members.places, strict=True)
    )
    return replace(answer, positions=found, notes=(*answer.notes, *members.notes))
