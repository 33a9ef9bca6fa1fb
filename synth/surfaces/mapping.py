"""What mapping a loop to a cone or a cylinder gives: one circle after the other, and families of them.

Both surfaces share this: `synth.surfaces.cone` and `synth.surfaces.cylinder` say what the circles mean.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from synth.surfaces.circuit import circuits
from synth.surfaces.loop_sums import Base, half_steps, loop_roots

__all__ = ["FamilyOfCircles", "MappedLoop", "in_degrees", "mapped_loop"]

_SAME = 1e-12


@dataclass(frozen=True, slots=True)
class MappedLoop:
    """A loop on its circle.

    Attributes
    ----------
    size : float
        Cone angle lambda, radians, or radius R of the cylinder.
    circuit : {"open", "crossed"}
    signs : tuple of int
        Of the steps, in loop order; the first is +.
    turns : int
        k: the steps sum to 360 k degrees.
    density : int
        How often the polygon winds; 1 if it is open.
    steps : tuple of float
        Projected angles, radians.
    residual : float
        Sum of the steps less 2 pi k, radians.
    double : bool
        Whether the loop sum touches 360 k here, or ends here.
    half_turns : tuple of int
        Links that span half the circle: their steps have no sign and are listed as +.
    """

    size: float
    circuit: str
    signs: tuple[int, ...]
    turns: int
    density: int
    steps: tuple[float, ...]
    residual: float
    double: bool
    half_turns: tuple[int, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the loop as plain data, but for its size, which a cone and a cylinder name differently."""
        return {
            "circuit": self.circuit,
            "signs": list(self.signs),
            "k": self.turns,
            "density": self.density,
            "steps_deg": in_degrees(self.steps),
            "residual_deg": degrees(self.residual),
            "double": self.double,
            "half_turns": list(self.half_turns),
        }


@dataclass(frozen=True, slots=True)
class FamilyOfCircles:
    """An interval of circles on which a loop closes: its loop sum vanishes identically.

    Attributes
    ----------
    interval : (float, float)
        Least and greatest lambda (the least, 0, is the flat cone) or radius (the greatest is infinite).
    circuit : {"open", "crossed"}
        In the middle of the interval.
    signs : tuple of int
    turns : int
        k, always 0.
    """

    interval: tuple[float, float]
    circuit: str
    signs: tuple[int, ...]
    turns: int

    def to_json(self) -> dict[str, Any]:
        """Return the family as plain data, but for its interval."""
        return {"circuit": self.circuit, "signs": list(self.signs), "k": self.turns}


def in_degrees(values: Iterable[float]) -> list[float]:
    """Return degrees without the last digits that conversion from and to radians spoils, and without -0.

    Examples
    --------
    >>> in_degrees([np.radians(40.1), -0.0])
    [40.1, 0.0]
    """
    return [round(degrees(value), 12) + 0.0 for value in values]


def mapped_loop(reach: Floats, base: Base) -> tuple[tuple[MappedLoop, ...], tuple[FamilyOfCircles, ...]]:
    """Return all circles of one loop, and the families.

    Parameters
    ----------
    reach : float[n]
        As in `synth.surfaces.loop_sums`.
    base : {0, 1}
        0 on a cylinder, 1 on a cone.

    Notes
    -----
    A step of half a turn has no sign. Sign patterns that differ in such steps only are one linkage, listed with
    +; where it ends a family it is not listed.
    """
    roots = loop_roots(reach, base)
    families = {tuple(signs.tolist()) for signs in roots.family_signs}
    end = float(reach.min())
    found = []
    for signs, turns, z, residual, double in zip(
        roots.signs, roots.turns, roots.size, roots.residual, roots.double, strict=True
    ):
        half = np.flatnonzero((z == end) & (reach - z <= _SAME * np.maximum(reach, np.sqrt(reach))))
        if _listed_otherwise(signs, half) or _ends_a_family(signs, half, families):
            continue
        steps = 2.0 * signs * half_steps(z, reach, base)
        found.append(
            MappedLoop(
                _size(z, base),
                str(circuits(steps).names()),
                tuple(signs.tolist()),
                int(turns),
                int(circuits(steps).density),
                tuple(steps.tolist()),
                float(residual),
                bool(double),
                tuple(half.tolist()),
            )
        )
    interval = (0.0, _size(end, 1)) if base else (_size(end, 0), np.inf)
    found.sort(key=lambda one: one.size)
    return tuple(found), tuple(
        FamilyOfCircles(
            interval, str(circuits(2.0 * np.array(s) * half_steps(end / 2, reach, base)).names()), s, 0
        )
        for s in sorted(families, reverse=True)
    )


def _size(z: float, base: Base) -> float:
    return float(np.arctan(np.sqrt(z))) if base else float(0.5 / np.sqrt(z))


def _listed_otherwise(signs: npt.NDArray[np.int8], half: npt.NDArray[np.intp]) -> bool:
    """Tell whether other signs of half turns, or those of the mirror image, are the ones to list."""
    rest = np.delete(signs, half)
    return bool((signs[half] < 0).any() or (0 in half and len(rest) and rest[0] < 0))


def _ends_a_family(
    signs: npt.NDArray[np.int8], half: npt.NDArray[np.intp], families: set[tuple[int, ...]]
) -> bool:
    """Tell whether other signs of half turns make a pattern, or its mirror image, whose sum vanishes."""
    for family in families:
        for mirrored in (1, -1):
            differ = np.flatnonzero(signs * mirrored != np.array(family))
            if len(half) and set(differ.tolist()) <= set(half.tolist()):
                return True
    return False
