"""Springs and moments at the joints of a linkage: energy, equilibria, load paths, small motions with masses.

Theory: docs/theory/compliance.md.
"""

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field
from math import isfinite, pi
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import scipy.linalg

from graphs.convert.duality import mechanism_of_sheet
from graphs.edit.named import known
from graphs.errors import InvariantError, NumericalError, UnsolvableError, shown
from graphs.geometry import unit
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.rank.singular_values import inertia, null_space, split
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats, JointId, LinkId
from synth.analysis.motion.branches import MOST_JOINTS, branches_of, search_for
from synth.analysis.motion.closure import ClosureEquations, corrected, exactly_held
from synth.analysis.motion.linkage import Linkage, joints_outwards, link_motions
from synth.analysis.motion.path import driven_path

_NUDGE = 1e-5


@dataclass(frozen=True, slots=True)
class Springs:
    """Torsion springs and dead moments at joints, in one system of units: moment, moment per radian.

    Attributes
    ----------
    stiffness : mapping of joint id to float
        0 or more; other joints turn freely.
    rest : mapping of joint id to float
        Angles at which springs are at rest, radians, from the zero of each joint; by default those of the linkage.
    moments : mapping of joint id to float
        That turn a joint's second link against its first, whatever its angle.

    Examples
    --------
    >>> Springs({0: 2.0, 2: 1.0}, rest={0: 0.5}).moments
    {}
    """

    stiffness: Mapping[JointId, float] = field(default_factory=dict)
    rest: Mapping[JointId, float] = field(default_factory=dict)
    moments: Mapping[JointId, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for what in ("stiffness", "rest", "moments"):
            for joint, value in getattr(self, what).items():
                if not isfinite(value) or (what == "stiffness" and value < 0.0):
                    expected = "a number, 0 or more" if what == "stiffness" else "a number"
                    raise InvariantError(what, f"joint {shown(joint)} has {value!r}", expected)
                if what == "rest" and not self.stiffness.get(joint):
                    raise InvariantError("rest", f"joint {shown(joint)} has no spring", "a stiffness")

    def check_joints(self, joints: tuple[JointId, ...]) -> None:
        """Raise `InvariantError` for joints that do not exist."""
        for joint in (*self.stiffness, *self.rest, *self.moments):
            if joint not in joints:
                raise InvariantError("joint", f"{shown(joint)} is no joint", known(joints, str(joint)))


@dataclass(frozen=True, slots=True)
class SpringArrays:
    """Springs and dead moments of many copies of one linkage, as `Springs` has them for one.

    Attributes
    ----------
    stiffness, rest, moments : mapping of joint id to float or float[N]
        A number holds for all copies.

    Raises
    ------
    InvariantError
        If arrays are not of one length, or as of `Springs`.

    Examples
    --------
    >>> copies = SpringArrays({0: [1.0, 2.0, 3.0], 2: 1.0}, rest={0: 0.5})
    >>> len(copies), copies[2]
    (3, Springs(stiffness={0: 3.0, 2: 1.0}, rest={0: 0.5}, moments={}))
    """

    stiffness: Mapping[JointId, npt.ArrayLike] = field(default_factory=dict)
    rest: Mapping[JointId, npt.ArrayLike] = field(default_factory=dict)
    moments: Mapping[JointId, npt.ArrayLike] = field(default_factory=dict)

    def __post_init__(self) -> None:
        shapes = {np.shape(value) for given in self._given.values() for value in given.values()} - {()}
        if len(shapes) > 1 or any(len(shape) > 1 for shape in shapes):
            listed = ", ".join(map(str, sorted(shapes)))
            raise InvariantError("springs", f"arrays of shapes {listed}", "numbers, and arrays float[N] of one length")

    @property
    def _given(self) -> dict[str, Mapping[JointId, npt.ArrayLike]]:
        return {"stiffness": self.stiffness, "rest": self.rest, "moments": self.moments}

    def __len__(self) -> int:
        sizes = [np.size(value) for given in self._given.values() for value in given.values() if np.ndim(value)]
        return sizes[0] if sizes else 1

    def __getitem__(self, number: int) -> Springs:
        """Return the springs of one copy. A rest angle without a stiffness there says nothing, and is left out."""
        own = {
            what: {joint: float(value[number] if np.ndim(value) else value) for joint, value in arrays.items()}
            for what, arrays in (
                (what, {joint: np.asarray(value, dtype=float) for joint, value in given.items()})
                for what, given in self._given.items()
            )
        }
        rest = {joint: angle for joint, angle in own["rest"].items() if own["stiffness"].get(joint)}
        return Springs(own["stiffness"], rest, own["moments"])


class Tangent(NamedTuple):
    """Derivatives of closure equations at a configuration, float[rows, J], and all motions, orthonormal float[J, f]."""

    jacobian: Floats
    rates: Floats


class EnergyExpansion(NamedTuple):
    """Energy on the closed configurations beside one, to second order along n rates; `held`: moments at held joints."""

    slope: Floats
    curvature: Floats
    held: Floats


class ElasticLinkage:
    """A linkage with springs, from a regular closed configuration; `freedoms` are those of finite motion.

    Raise `InvariantError` for joints that do not exist, `UnsolvableError` if loops are not closed, nothing moves,
    or the configuration is singular.
    """

    def __init__(self, linkage: Linkage, springs: Springs) -> None:
        self.linkage, self.closure = linkage, ClosureEquations(linkage)
        self.closure.check_closed(linkage.angles)
        self._set(springs)
        self.freedoms = _freedoms_at_regular(linkage, self.closure)

    def with_springs(self, springs: Springs) -> "ElasticLinkage":
        """Return the same linkage with other springs."""
        other = copy(self)
        other._set(springs)
        return other

    def _set(self, springs: Springs) -> None:
        joints, linkage = tuple(self.linkage.graph.joints), self.linkage
        springs.check_joints(joints)
        self.stiffness = np.array([springs.stiffness.get(joint, 0.0) for joint in joints])
        zero = zip(joints, linkage.angles.tolist(), strict=True)
        self.rest = np.array([springs.rest.get(joint, angle) for joint, angle in zero])
        self.moments = np.array([springs.moments.get(joint, 0.0) for joint in joints])

    def energy(self, angles: Floats) -> float:
        """Return the energy of springs and moments at joint angles, radians."""
        off = angles - self.rest
        return float(0.5 * self.stiffness @ off**2 - self.moments @ angles)

    def slopes(self, angles: Floats) -> Floats:
        """Return the derivatives of the energy by joint angles: float[J]."""
        return np.asarray(self.stiffness * (angles - self.rest) - self.moments)

    def tangent(self, angles: Floats) -> Tangent:
        """Return the closed configurations beside one, to first order; raise `NumericalError` at a singular one."""
        jacobian = self.closure.at(angles)[1].toarray()
        if not len(jacobian):
            return Tangent(jacobian, np.eye(len(angles)))
        parts, rank = split(jacobian, DOUBLE.clear), len(angles) - self.freedoms
        if parts.rank < rank:
            raise NumericalError("springs led to a singular configuration, where the motion branch is undetermined")
        return Tangent(jacobian, parts.right[rank:].T)

    def expansion(self, angles: Floats, tangent: Tangent, along: Floats, held: tuple[int, ...]) -> EnergyExpansion:
        """Return the energy on closed configurations beside one along orthonormal rates of its tangent, float[J, n].

        Joints at the places `held` do not move along the rates.
        """
        # The closure equations pull with moments -J^T w that hold the slopes of the energy in balance; the second
        # derivative of the energy has that of w . (closure) in it, found by differences of w . J along each rate.
        slopes = self.slopes(angles)
        places = list(held)
        moments = np.linalg.lstsq(tangent.rates[places].T, tangent.rates.T @ slopes, rcond=None)[0]
        balance = slopes.copy()
        balance[places] -= moments
        weights = np.linalg.lstsq(tangent.jacobian.T, -balance, rcond=None)[0]
        curvature = along.T @ (self.stiffness[:, None] * along)
        for number, rates in enumerate(along.T):
            ahead, back = (self.closure.at(angles + way * _NUDGE * rates)[1] for way in (1.0, -1.0))
            curvature[number] += (ahead - back).T @ weights @ along / (2.0 * _NUDGE)
        return EnergyExpansion(along.T @ slopes, (curvature + curvature.T) / 2.0, np.asarray(moments + 0.0))


def _freedoms_at_regular(linkage: Linkage, closure: ClosureEquations) -> int:
    joints = len(linkage.angles)
    if joints > MOST_JOINTS:
        raise UnsolvableError(f"springs in a linkage of {joints} joints; expected {MOST_JOINTS} joints at most")
    branches = branches_of(linkage, closure, search_for(joints, None))
    if branches.no_motion == "proved" or not joints:
        raise UnsolvableError("springs have nothing to move: all links are rigid against each other")
    if not branches.regular or branches.branches[0].freedoms is None:
        raise UnsolvableError(
            "springs require a regular configuration, and this one has several motion branches or none is known; "
            "try to fold it a little first (synth fold)"
        )
    return branches.branches[0].freedoms


_STEPS = 200
_LONGEST = 0.2
"""Longest step, in radians (root of the summed squares of all joints)."""
_BALANCED = 1e-11
"""Slope of the energy at which it is in balance, as part of the largest moment at hand."""
_SOFT = 1e-6
"""Curvature below this part of the largest is taken for it: else steps are long where the energy is level."""
_HALVINGS = 40
_DOWN = 1e-4
"""Part of the fall that the slope foretells which a step has to bring (Armijo)."""


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """A configuration (angles in radians) at which springs and moments are in balance, and their energy.

    `held`, float[D], are the moments that keep driven joints at their angles. `least` is the least curvature of
    the energy along motions that leave driven joints where they are, per squared radian; None without such
    motions. `unbalanced` is the slope of the energy that is left, `error` the loop-closure residual.
    """

    angles: Floats
    energy: float
    held: Floats
    least: float | None
    unbalanced: float
    error: float

    @property
    def stable(self) -> bool:
        """Whether the energy rises along all motions that leave driven joints still."""
        return self.least is None or self.least > 0.0


@dataclass(frozen=True, slots=True)
class LoadPath:
    """Equilibria while one joint, at place `driver`, is driven; the first is the start.

    `stopped` says why the path ended before its goal; it is empty if it reached it.
    """

    driver: int
    equilibria: tuple[Equilibrium, ...]
    stopped: str


def equilibrium(elastic: ElasticLinkage, start: Floats | None = None, held: tuple[int, ...] = ()) -> Equilibrium:
    """Return the equilibrium that the energy falls to from a closed configuration.

    Newton's method on closed configurations, with the curvature made positive, and steps halved until the energy falls
    as its slope predicts. The start, radians, is by default that of the linkage; joints at the places `held`
    keep their angles. Raise `NumericalError` at a singular configuration, or where balance is not reached.
    """
    angles = elastic.linkage.angles if start is None else start
    values = angles[list(held)]
    for _ in range(_STEPS):
        tangent = elastic.tangent(angles)
        along = tangent.rates @ null_space(tangent.rates[list(held)]) if held else tangent.rates
        expansion = elastic.expansion(angles, tangent, along, held)
        off = float(np.abs(expansion.slope).max(initial=0.0))
        moments = np.abs([elastic.slopes(angles), elastic.moments])
        if off <= _BALANCED * max(float(moments.max(initial=0.0)), float(elastic.stiffness.max(initial=0.0))):
            least = float(np.linalg.eigvalsh(expansion.curvature)[0]) if along.shape[1] else None
            error = elastic.closure.error(angles)
            return Equilibrium(angles, elastic.energy(angles), expansion.held, least, off, error)
        angles = _lower(elastic, angles, along @ _downhill(expansion), (held, values), along @ expansion.slope)
    raise NumericalError(f"springs found no balance in {_STEPS} steps: moments of {off:.1e} are left")


def load_path(elastic: ElasticLinkage, start: Floats, driver: int, values: npt.ArrayLike) -> LoadPath:
    """Return the equilibria while the joint at place `driver` is driven to angles, radians."""
    equilibria, stopped = [equilibrium(elastic, start, (driver,))], ""
    for value in np.asarray(values, dtype=float).tolist():
        path = driven_path(elastic.closure, equilibria[-1].angles, [driver], [[value]])
        if path.stopped:
            stopped = path.stopped
            break
        equilibria.append(equilibrium(elastic, path.angles[-1], (driver,)))
    return LoadPath(driver, tuple(equilibria), stopped)


def _downhill(expansion: EnergyExpansion) -> Floats:
    """Return Newton's step with the signs of all curvatures made positive, no longer than may be: float[n]."""
    values, vectors = np.linalg.eigh(expansion.curvature)
    sizes = np.abs(values)
    sizes = np.maximum(sizes, _SOFT * max(float(sizes.max()), float(np.abs(expansion.slope).max())))
    step = -vectors @ ((vectors.T @ expansion.slope) / sizes)
    return np.asarray(step * min(1.0, _LONGEST / float(np.linalg.norm(step))))


def _lower(
    elastic: ElasticLinkage, angles: Floats, step: Floats, held: tuple[tuple[int, ...], Floats], slope: Floats
) -> Floats:
    """Return a closed configuration along a step at which the energy is lower, held joints at their angles."""
    places, values = held
    before = elastic.energy(angles)
    rounding = 1e-14 * (abs(before) + float(elastic.stiffness.max(initial=0.0)))
    for halving in range(_HALVINGS):
        part = 0.5**halving
        closed = corrected(elastic.closure, angles + part * step, places)
        if places:
            closed = exactly_held(elastic.closure, closed, places, values)
        if closed.error > DOUBLE.closed or np.abs(closed.angles - angles).max() > 2.0 * _LONGEST:
            continue
        if elastic.energy(closed.angles) <= before + _DOWN * part * float(slope @ step) + rounding:
            return closed.angles
    raise NumericalError("springs found no balance: the energy falls along no step that keeps loops closed")


@dataclass(frozen=True, slots=True)
class Mass:
    """A point mass on a link. Several on a link are a body: any inertia can be made of them.

    Attributes
    ----------
    link : link id
    mass : float
        Less than 0 for what a body lacks; not of a link in all.
    point : (float, float, float)
        Its place at the input configuration, in the coordinates of the file.

    Examples
    --------
    >>> Mass("door", 1.5, (0.4, 0.0, 1.0)).mass
    1.5
    """

    link: LinkId
    mass: float
    point: tuple[float, float, float]

    def __post_init__(self) -> None:
        if len(self.point) != 3 or not all(map(isfinite, (self.mass, *self.point))):
            offender = f"link {shown(self.link)} has {self.mass!r} at {shown(list(self.point))}"
            raise InvariantError("mass", offender, "a number and three coordinates")


@dataclass(frozen=True, slots=True)
class Masses:
    """Masses on the links, and the link that stays.

    Attributes
    ----------
    points : tuple of Mass
    ground : link id or None
        None: the ground of the graph, else its first link.

    Examples
    --------
    >>> len(Masses((Mass("door", 1.5, (0.4, 0.0, 1.0)),), ground="wall").points)
    1
    """

    points: tuple[Mass, ...]
    ground: LinkId | None = None

    def check_links(self, linkage: Linkage) -> None:
        """Raise `InvariantError` for links that do not exist, and links without mass."""
        links = list(linkage.graph.nodes)
        for link in [*(mass.link for mass in self.points), *([] if self.ground is None else [self.ground])]:
            if link not in linkage.graph:
                raise InvariantError("link", f"{shown(link)} is no link", known(links, str(link)))
        totals: dict[LinkId, float] = {}
        for mass in self.points:
            totals[mass.link] = totals.get(mass.link, 0.0) + mass.mass
        for link, total in totals.items():
            if total <= 0.0:
                raise InvariantError("mass", f"link {shown(link)} has {total:g} in all", "more than 0")


@dataclass(frozen=True, slots=True)
class SmallMotion:
    """A mode of small motions: rates of the joints, the largest 1, and cycles per unit of time.

    Where the equilibrium is unstable along it, the frequency is None and `growth` the rate at which the motion
    grows.
    """

    frequency: float | None
    growth: float | None
    rates: Floats


def small_motions(elastic: ElasticLinkage, at: Equilibrium, masses: Masses) -> list[SmallMotion]:
    """Return the modes of small motions about an equilibrium without driven joints, slowest first.

    Raise `InvariantError` as `Masses.check_links` does, `UnsolvableError` if some motion moves no mass.
    """
    masses.check_links(elastic.linkage)
    tangent = elastic.tangent(at.angles)
    mass = tangent.rates.T @ mass_matrix(elastic.linkage, at.angles, masses) @ tangent.rates
    if not (inertia(mass, DOUBLE.clear**2).signs > 0).all():  # squares of speeds
        raise UnsolvableError("some motion moves no mass; expected masses on the moving links")
    curvature = elastic.expansion(at.angles, tangent, tangent.rates, ()).curvature
    squares, vectors = scipy.linalg.eigh(curvature, mass)
    modes = []
    for square, vector in zip(squares.tolist(), vectors.T, strict=True):
        rates, rate = tangent.rates @ vector, abs(square) ** 0.5
        frequency, growth = (None, rate) if square < 0.0 else (rate / (2.0 * pi), None)
        modes.append(SmallMotion(frequency, growth, rates / rates[leading(rates)]))
    return modes


def mass_matrix(linkage: Linkage, angles: Floats, masses: Masses) -> Floats:
    """Return the inertia of a linkage at closed joint angles, radians: float[J, J].

    In mass times squared coordinate unit; half of r^T M r is the kinetic energy at joint rates r along which loops
    stay closed.
    """
    motions = link_motions(linkage, angles[None])
    ground = linkage.graph.ground if masses.ground is None else masses.ground
    twists = {link: np.zeros((6, len(angles))) for link in linkage.graph.nodes}
    for near, far, place, sign in joints_outwards(linkage, ground):
        rotation, shift = (each[0] for each in motions[near])  # an axis goes with both of its links
        axis = sign * (rotation @ linkage.directions[place])
        point = rotation @ linkage.points[place] + shift
        twists[far] = twists[near].copy()
        twists[far][:, place] += np.concatenate([axis, np.cross(point, axis)])
    matrix = np.zeros((len(angles), len(angles)))
    for mass in masses.points:
        rotation, shift = (each[0] for each in motions[mass.link])
        place_now = rotation @ ((np.array(mass.point) - linkage.middle) / linkage.extent) + shift
        turning, sliding = twists[mass.link][:3], twists[mass.link][3:]
        velocity = (np.cross(turning.T, place_now) + sliding.T) * linkage.extent
        matrix += mass.mass * velocity @ velocity.T
    return matrix


def sheet_masses(sheet: Sheet, density: float) -> tuple[Mass, ...]:
    """Return the masses of the panels of a sheet, thin and all of one material.

    A triangle with a third of its mass at the middle of each side has its centre and its inertia.

    Parameters
    ----------
    sheet : Sheet
        With coordinates; of one with several frames the first that has them.
    density : float
        Mass of a unit of area.

    Raises
    ------
    UnsolvableError
        If it has no coordinates.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 0), (2, 0), (2, 2), (0, 2)))
    >>> round(sum(mass.mass for mass in sheet_masses(square, 0.5)), 12)
    2.0
    """
    if sheet.frames is not None:
        sheet = sheet.frames.first_placed()
    if sheet.coordinates is None:
        raise UnsolvableError("masses of panels require coordinates, and the sheet has none")
    corners = in_space(sheet.coordinates)
    whole = with_all_edges(sheet)
    masses = []
    for link, faces in enumerate(mechanism_of_sheet(whole).panels):
        for face in faces:
            masses += _lamina(link, corners[list(whole.faces[face])], density)
    return tuple(masses)


def _lamina(link: int, corners: Floats, density: float) -> list[Mass]:
    """Return the masses of a plane panel, a fan of triangles from a corner; those turned back count as less."""
    doubled = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0])
    areas = doubled @ unit(doubled.sum(axis=0)) / 2.0
    masses = []
    for area, second, third in zip(areas.tolist(), corners[1:-1], corners[2:], strict=True):
        for a, b in ((corners[0], second), (second, third), (third, corners[0])):
            x, y, z = ((a + b) / 2.0).tolist()
            masses.append(Mass(link, density * area / 3.0, (x, y, z)))
    return masses
