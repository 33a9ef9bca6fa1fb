"""The search for dimensions: angles fitted to the wishes first, then everything at once by least squares.

Closure counts as much as wishes at first and ever more after that, so that a design may open on the way; at the end
configurations are closed to the last digit. Theory: docs/theory/design.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from math import inf, pi

import numpy as np

from graphs.errors import SynthedraError
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.designing.least import System, least_squares, least_weight, nearest, shortest_step
from synth.designing.problem import DesignProblem, DesignStep
from synth.motion.closure import corrected, exactly_held
from synth.motion.path import driven_path

_WEIGHTS = (1.0, 30.0, 1e3)
"""Of closure and rules, one search after the other until configurations can be closed."""
_STEPS = (40, 30, 30)
_STIFF = 1e3
_SMOOTH = (0.1, 0.01)
"""Weights of turns between configurations, one search after the other, where they are to be near to each other."""
_DAMPING, _MORE, _LESS, _MOST_DAMPING = 1e-3, 4.0, 8.0, 1e3
_REFINED, _GAIN = 80, 1e-9
"""Most steps along closed designs, and the part of the sum of squares that a step must take away to be followed."""
_ROUGH = 1e-8
"""Part of the sum of squares that a step must take away, else a search ends."""
_FIT, _FITTED = 25, 1e-5
_BETTER = 10.0
"""How many times worse the nearest configuration may fit than another guess, and still be taken."""
_BESIDE = 0.03
"""How far beside a saddle a search begins, in units of dimensions."""
_LOOSE = 10.0
"""Radians of a joint angle that count as much as a unit of dimensions where the nearest design is looked for."""
_ROUNDS = 8


@dataclass(frozen=True)
class FoundDesign:
    """Numbers of a design, and its configurations closed as well as they can be.

    `errors` are the loop-closure residuals, `step` all equations there; `settled` is whether the search ended where no
    step makes it better, or brings it nearer to its start, not with the last of its steps.
    """

    numbers: Floats
    angles: list[Floats]
    errors: list[float]
    step: DesignStep
    settled: bool = False

    @property
    def error(self) -> float:
        """The largest loop-closure residual, and miss of a rule."""
        return max([0.0, *self.errors, float(np.abs(self.step.rules).max(initial=0.0))])

    @property
    def cost(self) -> float:
        """The sum of squares of weighted misses."""
        return float(((self.step.weights * self.step.wishes) ** 2).sum())

    @property
    def miss(self) -> float:
        """The largest miss of a wish, radians or units of the file."""
        return float(np.abs(self.step.wishes).max(initial=0.0))


def seeded(key: str, start: int) -> np.random.Generator:
    """Return the random numbers of a start, by what is searched and its number."""
    digest = sha256(f"{key} {start}".encode()).digest()
    return np.random.default_rng(int.from_bytes(digest[:8], "little"))


def start_of(problem: DesignProblem, start: int, spread: float, rng: np.random.Generator) -> Floats:
    """Return the numbers of a start: the first is the mechanism as it is, the others are ever farther off it."""
    family = problem.family
    if start == 0:
        return family.start
    part = spread * (0.5 + rng.random())
    numbers = family.start + part * family.scales * rng.normal(size=len(family.start))
    return np.asarray(np.clip(numbers, *family.bounds))


def found_from(
    problem: DesignProblem, numbers: Floats, rng: np.random.Generator, *, follow: bool = True
) -> FoundDesign | None:
    """Return the design to which least squares lead from some numbers; None if they make no mechanism.

    With `follow` configurations begin where the driven joint leads from the pose, else where they fit wishes best.
    """
    if problem.tried(problem.joined(numbers, [problem.zero] * len(problem.inputs))) is None:
        return None
    unknowns = start = problem.joined(numbers, fitted_angles(problem, numbers, rng, follow=follow))
    unknowns = _off_saddle(problem, unknowns, rng)
    for smooth in _SMOOTH if problem.wishes.between else ():
        unknowns = _least(problem, unknowns, 1.0, _STEPS[0], smooth)
    for weight, steps in zip(_WEIGHTS, _STEPS, strict=True):
        unknowns = _least(problem, unknowns, weight, steps)
        found = closed(problem, unknowns)
        if found is not None and found.error > DOUBLE.closed and weight == _WEIGHTS[-1]:
            found = closed(problem, _ruled(problem, unknowns, loops=True)) or found
        if found is not None and found.error <= DOUBLE.closed:
            return _finished(problem, found, start)
    begun = _folded_start(problem, numbers) if problem.wishes.flat_foldable else None
    return found if begun is None else _finished(problem, begun, start)


def _finished(problem: DesignProblem, found: FoundDesign, start: Floats) -> FoundDesign:
    """Return a closed design made as good as can be, then as near to its start, then led along one branch."""
    return _on_one_branch(problem, _nearest(problem, _refined(problem, found), start))


def _off_saddle(problem: DesignProblem, unknowns: Floats, rng: np.random.Generator) -> Floats:
    """Return unknowns beside some at which no change makes wishes better to first order, else these.

    A mechanism that is symmetric, or a sheet without curvature, may be such a saddle: no step leads away from it.
    """
    step = problem.tried(unknowns)
    assert step is not None
    off, by = step.residual(1.0), step.jacobian(1.0) * problem.scales
    size = np.linalg.norm(off)
    if size <= DOUBLE.closed or np.linalg.norm(off @ by) > DOUBLE.same_configuration * size:
        return unknowns
    moved = unknowns.copy()
    moved[: problem.numbers] += _BESIDE * problem.family.scales * rng.normal(size=problem.numbers)
    moved = np.clip(moved, *problem.bounds)
    return unknowns if problem.tried(moved) is None else np.asarray(moved)


def _folded_start(problem: DesignProblem, numbers: Floats) -> FoundDesign | None:
    """Return a flat sheet as it is, closed where it is folded; None where it is not.

    It fits wishes worse than open designs near them, but where those cannot be closed a way along closed ones begins.
    """
    folded = [problem.folded(number) for number in range(len(problem.inputs))]
    if not all(folded):
        return None
    angles = [problem.held(number, one) for number, (one, *_) in enumerate(folded)]
    found = closed(problem, problem.joined(numbers, angles))
    return found if found is not None and found.error <= DOUBLE.closed else None


def _on_one_branch(problem: DesignProblem, found: FoundDesign) -> FoundDesign:
    """Return a design with the configurations to which the driven joint leads, if they meet the wishes as well.

    Where wishes say nothing of some links these may be found in another assembly mode at each input. The joint leads
    from the pose, if the motion begins there, else from the first configuration.
    """
    driver = problem.drivers[0] if problem.drivers else None
    given = [driven(inputs, driver) for inputs in problem.inputs]
    zero = found.step.design.linkage.angles
    from_pose = problem.wishes.from_pose and not (problem.family.sheet is not None and not zero.any())
    goals = given if from_pose else given[1:]
    if driver is None or None in given or not goals:
        return found
    closure = problem.frame.closure(found.step.design)
    try:
        start = zero if from_pose else found.angles[0]
        path = driven_path(closure, start, [driver], np.array(goals, dtype=float)[:, None])
    except SynthedraError:
        return found
    if path.stopped or len(path.angles) != len(goals) + 1:
        return found
    angles = [*([] if from_pose else found.angles[:1]), *path.angles[1:]]
    step = problem.tried(problem.joined(found.numbers, [problem.held(k, one) for k, one in enumerate(angles)]))
    if step is None:
        return found
    traced = FoundDesign(found.numbers, angles, [closure.error(one) for one in angles], step, found.settled)
    good = traced.error <= DOUBLE.closed and traced.cost <= found.cost + DOUBLE.closed
    return traced if good else found


def driven(inputs: Mapping[int, float], driver: int | None) -> float | None:
    """Return the angle of the driven joint if it is the one input of a configuration."""
    return inputs.get(driver) if driver is not None and len(inputs) == 1 else None


def _refined(problem: DesignProblem, found: FoundDesign) -> FoundDesign:
    """Return a design that meets wishes better, closed at each step: Levenberg and Marquardt's method along rules.

    Steps are those of least squares in which closure and rules weigh so much that they hold to first order; then
    configurations are closed again. So the search follows curved families of closed designs, however narrow.
    """
    damping, scales = _DAMPING, problem.scales
    bounds = (problem.bounds[0] / scales, problem.bounds[1] / scales)
    for _ in range(_REFINED):
        step, before = found.step, found.cost
        if before <= DOUBLE.closed**2:
            return replace(found, settled=True)
        here = problem.joined(found.numbers, found.angles) / scales
        moved = scales * shortest_step(here, step.residual(_STIFF), step.jacobian(_STIFF) * scales, bounds, damping)
        tried = closed(problem, moved)
        if tried is None or tried.error > DOUBLE.closed or tried.cost >= before:
            damping *= _MORE
            if damping > _MOST_DAMPING:
                return replace(found, settled=True)
            continue
        found, damping = tried, max(damping / _LESS, least_weight(tried.cost))
        if before - tried.cost <= _GAIN * before:
            return replace(found, settled=True)
    return found


def _nearest(problem: DesignProblem, found: FoundDesign, start: Floats) -> FoundDesign:
    """Return the design nearest to a start that meets the wishes as well, if they are met: then many may meet them."""
    if found.cost > DOUBLE.derivative**2:
        return found
    scales = problem.scales.copy()
    scales[problem.numbers :] = _LOOSE
    bounds = (problem.bounds[0] / scales, problem.bounds[1] / scales)
    here = problem.joined(found.numbers, found.angles)
    near = nearest(_system(problem, scales), here / scales, start / scales, bounds)
    tried = closed(problem, near.unknowns * scales) if near.settled else None
    if tried is None or tried.error > DOUBLE.closed:
        return replace(found, settled=False)
    tried = _refined(problem, tried)
    return tried if tried.cost <= DOUBLE.derivative**2 else replace(found, settled=False)


def _system(problem: DesignProblem, scales: Floats, weight: float = 1.0, smooth: float = 0.0) -> System:
    """Return all equations as a function of the unknowns over some scales."""

    def system(parts: Floats) -> tuple[Floats, Floats] | None:
        step = problem.tried(parts * scales)
        return None if step is None else (step.residual(weight, smooth), step.jacobian(weight, smooth) * scales)

    return system


def _least(problem: DesignProblem, unknowns: Floats, weight: float, steps: int, smooth: float = 0.0) -> Floats:
    """Return unknowns of least squares: closure and rules with a weight, turns between configurations with another."""
    scales, bounds = problem.scales, problem.bounds
    found = least_squares(
        _system(problem, scales, weight, smooth),
        unknowns / scales,
        (bounds[0] / scales, bounds[1] / scales),
        steps,
        _ROUGH,
    )
    assert found is not None
    return np.asarray(found.unknowns * scales)


def fitted_angles(
    problem: DesignProblem, numbers: Floats, rng: np.random.Generator, *, follow: bool = True
) -> list[Floats]:
    """Return joint angles of each configuration at which it nearly closes and nearly meets its wishes.

    They are found outwards from the pose, each from the fitted configuration whose inputs are nearest; another guess
    is taken only where it fits much better.
    """
    count = len(problem.inputs)
    zero = problem.family.linkage(numbers).linkage.angles
    fitted: dict[int, Floats] = {-1: zero}  # the pose comes first
    reached = _followed(problem, numbers, zero) if follow else {}
    while len(fitted) <= count:
        pairs = ((_apart(problem, number, done, zero), number, done) for number in range(count) for done in fitted)
        _, number, nearest = min(pair for pair in pairs if pair[1] not in fitted)
        if number in reached:
            fitted[number] = _fitted(problem, numbers, number, reached[number])[1]
            continue
        guesses = [*problem.folded(number), fitted[nearest], zero, zero + rng.normal(size=len(zero))]
        tried = [_fitted(problem, numbers, number, problem.held(number, guess)) for guess in guesses]
        best = min(tried, key=lambda one: one[0])
        first = tried[0]
        fitted[number] = first[1] if first[0] <= _BETTER * best[0] + DOUBLE.zero else best[1]
    return [fitted[number] for number in range(count)]


def _followed(problem: DesignProblem, numbers: Floats, zero: Floats) -> dict[int, Floats]:
    """Return the configurations to which the driven joint leads from the pose, both ways; none of a flat sheet."""
    driver = problem.drivers[0] if problem.drivers else None
    turns = {number: driven(inputs, driver) for number, inputs in enumerate(problem.inputs)}
    given = sorted((angle, number) for number, angle in turns.items() if angle is not None)
    if driver is None or (problem.family.sheet is not None and not zero.any()):
        return {}
    closure = problem.frame.closure(problem.family.linkage(numbers))
    reached: dict[int, Floats] = {}
    upwards = [pair for pair in given if pair[0] > zero[driver]]
    downwards = [pair for pair in reversed(given) if pair[0] <= zero[driver]]
    for ahead in filter(None, (upwards, downwards)):
        try:
            path = driven_path(closure, zero, [driver], np.array([[angle] for angle, _ in ahead]))
        except SynthedraError:
            continue
        frames = path.angles[1 : len(path.angles) - bool(path.stopped)]
        reached |= {number: frame for (_, number), frame in zip(ahead, frames, strict=False)}
    return reached


def _apart(problem: DesignProblem, number: int, done: int, zero: Floats) -> float:
    """Return how far inputs of a configuration are from those of another, or of the pose; without, their places."""
    inputs = problem.inputs[number]
    other = problem.inputs[done] if done >= 0 else dict(enumerate(zero.tolist()))
    shared = [abs(angle - other[joint]) for joint, angle in inputs.items() if joint in other]
    return round(sum(shared), 9) if shared else float(abs(number - done))


def _fitted(problem: DesignProblem, numbers: Floats, number: int, guess: Floats) -> tuple[float, Floats]:
    """Return the joint angles near a guess that fit one configuration best, and how badly."""
    alone = problem.alone(number, numbers)
    free = problem.free[number]

    def angles(x: Floats) -> Floats:
        whole = guess.copy()
        whole[free] = x
        return whole

    def system(x: Floats) -> tuple[Floats, Floats]:
        off, by = alone(angles(x))
        return off, by[:, free]

    if not len(free):
        off, _ = alone(guess)
        return float(off @ off), guess
    reach = np.full(len(free), inf if problem.family.sheet is None else pi)
    found = least_squares(system, guess[free], (-reach, reach), _FIT, _FITTED)
    assert found is not None
    return found.cost / 2.0, angles(found.unknowns)


def closed(problem: DesignProblem, unknowns: Floats) -> FoundDesign | None:
    """Return a design whose rules hold, and whose configurations are closed, to the last digit where that can be."""
    numbers, angles = problem.parted(_ruled(problem, unknowns))
    design = problem.family.linkage(numbers)
    closure = problem.frame.closure(design)
    errors = []
    for number, inputs in enumerate(problem.inputs):
        held = sorted(inputs)
        pose = corrected(closure, angles[number], held)
        if held:
            pose = exactly_held(closure, pose, held, np.array([inputs[joint] for joint in held]))
        angles[number] = pose.angles
        errors.append(pose.error)
    step = problem.tried(problem.joined(numbers, angles))
    return None if step is None else FoundDesign(numbers, angles, errors, step)


def _ruled(problem: DesignProblem, unknowns: Floats, *, loops: bool = False) -> Floats:
    """Return the nearest unknowns at which rules hold and loops close: Newton's method, least steps within bounds.

    It ends where rules hold; with `loops` where these close too, which at a limit of the motion angles alone cannot do.
    """
    for _ in range(_ROUNDS):
        step = problem.tried(unknowns)
        if step is None:
            break
        matrix, off = np.vstack([step.by_closure, step.by_rules]), np.concatenate([step.closure, step.rules])
        if np.abs(off if loops else step.rules).max(initial=0.0) <= DOUBLE.closed / 100:
            break
        change = np.linalg.lstsq(matrix * problem.scales, off, rcond=DOUBLE.zero)[0]
        unknowns = np.clip(unknowns - problem.scales * change, *problem.bounds)
    return unknowns
