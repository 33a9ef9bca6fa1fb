"""All positions of one member of a family or of many, by following those of a general one.

Theory: docs/theory/positions.md.
"""

from typing import NamedTuple

import numpy as np

from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE, EPSILON
from graphs.types import Flags
from synth.analysis.assembly import precise
from synth.analysis.assembly.family import SMALL, Family, TrackedPaths, apart, as_real, same
from synth.analysis.assembly.general import GeneralPositions
from synth.analysis.assembly.kernel import ARRIVED, CLOSED, FAR, Complexes

_POLISHED = 4
_TOWARDS_SINGULAR, _LEVENBERG = 30, 1e-3
"""Steps of Newton's method towards a singular position, regularised by a share of what does not close."""
_NEAR_END = 1e-2
"""A path that could not go on ended so near to a singular position, radians and units of the extent."""
_SURER = (SMALL, SMALL / 30, SMALL / 1000)
"""Corrections that are allowed along paths: less, where one was lost, or two came to one place."""
_MOST_PRECISE = 8
"""Lost paths that are followed with more digits, at 1 or 2 s each; of more the rest stay lost."""


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


def solutions_of_many(family: Family, general: GeneralPositions, members: Complexes, seed: int = 0) -> list[Solutions]:
    """Return the solutions of each of many members, complex[N, parameters]: as `solutions` does, by the same curves.

    All are followed at once; where a path of a member was lost or ended at a singular place, that one is solved again.
    """
    count = len(general.values)
    bend = _bend(family, np.random.default_rng(seed))
    start, bent = (np.tile(each, (count * len(members), 1)) for each in (general.parameters, bend))
    followed = family.followed(
        (start, np.repeat(members, count, axis=0), bent), np.tile(general.values, (len(members), 1)), _SURER[0]
    )
    every = []
    for number, member in enumerate(members):
        own = slice(number * count, (number + 1) * count)
        paths = TrackedPaths(followed.values[own], followed.arrived[own], followed.far[own])
        ends = _ends(family, member, paths)
        every.append(solutions(family, general, member, seed) if ends.lost or ends.singular else ends)
    return every


def _bend(family: Family, random: np.random.Generator) -> Complexes:
    """Return by what the way to a member is bent: axes that coincide do so all along."""
    inputs, cuts = family.driven, (len(family.loops), 4)
    pairs = (len(family.axes), 2)
    straight, bent = (
        family.coincident(random.uniform(-1.0, 1.0, pairs) + 1j * random.uniform(-1.0, 1.0, pairs)) for _ in range(2)
    )
    turned = random.uniform(-1.0, 1.0, inputs) + 1j * random.uniform(-1.0, 1.0, inputs)
    closed = random.uniform(-1.0, 1.0, cuts) + 1j * random.uniform(-1.0, 1.0, cuts)
    return family.member(bent - straight, turned, closed)


def solutions(family: Family, general: GeneralPositions, member: Complexes, seed: int = 0) -> Solutions:
    """Return all positions of one member, real or not, by following those of a general one.

    The path of members is bent at random into complex parameters, so that it meets no special member on the way.
    Paths that are lost with the smallest steps are followed once more with more digits.
    """
    random = np.random.default_rng(seed)
    count = len(general.values)
    best = None
    for small in _SURER:
        bend = _bend(family, random)
        curve = (general.parameters, member, bend)
        start, end, bent = (np.tile(parameters, (count, 1)) for parameters in curve)
        paths = family.followed((start, end, bent), general.values, small)
        ends = _ends(family, member, paths)
        if best is None or (ends.lost, ends.singular) < (best[0].lost, best[0].singular):
            best = ends, paths, curve
        if not ends.lost and not ends.singular:
            break
    assert best is not None
    ends, paths, curve = best
    return _ends(family, member, _followed_again(family, general, curve, paths)) if ends.lost else ends


def with_given(family: Family, member: Complexes, ends: Solutions) -> Solutions:
    """Return solutions with the configuration that was read, where it is at these inputs and no path ended there.

    On a curve of solutions, where a linkage moves with its inputs held, paths end at places that chance chooses.
    """
    given = np.zeros(family.unknowns, dtype=complex)
    if np.abs(family.at(member, given)[0]).max() > CLOSED or same(ends.values, given, family.turning).any():
        return ends
    regular = _is_regular(family, member, given)
    return Solutions(
        np.concatenate([ends.values, given[None]]),
        np.append(ends.regular, regular),
        ends.far,
        ends.singular - int(not regular and ends.singular > 0),
        ends.lost - int(regular and ends.lost > 0),
    )


def _followed_again(
    family: Family, general: GeneralPositions, curve: tuple[Complexes, Complexes, Complexes], paths: TrackedPaths
) -> TrackedPaths:
    """Return the paths, those that stopped or came to one regular place with others followed with more digits."""
    values, arrived, far = paths.values.copy(), paths.arrived.copy(), paths.far.copy()
    stopped = np.flatnonzero(~(arrived | far))
    ended = values[arrived]
    together = [path for path in np.flatnonzero(arrived) if same(ended, values[path], family.turning).sum() > 1]
    for path in [*stopped, *together][:_MOST_PRECISE]:
        values[path], state = precise.followed(family, curve, general.values[path])
        arrived[path], far[path] = state == ARRIVED, state == FAR
    return TrackedPaths(values, arrived, far)


def _ends(family: Family, parameters: Complexes, followed: TrackedPaths) -> Solutions:
    """Return where paths ended."""
    polished = _polished(family, parameters, followed)
    values = apart(polished, family.turning)
    regular = np.array([_is_regular(family, parameters, solution) for solution in values], dtype=bool)
    # several paths may end in one singular position; paths that stopped near one count as singular too
    paths = np.array([int(same(polished, solution, family.turning).sum()) for solution in values], dtype=int)
    stopped = followed.values[~(followed.arrived | followed.far)]
    singular = int((paths - 1)[~regular].sum()) + sum(_is_singular(family, parameters, end) for end in stopped)
    far = int(followed.far.sum())
    return Solutions(values, regular, far, singular, len(followed.values) - far - len(values) - singular)


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
    sharp, errors = family.corrected(np.tile(parameters, (len(near), 1)), near, _POLISHED)
    return np.where((errors <= CLOSED)[:, None], sharp, values)
