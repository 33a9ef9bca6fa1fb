"""Circuits: how the joints of a loop follow each other round the circle.

A loop is given by its signed steps, the projected angles between successive joint axes. Sources: Hyatt et al.
2020, Table 1 (printed with every row inverted, docs/misprints.md 000-1). Theory:
docs/theory/conformed.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.tolerances import DOUBLE
from graphs.types import Floats

__all__ = ["HALF_TURN", "Circuits", "azimuths", "circuits", "closing_step", "table1", "wrapped"]

HALF_TURN = np.pi - DOUBLE.parallel
"""Steps between azimuths that are this wide (radians) are half a turn, and have no sign."""


@dataclass(frozen=True, slots=True)
class Circuits:
    """What loops look like on the circle.

    Attributes
    ----------
    open : bool[...]
        Whether the joints follow each other once round the circle: the polygon of the links is convex. Else it
        is crossed.
    turns : int[...]
        k: the steps sum to 360 k degrees, so the links wind k times round the axis.
    density : int[...]
        How often the polygon winds when every step is taken the same way round, the shorter of both ways: 1 if
        it is open.
    residual : float[...]
        Sum of the steps less 2 pi k, radians.

    Examples
    --------
    >>> found = circuits(np.radians([90, 90, 90, 90]))
    >>> bool(found.open), int(found.turns)
    (True, 1)
    """

    open: npt.NDArray[np.bool_]
    turns: npt.NDArray[np.int64]
    density: npt.NDArray[np.int64]
    residual: Floats

    def names(self) -> npt.NDArray[np.str_]:
        """Return ``open`` or ``crossed``."""
        return np.where(self.open, "open", "crossed")


def circuits(steps: npt.ArrayLike) -> Circuits:
    """Return the circuits of loops of any number of links.

    Parameters
    ----------
    steps : float[..., n]
        Projected angles in loop order, radians, in [-pi, pi]. Their sum is taken as a multiple of 2 pi; see the
        residual.

    Examples
    --------
    A pentagon, and the star on its five corners:

    >>> found = circuits(np.radians([[72, 72, 72, 72, 72], [144, 144, 144, 144, 144]]))
    >>> found.names().tolist(), found.turns.tolist(), found.density.tolist()
    (['open', 'crossed'], [1, 2], [1, 2])
    """
    steps = np.asarray(steps, dtype=float)
    n = steps.shape[-1]
    total = steps.sum(axis=-1)
    turns = np.rint(total / (2 * np.pi)).astype(np.int64)
    winds = turns + (steps < 0).sum(axis=-1)  # each negative step the other way round adds one turn
    density = np.minimum(winds, n - winds)
    return Circuits(density == 1, turns, density, total - 2 * np.pi * turns)


def table1(steps: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Tell whether four-bars are open, by signs and sum of their steps (Hyatt et al. 2020, Table 1, put right).

    Open: all signs multiply to + and the sum is +-360 degrees, or to - and it is 0.

    Parameters
    ----------
    steps : float[..., 4]

    Examples
    --------
    >>> steps = [[90, 80, 100, 90], [50, 40, 30, -120], [100, -50, 100, -150], [170, 170, 170, -150]]
    >>> table1(np.radians(steps)).tolist()
    [True, True, False, False]
    """
    steps = np.asarray(steps, dtype=float)
    even = np.sign(steps).prod(axis=-1) > 0
    return np.asarray(even == (np.abs(steps.sum(axis=-1)) > np.pi))


def wrapped(angles: npt.ArrayLike) -> Floats:
    """Return angles in (-pi, pi].

    Parameters
    ----------
    angles : float[...]
        Radians.

    Returns
    -------
    float[...]

    Examples
    --------
    >>> np.degrees(wrapped(np.radians([190, -180, 540, 30]))).round(9).tolist()
    [-170.0, 180.0, 180.0, 30.0]
    """
    angles = np.asarray(angles, dtype=float)
    turned = np.remainder(angles + np.pi, 2 * np.pi) - np.pi
    return np.where(turned <= -np.pi + 1e-15, np.pi, turned)


def azimuths(steps: npt.ArrayLike, first: float = 0.0) -> Floats:
    """Return the azimuths of the joints of loops; the last step leads back to the first joint.

    Parameters
    ----------
    steps : float[..., n]
    first : float, optional
        Azimuth of the first joint, radians.

    Returns
    -------
    float[..., n]
        Not wrapped.

    Notes
    -----
    Steps found numerically close with a small error. It is left to the longest step of each loop, whose link angle
    feels it least.

    Examples
    --------
    >>> np.degrees(azimuths(np.radians([90, 100, 80, 90]))).round(9).tolist()
    [0.0, 90.0, 190.0, 270.0]
    """
    steps = np.array(steps, dtype=float)
    longest = np.abs(steps).argmax(axis=-1)[..., np.newaxis]
    total = steps.sum(axis=-1, keepdims=True)
    error = total - 2 * np.pi * np.rint(total / (2 * np.pi))
    np.put_along_axis(steps, longest, np.take_along_axis(steps, longest, -1) - error, -1)
    places = np.cumsum(steps, axis=-1)
    return np.asarray(first + np.concatenate([np.zeros_like(error), places[..., :-1]], axis=-1))


def closing_step(steps: npt.ArrayLike) -> Floats:
    """Return the step that closes loops: lambda and all projected angles but one describe a linkage (Eq. 14).

    Parameters
    ----------
    steps : float[..., n - 1]

    Returns
    -------
    float[...]
        In (-pi, pi].

    Examples
    --------
    Hyatt et al. 2020, Fig. 11: from the last of the seven axes to the first.

    >>> float(np.degrees(closing_step(np.radians([-40, -20, -45, -68, 28, 30]))).round(9))
    115.0
    """
    return wrapped(-np.asarray(steps, dtype=float).sum(axis=-1))
