"""Walks: closed configurations one after the other along a curve, and the events on the way.

A step goes along rates at which loops stay closed, bent as the last step was, and is corrected by Newton's
method; where driven joints land on their angles they are held there. A step is halved if its end does not close,
lies far from where it was expected, or goes on in another direction: curves that come near each other are not
confused. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf, sqrt
from typing import Any, NamedTuple

import numpy as np

from graphs.errors import shown
from graphs.tolerances import DOUBLE, leading
from graphs.types import Flags, Floats, JointId
from synth.analysis.motion.closure import ClosureEquations, Corrected, corrected, exactly_held
from synth.analysis.motion.tangent import FREE, TangentSpace
from synth.analysis.motion.walk.step import (
    SINGULAR,
    STRAY,
    Allowance,
    EventKind,
    PathEvent,
    RankWatch,
    Step,
    in_degrees,
    length_of,
)

_FIRST, _LARGEST, _LEAST = 0.02, 0.2, 1e-6
"""Steps, radians of the joint that moves most."""
_STRAY_FIRST = 0.5
"""The same part of a step that begins at a singular configuration: rates there are chosen to second order only."""
_ALIKE = 0.6
"""Cosine of the angle between directions before and after a step, at least."""
_HARDLY = 0.05
"""A driven joint that has less than this part of the largest rate may be about to turn back."""
_EASY = 5
"""Steps of Newton's method after which a step of the walk may be longer."""
_MOST = 20_000
_FEW, _AT_ONCE = 64, 24
"""Of linkages of so few joints the library takes so many steps at once: those beyond an event are lost."""
_MANNER = np.array([FREE, DOUBLE.clear, _FIRST, _LARGEST, _LEAST, STRAY, _STRAY_FIRST, _ALIKE, _EASY, SINGULAR])
"""These numbers as closure_kernel.c takes them."""


class Event:
    """Something that a walk may meet: each kind says what it looks at, and when."""

    def before(self, walk: Walk, rates: Floats) -> str:
        """Return why a walk cannot go on at such rates, if so."""
        return ""

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """Return a step as far as the event, and why the walk ends there, empty if it goes on; else None."""
        return None

    def singular(self, step: Step) -> bool:
        """Tell whether the rank may be less at the end of a step."""
        return False

    def after(self, walk: Walk, step: Step) -> None:
        """Record what was met on a step, the walk being at its end."""


class DrivenGoal(Event):
    """Driven joints, at places `drivers`, have angles float[D], radians; the farthest from its angle leads.

    The walk begins at `start`; messages use the names of all joints. `lead` and `joint` are the place of the
    leading joint among the driven ones and among all, `way` is 1.0 or -1.0 as its angle is to grow or to fall, 0.0
    at the goal; `turned` says whether turning points of this joint were passed.
    """

    def __init__(self, drivers: list[int], values: Floats, start: Corrected, names: Sequence[JointId]) -> None:
        self.drivers, self.names, self.turned = drivers, names, False
        self._values = values
        left = self.left(start)
        self.lead = leading(left)
        self.joint, self.way = drivers[self.lead], float(np.sign(left[self.lead]))

    @property
    def several(self) -> bool:
        """Whether joints are driven together."""
        return len(self.drivers) > 1

    def left(self, place: Corrected) -> Floats:
        """Return how far the driven joints are to turn: float[D], radians."""
        return np.asarray(self._values - place.angles[self.drivers])

    def ahead(self, place: Corrected) -> float:
        """Return how far the goal is ahead, negative past it, 0.0 where the walk has come to it: radians."""
        return self.way * float(self.left(place)[self.lead])

    def before(self, walk: Walk, rates: Floats) -> str:
        """Return why the driven joint does not come nearer."""
        speed = self.way * float(rates[self.joint])
        if self.turned or speed > DOUBLE.zero_rate:
            return ""
        if speed < 0.0:
            return self.turns_back(walk.here)
        return f"{self.driver} cannot move from {self.angle(walk.here)}"

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """Land on the goal."""
        if self.several or self.ahead(step.after) >= 0.0:
            return None
        landed = step.landing(self.joint, float(self._values[0]))
        return (step.up_to(step.before), self.lost(step.before)) if landed is None else (step.up_to(landed), "")

    @property
    def driver(self) -> str:
        """The name of the leading joint in messages."""
        return f"the driven joint {shown(self.names[self.joint])}"

    def angle(self, place: Corrected, decimals: int = 6) -> str:
        """Return its angle in words."""
        return in_degrees(float(place.angles[self.joint]), decimals)

    def lost(self, place: Corrected) -> str:
        """Say that there is no step from here: how near it comes to where that is so, rounding decides."""
        return f"no closed configuration was found beyond {self.angle(place, 1)} of {self.driver}"

    def turns_back(self, place: Corrected) -> str:
        """Say that the driven joint turns back before it has its angle."""
        goal = in_degrees(float(self._values[self.lead]))
        return f"{self.driver} turns back at {self.angle(place)}, before {goal}"


class StepAhead(NamedTuple):
    """A step that the library took, and what the walk goes on with after it."""

    step: Step
    tangent: Floats
    bend: Floats
    across: tuple[Floats, Floats]
    length: float
    singular: bool


class Ahead:
    """Steps that the library takes for a walk where no joint is driven, several at once.

    They are those that `Walk` would take one by one. When an event ends a step earlier, the others are forgotten.
    """

    def __init__(self, closure: ClosureEquations) -> None:
        self._closure = closure
        self._places: dict[str, Floats] = {}
        self._next, self._last = 1, 0

    def forget(self) -> None:
        """Forget the steps that were not taken yet."""
        self._next, self._last = 1, 0

    def next(self, walk: Walk) -> StepAhead | None:
        """Return the next step; None where the walk has to take it: of many joints, or if none is found."""
        if self._next > self._last and walk.tangent is not None and 0 < self._closure.joints <= _FEW:
            self._take(walk)
        if self._next > self._last:
            return None
        k, places = self._next, self._places
        self._next += 1
        error, corrections = float(places["error"][k]), int(places["steps"][k])
        after = Corrected(places["angles"][k], error, corrections, self._closure, places["entries"][k])
        step = Step(self._closure, walk.here, after, places["leaving"][k], places["arriving"][k])
        across = places["across"][k], places["image"][k]
        singular = walk.watch is not None and bool(places["singular"][k])
        return StepAhead(step, places["tangent"][k], places["bend"][k], across, float(places["length"][k]), singular)

    def _take(self, walk: Walk) -> None:
        """Take steps from where the walk is."""
        self.forget()
        walked = self._closure.walked(_MANNER, walk.state, _AT_ONCE) if self._closure.rows else None
        if walked is not None:
            self._places, self._last = walked


class Walk(Iterator[Step]):
    """A walk along a curve of closed configurations, one step for each `next`, until an event ends it.

    It goes straight on, or where it has a goal along the least rates that move the driven joints: initial rates
    are `tangent`, or these. Each event may cut a step short, record itself, and end the walk; they are consulted
    in their order, and the first one on a step counts. A walk that ended goes on when it has another goal. It is
    at `here`; `tangent` is the way on, of any size, None where the goal decides, `length` that of the next step,
    radians of the joint that moves most. Its caller adds to `frames`; `met` are the recorded events, `drop` the
    joint angles where the rank dropped on the last step and by how much, `ended` why it ended.

    Examples
    --------
    A circuit of a Bennett linkage:

    >>> from synth.analysis.motion.singular.second_order import rates_at
    >>> from synth.analysis.motion.walk.events import Return
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> at = configuration_of(generate("bennett").mechanism)
    >>> walk = Walk(at.closure, at.linkage.angles, rates_at(at.closure, at.linkage.angles)[:, 0])
    >>> walk.events.append(Return(at.linkage.angles, walk.tangent))
    >>> len(list(walk)) > 20, walk.ended
    (True, 'it comes round')
    """

    def __init__(
        self,
        closure: ClosureEquations,
        start: Floats,
        tangent: Floats | None = None,
        *,
        straight: bool = False,
        allowance: Allowance | None = None,
        watch: RankWatch | None = None,
        kept: KeptSigns | None = None,
    ) -> None:
        self.closure, self.watch, self.kept = closure, watch, kept
        self.here = corrected(closure, start)
        self.tangent, self.length = tangent, _FIRST
        self.events: list[Event] = []
        self.goal: DrivenGoal | None = None
        self.frames, self.met = [self.here], list[PathEvent]()
        self.drop: tuple[Floats, int] | None = None
        self.ended = ""
        self.straight, self._allowance = straight, allowance
        self._bend = np.zeros(closure.joints)
        self._begun, self._steps = False, 0
        self._ahead = Ahead(closure)

    def towards(self, goal: DrivenGoal, events: Sequence[Event]) -> None:
        """Go on to a goal: back along the curve, if the driven joint does not go the way it is to go."""
        kept = [] if self.kept is None else [self.kept]
        self.goal, self.events, self.ended, self._steps = goal, [*events, *kept, goal], "", 0
        if self._begun and self.tangent is not None and goal.way * self.tangent[goal.joint] < 0.0:
            self.tangent = -self.tangent

    def record(
        self,
        kind: EventKind,
        angles: Floats,
        *,
        joints: tuple[int, ...] = (),
        frame: int | None = None,
        drop: int = 0,
        other_ways: int | None = None,
        panels: tuple[int, ...] = (),
    ) -> None:
        """Record an event at joint angles; by default of the driver, and after the last frame."""
        driver = joints[0] if self.goal is None and joints else 0 if self.goal is None else self.goal.joint
        frame = len(self.frames) - 1 if frame is None else frame
        self.met.append(PathEvent(kind, frame, driver, joints or (driver,), angles, drop, other_ways, panels))

    @property
    def singular(self) -> bool:
        """Whether rates are more than those of the curve, where it is, or hardly fewer."""
        return self.watch is not None and self.watch.singular

    def __next__(self) -> Step:
        """Take a step."""
        if self.ended:
            raise StopIteration
        ahead = self._ahead.next(self) if self.goal is None and self.kept is None else None
        rates = self._onwards() if ahead is None else ahead.step.leaving
        reasons = filter(None, (event.before(self, rates) for event in self.events))
        self.ended = self._exhausted() or next(reasons, "")
        step = None
        if ahead is not None and not self.ended:
            step, self.length = ahead.step, ahead.length
        elif not self.ended:
            step = self._stepped(rates)
        if step is None:
            nowhere = "no single branch leads on" if self.goal is None else self.goal.lost(self.here)
            self.ended = self.ended or nowhere
            raise StopIteration
        for event in self.events:
            cut = event.within(self, step)
            if cut is not None:
                step, self.ended = cut
        self._arrive(step, ahead if ahead is not None and step is ahead.step else None)
        for event in self.events:
            event.after(self, step)
        return step

    def _exhausted(self) -> str:
        self._steps += 1
        if self._steps > _MOST:
            return f"{_MOST} steps were not enough"
        allowed = self._allowance is None or self._allowance.take()
        return "" if allowed else "the allowance of steps was used up"

    def _onwards(self) -> Floats:
        """Return the least rates that move the driven joints, or else those nearest to the rates before."""
        rates = self._chosen()
        size = float(np.abs(rates).max(initial=0.0))
        return rates / size if size else rates

    def _chosen(self) -> Floats:
        before, goal = self.tangent, self.goal
        if before is not None and not self._begun:
            return before  # at a singular configuration: it was chosen
        if before is not None and (goal is None or self.straight or (self.singular and not goal.several)):
            return self.here.space.projected(before)
        assert goal is not None, "a walk without a goal needs rates to begin with"
        least = self.here.space.least_rates(goal.drivers, goal.left(self.here))
        if before is None or goal.several:
            return least
        least = least * np.sign(least @ before)
        hardly = np.abs(least[goal.drivers]).max() <= _HARDLY * np.abs(least).max(initial=0.0)
        return self.here.space.projected(before) if hardly or not _alike(least, before) else least

    def _stepped(self, rates: Floats) -> Step | None:
        """Return a step of the length that can be trusted, at most to what is left of the driven joints' way."""
        here, drivers, left, most = self.here, list[int](), np.zeros(0), inf
        several = self.goal is not None and self.goal.several
        bound: list[int] = []
        if self.kept is not None and self._begun and not self.singular:
            rates, self.length = self.kept.admitted(self, rates)
            bound = self.kept.bound
        bend = np.zeros_like(rates) if several or bound else self._bend
        if self.goal is not None:
            drivers, left = self.goal.drivers, self.goal.left(here)
            joint = self.goal.joint
            most = _reach(float(rates[joint]), float(bend[joint]), float(left[self.goal.lead]))
        stray = STRAY if self._begun else _STRAY_FIRST
        while self.length >= _LEAST:
            lands = self.length >= most
            length = most if lands else self.length
            expected = here.angles + length * rates + length**2 / 2.0 * bend
            held = drivers if lands or several else []
            expected[held] = here.angles[held] + (left if lands else length / most * left)[: len(held)]
            end = corrected(self.closure, expected, [*held, *bound])
            if end.closed and np.abs(end.angles - expected).max() <= stray * length:
                arriving = end.space.projected(rates)
                easy = end.steps <= _EASY and not lands
                end = exactly_held(self.closure, end, held, expected[held])
                lost = self.kept is not None and self._begun and self.kept.lost(end.angles, length)
                if end.closed and not lost and (several or _alike(arriving, rates)):
                    if easy:
                        self.length = min(1.5 * self.length, _LARGEST)
                    return Step(self.closure, here, end, rates, arriving)
            self.length = length / 2.0
        self.length = _FIRST
        return None

    @property
    def state(self) -> dict[str, Any]:
        """With which rates, bend and vector across the freedoms it goes on, as `ClosureEquations.walked` takes them."""
        watch = self.watch
        across, image = (0.0, 0.0) if watch is None else watch.across
        return {
            "angles": self.here.angles, "entries": self.here.entries, "tangent": self.tangent, "bend": self._bend,
            "across": across, "image": image, "length": self.length, "begun": self._begun,
            "watched": 0 if watch is None else 2 if watch.begun else 1,
        }  # fmt: skip

    def _arrive(self, step: Step, ahead: StepAhead | None = None) -> None:
        """Go to the end of a step; where it is singular, rates are more than the curve's."""
        self.here, self._begun = step.after, True
        if self.watch is not None:
            flat, across = any(each.singular(step) for each in self.events), None if ahead is None else ahead.across
            self.drop = self.watch.dropped(step, flat=flat, across=across)
        if ahead is not None and self.singular == ahead.singular:
            self.tangent, self._bend = ahead.tangent, ahead.bend
            return
        self._ahead.forget()
        length = float(np.abs(step.chord).max(initial=0.0))
        if not length:
            return
        self.tangent = 2.0 * step.chord / length - step.leaving if self.singular else step.arriving
        bend = (step.arriving / max(float(np.abs(step.arriving).max()), _LEAST) - step.leaving) / length
        straight = self.singular or np.abs(bend).max() * self.length > STRAY
        self._bend = np.zeros_like(bend) if straight else bend


def only_rates(place: Corrected, rates: Floats) -> bool:
    """Tell whether all rates at a configuration are those of a curve through it: one freedom, to first order."""
    along = place.space.projected(rates)
    along = along / np.linalg.norm(along)
    any_rates = place.space.projected(np.random.default_rng(len(rates)).normal(size=len(rates)))
    across = any_rates - (any_rates @ along) * along
    return bool(np.linalg.norm(across) <= DOUBLE.clear * np.linalg.norm(any_rates))


def _reach(speed: float, bend: float, left: float) -> float:
    """Return after which length a joint has gone as far as it is to go; infinite if it turns back before."""
    if left < 0.0:
        speed, bend, left = -speed, -bend, -left
    square = speed * speed + 2.0 * bend * left
    if square <= 0.0 or speed + sqrt(square) <= 0.0:
        return inf
    return 2.0 * left / (speed + sqrt(square))


def _alike(one: Floats, other: Floats) -> bool:
    return bool(one @ other > _ALIKE * length_of(one) * length_of(other))


_KEPT, _FLOOR = 0.5, 1e-3
"""A step leaves at least this part of a fold angle, and none is unfolded below the second, radians."""
_SHORTEST = 0.01
"""A crease turns over where no rates keep all signs for a longer step, radians of the joint that moves most."""
_ROUNDS = 40


class KeptSigns(Event):
    """Fold angles that keep their signs on a walk; each is left free once it has turned over.

    The rates nearest to those that a walk would take, among those at which loops stay closed, driven joints go on
    as they do, and no crease that is nearly unfolded goes on to unfold: a least-distance problem with few
    inequalities, solved by non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems,
    1974, chapter 23). Its solution is unique, so that it does not depend on bases.
    """

    def __init__(self, signs: Floats) -> None:
        self._signs, self._kept = np.sign(signs), np.sign(signs)
        self._crossing: list[int] = []
        self.bound: list[int] = []  # joints whose rates Newton's method holds on the current step

    def admitted(self, walk: Walk, rates: Floats) -> tuple[Floats, float]:
        """Return rates near others, the largest 1 or -1, that lose no sign on the next step, and its length.

        Where no others keep all signs, though the step is short, creases are given up until some do: of a
        contradiction the one first that would turn over fastest.
        """
        here, length = walk.here, walk.length
        held = [] if walk.goal is None else walk.goal.drivers
        signs = self._kept = self._signs.copy()
        signs[held] = 0.0
        while True:
            nearest, bound = _nearest(here, rates, signs, held, length)
            if nearest is not None:
                self.bound = np.flatnonzero(bound).tolist()
                return nearest / np.abs(nearest).max(), length
            if length > _SHORTEST:
                length = max(length / 4.0, _SHORTEST)
                continue
            signs[leading(np.where(bound, np.minimum(signs * rates, -DOUBLE.zero_rate), 0.0))] = 0.0
            length = walk.length

    def lost(self, angles: Floats, length: float) -> bool:
        """Tell whether a sign is lost at the end of a step that might have kept it, were it shorter."""
        return length > _SHORTEST and bool((self._kept * angles < -DOUBLE.immobile).any())

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """Note which joints change their signs on a step, without ending it."""
        before, after = (self._signs * end.angles for end in (step.before, step.after))
        self._crossing = np.flatnonzero((before >= 0.0) & (after < -DOUBLE.immobile)).tolist()
        return None

    def after(self, walk: Walk, step: Step) -> None:
        """Record the creases that turned over on a step."""
        for joint in self._crossing:
            part = step.zero(lambda place, joint=joint: float(place.angles[joint]))  # type: ignore[misc]
            walk.record("turns over", (step.after if part is None else step.at(part)).angles, joints=(joint,))
            self._signs[joint] = 0.0  # it has turned: from there on it is free


def _nearest(
    here: Corrected, rates: Floats, signs: Floats, held: Sequence[int], length: float
) -> tuple[Floats | None, Flags]:
    """Return the rates nearest to given ones at which signs are kept, or None and the joints that contradict."""
    least, sized = _least_rates(here.angles, signs, length), DOUBLE.zero**0.5
    chosen, bound = rates, np.zeros(len(rates), dtype=bool)
    for _ in range(_ROUNDS):
        broken = (signs != 0.0) & ~bound & (signs * chosen < least - sized)
        if not broken.any():
            return chosen, bound
        bound |= broken
        places = np.flatnonzero(bound)
        moves = signs[places][:, None] * _moves(here.space, places.tolist(), held)
        change, contradiction = _least_change(moves, (least - signs * rates)[places])
        if change is None:
            blamed = np.zeros(len(rates), dtype=bool)
            blamed[places[contradiction]] = True
            return None, blamed
        chosen = rates + change
    return chosen, bound


def _least_rates(angles: Floats, signs: Floats, length: float) -> Floats:
    """Return the least rates, by their signs, at which enough of each fold angle is left after a step."""
    size = signs * angles
    spare = np.maximum(size - np.maximum(_KEPT * size, _FLOOR), 0.0)
    return np.asarray(np.where(size < 0.0, -np.inf, -spare / length))


def _moves(space: TangentSpace, places: Sequence[int], held: Sequence[int]) -> Floats:
    """Return the least rates that move each of some joints, across those that move held ones: float[n, J]."""
    moves = np.array([space.move(joint) for joint in places])
    if not held:
        return moves
    fixed = np.array([space.move(joint) for joint in held])
    gram = fixed[:, list(held)]
    return np.asarray(moves - np.linalg.lstsq(gram, moves[:, list(held)].T, rcond=DOUBLE.zero)[0].T @ fixed)


def _least_change(moves: Floats, wanted: Floats) -> tuple[Floats | None, Flags]:
    """Return the least x with ``moves @ x >= wanted``, or None; and of which inequalities a sum contradicts.

    The least-distance problem: of non-negative multiples of the rows [moves, wanted] that sum is taken which is
    nearest to the last unit vector. What is left of that is x, but for a factor; if nothing is, there is no x.
    """
    from scipy.optimize import nnls  # takes a third of a second to load

    size = max(float(np.abs(wanted).max()), DOUBLE.zero)
    rows = np.concatenate([moves, wanted[:, None] / size], axis=1)
    target = np.eye(1, rows.shape[1], rows.shape[1] - 1)[0]
    shares, _ = nnls(rows.T, target, maxiter=50 * len(rows))
    left = rows.T @ shares - target
    if abs(left[-1]) <= DOUBLE.clear:
        return None, shares > 0.0
    return -left[:-1] / left[-1] * size, shares > 0.0
