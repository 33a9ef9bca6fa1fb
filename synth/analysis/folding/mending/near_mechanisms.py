"""The nearest mechanisms that move: for each branch that a crease pattern nearly has, vertices at which it has it.

Sheets of quadrilaterals fold because their geometry is special, and rounding takes that away. Where rates would
agree but for differences that the coordinates cannot resolve, vertices are moved to where they do. Angles that are
meant to be alike come first, since then most patterns have all their branches again; each branch that is left is
fitted, together with those before it as long as that is possible, else by itself. Theory: docs/theory/mending.md.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice, product

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.geometry import across, best_plane
from graphs.mechanism.precision import Precision, off_plane
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, MARGIN, Tolerances
from graphs.types import Floats
from synth.analysis.folding.mending.fitting import FARTHEST_PATTERN, Fitting, MeantAngles, VertexPlaces
from synth.analysis.motion.branches import MOST_BRANCHES
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import EXACT
from synth.analysis.motion.flat_vertices import FlatVertices
from synth.analysis.motion.linkage import Linkage, linkage_of_sheet
from synth.analysis.motion.singular.sampling import followed, rates_towards
from synth.analysis.motion.singular.second_order import (
    RateSpace,
    largest_only,
    quadrics_of,
    rates_at,
    rates_near,
    spaces_within,
)
from synth.analysis.motion.walk.step import Allowance

FARTHEST = 4.0
"""Vertices are moved by this times the precision at most."""


@dataclass(frozen=True, slots=True)
class MendedPattern:
    """A pattern with vertices moved, by a part of the extent; the precision before, and what it has now."""

    sheet: Sheet
    moved: float
    precision: Precision
    why: str

    def __str__(self) -> str:
        precise = f"coordinates precise to {self.precision.size:.1g}: {self.precision.source}"
        return f"vertices moved by up to {self.moved:.1g} of the extent so that {self.why} ({precise})"


def flattened(sheet: Sheet, precision: Precision) -> MendedPattern | None:
    """Return a sheet that is meant to be flat with its vertices in one plane; None if it is not, or is there.

    Examples
    --------
    >>> places = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1e-7), (0.0, 1.0, 0.0))
    >>> book = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), places)
    >>> print(flattened(book, Precision(1e-7, "7 decimals")).why)
    they lie in one plane
    """
    if sheet.coordinates is None or len(sheet.coordinates[0]) < 3:
        return None
    points = np.asarray(sheet.coordinates, dtype=float)
    off = off_plane(points)
    if not EXACT / 1e3 < off <= FARTHEST * precision.size:
        return None
    plane = best_plane(points)
    flat = plane.middle + across(points - plane.middle, plane.direction)
    return MendedPattern(with_vertices(sheet, flat), off, precision, "they lie in one plane")


def with_vertices(sheet: Sheet, corners: Floats) -> Sheet:
    """Return a sheet with its vertices at float[V, 3]."""
    assert sheet.coordinates is not None
    size = len(sheet.coordinates[0])
    return replace(sheet, coordinates=tuple(map(tuple, corners[:, :size].tolist())))


_SHORT = 10.0
"""Percentile of the lengths of the creases by which errors of directions are judged."""
_LIKE = 0.15
"""Rates of two spaces are those of one branch, one of them of coordinates with errors, up to this part of the
largest."""
_WIDER = (1.0, 10.0, 0.15)
"""Nearly agreeing rates are looked for at errors so many times those of one direction."""
_WORK_NEAR = 3e8
"""Work of one search for spaces of rates, in products of numbers: about a second."""
_HARDLY, _ERRORS = 0.02, 30.0
"""A rate may be an error that is no larger than the first, of the largest, and than this times what is zero."""
_SLOW = 0.1
"""Joints with smaller rates may be immobile where errors grew from vertex to vertex."""
_BESIDE = 3
"""Further motions along a branch with several freedoms, at most."""


@dataclass(frozen=True, slots=True)
class NearBranch:
    """A branch that a pattern nearly has: a space of rates that nearly agree.

    `motions` are some of them, general ones, float[J], that nearest to the assignment first; the largest rate of
    each is 1 or -1. Joints whose rates are no larger than `small` may be immobile on the intended branch.
    """

    space: RateSpace
    motions: tuple[Floats, ...]
    small: float

    @property
    def begun(self) -> list[list[Floats]]:
        """Rates of the motions: with joints immobile that hardly move, as they are, and with slow joints immobile."""
        largest = np.abs(self.motions).max(axis=0)
        beginnings = [list(self.motions)]
        for place, small in ((0, self.small), (2, _SLOW)):
            hardly = (largest <= small) & (largest > 0.0)
            if hardly.any():
                beginnings.insert(place, [np.where(largest > small, rates, 0.0) for rates in self.motions])
        return beginnings

    def agreement(self, wanted: Floats) -> float:
        """Return how many joints begin as is wanted, less those that do not."""
        return float(np.sign(self.motions[0]) @ wanted)


def zeros_of(precision: float, lengths: Floats) -> list[float]:
    """Return below which parts of the largest values count as zero: what nearly agrees, the most likely first.

    Errors of directions are those of short creases. They grow from vertex to vertex; and where lengths differ or
    errors are large, a zero that is too wide takes branches for one that are several.
    """
    length = float(np.percentile(lengths, _SHORT)) if len(lengths) else 1.0
    return list(dict.fromkeys(Tolerances.nearly(part * precision, length) for part in _WIDER))


def near_branches(
    linkage: Linkage, zero: float, wanted: Floats, most: int, known: Sequence[NearBranch] = ()
) -> tuple[list[NearBranch], bool]:
    """Return up to `most` branches that a linkage nearly has, but for known ones, and whether these are all."""
    branches: list[NearBranch] = []
    spaces, complete = spaces_at(linkage, most, zero)
    for space in spaces:
        motions = _motions(space, wanted)
        if motions and not any(_alike(space, one.space) for one in (*known, *branches)):
            branches.append(NearBranch(space, motions, min(_HARDLY, _ERRORS * zero)))
    return sorted(branches, key=lambda one: -one.agreement(wanted)), complete


def spaces_at(linkage: Linkage, most: int, zero: float = DOUBLE.zero) -> tuple[list[RateSpace], bool]:
    """Return the spaces of rates that agree to second order, and whether these are all."""
    tangent, allowance = rates_at(ClosureEquations(linkage), linkage.angles, zero), Allowance(_WORK_NEAR)
    spaces = spaces_within(tangent, quadrics_of(linkage), zero, allowance)
    spaces_found = list(islice(spaces, most + 1))
    return largest_only(spaces_found[:most], zero), len(spaces_found) <= most and not allowance.used_up


def covers(space: RateSpace, near: RateSpace) -> bool:
    """Tell whether rates that agree exactly are those of a branch that nearly agreed, with all its freedoms."""
    if space.basis.shape[1] < near.basis.shape[1] or len(space.left) > len(near.left):
        return False
    off = near.basis - space.basis @ (space.basis.T @ near.basis)
    return bool(np.abs(off).max() <= _LIKE * np.abs(near.basis).max())


def _alike(space: RateSpace, other: RateSpace) -> bool:
    return space.basis.shape == other.basis.shape and covers(space, other) and covers(other, space)


def _motions(space: RateSpace, wanted: Floats) -> tuple[Floats, ...]:
    """Return general rates of a space, those nearest to wanted ones first; none where there are none."""
    size = space.basis.shape[1]
    starts = [wanted]
    for number in range(min(size, _BESIDE) if size > 1 else 1):
        chance = np.random.default_rng((*space.basis.shape, number))
        starts.append(space.basis @ (chance.uniform(0.5, 1.0, size) * chance.choice([-1.0, 1.0], size)))
    motions: list[Floats] = []
    for start in starts:
        rates = rates_towards(space, start) if space.left else space.basis @ (space.basis.T @ start)
        largest = float(np.abs(rates).max())
        if largest > DOUBLE.zero_rate:
            scaled = rates / largest
            motions.append(np.where(np.abs(scaled) > MARGIN, scaled, 0.0))
    return tuple(motions if size > 1 else motions[:1])


ALL_BRANCHES = 120
"""For larger linkages one motion is enough: each two panels more may double the number of branches."""
_WORK = 3e4
"""Unknowns of all rounds of all fittings together: a few seconds."""
_SEPARATE = 4
"""After so many branches for which nothing was found no others are tried."""
_ALONG = "loops close along a motion"
_ALL_BUT = 0.1
"""A residual below this part of the precision, by the square of the turn, may be near to a mechanism."""
_AROUND = 2.0
"""An attempt with a vertex farther off than this times the reach says nothing of what is within."""
_FOLLOW = 5e2
"""Work of following a branch."""
_FARTHER = (1e-4, 1e-3)
"""Errors of a coordinate, of the extent, at which the nearest mechanism of a rigid pattern is looked for."""
_FINER = (0.4, 0.15, 0.06)
"""Parts of the precision that errors are taken to be where no mechanism was found at all of it: wide zeros may take
branches for one that are several."""
_TIGHTER = (1.0, 0.25)
"""Angles are taken to be alike if they agree within these parts of their errors."""


@dataclass(frozen=True)
class WrittenPattern:
    """A crease pattern as it is written, opened along cuts: its linkage, precision, and wanted signs of rates."""

    sheet: Sheet
    mechanism: SheetMechanism
    linkage: Linkage
    precision: Precision
    wanted: Floats

    @property
    def small(self) -> bool:
        """Whether all spaces of rates are looked for."""
        return len(self.linkage.graph.joints) <= ALL_BRANCHES


@dataclass(frozen=True)
class NearbyPatterns:
    """Mechanisms near a crease pattern that have branches which it nearly has.

    `within` reach comes first that on which the assignment is a branch, or that with the most branches; each has
    branches that those before it have not. `beyond` is the nearest one beyond reach, where there is none within.
    `unsettled` says that for some branch that nearly agrees no mechanism was found, as the fitting did not
    converge or the work was used up, `nearly` that rates nearly agree that do not agree exactly. With
    `written_first` the pattern as it is written is better than these: has the assignment, or more branches; with
    `written_too` it has branches that these have not.
    """

    within: tuple[MendedPattern, ...] = ()
    beyond: MendedPattern | None = None
    unsettled: bool = False
    nearly: bool = False
    written_first: bool = False
    written_too: bool = False


@dataclass(frozen=True)
class _Candidate:
    """A mended pattern, None for that as it is written, and the numbers of the near branches that it has."""

    mended: MendedPattern | None
    has: frozenset[int]


def nearby(written: WrittenPattern, levels: int = 3) -> NearbyPatterns:
    """Return the nearest mechanisms with the branches that a pattern nearly has.

    A vertex is displaced by four times the precision, at most. Nothing is done where a pattern has all of them as
    written, or its coordinates are exact. What nearly agrees is looked for at up to `levels` wider and wider
    zeros, until anything is found.
    """
    places = VertexPlaces(written.sheet, written.mechanism, written.linkage)
    precision = written.precision
    if precision.size <= EXACT < places.bent:  # exact by their digits, but not by these
        precision = Precision(places.bent, "creases of several pieces")
    if precision.size <= EXACT:
        return NearbyPatterns()
    if not written.small:
        return _Large(written, places, precision).nearby()
    found = _Search(written, places, precision).nearby(levels)
    if found.within or found.beyond or found.unsettled:
        return found
    finer = (_Search(written, places, precision, part).nearby(levels) for part in _FINER)
    return next((one for one in finer if one.within), found)


def beyond_precision(written: WrittenPattern) -> MendedPattern | None:
    """Return the nearest mechanism at larger and larger errors beyond the precision; else None."""
    for size in _FARTHER:
        if size > written.precision.size:
            near = nearby(replace(written, precision=Precision(size, "a larger one, tried")), 1)
            patterns = [*near.within[:1], *([near.beyond] if near.beyond else [])]
            if patterns:
                return replace(patterns[0], precision=written.precision)
    return None


def searched_to(precision: Precision) -> float:
    """Return how far from a rigid pattern mechanisms were looked for: displacements, in units of the extent."""
    return FARTHEST * max(precision.size, *_FARTHER)


class _PatternSearch:
    """The base of all searches: the reach, angles that are meant to be alike, patterns with moved vertices.

    Errors are taken to be a `part` of the precision; vertices may be displaced by four times all of it.
    """

    def __init__(self, written: WrittenPattern, places: VertexPlaces, precision: Precision, part: float = 1.0) -> None:
        self.written, self.places, self.precision = written, places, precision
        self.errors = part * precision.size
        self.reach = max(FARTHEST * precision.size, places.bent)  # pieces of a crease were taken to be in line
        self.allowance = Allowance(_WORK)

    @cached_property
    def bases(self) -> list[tuple[Fitting, str]]:
        """Return fittings whose angles are as they are meant, the most of them first, with what holds."""
        angles = [MeantAngles(self.places, part * self.errors) for part in _TIGHTER]
        if len(angles[0]) == len(angles[1]):
            angles.pop()
        angles = [*filter(len, angles), MeantAngles(self.places, 0.0)]
        fittings = []
        for meant in angles:
            fitting = Fitting(self.places, meant, self.written.linkage.angles, self.allowance)
            if fitting.at_configuration() and fitting.moved <= self.reach:
                equal, straight = "angles that nearly agree are equal", "creases are straight and panels planar"
                fittings.append((fitting, equal if len(meant) else straight))
        return fittings

    def mended(self, fitting: Fitting, why: str) -> MendedPattern:
        """Return the pattern with its vertices moved."""
        linkage = self.written.linkage
        corners = fitting.corners * linkage.extent + linkage.middle
        return MendedPattern(with_vertices(self.written.sheet, corners), fitting.moved, self.precision, why)

    def linkage(self, mended: MendedPattern) -> Linkage:
        """Return the linkage of a mended pattern."""
        return linkage_of_sheet(mended.sheet, self.written.mechanism)


class _Search(_PatternSearch):
    """The search in a pattern of which all spaces of rates are looked for."""

    def __init__(self, written: WrittenPattern, places: VertexPlaces, precision: Precision, part: float = 1.0) -> None:
        super().__init__(written, places, precision, part)
        self.near: list[NearBranch] = []
        self.candidates: list[_Candidate] = []
        self.beyond: MendedPattern | None = None
        self.only_beyond: set[int] = set()  # near branches of mechanisms that were found beyond reach
        self.unsettled = False

    def nearby(self, levels: int) -> NearbyPatterns:
        """Return what was found at the first of so many levels of what nearly agrees at which anything was."""
        lengths = self.places.lengths
        exactly, left, bent = frozenset[int](), list[int](), self.places.bent > EXACT
        linkage, wanted = self.written.linkage, self.written.wanted
        for zero in zeros_of(self.errors, lengths)[:levels]:
            more, complete = near_branches(linkage, zero, wanted, MOST_BRANCHES, self.near)
            known = len(self.near)
            self.near += more
            self.unsettled |= not complete
            exactly = self._had_by(linkage, follow=False)
            left = [number for number in range(len(self.near)) if number not in exactly]
            new = [number for number in left if number >= known]  # another attempt at others ends as the first did
            if new or bent:
                self._mend(new)
            if exactly or self.candidates:
                break
        within = self._sorted(exactly)
        mended = tuple(one.mended for one in within if one.mended is not None)
        beyond = self.beyond if not within else None
        unsettled = self.unsettled or bool(self._open(left) and self.allowance.used_up)
        as_written = [one.mended is None for one in within]
        return NearbyPatterns(mended, beyond, unsettled, bool(left), as_written[:1] == [True], any(as_written))

    def _mend(self, left: Sequence[int]) -> None:
        """Move vertices so that the pattern has the near branches that are left, as far as that is possible."""
        for fitting, why in self.bases:
            if fitting.moved > EXACT:
                self._add(self.mended(fitting, why))
            if self._open(left):
                self._fit(fitting, left)
            if self.candidates and not self._open(left):
                break

    def _open(self, left: Sequence[int]) -> list[int]:
        """Return the near branches that no mechanism has yet."""
        return [number for number in left if not any(number in one.has for one in self.candidates)]

    def _had_by(self, linkage: Linkage, *, follow: bool) -> frozenset[int]:
        """Return which near branches a linkage has; where that is not clear at the configuration they are followed."""
        spaces, _ = spaces_at(linkage, MOST_BRANCHES)
        closure, linear = ClosureEquations(linkage), FlatVertices(linkage).linear
        had = set()
        for number, near in enumerate(self.near):
            for space in spaces:
                if covers(space, near.space):
                    if not follow or (linear and not space.left) or self._moves(closure, linkage, space, number):
                        had.add(number)
                    break
        return frozenset(had)

    def _moves(self, closure: ClosureEquations, linkage: Linkage, space: RateSpace, number: int) -> bool:
        """Tell whether a motion begins in a space, near to that of a near branch, with all its freedoms."""
        if not self.allowance.take(_FOLLOW):
            return False
        begun = space.basis @ (space.basis.T @ self.near[number].motions[-1])
        rates = begun / np.abs(begun).max()
        immobile = tuple(np.flatnonzero(np.abs(space.basis).max(axis=1) <= DOUBLE.zero_rate).tolist())
        end, freedoms = followed(linkage, closure, rates, immobile), self.near[number].space.basis.shape[1]
        return end.far > 0.0 and (bool(space.left) or (end.freedoms or 0) >= freedoms)

    def _add(self, mended: MendedPattern) -> _Candidate | None:
        """Take a mended pattern among the candidates if it has any near branch."""
        has = self._had_by(self.linkage(mended), follow=True)
        if not has and self.near:
            return None
        if mended.moved > self.reach:
            self.only_beyond |= has
            if self.beyond is None or mended.moved < self.beyond.moved:
                self.beyond = mended
            return None
        self.candidates.append(_Candidate(mended, has))
        return self.candidates[-1]

    def _fit(self, base: Fitting, left: Sequence[int]) -> None:
        """Fit vertices along the near branches that no mechanism has yet: together, else each by itself."""
        together, tried = base, 0
        for number in left:
            if number not in self._open(left) or tried >= _SEPARATE:
                continue
            fitted = self._fitted(dict.fromkeys((together, base)), number)
            candidate = None if fitted is None else self._add(self.mended(fitted, _ALONG))
            if fitted is not None and candidate is not None and number in candidate.has:
                together = fitted
            else:
                tried += 1

    def _fitted(self, starts: Iterable[Fitting], number: int) -> Fitting | None:
        """Return the first fitting along a near branch that closes; none much beyond one found beyond reach."""
        unsettled = False
        most = _AROUND * self.reach if number in self.only_beyond else FARTHEST_PATTERN
        for start, motions in product(starts, self.near[number].begun):
            fitted = start.along(motions, most)
            if fitted is not None:
                return fitted
            # what all but closed may have been near to a mechanism, if no vertex was far from where it is written
            all_but = 0.0 < start.error <= _ALL_BUT * self.errors
            unsettled |= (all_but and start.displaced <= _AROUND * self.reach) or start.error == np.inf
        self.unsettled |= unsettled
        return None

    def _sorted(self, exactly: frozenset[int]) -> list[_Candidate]:
        """Return the candidates and what is written, the best first, each with what those before have not."""

        def worth(one: _Candidate) -> tuple[float, ...]:
            spaces = [self.near[number].space.basis.shape[1] for number in one.has]
            agreements = [self.near[number].agreement(self.written.wanted) for number in one.has]
            moved = 0.0 if one.mended is None else one.mended.moved
            return (max(agreements, default=-np.inf), len(spaces), sum(spaces), -moved)

        whole = self.places.bent <= EXACT  # else panels come apart at creases of several pieces
        every = [*self.candidates, *([_Candidate(None, exactly)] if exactly and whole else [])]
        chosen, has = list[_Candidate](), set[int]()
        for one in sorted(every, key=worth, reverse=True):
            if not chosen or one.has - has:
                chosen.append(one)
                has |= one.has
        return chosen


class _Large(_PatternSearch):
    """The search in a pattern that is too large for all its branches: along the assignment."""

    def nearby(self) -> NearbyPatterns:
        """Return what was found."""
        if self.places.bent <= EXACT and self._moves(self.written.linkage):
            return NearbyPatterns()
        rates = None
        for fitting, why in self.bases:
            mended = self.mended(fitting, why)
            if fitting.moved > EXACT and self._moves(self.linkage(mended)):
                return NearbyPatterns((mended,), nearly=True)
            rates = self._nearly() if rates is None else rates
            fitted = None if rates is None else fitting.along([rates])
            if fitted is None or fitted.moved > self.reach:
                continue
            mended = self.mended(fitted, _ALONG)
            if self._moves(self.linkage(mended)):
                return NearbyPatterns((mended,), nearly=True)
        return NearbyPatterns(unsettled=rates is not None, nearly=rates is not None)

    def _moves(self, linkage: Linkage) -> bool:
        return self._rates(linkage) is not None

    def _rates(self, linkage: Linkage, zero: float = DOUBLE.closed) -> Floats | None:
        closure, wanted = ClosureEquations(linkage), self.written.wanted
        return rates_near(closure, linkage.angles, quadrics_of(linkage), wanted, zero)

    def _nearly(self) -> Floats | None:
        """Return rates near to the assignment that nearly agree."""
        rates = self._rates(self.written.linkage, Tolerances.of(self.precision.size).zero)
        return None if rates is None else rates / np.abs(rates).max()
