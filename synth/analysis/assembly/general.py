"""All positions of a general member of a family: by curves of members that come back, until a bound or a trace ends.

The positions of a general member are kept between runs, since they are the same for all members of the type. What is
kept says itself what it is: its name is a digest of the type and the seed, its folder is named by a digest of the
files that find it. Where no folder can be written positions are found anew in each process. Theory:
docs/theory/positions.md.
"""

import io
from dataclasses import dataclass, replace
from functools import cache
from hashlib import sha256
from pathlib import Path

import numpy as np

from enumerate.machine_code.folders import keep, kept
from graphs.errors import NumericalError, UnsolvableError
from graphs.rank.singular_values import rank_of
from graphs.types import Flags
from synth.analysis.assembly.counts import root_count
from synth.analysis.assembly.family import SMALL, Family, apart, as_real
from synth.analysis.assembly.kernel import Complexes, Line

_QUIET = 20
"""Curves in a row that bring nothing new, before the positions are taken for all where neither bound nor trace is."""
_MOST_CURVES = 200
_WIDE = 0.7
"""Imaginary parts of the angles of a general member's axes, at most, radians."""


@dataclass(frozen=True, slots=True)
class GeneralPositions:
    """Positions of a general member, and why they are all.

    Attributes
    ----------
    parameters : complex[P]
    values : complex[N, U]
    curves : int
        Closed curves of members that were walked.
    bound : int or None
        How many there are at most, by a theorem (`root_count`).
    traced : bool
        Whether a trace test says that these are all.
    """

    parameters: Complexes
    values: Complexes
    curves: int
    bound: int | None
    traced: bool

    @property
    def complete(self) -> bool:
        """Whether these are all: they are as many as can be, or the trace test says so."""
        return self.traced or len(self.values) == self.bound


def general_positions(family: Family, seed: int = 0) -> GeneralPositions:
    """Return all positions of a random member of a family; another seed is another member, and other curves.

    Raises `UnsolvableError` if the driven joints do not determine the others, `NumericalError` if the curves go on
    to bring new positions.
    """
    # A curve of members that comes back to where it began takes each position to a position, perhaps a new one. Members
    # differ in what their loops close to alone: over them solutions are an irreducible variety (`family`), so that the
    # permutations by all curves take each solution to each.
    random = np.random.default_rng(seed)
    here, known = _start(family, random)
    if not _is_regular(family, here, known):
        raise UnsolvableError("the driven joints do not determine the others: drive joints that do")
    known = known[None]
    bound, quiet = root_count(family), 0
    for curves in range(1, _MOST_CURVES + 1):
        more = _round(family, here, known, random)
        quiet = quiet + 1 if len(more) == len(known) else 0
        known = more
        if bound is not None and len(known) > bound:
            bound = (
                None  # cut open, the loops are of a larger family than the type: see `synth.analysis.assembly.cutting`
            )
        if len(known) == bound or quiet == _QUIET:
            return GeneralPositions(here, known, curves, bound, False)
    raise NumericalError(f"after {_MOST_CURVES} curves new positions still appear, {len(known)} so far")


def determines(family: Family) -> bool:
    """Whether the driven joints of a general member determine the others, but for a finite choice."""
    return _is_regular(family, *_start(family, np.random.default_rng(0)))


def _start(family: Family, random: np.random.Generator) -> tuple[Complexes, Complexes]:
    """Return a random member, complex[P], and a position of it, complex[U]: its loops close to what is there."""
    axes, inputs = _random_axes(random, family), _random(random, family.driven, np.pi, 1.0)
    values = _random(random, family.unknowns, np.pi, 0.5)
    cuts = family.closed_to(family.member(axes, inputs), values)
    return family.member(axes, inputs, cuts / np.abs(cuts).max(axis=1, keepdims=True)), values


def _is_regular(family: Family, parameters: Complexes, values: Complexes) -> bool:
    parts = as_real(family.at(parameters, values)[1])
    return bool(rank_of(parts) == min(parts.shape))


def _round(family: Family, here: Complexes, known: Complexes, random: np.random.Generator) -> Complexes:
    """Return the known solutions of a member and where a random closed curve of members takes them."""
    turn = here.copy()
    cuts = 4 * len(family.loops)
    turn[-cuts:] = _random(random, cuts, 1.0, 1.0)
    values = known
    for ends in ((here, turn), (turn, here)):  # there and back on different curves
        bend = np.zeros_like(here)
        bend[-cuts:] = _random(random, cuts, 1.0, 1.0)
        first, last, bent = (np.tile(parameters, (len(values), 1)) for parameters in (*ends, bend))
        paths = family.followed((first, last, bent), values)
        values = paths.values[paths.arrived]
    return apart(np.concatenate([known, values]), family.turning)


def _random_axes(random: np.random.Generator, family: Family) -> Complexes:
    """Return complex parameters of axes, of those that coincide the same."""
    number = len(family.axes)
    tilts, turns = random.uniform(0.4, np.pi - 0.4, number), random.uniform(-np.pi, np.pi, number)
    pairs = np.stack([tilts, turns], axis=1) + 1j * random.uniform(-_WIDE, _WIDE, (number, 2))
    return np.asarray(family.coincident(pairs))


def _random(random: np.random.Generator, shape: int | tuple[int, int], real: float, imaginary: float) -> Complexes:
    return np.asarray(random.uniform(-real, real, shape) + 1j * random.uniform(-imaginary, imaginary, shape))


_TRACES = 12
"""Trace tests, each after more curves of hyperplanes, before the list of positions is left without one."""
_LINEAR = 1e-7
"""Second differences of a trace that is linear, as parts of the sum of absolute values."""


def traced(family: Family, general: GeneralPositions, seed: int = 0) -> GeneralPositions:
    """Return the positions with those that a trace test adds, and whether in the end it says that they are all.

    On a line of members in general position solutions are a curve, which is irreducible (Bertini). Hyperplanes, of the
    line's parameter and the tangents of half of some joint angles, meet it in as many points as its degree is; where a
    hyperplane is moved parallel to itself the sum of these points moves along a line, and the sum of some of them does
    not (Sommese, Verschelde, Wampler 2002). One hyperplane is the member itself, and the points on it its positions.
    The joints are such that they determine all others (`_determining`), so that no two points lie on each other; the
    fewer, the lower the degree.
    """
    random = np.random.default_rng((seed, 1))
    section = _Section(family, general.parameters, random)
    points = section.moved(section.member, section.first, section.points_of(general.values))
    for _ in range(_TRACES):
        quiet = 0
        while quiet < 2:
            more = section.round(points)
            quiet, points = (quiet + 1 if len(more) == len(points) else 0), more
        if section.trace_is_linear(points):
            there = section.moved(section.first, section.member, points)
            values = apart(np.concatenate([general.values, there[:, :-1]]), family.turning)
            return replace(general, values=values, traced=True)
    return general


class _Section:
    """A line of members and the hyperplanes that meet the curve of their solutions: points are complex[P, U + 1].

    Hyperplanes are complex[U + 2]: weights of the unknowns and of the line's parameter, and the sum.
    """

    def __init__(self, family: Family, member: Complexes, random: np.random.Generator) -> None:
        self._family, self._random = family, random
        direction, cuts = np.zeros_like(member), 4 * len(family.loops)
        direction[-cuts:] = _random(random, cuts, 1.0, 1.0)
        self._line: Line = (member, direction)
        self._turning: Flags = np.append(family.turning, False)
        self._weighted = np.zeros(family.unknowns + 2, dtype=bool)
        self._weighted[[*_determining(family), -2, -1]] = True
        self.member = np.zeros(family.unknowns + 2, dtype=complex)
        self.member[-2] = 1.0  # the parameter of the line is 0
        self.first = self._hyperplane()

    def _hyperplane(self) -> Complexes:
        # weights of very different sizes: curves of hyperplanes of equal weights go round few of the branch points
        size = self._family.unknowns + 2
        weights = self._random.normal(size=size) + 1j * self._random.normal(size=size)
        return np.where(self._weighted, weights * np.exp(self._random.normal(size=size)), 0.0)

    def points_of(self, values: Complexes) -> Complexes:
        return np.concatenate([values, np.zeros((len(values), 1))], axis=1)

    def moved(self, start: Complexes, end: Complexes, points: Complexes, *, bent: bool = True) -> Complexes:
        """Return where points come to while one hyperplane becomes another, less those that went to infinity."""
        bend = self._hyperplane() if bent else np.zeros_like(start)
        curves = tuple(np.tile(each, (len(points), 1)) for each in (start, end, bend))
        paths = self._family.followed((curves[0], curves[1], curves[2]), points, SMALL, self._line)
        return paths.values[paths.arrived]

    def round(self, points: Complexes) -> Complexes:
        turn = self._hyperplane()
        back = self.moved(turn, self.first, self.moved(self.first, turn, points))
        return apart(np.concatenate([points, back]), self._turning)

    def trace_is_linear(self, points: Complexes) -> bool:
        """Whether the sum of the points moves along a line while the hyperplane moves parallel to itself."""
        sums, sizes = [self._coordinates(points).sum(axis=0)], np.abs(self._coordinates(points)).sum(axis=0)
        for side in (1.0, -1.0):
            beside = self.first.copy()
            beside[-1] += side * (0.5 + 0.3j)
            there = self.moved(self.first, beside, points, bent=False)
            if len(apart(there, self._turning)) < len(points):
                return False
            sums.append(self._coordinates(there).sum(axis=0))
            sizes = np.maximum(sizes, np.abs(self._coordinates(there)).sum(axis=0))
        return bool((np.abs(sums[1] + sums[2] - 2.0 * sums[0]) <= _LINEAR * (1.0 + sizes)).all())

    def _coordinates(self, points: Complexes) -> Complexes:
        there = np.where(self._turning, np.tan(0.5 * np.where(self._turning, points, 0.0)), points)
        return np.asarray(there[:, self._weighted[:-1]])


def _determining(family: Family) -> list[int]:
    """Return unknowns that determine all others uniquely: where all joints of a loop but two are known, these are."""
    loops = []
    for loop in family.loops:
        columns = family.column[family.axes[loop[loop >= 0], 0]]
        loops.append({column for column in columns.tolist() if column >= 0})
    known, chosen = set[int](), list[int]()
    while True:
        left = sorted((len(joints - known), min(joints - known)) for joints in loops if joints - known)
        if not left:
            return chosen
        number, first = left[0]
        if number > 2:
            chosen.append(first)
            known.add(first)
        for joints in loops:
            if len(joints - known) <= 2:
                known |= joints


_FILES = ("general.py", "counts.py", "cutting.py", "family.py", "kernel.py", "kernel.c")
_MOST = 64
"""Types that a process remembers."""
_remembered: dict[str, GeneralPositions] = {}


def kept_positions(family: Family, seed: int = 0, *, trace: bool = False) -> GeneralPositions:
    """Return all positions of a general member of a family: those that are kept, or `general_positions`.

    With `trace`, and where no bound is reached, a trace test has been tried.
    """
    name = _name(family, seed)
    general = _remembered.get(name)
    if general is None:
        text = kept(_folder(), name)
        general = _read(text) if text is not None else general_positions(family, seed)
        if text is None:
            keep(_folder(), name, _written(general))
    if not general.traced and (trace or not general.complete):
        general = traced(family, general, seed)
        if general.traced:
            keep(_folder(), name, _written(general))
    while len(_remembered) >= _MOST:
        _remembered.pop(next(iter(_remembered)), None)
    _remembered[name] = general
    return general


def _name(family: Family, seed: int) -> str:
    arrays = (family.loops, family.signs, family.axes, family.column, family.links, family.alike)
    of_type = [(array.shape, array.tolist()) for array in arrays]
    return f"{sha256(repr((of_type, seed)).encode()).hexdigest()[:32]}.npz"


@cache
def _folder() -> str:
    texts = b"".join(Path(__file__).with_name(name).read_bytes() for name in _FILES)
    return f"{__name__}-{sha256(texts + np.__version__.encode()).hexdigest()[:32]}"


def _written(general: GeneralPositions) -> bytes:
    text = io.BytesIO()
    numbers = np.array([general.curves, -1 if general.bound is None else general.bound, general.traced])
    np.savez(text, parameters=general.parameters, values=general.values, numbers=numbers)
    return text.getvalue()


def _read(text: bytes) -> GeneralPositions:
    with np.load(io.BytesIO(text), allow_pickle=False) as arrays:
        curves, bound, traced_too = arrays["numbers"].tolist()
        parameters, values = arrays["parameters"], arrays["values"]
    return GeneralPositions(parameters, values, curves, None if bound < 0 else bound, bool(traced_too))
