"""A sheet at a configuration, as the orders of its layers are asked for."""

from collections.abc import Mapping
from dataclasses import dataclass

from graphs.convert.duality import SheetMechanism
from graphs.mechanism.precision import Precision
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import Tolerances
from graphs.types import Floats
from synth.motion.linkage import Creases


@dataclass(frozen=True, eq=False)
class PosedSheet:
    """A sheet at a configuration.

    Attributes
    ----------
    sheet : Sheet
    mechanism : SheetMechanism
    creases : Creases
        Where they are between its panels.
    precision : Precision
    tolerances : Tolerances
    points : float[V, 3]
        The places of the vertices, in the unit of the coordinates.
    angles : float[J]
        The fold angles, radians, in the order of the joints.
    signs : mapping of joint id to bool
        Whether each crease is a valley, where that is known of those folded by 180 degrees.
    """

    sheet: Sheet
    mechanism: SheetMechanism
    creases: Creases
    precision: Precision
    tolerances: Tolerances
    points: Floats
    angles: Floats
    signs: Mapping[int, bool]
