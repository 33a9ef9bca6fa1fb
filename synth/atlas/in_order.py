"""How near circuits come to single orientations or points in order, whatever they do between.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.atlas.signatures import Around, angles_between

_AT_ONCE, _EVEN, _DAMPED, _NUDGE = 32, 256, 0.01, 3e-4
"""Circuits that are compared with single orientations at once; places round each that are joined by cubics; damping
of least squares at first; parts of a circuit by which differences are taken."""


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
    >>> off, _ = differences_in_order(np.stack([circle, path]), path[[200, 130, 100, 40, 10]][:, [1, 2, 0]])
    >>> bool(off[1] < 1e-6 < 0.1 < off[0])
    True
    """
    wanted = angles_between(rows[:, None], rows[None])
    count = len(wanted)
    widest = [min(wanted[i, i - 1], wanted[i, i - 2], wanted[i - 1, i - 2]) for i in range(count)]
    first = int(np.argmax(np.round(widest, 6))) - 2  # the first three, which are chosen together, are far apart
    order = np.arange(first, first + count) % count
    wanted = wanted[np.ix_(order, order)]
    found = []
    for begin in range(0, len(circuits), _AT_ONCE):
        evenly = _Evenly(circuits[begin : begin + _AT_ONCE])
        parts = np.concatenate([way * _choices(evenly, wanted, way, effort) for way in (1, -1)], axis=1)
        ways = np.broadcast_to(np.repeat([1.0, -1.0], effort.starts), parts.shape[:2])
        for steps, kept in ((effort.steps, max(1, effort.starts // 4)), (2 * effort.steps, 1)):
            off, parts = _refined(evenly, parts, ways, wanted, steps)
            best = np.argsort(off, axis=1, kind="stable")[:, :kept]
            parts, ways = np.take_along_axis(parts, best[..., None], axis=1), np.take_along_axis(ways, best, axis=1)
        found.append((off.min(axis=1), parts[:, 0]))
    off, places = (np.concatenate(some) for some in zip(*found, strict=True))
    return off, np.remainder(places[:, np.argsort(order)], 1.0)


class _Evenly:
    """Circuits at places of equal distances, read between these by cubics: faster than by `Around`."""

    def __init__(self, circuits: Floats) -> None:
        at = Around(circuits).at(np.broadcast_to(np.arange(-1, _EVEN + 2) / _EVEN, (len(circuits), _EVEN + 3)))
        if at.shape[2] == 4:  # of two quaternions of a rotation the nearer one
            dots = (at[:, 1:] * at[:, :-1]).sum(axis=2)
            at[:, 1:] *= np.cumprod(np.where(dots < 0.0, -1.0, 1.0), axis=1)[..., None]
        self._rows, self.count = at, len(circuits)

    def at(self, parts: Floats) -> Floats:
        """Return unit vectors at parts of the lengths, float[n, ..., d]."""
        along = np.remainder(parts, 1.0) * _EVEN
        place = np.minimum(along.astype(np.int64), _EVEN - 1)
        t = along - place
        a, b, c = t + 1.0, t - 1.0, t - 2.0
        who = np.arange(self.count).reshape(-1, *(1,) * (parts.ndim - 1))
        total = np.zeros((*parts.shape, self._rows.shape[2]))
        for node, weight in enumerate((-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0)):
            total += weight[..., None] * self._rows[who, place + node]
        return np.asarray(total / np.linalg.norm(total, axis=-1, keepdims=True))


def _choices(evenly: _Evenly, wanted: Floats, way: int, effort: Effort) -> Floats:
    """Return choices of places in one direction that miss angles float[k, k] least: parts of circuits float[n, S, k].

    Three places are chosen together, from all, then one after the other; the least sums of squares are kept.
    """
    circuits, size, count = evenly.count, effort.places, len(wanted)
    at = evenly.at(np.broadcast_to(way * np.arange(size) / size, (circuits, size)))
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


def _refined(evenly: _Evenly, parts: Floats, ways: Floats, wanted: Floats, steps: int) -> tuple[Floats, Floats]:
    """Return how much parts of circuits, float[n, B, k], miss angles float[k, k] once they are refined, and the parts.

    The method is that of Levenberg and Marquardt; parts keep their order, each in its way, float[n, B].
    """
    at, way = evenly.at, ways[..., None]
    one, other = np.triu_indices(len(wanted), 1)
    angles, pairs = wanted[one, other], np.arange(len(one))

    def misses(some: Floats, others: Floats) -> Floats:
        return angles_between(some[:, :, one], others[:, :, other]) - angles

    here = at(parts)
    miss = misses(here, here)
    damping, nudge = np.full(parts.shape[:2], _DAMPED), _NUDGE * way
    for _ in range(steps):
        behind, ahead = at(parts - nudge), at(parts + nudge)  # of two equal places neither may overtake the other
        rates = np.zeros((*parts.shape[:2], len(pairs), parts.shape[2]))
        rates[:, :, pairs, one] = (miss - misses(behind, here)) / nudge
        rates[:, :, pairs, other] = (misses(here, ahead) - miss) / nudge
        gram = np.swapaxes(rates, 2, 3) @ rates
        sizes = np.einsum("...ii->...i", gram)
        damped = damping[..., None] * sizes + DOUBLE.clear * sizes.sum(axis=2, keepdims=True)
        gram += np.eye(len(wanted)) * damped[..., None]
        step = np.linalg.solve(gram, np.swapaxes(rates, 2, 3) @ miss[..., None])[..., 0]
        along = np.maximum.accumulate(way * (parts - step), axis=2)
        trial = way * np.minimum(along, along[:, :, :1] + 1.0)
        there = at(trial)
        off = misses(there, there)
        better = (off**2).sum(axis=2) < (miss**2).sum(axis=2)
        parts, miss = (np.where(better[..., None], *pair) for pair in ((trial, parts), (off, miss)))
        here = np.where(better[..., None, None], there, here)
        damping = np.where(better, damping / 5.0, damping * 5.0)
    return np.sqrt((miss**2).mean(axis=2)), parts
