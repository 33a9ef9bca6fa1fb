"""All positions of a general member of a family: solutions carried round closed curves of parameters.

A curve of members that comes back to where it began takes each position to a position; what is not known yet turns
up. Curves are walked until many in a row bring nothing new: with one position missing, each curve would bring it
unless it takes all known ones to known ones. Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphs.errors import NumericalError, UnsolvableError
from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats
from synth.assembly.family import Family
from synth.assembly.kernel import CLOSED, Complexes

__all__ = ["GeneralPositions", "apart", "as_real", "general_positions", "same"]

_STARTS, _STEPS = 64, 25
_QUIET = 6
"""Curves in a row that bring nothing new, before the positions are taken for all."""
_MOST_CURVES = 60
_WIDE = 0.7
"""Imaginary parts of the angles of a general member's axes, at most, radians."""


@dataclass(frozen=True, slots=True)
class GeneralPositions:
    """All positions (complex[N, U]) of a general member, and how many closed curves were walked to find them."""

    parameters: Complexes
    values: Complexes
    curves: int


def general_positions(family: Family, seed: int = 0) -> GeneralPositions:
    """Return all positions of a random member of a family.

    Parameters
    ----------
    family : Family
    seed : int, optional
        Another seed is another member, and other curves.

    Raises
    ------
    UnsolvableError
        If the driven joints do not determine the others.
    NumericalError
        If the curves go on to bring new positions.

    Examples
    --------
    >>> ring, directions = np.array([[0, 1, 2, 3]]), np.array([[0, 0], [1, 0], [2, 0], [3, 0]])
    >>> four_bar = Family(ring, np.ones((1, 4)), directions, (0, 1, 2, 3), np.array([-1, 0, 1, 2]))
    >>> len(general_positions(four_bar).values)
    2
    """
    random = np.random.default_rng(seed)
    number, inputs = len(family.axes), family.driven
    here = np.concatenate([_random_axes(random, number), np.zeros(inputs, dtype=complex)])
    known = np.zeros((1, family.unknowns), dtype=complex)  # the pose at which the axes are told
    derivatives = family.derivatives(here, known[0])
    parts = as_real(derivatives)
    if rank_of(parts) < min(parts.shape):
        raise UnsolvableError("the driven joints do not determine the others: drive joints that do")
    known = apart(np.concatenate([known, _by_newton(family, here, random)]), family.turning)
    quiet = 0
    for curves in range(1, _MOST_CURVES + 1):
        turn = np.concatenate([_random_axes(random, number), _random(random, inputs, np.pi, np.pi)])
        there = _carried(family, (here, turn), known, random)
        back = _carried(family, (turn, here), there, random)
        more = apart(np.concatenate([known, back]), family.turning)
        quiet = quiet + 1 if len(more) == len(known) else 0
        known = more
        if quiet == _QUIET:
            return GeneralPositions(here, known, curves)
    raise NumericalError(f"after {_MOST_CURVES} curves new positions still appear, {len(known)} so far")


def apart(values: Complexes, turning: Flags) -> Complexes:
    """Return solutions each once; angles, which `turning` (bool[U]) marks, are the same but for whole turns.

    >>> apart(np.array([[0.0], [2 * np.pi], [1.0]]), np.array([True])).tolist()
    [[0.0], [1.0]]
    """
    kept: list[Complexes] = []
    for solution in values:
        if not same(np.array(kept).reshape(-1, len(turning)), solution, turning).any():
            kept.append(solution)
    return np.array(kept).reshape(-1, values.shape[1])


def same(values: Complexes, solution: Complexes, turning: Flags) -> Flags:
    """Return which of some solutions, complex[N, U], are one solution, complex[U]: bool[N]."""
    return np.asarray(
        np.abs(_unturned(values - solution, turning)).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    )


def as_real(matrix: Complexes) -> Floats:
    """Return a complex matrix as a real one of twice its size, and twice its rank."""
    return np.block([[matrix.real, -matrix.imag], [matrix.imag, matrix.real]])


def _unturned(unknowns: Complexes, turning: Flags) -> Complexes:
    """Return unknowns, angles without whole turns."""
    return np.asarray(unknowns - 2 * np.pi * np.where(turning, np.rint(unknowns.real / (2 * np.pi)), 0.0))


def _by_newton(family: Family, parameters: Complexes, random: np.random.Generator) -> Complexes:
    """Return solutions that random starts come to."""
    starts = _random(random, (_STARTS, family.unknowns), np.pi, 1.5)
    many = np.tile(parameters, (_STARTS, 1))
    values, error = family.corrected(many, starts, _STEPS)
    return values[error <= CLOSED]


def _carried(
    family: Family, ends: tuple[Complexes, Complexes], values: Complexes, random: np.random.Generator
) -> Complexes:
    """Return solutions carried from one member to another along a random curve."""
    bend = _random(random, len(ends[0]), 1.0, 1.0)
    first, last, bent = (np.tile(one, (len(values), 1)) for one in (*ends, bend))
    found = family.followed((first, last, bent), values)
    return found.values[found.arrived]


def _random_axes(random: np.random.Generator, number: int) -> Complexes:
    """Return complex angles of axes."""
    tilts, turns = random.uniform(0.4, np.pi - 0.4, number), random.uniform(-np.pi, np.pi, number)
    pairs = np.stack([tilts, turns], axis=1) + 1j * random.uniform(-_WIDE, _WIDE, (number, 2))
    return np.asarray(pairs.ravel())


def _random(random: np.random.Generator, shape: int | tuple[int, int], real: float, imaginary: float) -> Complexes:
    return np.asarray(random.uniform(-real, real, shape) + 1j * random.uniform(-imaginary, imaginary, shape))
