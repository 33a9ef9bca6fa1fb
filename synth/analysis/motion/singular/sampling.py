"""Branches followed from a singular configuration: initial rates, a configuration along it, the freedoms there.

On many branches joints are immobile: three creases of a vertex that lies flat while a line through it folds. Their
closure equations are squares there, which Newton's method approaches slowly, so these joints are locked; where
no motion is found so, they are freed. Theory: docs/theory/folding.md.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import islice, pairwise
from math import radians, tan

import numpy as np

from graphs.rank.singular_values import Split, inertia, singular_values, split
from graphs.tolerances import DOUBLE, leading, signed, trailing
from graphs.types import Floats, Ints
from synth.analysis.motion.closure import MOST_WHOLE, ClosureEquations, corrected
from synth.analysis.motion.linkage import Linkage, moved
from synth.analysis.motion.path import PathOptions, driven_path
from synth.analysis.motion.singular import second_order
from synth.analysis.motion.walk.step import Allowance

_STEPS = 6
_NUDGE = 1e-4
"""Radians, of the differences by which derivatives change along a flex."""


def located(closure: ClosureEquations, angles: Floats) -> Floats:
    """Return the closed configuration beside another at which singular values that are nearly zero are zero.

    Along a flex that does not close to second order, loops closed to 1e-12 leave open the root of that: Newton's
    method ends anywhere within 1e-6 of the branch, and singular values that are zero on it are as large there. So
    the end of a path is taken across its flexes to where these are zero, before its rank is. It is returned as it
    is where no values but zeros are up to `Tolerances.singular`, or they do not vanish near it.
    """
    if closure.joints > second_order.MANY and _as_many_nearly(closure, angles):
        return angles
    matrix = closure.at(angles)[1].toarray()
    if not _nearly(singular_values(matrix)):
        return angles
    here, parts = angles, split(matrix, DOUBLE.singular)
    size = parts.right.shape[0] - parts.rank
    for _ in range(_STEPS):
        here = corrected(closure, here + _across(closure, here, parts)).angles
        if np.abs(here - angles).max() > DOUBLE.moved:
            return angles
        parts = split(closure.at(here)[1].toarray(), DOUBLE.singular)
        if parts.right.shape[0] - parts.rank != size:
            return angles
        if not _nearly(parts.values):
            return here if closure.error(here) <= DOUBLE.closed else angles
    return angles


def _nearly(values: Floats) -> int:
    """Return how many singular values are small, and not zero."""
    largest = values.max(initial=0.0)
    return int(((values > DOUBLE.zero * largest) & (values <= DOUBLE.singular * largest)).sum())


def _as_many_nearly(closure: ClosureEquations, angles: Floats) -> bool:
    """Tell whether singular values of a large linkage are small only where they are zero; or it is too large to see."""
    nearly = second_order.rates_at_most(closure, angles)
    too_large = closure.joints > MOST_WHOLE
    return too_large or nearly == second_order.rates_at(closure, angles).shape[1]


def _across(closure: ClosureEquations, angles: Floats, parts: Split) -> Floats:
    """Return the least change along flexes at which none of them parts loops to first order: float[J].

    Between flexes and self-stresses the derivatives J are a small matrix, S' J F; the changes along flexes that
    make it zero are a system of linear equations.
    """
    flexes, stresses = parts.right[parts.rank :], parts.left[:, parts.rank :]

    def between(at: Floats) -> Floats:
        return np.asarray(stresses.T @ (closure.at(at)[1] @ flexes.T))

    nudged = [(between(angles + _NUDGE * flex), between(angles - _NUDGE * flex)) for flex in flexes]
    slopes = [((ahead - back) / (2.0 * _NUDGE)).ravel() for ahead, back in nudged]
    shares = np.linalg.lstsq(np.array(slopes).T, -between(angles).ravel(), rcond=DOUBLE.zero**0.5)[0]
    return np.asarray(shares @ flexes)


FOLLOWED = radians(10.0)
"""How far each branch is followed, radians of the joint that moves most."""
_STARTS = 60
"""Starts of the search for rates on which equations are left, for each pattern of signs."""
_IDLE = 16
"""After so many starts that lead to nothing new, as many again for each part that was found, the search ends."""
_NEWTON, _ROUNDED = 30, 1e-14
_BESIDE, _ASIDE = 8, 0.3
"""Number of starts beside wanted rates, and their distance as part of the size of these."""
_SHORT_OF = 0.7
"""This part of a path that ended early is taken again."""
_SPACES = 512
"""At a configuration of a branch, after so many spaces of rates second order is said not to tell."""


@dataclass(frozen=True, slots=True)
class TracedBranch:
    """How far one branch was followed: joint angles at the end, radians, and the loop-closure residual there.

    Freedoms there are to second order; None where no motion was found, second order does not decide, or they were
    not asked for. `far` says how far the joint that moves most has moved, radians; 0 where no motion was found.
    """

    freedoms: int | None
    sample: Floats
    error: float
    far: float


def followed(
    linkage: Linkage,
    closure: ClosureEquations,
    rates: Floats,
    immobile: tuple[int, ...] = (),
    allowance: Allowance | None = None,
    *,
    counted: bool = True,
) -> TracedBranch:
    """Follow a branch for ten degrees, or as far as it goes, by joints that are not `immobile`.

    Its freedoms at the end are counted unless they are known.
    """
    ways = [closure.locked(immobile), closure] if immobile else [closure]
    for way in ways:
        end, error = walked(linkage.angles, way, rates, allowance)
        far = float(np.abs(end - linkage.angles).max())
        if far > DOUBLE.moved:
            break
    else:
        return TracedBranch(None, linkage.angles, closure.error(linkage.angles), 0.0)
    # what came here moves: where second order leaves nothing, it does not tell
    return TracedBranch(freedoms_at(linkage, closure, end) or None if counted else None, end, error, far)


def walked(
    start: Floats, closure: ClosureEquations, rates: Floats, allowance: Allowance | None = None
) -> tuple[Floats, float]:
    """Return the last general configuration of a path that begins at some rates, and by how much it does not close."""
    driver = leading(rates)
    options, goal = PathOptions(rates, straight=True), FOLLOWED * float(np.sign(rates[driver]))
    first = replace(options, allowance=allowance)  # the part that is taken again has no more steps
    path = driven_path(closure, start, [driver], start[driver] + goal, options=first)
    reached = float(path.angles[-1][driver] - start[driver])
    if path.stopped and abs(reached) > DOUBLE.moved:  # the end of a path may be no general configuration
        path = driven_path(closure, start, [driver], start[driver] + _SHORT_OF * reached, options=options)
    return path.angles[-1], float(path.errors[-1])


def in_half_tangents(closure: ClosureEquations, space: second_order.RateSpace, rates: Floats) -> TracedBranch:
    """Return a configuration of a branch along which tan(fold / 2) is any of its rates: its freedoms are as many."""
    end = 2.0 * np.arctan(tan(FOLLOWED / 2.0) * rates)
    return TracedBranch(space.basis.shape[1], end, closure.error(end), FOLLOWED)


def freedoms_at(linkage: Linkage, closure: ClosureEquations, angles: Floats) -> int | None:
    """Return the freedoms of motions through a general configuration, to second order; None where it cannot tell.

    A branch may run along where others meet it, of as many freedoms: then it is not told which of them it is on,
    but with how many freedoms.
    """
    spaces = _finite_spaces(linkage, closure, located(closure, angles))
    if spaces is None:
        return None
    freedoms = {space.basis.shape[1] for space in spaces}
    if len(freedoms) > 1 or any(space.left for space in spaces):
        return None
    return freedoms.pop() if freedoms else 0


def finite_rates(linkage: Linkage, closure: ClosureEquations, angles: Floats) -> tuple[Floats, Floats | None]:
    """Return what is located at a general closed configuration, and orthonormal rates of motions, float[J, M].

    Rates that close to first order may be more than a linkage can use all along a branch: a sheet that is
    folded along one straight line, for instance, has creases that lie in one plane. There Newton's method ends a
    little beside the branch, and the configuration on it is located first. Of the rates there, those that close
    to second order are returned; None if they are no linear space, or not known to be one.
    """
    angles = located(closure, angles)
    spaces = _finite_spaces(linkage, closure, angles)
    if spaces is None or len(spaces) > 1 or any(space.left for space in spaces):
        return angles, None
    return angles, spaces[0].basis if spaces else np.zeros((len(angles), 0))


def _finite_spaces(linkage: Linkage, closure: ClosureEquations, angles: Floats) -> list[second_order.RateSpace] | None:
    """Return the spaces of rates that close to second order at a closed configuration; None if they are too many."""
    tangent = second_order.rates_at(closure, angles)
    quadrics = second_order.all_quadrics(moved(linkage, angles), tangent)
    spaces = list(islice(second_order.spaces_within(tangent, quadrics), _SPACES + 1))
    return second_order.largest_only(spaces) if len(spaces) <= _SPACES else None


def rates_towards(space: second_order.RateSpace, wanted: Floats) -> Floats:
    """Return rates of a space near wanted ones, the largest 1 or -1; zeros if there are none.

    By symmetry the way from wanted rates onto the equations may lead to where parts of their solutions meet, at
    the apex of a cone for instance, where Newton's method finds half the digits only. Then starts beside the
    wanted ones are tried, and of what they come to the rates that point along these best are taken.
    """
    start = np.asarray(space.basis.T @ wanted)
    turn = 1.0 if signed(start) is start else -1.0  # rates against wanted ones are those against what is found
    start = turn * start
    size = float(np.linalg.norm(start))
    if size <= DOUBLE.zero * np.linalg.norm(wanted):
        return np.zeros_like(wanted)
    forms = second_order.local_forms(space.basis, space.left)
    x = _on_equations(forms, start)
    if x is not None and (rank := _slopes(forms, x)) < len(forms):
        chances = (np.random.default_rng((*space.basis.shape, number)) for number in range(_BESIDE))
        beside = [chance.normal(size=len(start)) for chance in chances]
        ends = [_on_equations(forms, start + _ASIDE * size / np.linalg.norm(aside) * aside) for aside in beside]
        general = [end for end in ends if end is not None and _slopes(forms, end) > rank]
        x = general[trailing(np.array([-(end @ start) / size for end in general]), scale=1.0)] if general else x
    return np.zeros_like(wanted) if x is None else turn * _scaled(space.basis @ x)


_ASIDE_STEPS = (8e-3, 4e-3, 2e-3)
"""Steps along general rates, radians of the joint that moves most."""
_SHRINKS = 0.7
"""What is off after a step of half the length, as part of what was off before: a half where rates touch a motion,
all of it where they do not."""


def closes_along_general_rates(closure: ClosureEquations, angles: Floats, moving: Ints) -> bool:
    """Tell whether motions through a closed configuration have as many freedoms as there are rates that close.

    Rates are those of joints that move, at places int[n], with the others at rest. General ones of these rates are
    followed by three steps. Where the nearest closed configuration is off by a part of the step that shrinks with it,
    the rates are tangent to a motion; rates in general position are so only if all are, but for a set of measure
    zero.
    """
    immobile = np.ones(len(angles), dtype=bool)
    immobile[moving] = False
    held = closure.locked(np.flatnonzero(immobile).tolist())
    chance = np.random.default_rng(len(moving)).normal(size=len(angles))
    rates = corrected(held, angles).space.projected(np.where(immobile, 0.0, chance))
    size = float(np.abs(rates).max(initial=0.0))
    if size <= DOUBLE.zero_rate:
        return False
    off = []
    for step in _ASIDE_STEPS:
        aside = step / size * rates
        end = corrected(held, angles + aside)
        if not end.closed:
            return False
        off.append(float(np.abs(end.angles - angles - aside).max()) / step)
    return all(less <= max(_SHRINKS * more, DOUBLE.zero) for more, less in pairwise(off))


def general_rates(
    space: second_order.RateSpace, most: int, towards: Floats | None = None, late: Callable[[], bool] = lambda: False
) -> tuple[list[Floats], bool]:
    """Return general rates of a space, one for each part that its equations leave; and whether these are all.

    Where two equations or more are left the parts are looked for from random starts: there may be others. Rates at
    which the equations have fewer independent slopes than at others, where parts meet, are left out. The search
    ends after `most` parts, then with the part near to the rates `towards` among them, or once `late` says so,
    after one part at least.
    """
    size = space.basis.shape[1]
    if not space.left:
        chance = np.random.default_rng(space.basis.shape)
        x = chance.uniform(0.5, 1.0, size) * chance.choice([-1.0, 1.0], size)
        return [signed(_scaled(space.basis @ x))], True
    forms = second_order.local_forms(space.basis, space.left)
    halves = _halves(space)
    parts = 2 ** max(len(halves) - 1, 0)
    found: dict[tuple[int, ...], Floats] = {}
    highest = idle = 0
    for number in range(_STARTS * 2 ** min(len(halves), 6)):
        idle += 1
        if idle > _IDLE * (1 + len(found)):
            break
        chance = np.random.default_rng((*space.basis.shape, number))
        x = _on_equations(forms, np.asarray(chance.normal(size=size)))
        if x is None or (rank := _slopes(forms, x)) < highest:
            continue
        if rank > highest:
            found, highest = {}, rank
        rates = signed(_scaled(space.basis @ x))
        signs = _side(halves, rates)
        key = max(signs, tuple(-one for one in signs))
        idle = idle if key in found else 0
        found.setdefault(key, rates)
        if len(found) == parts or len(found) == most or late():
            break
    others = [found[signs] for signs in sorted(found, reverse=True)]
    whole = len(found) == parts or not (len(found) == most or late())
    if whole or towards is None:
        return others, whole
    near = rates_towards(space, towards)
    general = near.any() and _slopes(forms, _unit(space.basis.T @ near)) >= highest
    first = [near] if general and not any(same_part(space, near, one) for one in others) else []
    return [*first, *others], False


def most_freedoms(space: second_order.RateSpace, rates: Floats) -> int:
    """Return how many freedoms a branch that begins at general rates of a space has at most.

    The rates beside them at which its branch begins too are those of the space at which its equations vanish: a
    manifold of as many dimensions as the space, less the independent slopes of the equations.
    """
    size = int(space.basis.shape[1])
    if not space.left:
        return size
    return size - _slopes(second_order.local_forms(space.basis, space.left), _unit(space.basis.T @ rates))


def same_part(space: second_order.RateSpace, one: Floats, other: Floats) -> bool:
    """Tell whether two rates of a space are, up to their sign, on the same part of what its equations leave."""
    halves = _halves(space)
    mine, theirs = _side(halves, one), _side(halves, other)
    return mine in (theirs, tuple(-sign for sign in theirs))


def _unit(vector: Floats) -> Floats:
    return np.asarray(vector / np.linalg.norm(vector))


def _scaled(rates: Floats) -> Floats:
    """Return rates the largest of which is 1 or -1; those that are none but for rounding are zero."""
    scaled = rates / np.abs(rates).max()
    return np.where(np.abs(scaled) > DOUBLE.zero_rate, scaled, 0.0)


def _on_equations(forms: Floats, x: Floats) -> Floats | None:
    """Return a unit vector at which forms float[n, s, s] vanish, by Newton's method from a start float[s]."""
    for _ in range(_NEWTON):
        x = x / np.linalg.norm(x)
        slopes = forms @ x
        off = slopes @ x
        if np.abs(off).max(initial=0.0) <= _ROUNDED:
            return x
        x = x - np.linalg.lstsq(2.0 * slopes, off, rcond=DOUBLE.zero)[0]
    return None


def _slopes(forms: Floats, x: Floats) -> int:
    """Return how many independent slopes forms float[n, s, s] have at a unit vector at which they vanish."""
    least = DOUBLE.zero**0.5 * np.abs(forms).max(initial=0.0)  # Newton's method ends with the root there
    return int((singular_values(forms @ x) > least).sum())


def _side(halves: list[Floats], rates: Floats) -> tuple[int, ...]:
    """Return on which half of each equation's solutions rates are."""
    return tuple(int(np.sign(half @ rates)) for half in halves)


def _halves(space: second_order.RateSpace) -> list[Floats]:
    """Return, for each equation whose solutions are two cones tip to tip, what has one sign on one of them."""
    found = []
    for one in map(inertia, second_order.local_forms(space.basis, space.left)):
        singles = [np.flatnonzero(one.signs == sign) for sign in (1, -1)]
        found += [signed(space.basis @ one.vectors[:, single[0]]) for single in singles if len(single) == 1][:1]
    return found
