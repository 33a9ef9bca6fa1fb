"""All assembly modes of a linkage at given inputs, at many of them as arrays, with their circuits and branches.

Positions of one *circuit* are reached from each other without taking the linkage apart; those of one *branch* of
it without the driven joint turning back. Theory: docs/theory/positions.md.
"""

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import degrees
from typing import Any, Literal, NamedTuple, overload

import numpy as np

from graphs.errors import InvariantError, SynthedraError, check_argument, numbered, shown
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Flags, Floats, Ints, JointId, LinkId
from synth.analysis.assembly.cutting import with_own_joints
from synth.analysis.assembly.ends import Solutions, solutions_of_many, with_given
from synth.analysis.assembly.family import Family, family_of
from synth.analysis.assembly.general import GeneralPositions, kept_positions
from synth.analysis.assembly.kernel import Complexes
from synth.analysis.assembly.precise import certified
from synth.analysis.assembly.redundant import Loosened, loosened
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.path import circuit_through
from synth.analysis.motion.walk.events import TurningPoint
from synth.analysis.motion.walk.step import Step
from synth.analysis.motion.walk.walking import Event, Walk
from synth.analysis.moving._configuration_of import Movable, configuration_of

Evidence = Literal["proved", "numerical (trace test)"]
PROVED: Evidence = "proved"
TRACED: Evidence = "numerical (trace test)"
"""Why a list is complete: as many certified positions as a theorem allows; a trace test, and no path lost."""

OTHER_QUESTION = "positions finds all configurations at given angles of driven joints, on all branches"


@dataclass(frozen=True, slots=True, repr=False)
class PositionTable(Printed):
    """All assembly modes at each of many inputs: F inputs of D driven joints, J joints, at most M real modes.

    Attributes
    ----------
    configuration : Configuration
        The mechanism that was given.
    joints, driven : tuple of joint id
    inputs : float[F, D]
        Radians; of prismatic joints lengths.
    angles : float[F, M, J]
        Of the real modes, in the order of `positions` at each input; nan where there are fewer.
    regular : bool[F, M]
        Whether the linkage is rigid there while its driven joints are held.
    count : int[F]
        How many real modes there are.
    general : int
        How many a generic realisation has, real or not.
    imaginary, far, singular, lost : int[F]
        The others at each input, as of `PositionSet`.
    evidence : tuple of str or None
        Why the modes at each input are all: "proved", "numerical (trace test)", or None where there may be more.
    curves : int
        Closed curves that were walked to find those of a generic realisation.

    Examples
    --------
    >>> from synth.analysis.assembly import positions
    >>> from synth.catalogue.patterns import generate
    >>> table = positions(generate("four-bar").mechanism, drive={0: [0.0, 0.5, 1.0]})
    >>> table.count.tolist(), table.angles.shape, table.evidence[0]
    ([2, 2, 2], (3, 2, 4), 'proved')
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    driven: tuple[JointId, ...]
    inputs: Floats
    angles: Floats
    regular: Flags
    count: Ints
    general: int
    imaginary: Ints
    far: Ints
    singular: Ints
    lost: Ints
    evidence: tuple[Evidence | None, ...]
    curves: int

    @property
    def exhaustive(self) -> Flags:
        """At which inputs these are all: bool[F]."""
        return np.array([evidence is not None for evidence in self.evidence], dtype=bool)

    def __len__(self) -> int:
        return len(self.inputs)

    def __repr__(self) -> str:
        return f"<PositionTable: {numbered(len(self), 'input')}, {int(self.count.sum())} modes>"

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        joints = ", ".join(map(plain, self.driven))
        numbers, inputs = np.unique(self.count, return_counts=True)
        rows = [(str(modes), str(many)) for modes, many in zip(numbers.tolist(), inputs.tolist(), strict=True)]
        known = [f"{evidence} at {self.evidence.count(evidence)}" for evidence in (PROVED, TRACED)]
        return [
            f"assembly modes at {numbered(len(self), 'input')} of joint {joints}",
            TableBlock(("assembly modes", "inputs"), rows, ["assembly modes", "inputs"]),
            f"a generic realisation has {self.general}; these are all: {', '.join(known)} of {len(self)} inputs",
        ]

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data, angles in radians; of each input as many modes as there are."""
        modes = [rows[:count].tolist() for rows, count in zip(self.angles, self.count.tolist(), strict=True)]
        rigid = [rows[:count].tolist() for rows, count in zip(self.regular, self.count.tolist(), strict=True)]
        return {
            "configuration": self.configuration.to_json(other_question=OTHER_QUESTION),
            "joints": list(self.joints),
            "driven": list(self.driven),
            "inputs": self.inputs.tolist(),
            "positions": modes,
            "regular": rigid,
            "general": self.general,
            **{name: getattr(self, name).tolist() for name in ("imaginary", "far", "singular", "lost")},
            "exhaustive": list(self.evidence),
            "curves": self.curves,
        }


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
    evidence : str or None
        Why these are all: "proved", "numerical (trace test)", or None where there may be more.
    curves : int
        Closed curves of members that were walked to find those of a general member.
    redundant : tuple of link ids
        Bars that repeat what the rest implies. They are given an elbow; the modes are those, among `general`, in
        which it is as in the linkage.
    misfits : int
        Those in which an elbow is bent.
    notes : tuple of str

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
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
    evidence: Evidence | None
    curves: int
    redundant: tuple[LinkId, ...] = ()
    misfits: int = 0
    notes: tuple[str, ...] = ()

    @property
    def exhaustive(self) -> bool:
        """Whether these are all."""
        return self.evidence is not None

    @property
    def slides(self) -> frozenset[JointId]:
        """The prismatic joints."""
        return frozenset(self.joints[place] for place in self.configuration.linkage.slides)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=OTHER_QUESTION),
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
            "exhaustive": self.evidence,
            "curves": self.curves,
            "redundant": list(self.redundant),
            "misfits": self.misfits,
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
        count = f"{'' if self.exhaustive else 'at least '}{numbered(len(self.positions), 'assembly mode')}"
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
        if self.misfits:
            parts.append(f"{self.misfits} with an elbow bent")
        links = ", ".join(map(plain, self.redundant))
        bent = f" with an elbow in the redundant {'link' if len(self.redundant) == 1 else 'links'} {links}"
        elbows = bent if links else ""
        proof = {
            PROVED: "all assembly modes, proved",
            TRACED: "all assembly modes, numerical (trace test)",
            None: "there may be more",
        }[self.evidence]
        return f"{proof}: a generic realisation{elbows} has {self.general}; here {', '.join(parts)}"

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


@overload
def positions(
    mechanism: Movable, *, drive: Mapping[JointId, float], circuits: bool | None = None, seed: int = 0
) -> PositionSet: ...


@overload
def positions(
    mechanism: Movable,
    *,
    drive: Mapping[JointId, Sequence[float] | Floats],
    circuits: bool | None = None,
    seed: int = 0,
) -> PositionTable: ...


def positions(
    mechanism: Movable,
    *,
    drive: Mapping[JointId, float] | Mapping[JointId, Sequence[float] | Floats],
    circuits: bool | None = None,
    seed: int = 0,
) -> PositionSet | PositionTable:
    """Find all positions of a spherical or planar linkage at angles of as many driven joints as it has freedoms.

    Parameters
    ----------
    mechanism : Mechanism or Linkage
        With coordinates. The axes of each loop meet in a point, which need not be the same for all, or are
        parallel; prismatic joints slide across them.
    drive : mapping of joint id to float, or to float[F]
        Radians; of creases fold angles, of other joints from the input configuration. Of prismatic joints lengths,
        in the unit of the coordinates. Empty for a linkage of mobility 0, whose assemblies are found. With arrays
        all are found at each of F inputs.
    circuits : bool, optional
        Find the circuits and branches of a linkage of one freedom: by default at one input, and not at many.
    seed : int, optional
        Random seed of the general member that the search starts from.

    Returns
    -------
    PositionSet, or of arrays PositionTable

    Raises
    ------
    UnsolvableError
        If it has no coordinates, or a spatial loop; if the driven joints are not as many as the freedoms by count,
        or do not determine the others.
    InvariantError
        If a driven joint is in no loop, an angle is no number, or arrays are not of one length.
    NumericalError
        If the positions of a general member could not be counted.

    Examples
    --------
    >>> from math import radians
    >>> from synth.catalogue.patterns import generate
    >>> answer = positions(generate("four-bar").mechanism, drive={0: radians(10)})
    >>> len(answer.positions), answer.general, answer.exhaustive
    (2, 2, True)
    >>> positions(generate("four-bar").mechanism, drive={0: np.linspace(0, 1, 100)})
    <PositionTable: 100 inputs, 200 modes>
    """
    check_argument("positions", mechanism, Movable)
    at = configuration_of(mechanism, slides=True)
    linkage = at.linkage
    inputs, several = _inputs(drive)
    if several and circuits:
        raise InvariantError("circuits", "circuits of many inputs", "one input")
    loose = loosened(linkage, list(drive), at.tolerances)
    opened = with_own_joints(loose.linkage, at.tolerances)
    family, axes = family_of(opened, list(drive), at.tolerances)
    names = list(linkage.graph.joints)
    places = [names.index(joint) for joint in drive]
    units = _units(linkage)
    turned = inputs / units[places] - linkage.angles[places]
    members = np.array([family.member(axes, row) for row in turned])
    general = kept_positions(family, seed)
    ends = _ends(family, general, members, seed)
    proofs = [_is_proved(loose, family, general, *one) for one in zip(members, ends, strict=True)]
    if not all(proofs) and not general.traced:
        found, general = len(general.values), kept_positions(family, seed, trace=True)
        if len(general.values) != found:
            ends = _ends(family, general, members, seed)
    evidence = tuple(map(_evidence, [general] * len(ends), ends, proofs))
    straight = max(DOUBLE.same_configuration, at.tolerances.zero)
    modes = [_real(loose, family, *one, units, straight) for one in zip(members, ends, strict=True)]
    if several:
        return _table(at, tuple(drive), inputs, general, modes, evidence)
    (found_modes,) = modes
    answer = PositionSet(
        at,
        tuple(names),
        dict(zip(drive, inputs[0].tolist(), strict=True)),
        tuple(AssemblyMode(*mode) for mode in zip(found_modes.angles, found_modes.regular.tolist(), strict=True)),
        len(general.values),
        found_modes.imaginary,
        ends[0].far,
        ends[0].singular,
        ends[0].lost,
        evidence[0],
        general.curves,
        loose.bars,
        found_modes.misfits,
    )
    return _with_circuits(answer) if circuits is not False and len(drive) == 1 else answer


def _ends(family: Family, general: GeneralPositions, members: Complexes, seed: int) -> list[Solutions]:
    followed = solutions_of_many(family, general, members, seed)
    return [with_given(family, *one) for one in zip(members, followed, strict=True)]


def _is_proved(loose: Loosened, family: Family, general: GeneralPositions, member: Complexes, ends: Solutions) -> bool:
    """Whether there are as many certified positions as are possible.

    Then there are no others, not even where the linkage moves: solutions of all members together are irreducible, so
    that near such a place general members would have one more. That redundant bars fit no computation proves.
    """
    if loose.bars or general.bound is None or len(ends.values) != general.bound:
        return False
    return bool(ends.regular.all()) and bool(certified(family, member, ends.values).all())


def _evidence(general: GeneralPositions, ends: Solutions, is_proved: bool) -> Evidence | None:
    if is_proved:
        return PROVED
    return TRACED if general.traced and not ends.lost and not ends.singular else None


def _inputs(drive: Mapping[JointId, Any]) -> tuple[Floats, bool]:
    """Return the angles of driven joints, float[F, D], and whether they were arrays."""
    columns = [np.asarray(angle, dtype=float) for angle in drive.values()]
    for joint, column in zip(drive, columns, strict=True):
        if not np.isfinite(column).all():
            angle = column.ravel()[~np.isfinite(column.ravel())][0]
            raise InvariantError("angle", f"the angle of joint {shown(joint)} is {angle}", "a finite number")
    shapes = {column.shape for column in columns}
    if len(shapes) > 1 or any(len(shape) > 1 for shape in shapes):
        listed = ", ".join(map(str, sorted(shapes)))
        raise InvariantError("inputs", f"inputs of shapes {listed}", "a number, or float[F], for each driven joint")
    if not columns:
        return np.zeros((1, 0)), False
    return np.stack([np.atleast_1d(column) for column in columns], axis=1), columns[0].ndim == 1


class _RealModes(NamedTuple):
    """The real ones of some solutions in their order: angles float[M, J], in units of the coordinates."""

    angles: Floats
    regular: Flags
    imaginary: int
    misfits: int
    ends: Solutions


def _real(
    loose: Loosened, family: Family, member: Complexes, ends: Solutions, units: Floats, straight: float
) -> _RealModes:
    linkage, joints = loose.linkage, len(units)
    elbows = [family.column[place] for place in range(len(family.joints)) if family.joints[place] in loose.elbows]
    turns = ends.values[:, elbows]
    off = np.abs(turns - 2 * np.pi * np.rint(turns.real / (2 * np.pi))).max(axis=1, initial=0.0)
    fits = off <= straight
    real = fits & (np.abs(ends.values.imag).max(axis=1, initial=0.0) <= DOUBLE.same_configuration)
    angles = [_angles(linkage, family, member, unknowns)[:joints] for unknowns in ends.values.real[real]]
    order = canonical_order(angles)
    listed = np.array([angles[place] * units for place in order]).reshape(-1, joints)
    imaginary = int((fits & ~real).sum())
    return _RealModes(listed, ends.regular[real][list(order)], imaginary, int((~fits).sum()), ends)


def _table(
    at: Configuration,
    driven: tuple[JointId, ...],
    inputs: Floats,
    general: GeneralPositions,
    modes: Sequence[_RealModes],
    evidence: tuple[Evidence | None, ...],
) -> PositionTable:
    most, joints = max((len(one.angles) for one in modes), default=0), tuple(at.linkage.graph.joints)
    angles = np.full((len(modes), most, len(joints)), np.nan)
    regular = np.zeros((len(modes), most), dtype=bool)
    for number, one in enumerate(modes):
        angles[number, : len(one.angles)], regular[number, : len(one.angles)] = one.angles, one.regular
    counts = [
        np.array(column, dtype=np.int64)
        for column in (
            [len(one.angles) for one in modes],
            [one.imaginary for one in modes],
            [one.ends.far for one in modes],
            [one.ends.singular for one in modes],
            [one.ends.lost for one in modes],
        )
    ]
    count, imaginary, far, singular, lost = counts
    return PositionTable(
        at, joints, driven, inputs, angles, regular, count, len(general.values), imaginary, far, singular, lost,
        evidence, general.curves,
    )  # fmt: skip


def _angles(linkage: Linkage, family: Family, member: Complexes, unknowns: Floats) -> Floats:
    """Return the angles of all joints, above -180 and up to 180 degrees; joints in no loop stay as they are.

    Joints that slide have lengths, in units of the extent.
    """
    names = list(linkage.graph.joints)
    whole = linkage.angles.copy()
    inputs = member[2 * len(family.axes) :].real
    for joint, column in zip(family.joints, family.column.tolist(), strict=True):
        whole[names.index(joint)] += unknowns[column] if column >= 0 else inputs[-1 - column]
    half_turn = np.pi + DOUBLE.parallel  # 180 degrees but for rounding, and not -180
    wrapped = np.asarray(half_turn - np.remainder(half_turn - whole, 2 * np.pi))
    slides = list(linkage.slides)
    wrapped[slides] = whole[slides]
    return wrapped


def _units(linkage: Linkage) -> Floats:
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
