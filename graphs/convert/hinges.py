"""Hinges between the same two panels: which of them lie on one line, and so are one joint.

Theory: docs/theory/crease-patterns.md, "Split hinges".
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, log10

import numpy as np
import numpy.typing as npt

from graphs.errors import numbered
from graphs.mechanism.sheet import COLLINEAR, Edge
from graphs.types import Floats

BENT = 0.03
"""Hinges farther off one line than this, in units of their lengths, are bent: equal ones by over 3.4 degrees."""

# Ratio of the ends of a plateau. Between errors of one size and bends there is a decade without any; between two errors
# of one drawing, hardly ever (docs/theory/crease-patterns.md).
_PLATEAU = 10.0

_APART = 1.0  # deviation that bent hinges count with: any number above `BENT` keeps them apart at all tolerances

_SHORTEST = 1e-12  # of the extent: hinges of no length are divided by this, which no two vertices of a sheet are apart

_AT_ONCE = 50_000  # pairs measured in one go: each takes nearly a kilobyte, so that memory stays below 50 MB

Indices = npt.NDArray[np.int64]

Groups = frozenset[tuple[int, ...]]
"""The places of hinges in their bundle, line by line."""


@dataclass(frozen=True)
class HingeLines:
    """Bundles of hinges, a bundle for two panels, grouped by the lines on which they lie.

    For each bundle, each group has the indices of its hinges. `within` is the largest deviation of two hinges of a
    group from one line, in units of their lengths, `loosely` how many joints fewer there are than with the
    tolerance ``COLLINEAR``, `unclear` how many hinges stay apart from others, but may lie on a line with them.
    """

    groups: tuple[tuple[tuple[int, ...], ...], ...]
    within: float = 0.0
    loosely: int = 0
    unclear: int = 0

    @property
    def repairs(self) -> tuple[str, ...]:
        """The joined hinges that a tight tolerance leaves apart, in words."""
        if not self.loosely:
            return ()
        unit = 10.0 ** floor(log10(self.within))
        return (f"hinges within {ceil(self.within / unit) * unit:.0e} of a line joined: {self.loosely}",)

    @property
    def warnings(self) -> tuple[str, ...]:
        """The undecided hinges, in words."""
        warning = f"{numbered(self.unclear, 'hinge')} may or may not be on one line: kept apart"
        return (warning,) if self.unclear else ()


def lines_of_hinges(
    coordinates: Sequence[Sequence[float]] | None, bundles: Sequence[Sequence[Edge]], *, rounding: float = 0.0
) -> HingeLines:
    """Group the hinges between the same two panels, a bundle, by the lines on which they lie.

    Without coordinates every hinge is on a line of its own; `rounding` is their rounding error, if known, in units
    of their extent. The tolerance is the foot of the coarsest plateau, a range of a decade or more between
    ``COLLINEAR`` and ``BENT`` in which the number of lines does not change; ``COLLINEAR`` if there is none. The
    hinges of a group fit each other two by two; hinges in a row that fit one to the next, but not the first to the
    last, are a curve, and ``COLLINEAR`` holds for them.
    """
    groups: list[tuple[tuple[int, ...], ...]] = [tuple((i,) for i in range(len(bundle))) for bundle in bundles]
    several = [i for i, bundle in enumerate(bundles) if len(bundle) > 1]
    if coordinates is None or not several:
        return HingeLines(tuple(groups))
    measured = _measured(np.asarray(coordinates, dtype=float), [bundles[i] for i in several], rounding)
    tolerance = _plateau([bundle.tree(bundle.excess)[:, 2] for bundle in measured])
    within, loosely, unclear = 0.0, 0, 0
    for i, bundle in zip(several, measured, strict=True):
        if (most := float(bundle.deviation.max())) <= COLLINEAR:  # one line at any tolerance: by far the most are
            within = max(within, most)
            groups[i] = (tuple(range(bundle.size)),)
            continue
        tight = bundle.groups(bundle.deviation, COLLINEAR)
        lines = _lines(bundle, tolerance, tight)
        apart = bundle.apart(lines)
        groups[i] = tuple(sorted(lines))
        within = max(within, float(bundle.deviation[~apart].max(initial=0.0)))
        loosely += len(tight) - len(lines)
        unclear += bundle.unclear(lines, apart, tolerance)
    return HingeLines(tuple(groups), within, loosely, unclear)


@dataclass(frozen=True)
class _Bundle:
    """The hinges between two panels, measured two by two: (0, 1), (0, 2), ..., (1, 2), ...

    `pairs`, int[2, pairs], are the indices of the hinges of each pair; `deviation`, float[pairs], is how far they
    are off one line in units of their lengths, and `excess` the same less what rounding explains.
    """

    size: int
    pairs: Indices
    deviation: Floats
    excess: Floats

    def tree(self, heights: Floats, method: str = "complete") -> Floats:
        """Return merges of clusters in the order of their heights, as scipy does: two clusters, height, size."""
        heights = np.where(self.deviation > BENT, _APART, heights)
        if self.size == 2:
            return np.array([(0.0, 1.0, heights[0], 2.0)])
        from scipy.cluster.hierarchy import linkage

        merges: Floats = linkage(heights, method)
        return merges

    def groups(self, heights: Floats, tolerance: float, method: str = "complete") -> Groups:
        """Group hinges within a tolerance, each of each other; "single": connected by steps, as on a curve."""
        return _cut(self.tree(heights, method), tolerance)

    def apart(self, groups: Groups) -> npt.NDArray[np.bool_]:
        """Return, for each pair, whether it is in two groups: bool[pairs]."""
        label = np.empty(self.size, dtype=np.int64)
        for number, group in enumerate(groups):
            label[list(group)] = number
        apart: npt.NDArray[np.bool_] = label[self.pairs[0]] != label[self.pairs[1]]
        return apart

    def unclear(self, lines: Groups, apart: npt.NDArray[np.bool_], tolerance: float) -> int:
        """Return how many hinges are apart from others that may be on their line."""
        nearly = self.groups(self.deviation, BENT) & self.groups(self.deviation, BENT, "single")
        bent_a_little = {hinge for group in nearly - lines for hinge in group}
        explained = self.pairs[:, apart & (self.excess <= tolerance)]
        return len(bent_a_little.union(explained.ravel().tolist()))


def _lines(bundle: _Bundle, tolerance: float, tight: Groups) -> Groups:
    """Group the hinges of a bundle; where they fit in a row, but not all each other, take their tight groups."""
    whole = bundle.groups(bundle.excess, tolerance) & bundle.groups(bundle.excess, tolerance, "single")
    there = {hinge for group in whole for hinge in group}
    return whole | {group for group in tight if there.isdisjoint(group)}


def _plateau(merges: Sequence[Floats]) -> float:
    """Return the foot of the coarsest plateau of the heights at which lines become one."""
    heights = np.unique(np.concatenate(merges))
    steps = [COLLINEAR, *heights[(heights > COLLINEAR) & (heights < BENT)].tolist(), BENT]
    feet = [below for below, above in pairwise(steps) if above >= _PLATEAU * below]
    return feet[-1] if feet else COLLINEAR


def _cut(tree: Floats, tolerance: float) -> Groups:
    """Carry out the merges up to a tolerance."""
    clusters: dict[int, tuple[int, ...]] = {hinge: (hinge,) for hinge in range(len(tree) + 1)}
    for row, (one, two, height, _) in enumerate(tree.tolist(), len(tree) + 1):
        if height > tolerance:
            break
        clusters[row] = clusters.pop(int(one)) + clusters.pop(int(two))
    return frozenset(tuple(sorted(cluster)) for cluster in clusters.values())


def _measured(points: Floats, bundles: Sequence[Sequence[Edge]], rounding: float) -> list[_Bundle]:
    """Measure all pairs of hinges, many at once."""
    spread = points - points.mean(axis=0)
    ends = (spread / (np.ptp(spread, axis=0).max() or 1.0))[np.array([edge for one in bundles for edge in one])]
    explained = 2 * np.sqrt(points.shape[1]) * rounding
    sizes = [len(bundle) for bundle in bundles]
    of_size = {size: np.array(np.triu_indices(size, 1)) for size in set(sizes)}
    starts = np.cumsum([0, *sizes]).tolist()
    first, second = np.hstack([of_size[size] + start for size, start in zip(sizes, starts[:-1], strict=True)])
    pieces = np.array_split(np.arange(len(first)), len(first) // _AT_ONCE + 1)
    deviation, excess = np.hstack([_off_line(ends[first[some]], ends[second[some]], explained) for some in pieces])
    stops = np.cumsum([0, *(size * (size - 1) // 2 for size in sizes)]).tolist()
    return [
        _Bundle(size, of_size[size], deviation[start:stop], excess[start:stop])
        for size, (start, stop) in zip(sizes, pairwise(stops), strict=True)
    ]


def _off_line(one: Floats, two: Floats, explained: float) -> Floats:
    """Return the deviations of pairs of hinges from one line, in units of their lengths, and what rounding leaves.

    `one` and `two` are the ends of the hinges of each pair, float[pairs, 2, dimensions]; returns float[2, pairs].
    The line goes through the two of the four ends that are farthest apart. So for hinges that meet the deviation
    is an angle, half that of the bend if they are equally long; for hinges beside each other it is large.
    """
    four = np.concatenate([one, two], axis=1)
    apart = np.linalg.norm(four[:, :, None] - four[:, None], axis=3).reshape(-1, 16)
    farthest = apart.argmax(axis=1)
    rows = np.arange(len(four))
    here, there = four[rows, farthest // 4], four[rows, farthest % 4]
    along = ((there - here) / np.maximum(apart[rows, farthest], _SHORTEST)[:, None])[:, None]
    arms = four - here[:, None]
    across = arms - (arms * along).sum(axis=2, keepdims=True) * along
    off = np.linalg.norm(across, axis=2).reshape(-1, 2, 2).max(axis=2)
    lengths = np.maximum(apart[:, [1, 11]], _SHORTEST)
    return np.stack([(off / lengths).max(axis=1), (np.maximum(off - explained, 0.0) / lengths).max(axis=1)])
