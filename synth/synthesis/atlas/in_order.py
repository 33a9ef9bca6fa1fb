"""How near circuits come to single orientations or points in order, whatever they do between.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.least_squares.batched import BatchedSearch
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt
from graphs.least_squares.steps import by_each_unknown
from graphs.types import Floats, Ints
from synth.synthesis.atlas.signatures import Around, angles_between


@dataclass(frozen=True, slots=True, kw_only=True)
class _Refining(LevenbergMarquardt):
    """How places are refined."""

    at_once: int
    even: int
    nudge: float


_REFINING = _Refining(
    first=0.01,  # of each entry of the diagonal: choices among equal distances are a few degrees off
    raised=5.0,
    lowered=(5.0,),  # the same back: with so few steps the damping finds its size soonest
    at_once=32,  # circuits: bounds the memory of tables of all choices of three places
    even=256,  # places round each circuit, joined by cubics: what these miss is far below what circuits differ by
    nudge=3e-4,  # part of a circuit by which differences are taken: within one cubic
)


class Effort(NamedTuple):
    """How hard places for single orientations are looked for, in each direction of travel round a circuit.

    Places of which some are chosen, choices that are kept, those of them that are refined, and with how many steps;
    the best quarter of these is refined by twice as many steps again.
    """

    places: int
    choices: int
    starts: int
    steps: int


QUICK, THOROUGH = Effort(36, 128, 8, 5), Effort(54, 256, 24, 8)


def differences_in_order(circuits: Floats, rows: Floats, effort: Effort = THOROUGH) -> tuple[Floats, Floats]:
    """Return by how much circuits miss single orientations or points in order, and where they come nearest to these.

    Compared are the angles between all pairs of `rows`, float[k, d], k at least 3, and those between k places that
    follow each other within one round of a circuit, either way: frames of reference have no meaning. Choices among
    places of equal distances are refined by least squares; a nearer choice may be missed. Circuits, float[n, M, d],
    are as for `signatures_of`. The differences, float[n], are root mean squares in radians, the places, float[n, k],
    parts of the circuits.

    Examples
    --------
    >>> turn = np.linspace(0, 2 * np.pi, 256, endpoint=False)
    >>> path = np.stack([np.cos(turn), np.sin(turn), 0.5 * np.cos(2 * turn)], axis=1)
    >>> path /= np.linalg.norm(path, axis=1)[:, None]
    >>> circle = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    >>> differences, _ = differences_in_order(np.stack([circle, path]), path[[200, 130, 100, 40, 10]][:, [1, 2, 0]])
    >>> bool(differences[1] < 1e-6 < 0.1 < differences[0])
    True
    """
    wanted = angles_between(rows[:, None], rows[None])
    count = len(wanted)
    widest = [min(wanted[i, i - 1], wanted[i, i - 2], wanted[i - 1, i - 2]) for i in range(count)]
    first = int(np.argmax(np.round(widest, 6))) - 2  # the first three, which are chosen together, are far apart
    order = np.arange(first, first + count) % count
    wanted = wanted[np.ix_(order, order)]
    found = []
    for begin in range(0, len(circuits), _REFINING.at_once):
        evenly = _Evenly(circuits[begin : begin + _REFINING.at_once])
        parts = np.concatenate([way * _choices(evenly, wanted, way, effort) for way in (1, -1)], axis=1)
        ways = np.broadcast_to(np.repeat([1.0, -1.0], effort.starts), parts.shape[:2])
        for steps, kept in ((effort.steps, max(1, effort.starts // 4)), (2 * effort.steps, 1)):
            differences, parts = _refined(evenly, parts, ways, wanted, steps)
            # symmetric circuits pass equal angles twice: of choices that are equal but for rounding the first is kept
            best = np.argsort(np.round(differences, 9), axis=1, kind="stable")[:, :kept]
            parts, ways = np.take_along_axis(parts, best[..., None], axis=1), np.take_along_axis(ways, best, axis=1)
        found.append((differences.min(axis=1), parts[:, 0]))
    differences, places = (np.concatenate(some) for some in zip(*found, strict=True))
    return differences, np.remainder(places[:, np.argsort(order)], 1.0)


class _Evenly:
    """Circuits at places of equal distances, read between these by cubics: faster than by `Around`."""

    def __init__(self, circuits: Floats) -> None:
        even = _REFINING.even
        at = Around(circuits).at(np.broadcast_to(np.arange(-1, even + 2) / even, (len(circuits), even + 3)))
        if at.shape[2] == 4:  # of two quaternions of a rotation the nearer one
            dots = (at[:, 1:] * at[:, :-1]).sum(axis=2)
            at[:, 1:] *= np.cumprod(np.where(dots < 0.0, -1.0, 1.0), axis=1)[..., None]
        self._rows, self.count = at, len(circuits)

    def at(self, circuits: Ints, parts: Floats) -> Floats:
        """Return unit vectors at parts float[k, p] of the lengths of circuits, int[k]: float[k, p, d]."""
        along = np.remainder(parts, 1.0) * _REFINING.even
        place = np.minimum(along.astype(np.int64), _REFINING.even - 1)
        t = along - place
        a, b, c = t + 1.0, t - 1.0, t - 2.0
        total = np.zeros((*parts.shape, self._rows.shape[2]))
        for node, weight in enumerate((-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0)):
            total += weight[..., None] * self._rows[circuits[:, None], place + node]
        return np.asarray(total / np.linalg.norm(total, axis=-1, keepdims=True))


def _choices(evenly: _Evenly, wanted: Floats, way: int, effort: Effort) -> Floats:
    """Return choices of places in one direction that miss angles float[k, k] least: parts of circuits float[n, S, k].

    Three places are chosen together, from all, then one after the other; the least sums of squares are kept.
    """
    circuits, size, count = evenly.count, effort.places, len(wanted)
    at = evenly.at(np.arange(circuits), np.broadcast_to(way * np.arange(size) / size, (circuits, size)))
    table = angles_between(at[:, :, None], at[:, None]).astype(np.float32)
    squares = {pair: (table - np.float32(wanted[pair])) ** 2 for pair in combinations(range(count), 2)}
    later = np.array(np.triu_indices(size))  # how far the second and third place are after the first
    first = np.repeat(np.arange(size), later.shape[1])
    second, third = ((first + np.tile(each, size)) % size for each in later)
    sums = np.zeros((circuits, len(first)), np.float32)
    three = (first, second, third)
    for one, other in combinations(range(3), 2):
        sums += np.take(squares[one, other].reshape(circuits, -1), three[one] * size + three[other], axis=1)
    who = np.arange(circuits)[:, None]
    kept = np.argpartition(sums, effort.choices, axis=1)[:, : effort.choices]
    sums, places = sums[who, kept], np.stack(three, axis=1)[kept]
    for number in range(3, count):
        more = np.repeat(sums[:, :, None], size, axis=2)
        for before in range(number):
            more += squares[before, number][who, places[:, :, before]]
        offset = (np.arange(size) - places[:, :, :1]) % size
        more[offset < offset[who, np.arange(effort.choices), places[:, :, -1]][:, :, None]] = np.inf
        more = more.reshape(circuits, -1)
        kept = np.argpartition(more, effort.choices, axis=1)[:, : effort.choices]
        sums = more[who, kept]
        places = np.concatenate([places[who, kept // size], (kept % size)[:, :, None]], axis=2)
    return _apart(sums, places, effort)


def _apart(sums: npt.NDArray[np.float32], places: Ints, effort: Effort) -> Floats:
    """Return the best choices that differ by two places or more, as parts of circuits that never decrease."""
    size, who, chosen = effort.places, np.arange(len(sums)), []
    for _ in range(effort.starts):
        chosen.append(places[who, sums.argmin(axis=1)])
        gap = np.abs((places - chosen[-1][:, None] + size // 2) % size - size // 2).max(axis=2)
        sums = np.where(gap < 2, np.inf, sums)
    starts = np.stack(chosen, axis=1)
    offsets = (starts - starts[:, :, :1]) % size
    spread = 0.5 * np.arange(starts.shape[2]) / starts.shape[2]  # equal places are no start for least squares
    return np.asarray((starts[:, :, :1] + offsets + spread) / size)


class _PlacesInOrder:
    """Places on circuits, int[n], that keep their order, each in its way, float[n]: a `BatchedSystem`.

    Residuals are the angles between all pairs of places less those of the pairs of `wanted`, float[k, k].
    """

    def __init__(self, evenly: _Evenly, circuits: Ints, ways: Floats, wanted: Floats) -> None:
        self._evenly, self._circuits, self._ways = evenly, circuits, ways[:, None]
        self._one, self._other = np.triu_indices(len(wanted), 1)
        self._wanted = wanted[self._one, self._other]

    def residual(self, which: Ints, unknowns: Floats) -> tuple[Floats, Floats]:
        """Return residuals, and unit vectors at the places."""
        here = self._evenly.at(self._circuits[which], unknowns)
        return self._between(here, here), here

    def jacobian(self, which: Ints, unknowns: Floats, residual: Floats, data: Floats) -> Floats:
        """Return derivatives by differences: of two equal places neither may overtake the other."""
        nudge, pairs = _REFINING.nudge * self._ways[which], np.arange(len(self._one))
        behind, ahead = (self._evenly.at(self._circuits[which], unknowns + sign * nudge) for sign in (-1.0, 1.0))
        jacobian = np.zeros((*residual.shape, unknowns.shape[1]))
        jacobian[:, pairs, self._one] = (residual - self._between(behind, data)) / nudge
        jacobian[:, pairs, self._other] = (self._between(data, ahead) - residual) / nudge
        return jacobian

    def moved(self, which: Ints, unknowns: Floats, step: Floats) -> Floats:
        """Return the places after steps: none overtakes the one before it, nor the first by a whole round."""
        way = self._ways[which]
        along = np.maximum.accumulate(way * (unknowns + step), axis=1)
        return np.asarray(way * np.minimum(along, along[:, :1] + 1.0))

    def _between(self, some: Floats, others: Floats) -> Floats:
        return np.asarray(angles_between(some[:, self._one], others[:, self._other]) - self._wanted)


def _refined(evenly: _Evenly, parts: Floats, ways: Floats, wanted: Floats, steps: int) -> tuple[Floats, Floats]:
    """Return how much parts of circuits, float[n, B, k], miss angles float[k, k] once they are refined, and the parts.

    Parts keep their order, each in its way, float[n, B].
    """
    shape = parts.shape
    circuits = np.repeat(np.arange(shape[0]), shape[1])
    system = _PlacesInOrder(evenly, circuits, ways.reshape(-1), wanted)
    search = BatchedSearch(system, parts.reshape(-1, shape[2]), _REFINING, by_each_unknown)
    search.run(steps, np.arange(len(circuits)))
    missed = np.sqrt((search.residual**2).mean(axis=1))
    return missed.reshape(shape[:2]), search.unknowns.reshape(shape)
