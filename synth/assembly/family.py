"""Families of linkages with complex axes and inputs: all positions of a general member, followed to any other.

Joint angles, axes and inputs may be complex: then the number of positions is the same for all members but special
ones, and positions can be followed from one member to another. An axis through a finite centre has two angles, one
across a plane its point there, so that everything is an entire function and no root has to choose a sign.

The positions of a general member are kept between runs, since they are the same for all members of the type. What is
kept says itself what it is: its name is a digest of the type and the seed, its folder is named by a digest of the
files that find it. Where no folder can be written positions are found anew in each process. Theory:
docs/theory/positions.md.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from math import atan2, hypot
from pathlib import Path
from typing import NamedTuple

import numpy as np

from enumerate.machine_code.folders import keep, kept
from graphs.errors import InvariantError, NumericalError, UnsolvableError, numbered, shown
from graphs.geometry import frame_about, lines_meet
from graphs.loops.loop import Centre
from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE, EPSILON
from graphs.types import Flags, Floats, Ints, JointId
from synth.assembly.kernel import ARRIVED, CLOSED, DIRECTION, FAR, POINT, SLIDE, Complexes, Type
from synth.assembly.tracking import corrected_all, evaluated, followed_all
from synth.motion.linkage import PosedLinkage, PosedLoop

Curves = tuple[Complexes, Complexes, Complexes]
SMALL = 3e-3
"""Of corrections along a path, radians."""


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages of one type with driven joints; loops, signs, axes and column are those of `kernel.Type`.

    Parameters of a member: two numbers for each axis, and the angle or length of each driven joint. `joints` are
    all that are in loops.
    """

    loops: Ints
    signs: Floats
    axes: Ints
    joints: tuple[JointId, ...]
    column: Ints

    @property
    def unknowns(self) -> int:
        """Number of joints that are not driven."""
        return int((self.column >= 0).sum())

    @property
    def turning(self) -> Flags:
        """Whether an unknown is an angle, and not the length of a slide: bool[U]."""
        turning = np.ones(self.unknowns, dtype=bool)
        slides = self.column[self.axes[self.axes[:, 1] == SLIDE, 0]]
        turning[slides[slides >= 0]] = False
        return turning

    def followed(self, curves: Curves, values: Complexes, small: float = SMALL) -> TrackedPaths:
        """Follow solutions, complex[P, U], from members of the family to others.

        Curves are start, end and bend of the parameters, complex[P, parameters]: at s, start + s (end - start) + s
        (1 - s) bend. The smaller the allowed corrections (`small`, radians), the surer each path stays its own.
        """
        solutions = np.array(values, dtype=complex, order="C")
        ends = followed_all(self._type, curves, solutions, small)
        return TrackedPaths(solutions, ends == ARRIVED, ends == FAR)

    def corrected(self, parameters: Complexes, values: Complexes, steps: int) -> tuple[Complexes, Floats]:
        """Return solutions by Newton's method, complex[P, U], and by how much loops do not close, float[P]."""
        solutions = np.array(values, dtype=complex, order="C")
        return solutions, corrected_all(self._type, parameters, solutions, steps)

    def at(self, parameters: Complexes, values: Complexes) -> tuple[Complexes, Complexes]:
        """Return the closure residual, complex[3 L], and its derivatives by the unknowns, complex[3 L, U]."""
        jacobian = np.empty((3 * len(self.loops), self.unknowns), dtype=complex)
        residual = np.empty(3 * len(self.loops), dtype=complex)
        evaluated(self._type, parameters, values, residual, jacobian)
        return residual, jacobian

    @property
    def _type(self) -> Type:
        return self.loops, self.signs, self.axes, self.column


class TrackedPaths(NamedTuple):
    """Ends of paths: values, complex[P, U], and which arrived or are far, at infinity; the others stopped."""

    values: Complexes
    arrived: Flags
    far: Flags


def family_of(linkage: PosedLinkage, driven: Sequence[JointId]) -> tuple[Family, Floats]:
    """Return the family of a linkage with driven joints, and the parameters of this member's axes: float[2 A].

    Joints in no loop are left out. Raise `UnsolvableError` if a loop is neither spherical nor planar, or if so
    many driven joints do not determine the others by count, `InvariantError` if a driven joint is in no loop, or
    named twice. Without loops there is nothing to solve, which is an `UnsolvableError` too.
    """
    if not linkage.loops:
        raise UnsolvableError("positions requires a closed loop; here each joint moves by itself")
    names = list(linkage.graph.joints)
    numbers_in_loops = sorted({joint for loop in linkage.loops for joint in loop.joints})
    joints = tuple(names[joint] for joint in numbers_in_loops)
    _check_driven(joints, driven, len(joints) - 3 * len(linkage.loops))
    axes = _Axes(linkage)
    longest = max((len(loop.joints) for loop in linkage.loops), default=0)
    loops = np.full((len(linkage.loops), longest), -1, dtype=np.int64)
    signs = np.zeros(loops.shape)
    for row, loop in enumerate(linkage.loops):
        numbers, senses = axes.of_loop(loop)
        loops[row, : len(numbers)] = numbers
        signs[row, : len(numbers)] = np.multiply(loop.signs, senses)
    column = np.empty(len(joints), dtype=np.int64)
    known = [joints.index(joint) for joint in driven]
    column[known] = -1 - np.arange(len(known))
    column[np.setdiff1d(np.arange(len(joints)), known)] = np.arange(len(joints) - len(known))
    place = {joint: number for number, joint in enumerate(numbers_in_loops)}
    kinds = np.array([(place[joint], kind) for joint, kind in axes.kinds], dtype=np.int64).reshape(-1, 2)
    return Family(loops, signs, kinds, joints, column), np.array(axes.parameters, dtype=float).ravel()


def _check_driven(joints: Sequence[JointId], driven: Sequence[JointId], freedoms: int) -> None:
    for number, joint in enumerate(driven):
        if joint not in joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint of a loop", "a joint of a loop")
        if joint in driven[:number]:
            raise InvariantError("joint", f"joint {shown(joint)} is driven twice", "once")
    if len(driven) != freedoms:
        raise UnsolvableError(
            f"{numbered(len(driven), 'joint')} driven; expected as many as there are degrees of freedom, "
            f"M = {freedoms} by count"
        )


class _Axes:
    """The axes of a member, each with two parameters: one for each joint in each plane or sphere that it is in."""

    def __init__(self, linkage: PosedLinkage) -> None:
        self._linkage = linkage
        self._slides = set(linkage.slides)
        self._normals: list[Floats] = []
        self._numbers: dict[tuple[int, int], int] = {}
        self.kinds: list[tuple[int, int]] = []
        self.parameters: list[tuple[float, float]] = []

    def of_loop(self, loop: PosedLoop) -> tuple[list[int], list[int]]:
        """Return the axis of each joint of a loop, and -1 where it points against the normal of the plane."""
        directions = self._linkage.directions
        centre = self._centre(loop)
        if centre is Centre.FINITE:
            numbers = []
            for joint in loop.joints:
                x, y, z = directions[joint].tolist()
                numbers.append(self._added(joint, -1, DIRECTION, (atan2(hypot(x, y), z), atan2(y, x))))
            return numbers, [1] * len(loop.joints)
        if centre is not Centre.INFINITE:
            names = list(self._linkage.graph.joints)
            ids = ", ".join(shown(names[joint]) for joint in loop.joints)
            raise UnsolvableError(
                f"the axes of loop {ids} neither meet in a point nor are parallel, as positions require; "
                "try `synth fold`, which drives joints along the motion"
            )
        turning = [joint for joint in loop.joints if joint not in self._slides]
        plane, frame = self._plane(directions[turning])
        numbers, senses = [], []
        for joint in loop.joints:
            if joint in self._slides:
                x, y = frame[:2] @ directions[joint]
                numbers.append(self._added(joint, plane, SLIDE, (float(np.arctan2(y, x)), 0.0)))
                senses.append(1)
            else:
                x, y = frame[:2] @ self._linkage.points[joint]
                numbers.append(self._added(joint, plane, POINT, (float(x), float(y))))
                senses.append(1 if directions[joint] @ frame[2] > 0.0 else -1)
        return numbers, senses

    def _centre(self, loop: PosedLoop) -> Centre:
        """Return the centre of a loop, found from its axes where it is not declared."""
        if loop.centre is not Centre.NONE:
            return loop.centre
        turning = [joint for joint in loop.joints if joint not in self._slides]
        sliding = [joint for joint in loop.joints if joint in self._slides]
        axes, along = self._linkage.directions[turning], self._linkage.directions[sliding]
        if len(axes):  # parallel axes, and slides across them
            off = max(np.abs(np.cross(axes, axes[0])).max(), np.abs(along @ axes[0]).max(initial=0.0))
            if off <= DOUBLE.meant:
                return Centre.INFINITE
        if not sliding and float(lines_meet(self._linkage.points[turning], axes).off.max()) <= DOUBLE.meant:
            return Centre.FINITE
        return Centre.NONE

    def _plane(self, axes: Floats) -> tuple[int, Floats]:
        """Return the number of the plane across some axes, and its frame: one for all parallel planes."""
        for number, normal in enumerate(self._normals):
            if np.abs(np.cross(normal, axes[0])).max() <= DOUBLE.meant:
                return number, frame_about(normal)
        self._normals.append(axes[0])
        return len(self._normals) - 1, frame_about(axes[0])

    def _added(self, joint: int, plane: int, kind: int, parameters: tuple[float, float]) -> int:
        number = self._numbers.setdefault((joint, plane), len(self.kinds))
        if number == len(self.kinds):
            self.kinds.append((joint, kind))
            self.parameters.append(parameters)
        return number


_STARTS, _STEPS = 64, 25
_QUIET = 20
"""Curves in a row that bring nothing new, before the positions are taken for all: see `general_positions`."""
_MOST_CURVES = 120
_WIDE = 0.7
"""Imaginary parts of the angles of a general member's axes, at most, radians."""


class GeneralPositions(NamedTuple):
    """All positions (complex[N, U]) of a general member, and how many closed curves were walked to find them."""

    parameters: Complexes
    values: Complexes
    curves: int


def general_positions(family: Family, seed: int = 0) -> GeneralPositions:
    """Return all positions of a random member of a family; another seed is another member, and other curves.

    Raises `UnsolvableError` if the driven joints do not determine the others, `NumericalError` if the curves go on
    to bring new positions.
    """
    # A curve of members that comes back to where it began takes each position to a position, perhaps a new one.
    # Curves are walked until many in a row bring nothing new. If positions are missing, a curve takes all known ones
    # to known ones with a chance of one half at most: the permutations that do are a proper subgroup of all. (Half of
    # them do where one loop has two modes whatever the others have, so that 6 curves in a row were too few.)
    random = np.random.default_rng(seed)
    number, inputs = len(family.axes), len(family.joints) - family.unknowns
    here = np.concatenate([_random_axes(random, number), np.zeros(inputs, dtype=complex)])
    known = np.zeros((1, family.unknowns), dtype=complex)  # all joint angles are 0 where the axes were read
    parts = as_real(family.at(here, known[0])[1])
    if rank_of(parts) < min(parts.shape):
        raise UnsolvableError("the driven joints do not determine the others: drive joints that do")
    starts = _random(random, (_STARTS, family.unknowns), np.pi, 1.5)
    values, error = family.corrected(np.tile(here, (_STARTS, 1)), starts, _STEPS)
    known = apart(np.concatenate([known, values[error <= CLOSED]]), family.turning)
    quiet = 0
    for curves in range(1, _MOST_CURVES + 1):
        turn = np.concatenate([_random_axes(random, number), _random(random, inputs, np.pi, np.pi)])
        # there and back on different curves: the closed curve permutes positions
        there = _carried(family, (here, turn), known, random)
        back = _carried(family, (turn, here), there, random)
        more = apart(np.concatenate([known, back]), family.turning)
        quiet = quiet + 1 if len(more) == len(known) else 0
        known = more
        if quiet == _QUIET:
            return GeneralPositions(here, known, curves)
    raise NumericalError(f"after {_MOST_CURVES} curves new positions still appear, {len(known)} so far")


def apart(values: Complexes, turning: Flags) -> Complexes:
    """Return solutions each once; angles, which `turning` (bool[U]) marks, are the same but for whole turns."""
    kept: list[Complexes] = []
    for solution in values:
        if not same(np.array(kept).reshape(-1, len(turning)), solution, turning).any():
            kept.append(solution)
    return np.array(kept).reshape(-1, values.shape[1])


def same(values: Complexes, solution: Complexes, turning: Flags) -> Flags:
    """Return which of some solutions, complex[N, U], are one solution, complex[U]: bool[N]."""
    off = values - solution
    off = off - 2 * np.pi * np.where(turning, np.rint(off.real / (2 * np.pi)), 0.0)
    return np.asarray(np.abs(off).max(axis=1, initial=0.0) <= DOUBLE.same_configuration)


def as_real(matrix: Complexes) -> Floats:
    """Return a complex matrix as a real one of twice its size, and twice its rank."""
    return np.block([[matrix.real, -matrix.imag], [matrix.imag, matrix.real]])


def _carried(
    family: Family, ends: tuple[Complexes, Complexes], values: Complexes, random: np.random.Generator
) -> Complexes:
    """Return solutions carried from one member to another along a random curve."""
    bend = _random(random, len(ends[0]), 1.0, 1.0)
    first, last, bent = (np.tile(parameters, (len(values), 1)) for parameters in (*ends, bend))
    paths = family.followed((first, last, bent), values)
    return paths.values[paths.arrived]


def _random_axes(random: np.random.Generator, number: int) -> Complexes:
    """Return complex angles of axes."""
    tilts, turns = random.uniform(0.4, np.pi - 0.4, number), random.uniform(-np.pi, np.pi, number)
    pairs = np.stack([tilts, turns], axis=1) + 1j * random.uniform(-_WIDE, _WIDE, (number, 2))
    return np.asarray(pairs.ravel())


def _random(random: np.random.Generator, shape: int | tuple[int, int], real: float, imaginary: float) -> Complexes:
    return np.asarray(random.uniform(-real, real, shape) + 1j * random.uniform(-imaginary, imaginary, shape))


_FILES = ("family.py", "kernel.py", "kernel.c")
_MOST = 64
"""Types that a process remembers."""
_remembered: dict[str, GeneralPositions] = {}


def kept_positions(family: Family, seed: int = 0) -> GeneralPositions:
    """Return all positions of a general member of a family: those that are kept, or `general_positions`."""
    name = _name(family, seed)
    general = _remembered.get(name)
    if general is None:
        text = kept(_folder(), name)
        general = _read(text) if text is not None else general_positions(family, seed)
        if text is None:
            keep(_folder(), name, _written(general))
        while len(_remembered) >= _MOST:
            _remembered.pop(next(iter(_remembered)), None)
        _remembered[name] = general
    return general


def _name(family: Family, seed: int) -> str:
    arrays = (family.loops, family.signs, family.axes, family.column)
    of_type = [(array.shape, array.tolist()) for array in arrays]
    return f"{sha256(repr((of_type, seed)).encode()).hexdigest()[:32]}.npz"


@cache
def _folder() -> str:
    texts = b"".join(Path(__file__).with_name(name).read_bytes() for name in _FILES)
    return f"{__name__}-{sha256(texts + np.__version__.encode()).hexdigest()[:32]}"


def _written(general: GeneralPositions) -> bytes:
    text = io.BytesIO()
    np.savez(text, parameters=general.parameters, values=general.values, curves=np.array(general.curves))
    return text.getvalue()


def _read(text: bytes) -> GeneralPositions:
    with np.load(io.BytesIO(text), allow_pickle=False) as arrays:
        return GeneralPositions(arrays["parameters"], arrays["values"], int(arrays["curves"]))


_POLISHED = 4
_TOWARDS_SINGULAR, _LEVENBERG = 30, 1e-3
"""Steps of Newton's method towards a singular position, regularised by a share of what does not close."""
_NEAR_END = 1e-2
"""A path that could not go on ended so near to a singular position, radians and units of the extent."""
_SURER = (SMALL, SMALL / 30, SMALL / 1000)
"""Corrections that are allowed along paths: less, where one was lost, or two came to one place."""


class Solutions(NamedTuple):
    """The ends of the paths from the positions of a general member to one member.

    `values`, complex[N, U], are the unknowns of the positions, real or not, each once; `regular`, bool[N], says
    where the closure equations are independent, so that the position is rigid at its inputs. Of the paths, `far`
    went to infinity, `singular` ended where closure equations depend on each other (the linkage moves though its
    inputs are held, or positions come together), `lost` ended at unknown places.
    """

    values: Complexes
    regular: Flags
    far: int
    singular: int
    lost: int


def solutions_of_many(family: Family, general: GeneralPositions, members: Floats, seed: int = 0) -> list[Solutions]:
    """Return the solutions of each of many members, float[N, parameters]: as `solutions` does, by the same curves.

    All are followed at once; where a path of a member was lost, that one is solved again by itself.
    """
    count = len(general.values)
    bend = _bend(np.random.default_rng(seed), members.shape[1])
    start, bent = (np.tile(each, (count * len(members), 1)) for each in (general.parameters, bend))
    followed = family.followed(
        (start, np.repeat(members, count, axis=0).astype(complex), bent),
        np.tile(general.values, (len(members), 1)),
        _SURER[0],
    )
    every = []
    for number, member in enumerate(members):
        own = slice(number * count, (number + 1) * count)
        end = np.tile(member.astype(complex), (count, 1))
        paths = TrackedPaths(followed.values[own], followed.arrived[own], followed.far[own])
        ends = _ends(family, end, paths)
        every.append(solutions(family, general, member, seed) if ends.lost else ends)
    return every


def _bend(random: np.random.Generator, parameters: int) -> Complexes:
    """Return by what the way to a member is bent."""
    return np.asarray(random.uniform(-1.0, 1.0, parameters) + 1j * random.uniform(-1.0, 1.0, parameters))


def solutions(family: Family, general: GeneralPositions, member: Floats, seed: int = 0) -> Solutions:
    """Return all positions of one member, real or not, by following those of a general one.

    The path of members is bent at random into complex parameters, so that it meets no special member on the way.
    """
    random = np.random.default_rng(seed)
    count = len(general.values)
    best = None
    for small in _SURER:
        bend = _bend(random, len(member))
        curve = (general.parameters, member.astype(complex), bend)
        start, end, bent = (np.tile(parameters, (count, 1)) for parameters in curve)
        followed = family.followed((start, end, bent), general.values, small)
        ends = _ends(family, end, followed)
        if best is None or ends.lost < best.lost:
            best = ends
        if not ends.lost:
            break
    assert best is not None
    return best


def _ends(family: Family, member: Complexes, followed: TrackedPaths) -> Solutions:
    """Return where paths ended."""
    polished, parameters = _polished(family, member, followed), member[0]
    values = apart(polished, family.turning)
    regular = np.array([_is_regular(family, parameters, solution) for solution in values], dtype=bool)
    # several paths may end in one singular position; paths that stopped near one count as singular too
    paths = np.array([int(same(polished, solution, family.turning).sum()) for solution in values], dtype=int)
    stopped = followed.values[~(followed.arrived | followed.far)]
    singular = int((paths - 1)[~regular].sum()) + sum(_is_singular(family, parameters, end) for end in stopped)
    far = int(followed.far.sum())
    return Solutions(values, regular, far, singular, len(member) - far - len(values) - singular)


def _is_regular(family: Family, parameters: Complexes, values: Complexes, zero: float = DOUBLE.zero) -> bool:
    """Return whether the closure equations are independent of each other."""
    parts = as_real(family.at(parameters, values)[1])
    return bool(rank_of(parts, zero) == min(parts.shape))


def _is_singular(family: Family, parameters: Complexes, start: Complexes) -> bool:
    """Return whether a singular position is near, where a path could not go on."""
    values = start.copy()
    for _ in range(_TOWARDS_SINGULAR):
        residual, derivatives = family.at(parameters, values)
        gram = derivatives @ derivatives.conj().T
        regular = max(_LEVENBERG * float(np.abs(residual).max()), EPSILON * float(np.abs(gram).max()))
        values = values - derivatives.conj().T @ np.linalg.solve(gram + regular * np.eye(len(gram)), residual)
    residual, _ = family.at(parameters, values)
    near = float(np.abs(values - start).max()) <= _NEAR_END
    closed = bool(np.abs(residual).max() <= CLOSED)
    return near and closed and not _is_regular(family, parameters, values, DOUBLE.singular)


def _polished(family: Family, parameters: Complexes, paths: TrackedPaths) -> Complexes:
    """Return where paths arrived, real ones with angles that are so to the last digit."""
    values = paths.values[paths.arrived]
    real = np.abs(values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    near = np.where(real[:, None], values.real, values)
    sharp, errors = family.corrected(parameters[paths.arrived], near, _POLISHED)
    return np.where((errors <= CLOSED)[:, None], sharp, values)
