"""All assembly modes of a linkage at given inputs, with the circuits and branches they belong to.

Positions of one *circuit* are reached from each other without taking the linkage apart; those of one *branch* of
it without the driven joint turning back. Theory: docs/theory/positions.md.
"""

from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import degrees, isfinite
from typing import Any, NamedTuple

import numpy as np

from graphs.errors import InvariantError, SynthedraError, check_argument, numbered, shown
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE, EPSILON, canonical_order
from graphs.types import Flags, Floats, JointId
from synth.assembly.family import SMALL, Family, GeneralPositions, TrackedPaths, apart, as_real, family_of, same
from synth.assembly.kept import kept_positions
from synth.assembly.kernel import CLOSED, Complexes
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage
from synth.motion.path import circuit_through
from synth.motion.walk.events import TurningPoint
from synth.motion.walk.step import Step
from synth.motion.walk.walking import Event, Walk
from synth.moving.made import Movable, configuration_of

_OTHER_QUESTION = "positions finds all configurations at given angles of driven joints, on all branches"


@dataclass(frozen=True, slots=True)
class AssemblyMode:
    """A configuration of a linkage at given angles of its driven joints.

    Attributes
    ----------
    angles : float[J]
        Of all joints, radians, from -pi to pi; creases from flat, other joints from the input configuration. Of
        prismatic joints lengths, in the unit of the coordinates.
    regular : bool
        Whether the linkage is rigid there while its driven joints are held, by the rank of its closure equations.
    circuit, branch : int or None
        From 0; positions of one circuit are reached from each other, those of one branch without the driven joint
        turning back. None where they were not computed.
    """

    angles: Floats
    regular: bool = True
    circuit: int | None = None
    branch: int | None = None


@dataclass(frozen=True, slots=True, repr=False)
class PositionSet(Printed):
    """All positions at angles of driven joints. It prints as ``synth positions`` does.

    Attributes
    ----------
    configuration : Configuration
        The input.
    joints : tuple of joint ids
    driven : mapping of joint id to float
        Radians; of prismatic joints lengths.
    positions : tuple of AssemblyMode
        Real ones.
    general : int
        How many a generic realisation of the family has, real or not.
    imaginary, far, singular, lost : int
        Those of this one that are not real; at infinity, since its proportions are special; at singular
        configurations, where the linkage moves though its driven joints are held, or where positions coincide;
        lost in tracking.
    curves : int
        Closed curves of members that were walked to count those of a general member.
    notes : tuple of str

    Examples
    --------
    >>> from synth.patterns import generate
    >>> positions(generate("four-bar").mechanism, drive={0: 0.2})
    <PositionSet: 2 of 2>
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    driven: Mapping[JointId, float]
    positions: tuple[AssemblyMode, ...]
    general: int
    imaginary: int
    far: int
    singular: int
    lost: int
    curves: int
    notes: tuple[str, ...] = ()

    @property
    def exhaustive(self) -> bool:
        """Whether each position of the general member was followed to one that is listed, or to infinity."""
        return not self.lost and not self.singular

    @property
    def slides(self) -> frozenset[JointId]:
        """The prismatic joints."""
        return frozenset(self.joints[place] for place in self.configuration.linkage.slides)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            **self._values(self.driven.items(), "driven_deg", "driven_lengths"),
            "positions": [
                {
                    **self._values(zip(self.joints, mode.angles.tolist(), strict=True), "angles_deg", "lengths"),
                    "regular": mode.regular,
                    "circuit": mode.circuit,
                    "branch": mode.branch,
                }
                for mode in self.positions
            ],
            "general": self.general,
            "imaginary": self.imaginary,
            "at_infinity": self.far,
            "singular": self.singular,
            "lost": self.lost,
            "exhaustive": self.exhaustive,
            "curves": self.curves,
            "notes": list(self.notes),
        }

    def _values(self, values: Iterable[tuple[JointId, float]], angles: str, lengths: str) -> dict[str, Any]:
        """Return angles in degrees under one key, and where joints slide lengths under another."""
        slides, values = self.slides, list(values)
        turned = {str(joint): degrees(value) for joint, value in values if joint not in slides}
        slid = {str(joint): value for joint, value in values if joint in slides}
        return {angles: turned, lengths: slid} if slides else {angles: turned}

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        inputs = " and ".join(
            f"joint {plain(joint)} at {value:g}"
            if joint in self.slides
            else f"joint {plain(joint)} at {degrees(value):g}°"
            for joint, value in self.driven.items()
        )
        count = numbered(len(self.positions), "assembly mode")
        blocks: list[Block] = [f"{count} with {inputs}" if inputs else count]
        if self.positions:
            all_rigid = all(mode.regular for mode in self.positions)
            rigid = () if all_rigid else ("rigid",)
            titles = ("assembly mode", *rigid, "circuit", "branch", *map(plain, self.joints))
            rows = []
            for number, mode in enumerate(self.positions, start=1):
                values = zip(self.joints, mode.angles.tolist(), strict=True)
                angles = (value if joint in self.slides else degrees(value) for joint, value in values)
                is_rigid = () if all_rigid else ("yes" if mode.regular else "no",)
                places = ("-" if place is None else str(place + 1) for place in (mode.circuit, mode.branch))
                rows.append((str(number), *is_rigid, *places, *(f"{angle + 0.0:.4f}" for angle in angles)))
            blocks.append(TableBlock(titles, rows, titles))
        return [*blocks, self._evidence(), *(f"note: {note}" for note in self.notes)]

    def _evidence(self) -> str:
        """Return a sentence with the evidence that these are all."""
        parts = [f"{len(self.positions)} real", f"{self.imaginary} complex"]
        if self.far:
            parts.append(f"{self.far} at infinity")
        movable = sum(not mode.regular for mode in self.positions)
        if movable:
            parts[0] += f" ({movable} of them singular)"
        if self.singular:
            parts.append(
                f"{self.singular} at singular configurations, where the linkage moves or assembly modes coincide"
            )
        if self.lost:
            parts.append(f"{self.lost} lost in tracking")
        counted = f"a generic realisation has {self.general}, counted over {numbered(self.curves, 'closed curve')}"
        tracked = "all solutions tracked" if self.exhaustive else "not all solutions tracked"
        return f"{tracked}: {counted}; here {', '.join(parts)}"

    def __repr__(self) -> str:
        return f"<PositionSet: {len(self.positions)} of {self.general}>"


class _Passed(Event):
    """Where a walk passes some positions, float[J] each: `frames` are those before them."""

    def __init__(self, positions: dict[int, Floats]) -> None:
        self._positions = positions
        self.frames: dict[int, int] = {}

    def after(self, walk: Walk, step: Step) -> None:
        for number, position in self._positions.items():
            if number not in self.frames and step.passing(position, DOUBLE.same_configuration) is not None:
                self.frames[number] = len(walk.frames) - 1


_POLISHED = 4
_TOWARDS_SINGULAR, _LEVENBERG = 30, 1e-3
"""Steps of Newton's method towards a singular position, regularised by a share of what does not close."""
_NEAR_END = 1e-2
"""A path that could not go on ended so near to a singular position, radians and units of the extent."""
_SURER = (SMALL, SMALL / 30, SMALL / 1000)
"""Corrections that are allowed along paths: less, where one was lost, or two came to one place."""


def positions(
    mechanism: Movable, *, drive: Mapping[JointId, float], circuits: bool = True, seed: int = 0
) -> PositionSet:
    """Find all positions of a spherical or planar linkage at angles of as many driven joints as it has freedoms.

    Parameters
    ----------
    mechanism : Mechanism or PosedLinkage
        With coordinates. The axes of each loop meet in a point, which need not be the same for all, or are
        parallel; prismatic joints slide across them.
    drive : mapping of joint id to float
        Radians; of creases fold angles, of other joints from the input configuration. Of prismatic joints lengths,
        in the unit of the coordinates. Empty for a linkage of mobility 0, whose assemblies are found.
    circuits : bool, optional
        Find the circuits and branches of a linkage of one freedom.
    seed : int, optional
        Random seed of the general member that the search starts from.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, or a spatial loop; if the driven joints are not as many as the freedoms by count,
        or do not determine the others.
    InvariantError
        If a driven joint is in no loop, or an angle is no number.
    NumericalError
        If the positions of a general member could not be counted.

    Examples
    --------
    >>> from math import radians
    >>> from synth.patterns import generate
    >>> answer = positions(generate("four-bar").mechanism, drive={0: radians(10)})
    >>> len(answer.positions), answer.general, answer.exhaustive
    (2, 2, True)
    """
    check_argument("positions", mechanism, Movable)
    at = configuration_of(mechanism, slides=True)
    linkage = at.linkage
    for joint, angle in drive.items():
        if not isfinite(angle):
            raise InvariantError("angle", f"the angle of joint {shown(joint)} is {angle}", "a finite number")
    family, axes = family_of(linkage, list(drive))
    general = kept_positions(family, seed)
    names = list(linkage.graph.joints)
    places = [names.index(joint) for joint in drive]
    units = _units(linkage)
    inputs = np.array(list(drive.values()), dtype=float) / units[places]
    member = np.concatenate([axes, inputs - linkage.angles[places]])
    ends = solutions(family, general, member, seed)
    real = np.abs(ends.values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration
    angles = [_angles(linkage, family, member, unknowns) for unknowns in ends.values.real[real]]
    order = canonical_order(angles)
    answer = PositionSet(
        at,
        tuple(names),
        dict(drive),
        tuple(AssemblyMode(angles[place] * units, bool(ends.regular[real][place])) for place in order),
        len(general.values),
        int((~real).sum()),
        ends.far,
        ends.singular,
        ends.lost,
        general.curves,
    )
    return _with_circuits(answer) if circuits and len(drive) == 1 else answer


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


def solutions(family: Family, general: GeneralPositions, member: Floats, seed: int = 0) -> Solutions:
    """Return all positions of one member, real or not, by following those of a general one.

    The path of members is bent at random into complex parameters, so that it meets no special member on the way.
    """
    random = np.random.default_rng(seed)
    count = len(general.values)
    best = None
    for small in _SURER:
        bend = random.uniform(-1.0, 1.0, len(member)) + 1j * random.uniform(-1.0, 1.0, len(member))
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


def _angles(linkage: PosedLinkage, family: Family, member: Floats, unknowns: Floats) -> Floats:
    """Return the angles of all joints, above -180 and up to 180 degrees; joints in no loop stay as they are.

    Joints that slide have lengths, in units of the extent.
    """
    names = list(linkage.graph.joints)
    whole = linkage.angles.copy()
    inputs = member[2 * len(family.axes) :]
    for joint, column in zip(family.joints, family.column.tolist(), strict=True):
        whole[names.index(joint)] += unknowns[column] if column >= 0 else inputs[-1 - column]
    half_turn = np.pi + DOUBLE.parallel  # 180 degrees but for rounding, and not -180
    wrapped = np.asarray(half_turn - np.remainder(half_turn - whole, 2 * np.pi))
    slides = list(linkage.slides)
    wrapped[slides] = whole[slides]
    return wrapped


def _units(linkage: PosedLinkage) -> Floats:
    """Return what joint angles and lengths are multiplied by to be in the unit of the coordinates: float[J]."""
    units = np.ones(len(linkage.angles))
    units[list(linkage.slides)] = linkage.extent
    return units


def _with_circuits(answer: PositionSet) -> PositionSet:
    """Add circuits and branches, counted in each circuit, of a linkage of one freedom, or a note why not."""
    closure, units = answer.configuration.closure, _units(answer.configuration.linkage)
    driver = answer.joints.index(next(iter(answer.driven)))
    left = {number: mode.angles / units for number, mode in enumerate(answer.positions)}
    modes, notes, circuits = list(answer.positions), list(answer.notes), 0
    while left:
        number, passed = next(iter(left)), _Passed(left)
        try:
            circuit = circuit_through(closure, left[number], events=[TurningPoint(driver), passed])
        except SynthedraError as error:
            return replace(answer, notes=(*answer.notes, f"circuits unknown: {error}"))
        if circuit.stopped:
            notes.append(f"circuit {circuits + 1} was not traced all round: {circuit.stopped}")
        if circuit.meets:
            notes.append(f"circuit {circuits + 1} meets another one; it was traced straight on")
        # turning points part a closed circuit into as many branches, an open one into one more
        branches = len(circuit.turning) if not circuit.stopped and circuit.turning else len(circuit.turning) + 1
        for other, frame in {**passed.frames, number: 0}.items():
            branch = bisect_right(circuit.turning, frame) % branches
            modes[other] = replace(modes[other], circuit=circuits, branch=branch)
            del left[other]
        circuits += 1
    return replace(answer, positions=tuple(modes), notes=tuple(notes))
