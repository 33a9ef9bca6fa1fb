"""The search for dimensions: angles fitted to the wishes first, then everything at once by least squares.

Closure counts as much as wishes at first and ever more after that, so that a design may open on the way; at the end
configurations are closed to the last digit. Theory: docs/theory/design.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256
from math import inf, pi

import numpy as np

from graphs.errors import SynthedraError
from graphs.least_squares import nearest_solution
from graphs.least_squares.gauss_newton import GaussNewton, find_root
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt, System, Trial, least_squares, minimise
from graphs.least_squares.steps import bounded_step, minimum_norm_step
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.motion.closure import corrected, exactly_held
from synth.analysis.motion.path import driven_path
from synth.synthesis.designing.problem import DesignProblem, DesignStep

SEARCH = LevenbergMarquardt(
    first=9e-4,  # holds back what changes residuals by less than 0.03 per unit, of which little is known at first
    least=1e-14,  # below it rounding shows along what the equations leave free
    least_of_cost=1e-4,  # a hundredth of the residual: so far the linear model may be wrong
    most=1e6,  # steps are then a millionth of the gradient, and none of them gained
    raised=16.0,  # steps of a quarter: where one is rejected, the next few would be too
    lowered=(25.0, 6.25, 2.25),  # a step that had to be corrected once or twice was at the end of what is linear
    poor=0.25,  # Moré's bounds: less than a quarter of what is predicted comes of curvature,
    good=0.5,  # and of a step with half of it a longer one has more still
    least_gain=1e-8,  # the search along closed designs, which follows, does the rest
    longest=1.0,  # radians and units of dimensions: farther away derivatives say nothing
    shortest=DOUBLE.closed,  # a shorter one closes nothing that is open
    corrections=2,  # the first takes away what is quadratic along the step, the second what is cubic
)
"""Dimensions and angles at once."""

_ANGLES = replace(
    SEARCH,
    most_trials=25,  # several guesses are fitted, and one that needs more is not near
    least_gain=1e-5,  # guesses are compared by factors of ten, and what is chosen is searched again
)
"""Angles of one configuration, dimensions as they are."""

_CLOSED = LevenbergMarquardt(
    first=1e-6,  # the search before ended near a minimum
    least=SEARCH.least,
    least_of_cost=SEARCH.least_of_cost,
    most=SEARCH.most,
    raised=16.0,
    lowered=(64.0,),  # closing the loops corrects each step, so longer ones are good
    most_trials=80,  # each of them closes all configurations, which takes longest
    least_gain=1e-9,  # of designs that cannot meet their wishes half the digits are then right
    solved=DOUBLE.closed,
)
"""Along closed designs."""

_RULES = GaussNewton(
    most_steps=8  # errors are squared: from a tenth to rounding in five, and three for a bad start
)
"""To where rules hold and loops close."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Search:
    """Weights, and what else the search for a design decides by."""

    weights: tuple[float, ...]
    trials: tuple[int, ...]
    stiff: float
    smooth: tuple[float, ...]
    better: float
    beside: float
    loose: float


_SEARCH = _Search(
    weights=(1.0, 30.0, 1e3),  # of closure and rules, one search after the other until configurations can be closed
    trials=(40, 30, 30),  # of each of these searches: later ones begin nearer
    stiff=1e3,  # weight of closure along closed designs: steps are tangent to these to a millionth
    smooth=(0.1, 0.01),  # of turns between configurations, one search after the other, where they are to be near
    better=10.0,  # times that the nearest configuration may fit worse than another guess, and still be taken
    beside=0.03,  # how far beside a saddle a search begins, in units of dimensions: beyond where it is flat
    loose=10.0,  # radians of a joint angle that count as a unit of dimensions: these decide which design is nearest
)


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

    With `follow` configurations begin where the driven joint leads from the file's, else where they fit wishes best.
    """
    if problem.tried(problem.joined(numbers, [problem.zero] * len(problem.inputs))) is None:
        return None
    unknowns = start = problem.joined(numbers, fitted_angles(problem, numbers, rng, follow=follow))
    unknowns = _off_saddle(problem, unknowns, rng)
    for smooth in _SEARCH.smooth if problem.wishes.between else ():
        unknowns = _minimised(problem, unknowns, 1.0, _SEARCH.trials[0], smooth)
    for weight, trials in zip(_SEARCH.weights, _SEARCH.trials, strict=True):
        unknowns = _minimised(problem, unknowns, weight, trials)
        found = closed(problem, unknowns)
        if found is not None and found.error > DOUBLE.closed and weight == _SEARCH.weights[-1]:
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
    residual, jacobian = step.residual(1.0), step.jacobian(1.0) * problem.scales
    size = np.linalg.norm(residual)
    if size <= DOUBLE.closed or np.linalg.norm(residual @ jacobian) > DOUBLE.same_configuration * size:
        return unknowns
    moved = unknowns.copy()
    moved[: problem.numbers] += _SEARCH.beside * problem.family.scales * rng.normal(size=problem.numbers)
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
    from that of the file, if the motion begins there, else from the first configuration.
    """
    driver = problem.drivers[0] if problem.drivers else None
    given = [driven(inputs, driver) for inputs in problem.inputs]
    zero = found.step.design.linkage.angles
    from_start = problem.wishes.from_start and not (problem.family.sheet is not None and not zero.any())
    goals = given if from_start else given[1:]
    if driver is None or None in given or not goals:
        return found
    closure = problem.frame.closure(found.step.design)
    try:
        start = zero if from_start else found.angles[0]
        path = driven_path(closure, start, [driver], np.array(goals, dtype=float)[:, None])
    except SynthedraError:
        return found
    if path.stopped or len(path.angles) != len(goals) + 1:
        return found
    angles = [*([] if from_start else found.angles[:1]), *path.angles[1:]]
    step = problem.tried(problem.joined(found.numbers, [problem.held(k, one) for k, one in enumerate(angles)]))
    if step is None:
        return found
    traced = FoundDesign(found.numbers, angles, [closure.error(one) for one in angles], step, found.settled)
    good = traced.error <= DOUBLE.closed and traced.cost <= found.cost + DOUBLE.closed
    return traced if good else found


def driven(inputs: Mapping[int, float], driver: int | None) -> float | None:
    """Return the angle of the driven joint if it is the one input of a configuration."""
    return inputs.get(driver) if driver is not None and len(inputs) == 1 else None


@dataclass(frozen=True)
class _ClosedIterate:
    """A closed design as an iterate: each step is closed again, and wishes alone are its cost."""

    problem: DesignProblem
    found: FoundDesign

    @cached_property
    def cost(self) -> float:
        """The sum of squares of weighted misses."""
        return self.found.cost

    @property
    def solved(self) -> bool:
        """Whether all wishes are met but for rounding."""
        return self.cost <= _CLOSED.solved**2

    def trial(self, damping: float) -> Trial["_ClosedIterate"]:
        """Return the step in which closure and rules weigh so much that they hold to first order, closed again."""
        problem, step, scales = self.problem, self.found.step, self.problem.scales
        bounds = (problem.bounds[0] / scales, problem.bounds[1] / scales)
        here = problem.joined(self.found.numbers, self.found.angles) / scales
        residual, jacobian = step.residual(_SEARCH.stiff), step.jacobian(_SEARCH.stiff) * scales
        tried = closed(problem, scales * bounded_step(here, jacobian, residual, bounds, damping))
        there = None if tried is None or tried.error > DOUBLE.closed else _ClosedIterate(problem, tried)
        return Trial(there, damping)


def _refined(problem: DesignProblem, found: FoundDesign) -> FoundDesign:
    """Return a design that meets wishes better, closed at each step: so curved families are followed, however narrow.

    It is `settled` if no further step would make it better.
    """
    end = minimise(_ClosedIterate(problem, found), _CLOSED)
    return replace(end.at.found, settled=True) if end.reason.converged else end.at.found


def _nearest(problem: DesignProblem, found: FoundDesign, start: Floats) -> FoundDesign:
    """Return the design nearest to a start that meets the wishes as well, if they are met: then many may meet them."""
    if found.cost > DOUBLE.derivative**2:
        return found
    scales = problem.scales.copy()
    scales[problem.numbers :] = _SEARCH.loose
    bounds = (problem.bounds[0] / scales, problem.bounds[1] / scales)
    here = problem.joined(found.numbers, found.angles)
    near = nearest_solution(_system(problem, scales), here / scales, start / scales, bounds)
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


def _minimised(problem: DesignProblem, unknowns: Floats, weight: float, trials: int, smooth: float = 0.0) -> Floats:
    """Return unknowns of least squares: closure and rules with a weight, turns between configurations with another."""
    scales = problem.scales
    bounds = (problem.bounds[0] / scales, problem.bounds[1] / scales)
    rule = replace(SEARCH, most_trials=trials)
    end = least_squares(_system(problem, scales, weight, smooth), unknowns / scales, rule, bounds)
    assert end is not None
    return np.asarray(end.at.unknowns * scales)


def fitted_angles(
    problem: DesignProblem, numbers: Floats, rng: np.random.Generator, *, follow: bool = True
) -> list[Floats]:
    """Return joint angles of each configuration at which it nearly closes and nearly meets its wishes.

    They are found outwards from that of the file, each from the fitted one whose inputs are nearest; another guess
    is taken only where it fits much better.
    """
    count = len(problem.inputs)
    zero = problem.family.linkage(numbers).linkage.angles
    fitted: dict[int, Floats] = {-1: zero}  # that of the file comes first
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
        fitted[number] = first[1] if first[0] <= _SEARCH.better * best[0] + DOUBLE.zero else best[1]
    return [fitted[number] for number in range(count)]


def _followed(problem: DesignProblem, numbers: Floats, zero: Floats) -> dict[int, Floats]:
    """Return the configurations to which the driven joint leads from the file's, both ways; none of a flat sheet."""
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
    """Return how far inputs of a configuration are from those of another, or of the file's; without, their places."""
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
        residual, jacobian = alone(angles(x))
        return residual, jacobian[:, free]

    if not len(free):
        residual, _ = alone(guess)
        return float(residual @ residual), guess
    reach = np.full(len(free), inf if problem.family.sheet is None else pi)
    end = least_squares(system, guess[free], _ANGLES, (-reach, reach))
    assert end is not None
    return end.at.cost / 2.0, angles(end.at.unknowns)


def closed(problem: DesignProblem, unknowns: Floats) -> FoundDesign | None:
    """Return a design whose rules hold, and whose configurations are closed, to the last digit where that can be."""
    numbers, angles = problem.parted(_ruled(problem, unknowns))
    design = problem.family.linkage(numbers)
    closure = problem.frame.closure(design)
    errors = []
    for number, inputs in enumerate(problem.inputs):
        held = sorted(inputs)
        configuration = corrected(closure, angles[number], held)
        if held:
            configuration = exactly_held(closure, configuration, held, np.array([inputs[joint] for joint in held]))
        angles[number] = configuration.angles
        errors.append(configuration.error)
    step = problem.tried(problem.joined(numbers, angles))
    return None if step is None else FoundDesign(numbers, angles, errors, step)


@dataclass(frozen=True)
class _RuledIterate:
    """Unknowns at which rules are to hold; with `loops` these are to close too."""

    problem: DesignProblem
    unknowns: Floats
    step: DesignStep
    loops: bool

    @property
    def error(self) -> float:
        """The largest residual of a rule, with `loops` of a closure equation too."""
        rules = float(np.abs(self.step.rules).max(initial=0.0))
        return max(rules, float(np.abs(self.step.closure).max(initial=0.0))) if self.loops else rules

    def onwards(self) -> "_RuledIterate | None":
        """Return what the shortest step leads to that takes rules and closure equations away, within bounds."""
        problem, step = self.problem, self.step
        jacobian = np.vstack([step.by_closure, step.by_rules]) * problem.scales
        change = minimum_norm_step(jacobian, np.concatenate([step.closure, step.rules]))
        moved = np.clip(self.unknowns + problem.scales * change, *problem.bounds)
        there = problem.tried(moved)
        return None if there is None else _RuledIterate(problem, moved, there, self.loops)


def _ruled(problem: DesignProblem, unknowns: Floats, *, loops: bool = False) -> Floats:
    """Return the nearest unknowns at which rules hold and loops close.

    The search ends where rules hold; with `loops` where these close too, which at a limit of the motion angles alone
    cannot do.
    """
    step = problem.tried(unknowns)
    return unknowns if step is None else find_root(_RuledIterate(problem, unknowns, step, loops), _RULES).at.unknowns
