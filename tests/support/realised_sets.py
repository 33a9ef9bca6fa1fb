"""Sets of types that are realised: all of a size, or some of them, and what each does when it is moved."""

from dataclasses import dataclass
from math import pi, radians
from random import Random

import numpy as np

from enumerate.scd.jobs import scd_rows
from graphs.identity.drawings import mechanism_from_map_id
from graphs.mechanism.drawing import FaceKind
from graphs.rank.infinitesimal import infinitesimal_mobility
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.motion import fold

TURN = radians(10.0)


@dataclass(frozen=True)
class Moved:
    """A motion from a pose: how far the joint that turned most came, freedoms on the way, why it ended."""

    turned: float
    freedoms: set[int | None]
    closure: float
    limit: str


def codes_of(links, most, number=None):
    """Return the ids of the types with M = 1 of a size, or of some at random, always the same."""
    codes = [row["code"] for row in scd_rows(links, 1, most)]
    return codes if number is None else sorted(Random(0).sample(codes, number))


def is_explicit(scd):
    """Tell whether no centre lies across a hole."""
    return all(scd.drawing.kind_of_face(face.index) is not FaceKind.IMPLICIT for face in scd.faces)


def explicit_codes_of(links, most, number=None):
    """Return those whose centres are all explicit."""
    return [code for code in codes_of(links, most, number) if is_explicit(mechanism_from_map_id(code))]


def moved(sheet):
    """Turn the joint that moves most by ten degrees from the pose."""
    ready = configuration_of_sheet(sheet)
    rates = ready.branches.branches[0].rates
    driven = int(np.abs(rates).argmax())
    goal = ready.linkage.angles[driven] + TURN * np.sign(rates[driven])
    if abs(goal) > pi:
        goal -= 2 * TURN * np.sign(goal)
    folded = fold(sheet, drive={driven: goal}, frames=3)
    turned = float(np.abs(folded.path.angles - folded.path.angles[0]).max())
    freedoms = {infinitesimal_mobility(frame).dof for frame in folded.frames()[1:]}
    return Moved(turned, freedoms, folded.closure, folded.path.stopped)
