"""How precise a drawing is, estimated from its geometry.

Relations that a drawing was made to hold are off by what its coordinates are, all alike when they are measured as
displacements of a coordinate; those that hold by chance are off by anything. So the deviations of what was meant
are a cluster far below the others. Theory: docs/theory/precision.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, log2, sqrt

import numpy as np
import scipy.sparse

from graphs.arrays import Floats
from graphs.mechanism.evidence.relations import OF_45, Relations, nearly_exact, nearly_fine, nearly_soft
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, EPSILON

__all__ = ["Estimate", "estimate_of"]

_WIDE = 16.0
"""The deviations of a cluster are looked for between a largest one and this part of it."""
_LEAST = 4
"""Of fewer relations nothing is estimated."""
_LEAST_SOFT = 12
"""Of fewer equal angles and lengths neither: a search for coordinates ends near them."""
_BY_CHANCE = 0.05
"""No more of a cluster may be expected by chance, as part of its size,"""
_BY_CHANCE_SOFT = 0.01
"""of relations that neighbours may have nearly on purpose, fewer still,"""
_UNLIKELY = log(1e6)
"""and it is as unlikely by chance as this, at least."""
_SHARE = 0.15
"""A cluster above what is exact is this part of both, at least."""
_TOP = 4.0
"""Largest deviation of a cluster, in root mean squares."""
_BULK = 2.0
"""So many root mean squares hold most errors."""
_ROUNDS = 30
_ALIKE = 0.7
"""Errors differ: a quarter of them is a third of another quarter. Angles of a curve are all off by the same."""
_SMALL, _FEW = 8.0, 0.02
"""A tenth of errors is smaller than this part of their root mean square: less than a fiftieth if they are none."""
_ENOUGH, _MANY = 8, 60
"""So many deviations show whether they differ, and whether some are small."""
_FIGURES = 3
"""More figures of an estimate would be those of rounding."""
_COARSEST = 3e-3
"""As a precision of drawings nothing coarser is estimated, in units of the extent."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """An estimated precision.

    Attributes
    ----------
    size : float
        Error of a coordinate, in units of the extent.
    relations : int
        How many hold to that.
    kinds : tuple of str
        Of which kinds, the most frequent first.
    by_chance : float
        How many would by chance.
    margin : float or None
        How many times the largest deviation of them the next larger one is; None if there is none.
    """

    size: float
    relations: int
    kinds: tuple[str, ...]
    by_chance: float
    margin: float | None

    def __str__(self) -> str:
        named = ", ".join(self.kinds[:2])
        return f"{self.relations} relations ({named}) hold to {self.size:.0e}, {self.by_chance:.1g} by chance"


def estimate_of(sheet: Sheet) -> Estimate | None:
    """Return how precise the coordinates of a sheet are by its geometry; None where nothing can be estimated.

    >>> from math import cos, sin
    >>> grid = [(x * cos(.6) - y * sin(.6), x * sin(.6) + y * cos(.6)) for x in range(4) for y in range(4)]
    >>> places = tuple((round(x, 4), round(y, 4)) for x, y in grid)
    >>> faces = tuple((k, k + 4, k + 5, k + 1) for k in range(11) if k % 4 < 3)
    >>> found = estimate_of(Sheet(16, (), "", faces, places))
    >>> 1e-5 < found.size < 1e-4
    True
    """
    if sheet.coordinates is None or not sheet.faces:
        return None
    points = np.zeros((len(sheet.coordinates), 3))
    points[:, : len(sheet.coordinates[0])] = sheet.coordinates
    points -= points.mean(axis=0)
    extent = float(np.abs(points).max())
    if extent == 0.0:
        return None
    points /= extent
    exact = nearly_exact(sheet, points)
    # Where many angles are near multiples of 45 degrees by chance the others may show a cluster without them.
    found = _estimated(exact) or _estimated([one for one in exact if one.kind != OF_45])
    found = found or _estimated([*exact, nearly_fine(sheet, points)])
    if found is not None and found.size > DOUBLE.closed:
        return found
    soft = _estimated(nearly_soft(sheet, points), _BY_CHANCE_SOFT)
    # A few exact relations, as of the corners of a border, say nothing of the vertices inside.
    few = 0 if found is None else 2 * found.relations
    return found if soft is None or soft.relations < max(_LEAST_SOFT, few) else soft


def _estimated(relations: Sequence[Relations], by_chance: float = _BY_CHANCE) -> Estimate | None:
    """Return what relations say; None if no cluster of them is more than chance.

    Of clusters above what is exact it is the finest that has half as many relations as the largest: of a finer one
    it may be the tail, and a coarser one may hold what is nearly so on purpose.
    """
    off = np.concatenate([one.off for one in relations]) if relations else np.zeros(0)
    if len(off) < _LEAST:
        return None
    density = float((1.0 / np.concatenate([one.reach for one in relations])).sum())
    clusters = {_settled(off, top) for top in _tops(np.sort(off), density)}
    meant = {rms: _held(off, rms) for rms in sorted(clusters) if _is_meant(off, rms, density, by_chance)}
    above = [rms for rms in meant if sqrt(3.0) * rms > DOUBLE.closed]
    most = max((len(meant[rms]) for rms in above), default=0)
    chosen = next((rms for rms in above if 2 * len(meant[rms]) >= most), None)
    if chosen is not None and _of_one_vertex(relations, off, chosen):
        chosen = None
    if chosen is None:
        chosen = next((rms for rms in meant if rms not in above), None)
    return None if chosen is None else _described(relations, off, chosen, density)


def _of_one_vertex(relations: Sequence[Relations], off: Floats, rms: float) -> bool:
    """Tell whether what is not exact is so for one vertex: that is off, and not the drawing imprecise."""
    exact = sqrt(3.0) * off <= DOUBLE.closed
    wrong = (off <= _TOP * rms) & ~exact
    if exact.sum() < _SHARE * wrong.sum():
        return False
    between = scipy.sparse.vstack([one.between for one in relations]).tocsr()[np.flatnonzero(wrong)]
    rows, columns = between.nonzero()
    pairs = np.unique(np.stack([rows, columns // 3]), axis=1)
    often = np.bincount(pairs[1])
    return bool(often.max(initial=0) == wrong.sum())


def _held(off: Floats, rms: float) -> Floats:
    """Return the deviations of a cluster that are neither far above it nor exact."""
    held: Floats = off[(off <= _TOP * rms) & (off > rms / _WIDE)]
    return held


def _is_meant(off: Floats, rms: float, density: float, by_chance: float) -> bool:
    """Tell whether a cluster is no chance, no coarser than drawings are, and as uneven as errors are."""
    if sqrt(3.0) * rms > _COARSEST or _BULK * rms * density > by_chance * int((off <= _BULK * rms).sum()):
        return False
    held = _held(off, rms)
    if len(held) < _ENOUGH or rms <= _SMALL**2 * DOUBLE.closed:
        return True
    low, high = np.quantile(held, [0.25, 0.75])
    if low > _ALIKE * high:
        return False
    small = int(((off <= rms / _SMALL) & (off > max(rms / _SMALL**2, DOUBLE.closed))).sum())
    return len(held) < _MANY or small >= _FEW * len(held)


def _tops(off: Floats, density: float) -> list[float]:
    """Return largest deviations of clusters that are more than chance, the finest first; deviations are sorted."""
    powers = np.arange(int(log2(EPSILON)) - 4, -3)
    tops = np.exp2(powers.astype(float))
    below = np.searchsorted(off, tops, side="right")
    within = below - np.searchsorted(off, tops / _WIDE, side="right")
    chance = tops * density
    within[0] = below[0]  # all that is exact
    unlikely = within * np.log(np.maximum(within, 1) / chance) - within + chance
    good = (
        (within >= _LEAST) & (chance <= _BY_CHANCE * within) & (unlikely >= _UNLIKELY) & (within >= _SHARE * below)
    )
    return [float(top) for top in tops[good]]


def _settled(off: Floats, top: float) -> float:
    """Return the root mean square of the errors in a cluster: of those that are neither far above nor exact."""
    rms = top
    for _ in range(_ROUNDS):
        held = _held(off, rms)
        now = float(np.sqrt((held**2).mean())) if len(held) else 0.0
        if now == rms or not now:
            break
        rms = now
    return max(rms, EPSILON)


def _described(relations: Sequence[Relations], off: Floats, rms: float, density: float) -> Estimate:
    top = _TOP * rms
    numbers = {one.kind: 0 for one in relations}
    for one in relations:
        numbers[one.kind] += int((one.off <= top).sum())
    kinds = sorted((kind for kind, number in numbers.items() if number), key=lambda kind: -numbers[kind])
    above, held = off[off > top], off[off <= top]
    largest = float(held.max(initial=0.0))
    margin = float(above.min()) / max(largest, EPSILON) if len(above) else None
    size, by_chance = (float(f"{number:.{_FIGURES}g}") for number in (sqrt(3.0) * rms, top * density))
    margin = None if margin is None else float(f"{margin:.{_FIGURES}g}")
    return Estimate(size, sum(numbers.values()), tuple(kinds), by_chance, margin)
