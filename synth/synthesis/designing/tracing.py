"""Defects of designs: whether a motion passes the configurations, on one circuit and branch, in order, and collides.

The driven joint is taken from one configuration to the next, by the walk of `synth.analysis.motion`; what the search
found is only compared with where that arrives. Theory: docs/theory/design.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import tau

import numpy as np

from graphs.errors import SynthedraError
from graphs.types import Floats
from synth.analysis.folding.panel_collisions import Collision
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.path import Path, PathOptions, circuit_through, driven_path
from synth.synthesis.designing.defects import Defect, DefectKind

_SAME = 1e-6
"""Radians by which a traced configuration may differ from one that was found. Both are solved to 1e-12, and near a
turning point half of these digits are lost; other assembly modes are farther off by orders of magnitude."""


@dataclass(frozen=True, slots=True)
class TracedMotion:
    """The motion of a design through its configurations, and what is wrong with it.

    `defects` are none of a sound design; `traced` is whether the configurations could be traced, as those of designs of
    one degree of freedom can; `inputs` are the angles of the driven joint where they are passed, radians, not wrapped.
    """

    defects: tuple[Defect, ...] = ()
    traced: bool = False
    inputs: tuple[float, ...] = ()


def off_by_turns(one: Floats, other: Floats) -> float:
    """Return the largest difference of joint angles, whole turns aside, radians."""
    return float(np.abs(np.remainder(one - other + np.pi, tau) - np.pi).max(initial=0.0))


def traced(
    closure: ClosureEquations, names: Sequence[str], angles: Sequence[Floats], driver: int, *, in_order: bool
) -> TracedMotion:
    """Return the motion of a linkage of one freedom that is to pass configurations float[J] in their order.

    Both senses of the driven joint are tried, up to one turn. If neither passes all, configurations are taken one by
    one: off the branch of the first (the driven joint would have to turn back), on another circuit, or out of order.
    """
    start = angles[0]
    values = np.array([one[driver] for one in angles])
    missed: int | None = None
    for sense in (1, -1, 0):
        path, goals = _traced_to(closure, start, driver, values[0] + np.cumsum(_steps(values, sense)))
        missed = _passed(path, angles)
        if missed is None and (sense or not in_order):
            return TracedMotion((), True, tuple(goals.tolist()))
    if missed is None:
        return TracedMotion((Defect(DefectKind.ORDER, tuple(names)),), True)
    circuit = _on_circuit(closure, angles, driver)
    if circuit is None:
        return TracedMotion((Defect(DefectKind.UNTRACED),))
    apart = tuple(names[place] for place, on in enumerate(circuit) if not on)
    if apart:
        return TracedMotion((Defect(DefectKind.CIRCUIT, apart, reference=names[0]),), True)
    return TracedMotion((Defect(DefectKind.BRANCH, (names[missed - 1], names[missed])),), True)


def traced_together(
    closure: ClosureEquations, names: Sequence[str], angles: Sequence[Floats], drivers: Sequence[int]
) -> TracedMotion:
    """Return the motion of a linkage with as many inputs as freedoms: all are driven straight on at once."""
    path = driven_path(closure, angles[0], drivers, np.array(angles)[1:, drivers])
    missed = _passed(path, angles)
    if missed is None:
        return TracedMotion((), True)
    return TracedMotion((Defect(DefectKind.INPUTS, (names[missed - 1], names[missed])),), True)


def collision_on_the_way(
    closure: ClosureEquations, names: Sequence[str], angles: Sequence[Floats], goals: Floats, drivers: Sequence[int],
    collision: Collision,
) -> Defect | None:  # fmt: skip
    """Return which panels pass through each other on the way through configurations; None if none do.

    Goals, float[F - 1, D], are those of the driven joints after the first configuration.
    """
    pair = collision.crossing(angles[0])
    if pair is not None:
        return Defect(DefectKind.COLLISION, (names[0],), parts=tuple(map(str, pair)))
    if not goals.size:
        return None
    options = PathOptions(events=[collision])
    path = driven_path(closure, angles[0], drivers, goals, options=options)
    met = next((event for event in path.events if event.kind == "collision"), None)
    if met is None:
        return None
    before = min(met.frame, len(names) - 2)
    return Defect(DefectKind.COLLISION, (names[before], names[before + 1]), parts=tuple(map(str, met.panels)))


def _steps(values: Floats, sense: int) -> Floats:
    """Return the turns from each value to the next, the first 0: the shortest, or all in one sense."""
    turns = np.diff(values, prepend=values[0])
    if not sense:
        return np.asarray(np.remainder(turns + np.pi, tau) - np.pi)
    return np.asarray(sense * np.remainder(sense * turns, tau))


def _traced_to(closure: ClosureEquations, start: Floats, driver: int, goals: Floats) -> tuple[Path | None, Floats]:
    if abs(goals[-1] - goals[0]) > tau:
        return None, goals
    return driven_path(closure, start, [driver], goals[1:, None]), goals


def _passed(path: Path | None, angles: Sequence[Floats]) -> int | None:
    """Return the first configuration that a path does not pass on one branch; None if it passes all."""
    if path is None:
        return 1
    turning = path.turning
    for place in range(1, len(angles)):
        reached = place < len(path.angles) and off_by_turns(path.angles[place], angles[place]) <= _SAME
        if not reached or any(frame <= place for frame in turning):
            return place
    return None


def _on_circuit(closure: ClosureEquations, angles: Sequence[Floats], driver: int) -> list[bool] | None:
    """Return which configurations are on the circuit of the first; None if it cannot be followed."""
    try:
        circuit = circuit_through(closure, angles[0])
    except SynthedraError:
        return None
    frames = circuit.angles
    on = []
    for one in angles:
        begin = int(np.abs(np.remainder(frames - one + np.pi, tau) - np.pi).max(axis=1).argmin())
        goal = frames[begin, driver] + (np.remainder(one[driver] - frames[begin, driver] + np.pi, tau) - np.pi)
        reached = driven_path(closure, frames[begin], [driver], [[goal]])
        on.append(off_by_turns(reached.angles[-1], one) <= _SAME)
    return on
