"""Members whose joints are not determined by count, or that are flat: each moves as `synth.move` moves it.

Loops of most crease patterns, and of spatial linkages that move, have redundant equations, so a square system does
not decide them; the walk of one member after the other does (`synth.motion.walk`).
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from graphs.errors import SynthedraError
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.folding.configuration import SheetConfiguration
from synth.members.member_type import BARRED, CLOSED, OPEN, TURNS_BACK, Swept
from synth.motion.configuration import Configuration
from synth.motion.driving import MotionOptions, driven_from
from synth.moving.made import configuration_of


def walked(
    members: Sequence[Callable[[], Configuration]],
    driven: Ints,
    inputs: Floats,
    joints: int,
    report: Callable[[int], None] | None,
) -> tuple[Swept, dict[int, str]]:
    """Move members, each made when it is its turn, to inputs, float[F, D] or float[N, F, D]: radians.

    Return the angles of all joints, and why members have none.
    """
    rows = inputs.shape[-2]
    answer = Swept(
        np.full((len(members), rows, joints), np.nan),
        np.full((len(members), rows), np.nan),
        np.full((len(members), rows), BARRED, dtype=np.int8),
    )
    why: dict[int, str] = {}
    for member, made in enumerate(members):
        try:
            own = made()
            answer.status[member] = OPEN
            for places, angles, errors in _moved(own, driven, inputs[member] if inputs.ndim == 3 else inputs):
                answer.status[member, places] = TURNS_BACK
                reached = places[: len(angles)]
                answer.status[member, reached] = CLOSED
                answer.angles[member, reached], answer.residuals[member, reached] = angles, errors
        except SynthedraError as error:
            why[member] = str(error)
        if report is not None:
            report(member + 1)
    return answer, why


def sheets_at(at: SheetConfiguration, coordinates: Floats) -> list[Callable[[], Configuration]]:
    """Return what makes the configuration of a crease pattern with each of some vertices, float[N, V, 3]."""

    def made(corners: Floats) -> Configuration:
        return configuration_of(replace(at.sheet, coordinates=tuple(map(tuple, corners.tolist()))))

    return [partial(made, corners) for corners in coordinates]


def _moved(own: Configuration, driven: Ints, values: Floats) -> Iterator[tuple[Ints, Floats, Floats]]:
    """Yield numbers of inputs, in the order in which they are come to, and the configurations at the first of them.

    One joint goes from where it is to larger angles, and to smaller ones; several go from input to input.
    """
    start = own.linkage.angles[driven]
    ways = [np.arange(len(values))]
    if len(driven) == 1:
        rising = np.argsort(values[:, 0], kind="stable")
        above = values[rising, 0] >= start[0]
        ways = [rising[above], rising[~above][::-1]]
    names = [own.joints[place] for place in driven.tolist()]
    for places in filter(len, ways):
        wanted = values[places]
        here = np.abs(wanted - start).max(axis=1) <= DOUBLE.closed
        if here.all():
            yield places, np.tile(own.linkage.angles, (len(places), 1)), np.zeros(len(places))
            continue
        goals = dict(zip(names, wanted[-1].tolist(), strict=True))
        path = driven_from(own, MotionOptions(goals, frames=len(wanted), values=wanted)).path
        frame, found = 0, list[int]()
        for value in wanted:  # frames at turning points stand between those at inputs
            off = np.abs(path.angles[frame:][:, driven] - value).max(axis=1) <= DOUBLE.same_configuration
            if not off.any():
                break
            frame += int(off.argmax())
            found.append(frame)
        yield places, path.angles[found], path.errors[found]
