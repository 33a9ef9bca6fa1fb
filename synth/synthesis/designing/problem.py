"""Wishes as equations: the numbers of a design and the joint angles of all its configurations are the unknowns.

Closure equations of each configuration and rules are to be zero, misses of wishes small, with exact derivatives.
Theory: docs/theory/design.md.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import degrees, inf

import numpy as np

from graphs.errors import InvariantError, SynthedraError, UnsolvableError
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.synthesis.designing.dimensions import DesignedLinkage, Dimensions
from synth.synthesis.designing.placement import Derived, DesignConfiguration, DesignFrame
from synth.synthesis.designing.sheet_rules import flat_rules, folded_frames
from synth.synthesis.designing.wishes import POSE, JointAngle, Wish, WishedConfiguration, Wishes, check_wishes

NumberRule = Callable[[DesignedLinkage], tuple[Floats, Floats]]
"""A condition on the numbers of a design alone: residuals float[m] to be zero, and derivatives float[m, n]."""


@dataclass(frozen=True, slots=True)
class DesignStep:
    """All equations at one place: the parts by which they miss, and their derivatives by all unknowns.

    `closure` and `rules` are to be zero, `wishes` small; these are in radians and units of the file, and `weights` make
    parts of the extent of them; `rows` is the number of residuals of each wish. `turns` are those of
    joints from each configuration to the next.
    """

    design: DesignedLinkage
    closure: Floats
    rules: Floats
    wishes: Floats
    by_closure: Floats
    by_rules: Floats
    by_wishes: Floats
    weights: Floats
    rows: tuple[int, ...]
    turns: Floats
    by_turns: Floats

    def residual(self, weight: float, smooth: float = 0.0) -> Floats:
        """Return all residuals: closure and rules times a weight, wishes times theirs, turns if they count."""
        turns = [smooth * self.turns] if smooth else []
        return np.concatenate([weight * self.closure, weight * self.rules, self.weights * self.wishes, *turns])

    def jacobian(self, weight: float, smooth: float = 0.0) -> Floats:
        """Return their derivatives."""
        weighed = self.weights[:, None] * self.by_wishes
        turns = [smooth * self.by_turns] if smooth else []
        return np.vstack([weight * self.by_closure, weight * self.by_rules, weighed, *turns])


def with_between(wishes: Wishes) -> Wishes:
    """Return wishes with further configurations between each and the next, without inputs; the file's comes first."""
    configurations: list[WishedConfiguration] = []
    for one in wishes.configurations:
        before = configurations[-1].name if configurations else POSE
        names = [f"{before} to {one.name}, {number}" for number in range(1, wishes.between + 1)]
        configurations += [*map(WishedConfiguration, names), one]
    return replace(wishes, configurations=tuple(configurations))


def reweighed(wishes: Wishes, frozen: Collection[int] = (), weights: Mapping[int, float] | None = None) -> Wishes:
    """Return wishes of which some have other weights, and some must hold.

    Parameters
    ----------
    wishes : Wishes
    frozen : collection of int, optional
        Numbers of wishes, from 0, that become rules too.
    weights : mapping of int to float, optional
        Weights by numbers of wishes.

    Raises
    ------
    InvariantError
        If there is no wish of a number.

    Examples
    --------
    >>> from synth.synthesis.designing.sizes import LinkArc
    >>> from synth.synthesis.designing.wishes import Goal
    >>> wishes = Wishes((JointAngle(joint="1", goal=Goal(equals=0.3)), LinkArc(joints=("0", "1"), goal=Goal(equals=1))))
    >>> changed = reweighed(wishes, frozen=[1], weights={0: 5.0})
    >>> changed.wishes[0].weight, str(changed.rules[0])
    (5.0, 'arc between joints 0 and 1')
    """
    every, weights = list(wishes.wishes), weights or {}
    for number in (*frozen, *weights):
        if not 0 <= number < len(every):
            raise InvariantError("wishes", f"there is no wish {number + 1}", f"1 to {len(every)}")
    held = tuple(every[number] for number in sorted(set(frozen)) if every[number] not in wishes.rules)
    for number, weight in weights.items():
        every[number] = replace(every[number], weight=weight)
    return replace(wishes, wishes=tuple(every), rules=(*wishes.rules, *held))


class DesignProblem:
    """Wishes about a family of mechanisms, as equations.

    Parameters
    ----------
    family : Dimensions
    wishes : Wishes
    number_rules : sequence of NumberRule
        Conditions on numbers that keep a type mobile.

    Examples
    --------
    >>> from synth.synthesis.designing.dimensions import dimensions_of
    >>> from synth.synthesis.designing.wishes import Goal, JointAngle, WishedConfiguration
    >>> from synth.catalogue.patterns import generate
    >>> wish = JointAngle(at="open", joint="2", goal=Goal(equals=0.4))
    >>> family = dimensions_of(generate("four-bar").mechanism)
    >>> problem = DesignProblem(family, Wishes((wish,), (WishedConfiguration("open", {"0": 0.3}),)))
    >>> len(problem.start), problem.evaluated(problem.start).closure.shape
    (15, (3,))
    """

    def __init__(self, family: Dimensions, wishes: Wishes, number_rules: Sequence[NumberRule] = ()) -> None:
        self.asked = [one.name for one in wishes.configurations]
        self.family, self.wishes, self.number_rules = family, with_between(wishes), list(number_rules)
        wishes = self.wishes
        if wishes.flat_foldable:
            if family.sheet is None:
                raise UnsolvableError("flat_foldable is for flat sheets, and the mechanism is none")
            self.number_rules = [*number_rules, *flat_rules(family.sheet)]
        first = family.linkage(family.start)
        self.frame = frame = DesignFrame(family, first)
        check_wishes(wishes, frame)
        self.zero = first.linkage.angles
        self.numbers, self.joints = len(family.start), len(frame.joints)
        self.inputs = [
            {frame.joint(name): angle for name, angle in one.inputs.items()} for one in wishes.configurations
        ]
        self.free: list[Ints] = [
            np.array([joint for joint in range(self.joints) if joint not in given], dtype=np.int64)
            for given in self.inputs
        ]
        starts = self.numbers + np.cumsum([0, *(len(free) for free in self.free)])
        self.columns = [slice(int(a), int(b)) for a, b in pairwise(starts)]
        self.size = int(starts[-1])
        angles = np.ones(self.size - self.numbers)
        self.scales = np.concatenate([family.scales, angles])
        low, high = family.bounds
        self.bounds = (np.concatenate([low, -inf * angles]), np.concatenate([high, inf * angles]))
        self.drivers = self._drivers()
        self.together = sorted({joint for inputs in self.inputs for joint in inputs})
        self.start = self.joined(family.start, [self.held(k, self.zero) for k in range(len(self.inputs))])
        self._contradictions()

    def begun_at(self, family: Dimensions) -> DesignProblem:
        """Return the same equations for a family that begins at another member of its type, in the same unit."""
        other = copy(self)
        other.family = family
        other.start = other.joined(family.start, [self.held(k, self.zero) for k in range(len(self.inputs))])
        return other

    def _drivers(self) -> list[int]:
        """Return the joints that may be driven: as stated, of the first input, else any of the fixed link.

        A configuration that gives all joints, a flat state for one, has no input: without others any joint may be.
        """
        frame, wishes = self.frame, self.wishes
        if wishes.driver is not None:
            return [frame.joint(wishes.driver)]
        given = [list(inputs) for inputs in self.inputs if inputs]
        first = next((joints[:1] for joints in given if len(joints) < self.joints), None)
        if given:
            return first or given[0]
        return [place for place, joint in enumerate(frame.joints) if self.family.ground in frame.graph.joints[joint]]

    def _contradictions(self) -> None:
        """Refuse wishes and rules for the same measure that exclude each other, or the input that is given."""
        seen: dict[str, list[Wish]] = {}
        for wish in (*self.wishes.wishes, *self.wishes.rules):
            before = seen.setdefault(str(wish), [])
            if any(one.contradicts(wish) for one in before):
                raise InvariantError("wishes", f"two different wishes for the {wish} contradict each other", "one")
            before.append(wish)
            if isinstance(wish, JointAngle) and wish.at != POSE:
                given = self.inputs[self.wishes.names.index(wish.at) - 1].get(self.frame.joint(wish.joint))
                if given is not None and abs(wish.off(given)) > DOUBLE.zero:
                    stated = f"its input there is {degrees(given):g}°"
                    raise InvariantError("wishes", f"the wish for the {wish} contradicts its input", stated)

    @cached_property
    def _frames(self) -> Floats:
        """Folded states of a flat sheet, which is singular itself: float[F, J], none of others."""
        sheet = self.family.sheet
        return np.zeros((0, self.joints)) if sheet is None or self.zero.any() else folded_frames(sheet)

    def folded(self, number: int) -> list[Floats]:
        """Return the folded state of a flat sheet whose driven joint is nearest to its input, where it has one."""
        if not len(self._frames):
            return []
        given = [(joint, angle) for joint, angle in self.inputs[number].items() if self._frames[:, joint].any()]
        off = sum((np.abs(self._frames[:, joint] - angle) for joint, angle in given), np.zeros(len(self._frames)))
        return [self._frames[int(off.argmin()) if given else len(self._frames) // 2]]

    def held(self, number: int, angles: Floats) -> Floats:
        """Return joint angles with the inputs of a configuration."""
        changed = angles.copy()
        for joint, angle in self.inputs[number].items():
            changed[joint] = angle
        return changed

    def joined(self, numbers: Floats, angles: Sequence[Floats]) -> Floats:
        """Return all unknowns in one row."""
        return np.concatenate([numbers, *(one[free] for one, free in zip(angles, self.free, strict=True))])

    def parted(self, unknowns: Floats) -> tuple[Floats, list[Floats]]:
        """Return the numbers, and the joint angles of each configuration."""
        angles = []
        for number, (free, columns) in enumerate(zip(self.free, self.columns, strict=True)):
            one = self.held(number, self.zero)
            one[free] = unknowns[columns]
            angles.append(one)
        return unknowns[: self.numbers], angles

    def evaluated(self, unknowns: Floats) -> DesignStep:
        """Return all equations at some unknowns."""
        numbers, angles = self.parted(unknowns)
        design = self.family.linkage(numbers)
        parts = [self._closed(design, angles)] if angles else []
        configurations = {POSE: DesignConfiguration(self.frame, design, design.linkage.angles)}
        configurations |= {
            one.name: DesignConfiguration(self.frame, design, at)
            for one, at in zip(self.wishes.configurations, angles, strict=True)
        }
        on_numbers = [rule(design) for rule in self.number_rules]
        rules = [self._missed(wish, configurations) for wish in self.wishes.rules]
        rules += [(off, self._by_numbers(by)) for off, by in on_numbers]
        wishes = [self._missed(wish, configurations) for wish in self.wishes.wishes]
        extent = self.frame.extent
        weights = [
            np.full(len(off), wish.weight / wish.scale(extent))
            for wish, (off, _) in zip(self.wishes.wishes, wishes, strict=True)
        ]
        vectors, matrices = [], []
        for rows in (parts, rules, wishes):
            vectors.append(np.concatenate([np.zeros(0), *(off for off, _ in rows)]))
            matrices.append(np.concatenate([np.zeros((0, self.size)), *(by for _, by in rows)]))
        (off, ruled, missed), (by_off, by_ruled, by_missed) = vectors, matrices
        weight = np.concatenate([np.zeros(0), *weights])
        counts = tuple(map(len, weights))
        turns = self._turns(angles)
        return DesignStep(design, off, ruled, missed, by_off, by_ruled, by_missed, weight, counts, *turns)

    def _turns(self, angles: Sequence[Floats]) -> tuple[Floats, Floats]:
        """Return how far joints turn from each configuration to the next, the file's first, and the derivatives."""
        if not self.wishes.between:
            return np.zeros(0), np.zeros((0, self.size))
        count, joints = len(angles), self.joints
        turns = np.diff(np.array([self.zero, *angles]), axis=0)
        by = np.zeros((count, joints, self.size))
        for number, (columns, free) in enumerate(zip(self.columns, self.free, strict=True)):
            places = np.arange(columns.start, columns.stop)
            by[number, free, places] = 1.0
            if number + 1 < count:
                by[number + 1, free, places] = -1.0
        return turns.ravel(), by.reshape(count * joints, self.size)

    def _by_numbers(self, slopes: Floats) -> Floats:
        whole = np.zeros((len(slopes), self.size))
        whole[:, : self.numbers] = slopes
        return whole

    def _closed(self, design: DesignedLinkage, angles: Sequence[Floats]) -> tuple[Floats, Floats]:
        """Return the closure residuals of all configurations, and their derivatives."""
        closure, every = self.frame.closure(design, len(angles)), np.concatenate(angles)
        off, jacobian = closure.at(every)
        twists, zeros = (np.tile(part, (len(angles), 1)) for part in design.dependence.arrays)
        whole = self._by_numbers(closure.opened(off, closure.by_axes(every) @ twists - jacobian @ zeros))
        by_angles = closure.opened(off, jacobian.toarray())
        for number, (columns, free) in enumerate(zip(self.columns, self.free, strict=True)):
            whole[:, columns] = by_angles[:, number * self.joints + free]
        return off, whole

    def _missed(self, wish: Wish, configurations: dict[str, DesignConfiguration]) -> tuple[Floats, Floats]:
        """Return by how much a wish misses, and its derivatives by all unknowns."""
        off, whole = np.zeros(0), np.zeros((0, self.size))
        for name, part in wish.misses(configurations).items():
            if not len(whole):
                off, whole = part.values, np.zeros((len(part.values), self.size))
            self._add(whole, name, part, configurations[name].design)
        return off, whole

    def _add(self, whole: Floats, name: str, part: Derived, design: DesignedLinkage) -> None:
        whole[:, : self.numbers] += part.by_numbers
        if name == POSE:  # its angles are those of the design
            whole[:, : self.numbers] += part.by_angles @ design.dependence.zeros
            return
        number = self.wishes.names.index(name) - 1
        whole[:, self.columns[number]] += part.by_angles[:, self.free[number]]

    def alone(self, number: int, numbers: Floats) -> Callable[[Floats], tuple[Floats, Floats]]:
        """Return the equations of one configuration with numbers held, as a function of its joint angles float[J].

        Residuals, and derivatives by the angles: of its closure equations, and wishes for it alone.
        """
        design = self.family.linkage(numbers)
        closure, frame = self.frame.closure(design), self.frame
        name = self.wishes.names[number + 1]
        own = [wish for wish in self.wishes.wishes if wish.configurations == (name,)]

        def equations(angles: Floats) -> tuple[Floats, Floats]:
            off, jacobian = closure.at(angles)
            values, slopes = [off], [closure.opened(off, jacobian.toarray())]
            configuration = DesignConfiguration(frame, design, angles)
            for wish in own:
                part, factor = wish.missed(configuration), wish.weight / wish.scale(frame.extent)
                values.append(factor * part.values)
                slopes.append(factor * part.by_angles)
            return np.concatenate(values), np.concatenate(slopes)

        return equations

    def tried(self, unknowns: Floats) -> DesignStep | None:
        """Return all equations, None where the numbers make no mechanism."""
        try:
            step = self.evaluated(unknowns)
        except SynthedraError:
            return None
        parts = (step.closure, step.rules, step.wishes, step.by_closure, step.by_rules, step.by_wishes)
        finite = all(np.isfinite(part).all() for part in parts)
        return step if finite else None
