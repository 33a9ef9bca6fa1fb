"""Solutions of a member of a family, by following those of a general member to it.

Theory: docs/theory/positions.md.
"""

from typing import NamedTuple

import numpy as np

from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE, EPSILON
from graphs.types import Flags, Floats
from synth.assembly.family import SMALL, Family, GeneralPositions, TrackedPaths, apart, as_real, same
from synth.assembly.kernel import CLOSED, Complexes

_POLISHED = 4
_TOWARDS_SINGULAR, _LEVENBERG = 30, 1e-3
"""Steps of Newton's method towards a singular position, regularised by a share of what does not close."""
_NEAR_END = 1e-2
"""A path that could not go on ended so near to a singular position, radians and units of the extent."""
_SURER = (SMALL, SMALL / 30, SMALL / 1000)
"""Corrections that are allowed along paths: less, where one was lost, or two came to one place."""


class Solutions(NamedTuple):
    """The ends of the paths from the positions of a general member to one member.

    `values`, complex[N, U], are the unknowns of the positions, real or not, each once; `regular`, bool[N], says
    where the closure equations are independent, so that the position is rigid at its inputs. Of the paths, `far`
    went to infinity, `singular` ended where closure equations depend on each other (the linkage moves though its
    inputs are held, or positions come together), `lost` ended at unknown places.
    """

    values: Complexes
    regular: Flags
    far: int
    singular: int
    lost: int


def solutions_of_many(family: Family, general: GeneralPositions, members: Floats, seed: int = 0) -> list[Solutions]:
    """Return the solutions of each of many members, float[N, parameters]: as `solutions` does, by the same curves.

    All are followed at once; where a path of a member was lost, that one is solved again by itself.
    """
    count = len(general.values)
    bend = _bend(np.random.default_rng(seed), members.shape[1])
    start, bent = (np.tile(each, (count * len(members), 1)) for each in (general.parameters, bend))
    followed = family.followed(
        (start, np.repeat(members, count, axis=0).astype(complex), bent),
        np.tile(general.values, (len(members), 1)),
        _SURER[0],
    )
    every = []
    for number, member in enumerate(members):
        own = slice(number * count, (number + 1) * count)
        end = np.tile(member.astype(complex), (count, 1))
        paths = TrackedPaths(followed.values[own], followed.arrived[own], followed.far[own])
        ends = _ends(family, end, paths)
        every.append(solutions(family, general, member, seed) if ends.lost else ends)
    return every


def _bend(random: np.random.Generator, parameters: int) -> Complexes:
    """Return by what the way to a member is bent."""
    return np.asarray(random.uniform(-1.0, 1.0, parameters) + 1j * random.uniform(-1.0, 1.0, parameters))


def solutions(family: Family, general: GeneralPositions, member: Floats, seed: int = 0) -> Solutions:
    """Return all positions of one member, real or not, by following those of a general one.

    The path of members is bent at random into complex parameters, so that it meets no special member on the way.
    """
    random = np.random.default_rng(seed)
    count = len(general.values)
    best = None
    for small in _SURER:
        bend = _bend(random, len(member))
        curve = (general.parameters, member.astype(complex), bend)
        start, end, bent = (np.tile(parameters, (count, 1)) for parameters in curve)
        followed = family.followed((start, end, bent), general.values, small)
        ends = _ends(family, end, followed)
        if best is None or ends.lost < best.lost:
            best = ends
        if not ends.lost:
            break
    assert best is not None
    return best


def _ends(family: Family, member: Complexes, followed: TrackedPaths) -> Solutions:
    """Return where paths ended."""
    polished, parameters = _polished(family, member, followed), member[0]
    values = apart(polished, family.turning)
    regular = np.array([_is_regular(family, parameters, solution) for solution in values], dtype=bool)
    # several paths may end in one singular position; paths that stopped near one count as singular too
    paths = np.array([int(same(polished, solution, family.turning).sum()) for solution in values], dtype=int)
    stopped = followed.values[~(followed.arrived | followed.far)]
    singular = int((paths - 1)[~regular].sum()) + sum(_is_singular(family, parameters, end) for end in stopped)
    far = int(followed.far.sum())
    return Solutions(values, regular, far, singular, len(member) - far - len(values) - singular)


def _is_regular(family: Family, parameters: Complexes, values: Complexes, zero: float = DOUBLE.zero) -> bool:
    """Return whether the closure equations are independent of each other."""
    parts = as_real(family.at(parameters, values)[1])
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


def _polished(family: Family, parameters: Complexes, paths: TrackedPaths) -> Complexes:
    """Return where paths arrived, real ones with angles that are so to the last digit."""
    values = paths.values[paths.arrived]
    real = np.abs(values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    near = np.where(real[:, None], values.real, values)
    sharp, errors = family.corrected(parameters[paths.arrived], near, _POLISHED)
    return np.where((errors <= CLOSED)[:, None], sharp, values)
