"""The search for dimensions: angles fitted to the wishes first, then everything at once by least squares.

Closure counts as much as wishes at first and ever more after that, so that a design may open on the way; at the end
configurations are closed to the last digit. Theory: docs/theory/design.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256

import numpy as np

from graphs.errors import SynthedraError
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.designing.problem import DesignProblem, DesignStep
from synth.motion.closure import corrected, exactly_held
from synth.motion.path import driven_path

_WEIGHTS = (1.0, 30.0, 1e3)
"""Of closure and rules, one search after the other until configurations can be closed."""
_STEPS = (40, 30, 30)
_STIFF = 1e5
_SMOOTH = (0.1, 0.01)
"""Weights of turns between configurations, one search after the other, where they are to be near to each other."""
_DAMPING, _MORE, _LESS, _MOST_DAMPING = 1e-3, 4.0, 8.0, 1e3
_REFINED, _GAIN = 80, 1e-9
"""Most steps along closed designs, and the part of the sum of squares that a step must take away to be followed."""
_ROUGH, _SETTLED = 1e-8, 1e-15
"""Where steps or gains are less than the first part, or slopes or misses than the second, a search ends."""
_FIT, _FITTED = 25, 1e-5
_BETTER = 10.0
"""How many times worse the nearest configuration may fit than another guess, and still be taken."""
_UNMET = 1e6
"""A residual where there is no mechanism: no step goes there."""
_ROUNDS = 8


@dataclass(frozen=True)
class FoundDesign:
    """Numbers of a design, and its configurations closed as well as they can be.

    `errors` are the loop-closure residuals, `step` all equations there.
    """

    numbers: Floats
    angles: list[Floats]
    errors: list[float]
    step: DesignStep

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
    unknowns = problem.joined(numbers, fitted_angles(problem, numbers, rng, follow=follow))
    for smooth in _SMOOTH if problem.wishes.between else ():
        unknowns = _least(problem, unknowns, 1.0, _STEPS[0], smooth)
    for weight, steps in zip(_WEIGHTS, _STEPS, strict=True):
        unknowns = _least(problem, unknowns, weight, steps)
        found = closed(problem, unknowns)
        if found is not None and found.error <= DOUBLE.closed:
            return _on_one_branch(problem, _refined(problem, found))
    begun = _folded_start(problem, numbers) if problem.wishes.flat_foldable else None
    return found if begun is None else _on_one_branch(problem, _refined(problem, begun))


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

    Where wishes say nothing of some links these may be found in another assembly mode at each input.
    """
    driver = problem.drivers[0] if problem.drivers else None
    given = [driven(inputs, driver) for inputs in problem.inputs]
    if driver is None or None in given or len(given) < 2:
        return found
    closure = problem.frame.closure(found.step.design)
    start = found.angles[0]
    try:
        path = driven_path(closure, start, [driver], np.array(given[1:], dtype=float)[:, None])
    except SynthedraError:
        return found
    if path.stopped or len(path.angles) != len(given):
        return found
    angles = [found.angles[0], *path.angles[1:]]
    step = problem.tried(problem.joined(found.numbers, [problem.held(k, one) for k, one in enumerate(angles)]))
    if step is None:
        return found
    traced = FoundDesign(found.numbers, angles, [closure.error(one) for one in angles], step)
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
    damping, low, high = _DAMPING, *problem.family.bounds
    for _ in range(_REFINED):
        step, before = found.step, found.cost
        if before <= _SETTLED**2:
            break
        matrix = np.vstack([step.jacobian(_STIFF), damping * np.eye(problem.size)])
        off = np.concatenate([step.residual(_STIFF), np.zeros(problem.size)])
        change = np.linalg.lstsq(matrix, -off, rcond=None)[0]
        moved = problem.joined(found.numbers, found.angles) + change
        moved[: problem.numbers] = np.clip(moved[: problem.numbers], low, high)
        tried = closed(problem, moved)
        if tried is None or tried.error > DOUBLE.closed or tried.cost >= before:
            damping *= _MORE
            if damping > _MOST_DAMPING:
                break
            continue
        found, damping = tried, damping / _LESS
        if before - tried.cost <= _GAIN * before:
            break
    return found


def _least(problem: DesignProblem, unknowns: Floats, weight: float, steps: int, smooth: float = 0.0) -> Floats:
    """Return unknowns of least squares: closure and rules with a weight, turns between configurations with another."""
    from scipy.optimize import least_squares

    last: dict[bytes, DesignStep | None] = {}

    def at(x: Floats) -> DesignStep | None:
        key = x.tobytes()
        if key not in last:
            last.clear()
            last[key] = problem.tried(x)
        return last[key]

    first = at(unknowns)
    assert first is not None
    size = len(first.residual(weight, smooth))

    def residual(x: Floats) -> Floats:
        step = at(x)
        return np.full(size, _UNMET) if step is None else step.residual(weight, smooth)

    def jacobian(x: Floats) -> Floats:
        step = at(x)
        return np.zeros((size, len(x))) if step is None else step.jacobian(weight, smooth)

    low, high = np.full(len(unknowns), -np.inf), np.full(len(unknowns), np.inf)
    low[: problem.numbers], high[: problem.numbers] = problem.family.bounds
    inside = np.clip(unknowns, low, high)
    ends = {"xtol": _ROUGH, "ftol": _ROUGH, "gtol": _SETTLED}
    found = least_squares(residual, inside, jac=jacobian, bounds=(low, high), max_nfev=steps, **ends)
    return np.asarray(found.x)


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
    from scipy.optimize import least_squares

    alone = problem.alone(number, numbers)
    free = problem.free[number]

    def angles(x: Floats) -> Floats:
        whole = guess.copy()
        whole[free] = x
        return whole

    if not len(free):
        off, _ = alone(guess)
        return float(off @ off), guess
    ends = {"xtol": _FITTED, "ftol": _FITTED, "gtol": _FITTED}
    found = least_squares(
        lambda x: alone(angles(x))[0], guess[free], jac=lambda x: alone(angles(x))[1][:, free], max_nfev=_FIT, **ends
    )
    return float(found.cost), angles(found.x)


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


def _ruled(problem: DesignProblem, unknowns: Floats) -> Floats:
    """Return the nearest unknowns at which rules hold and loops close: Newton's method, least steps within bounds."""
    for _ in range(_ROUNDS):
        step = problem.tried(unknowns)
        if step is None or float(np.abs(step.rules).max(initial=0.0)) <= DOUBLE.closed / 100:
            break
        matrix, off = np.vstack([step.by_closure, step.by_rules]), np.concatenate([step.closure, step.rules])
        unknowns = unknowns - np.linalg.lstsq(matrix, off, rcond=DOUBLE.zero)[0]
        unknowns[: problem.numbers] = np.clip(unknowns[: problem.numbers], *problem.family.bounds)
    return unknowns
