"""Four-bars that guide a body through orientations: two dyads joined, their defects, their motion, their cones.

One dyad is driven (link alpha, fixed axis G_1, moving axis W_1), the other follows (beta, G_2, W_2); the ground is
gamma, the body is the coupler eta. The angle theta of the driver is counted about G_1 from the plane of G_1 and
G_2. A dyad fixes the lines of its two axes, not which end of an axis a link reaches: up to eight linkages have the
same joint lines (Hyatt et al. 2020, section 2.3), each mapped to cones apart. Theory: docs/theory/guidance.md.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise, permutations
from math import degrees
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError, numbered
from graphs.geometry import across, angles_between, rotated, unit
from graphs.loops.loop import Centre
from graphs.mechanism.closed_form import ClosedFormLinkage, PlacedChain
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats
from synth.linkages.fourbar.closing import FourBarKind, kind_of_spherical, supplementary
from synth.linkages.fourbar.position import input_limits_spherical, output_spherical, transmission_spherical
from synth.linkages.guidance.dyads import Dyad, facing_on
from synth.linkages.guidance.order import DIRECTIONS, Direction, order_by_crank_angles
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.surfaces.loop_maps import map_to_cones
from synth.linkages.surfaces.mapping import FamilyOfCircles, MappedLoop

_TURN = 2.0 * np.pi


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class GuidedFourBar(ClosedFormLinkage):
    """A spherical four-bar whose coupler is guided through orientations.

    Attributes
    ----------
    driver, follower : Dyad
    link_angles : float[4]
        gamma (ground), alpha (driver), eta (coupler), beta (follower): loop order, radians, in (0, pi).
    kind : FourBarKind
        Grashof's class and the type.
    angles : float[n]
        theta at each orientation, radians in [0, 2 pi).
    circuits, branches : tuple of int
        The circuit of each orientation, 0 or 1, and its branch, 0 to 3: within one the driver can take the linkage
        along.
    direction : "ccw" or "cw" or None
        How the driver turns to take the orientations in their order within its range, if it can.
    in_order_on_circuit : bool
        Whether the linkage, moved along its circuit one way, takes the orientations in their order, if need be
        past dead points of the driver.
    transmission : float
        Least angle, radians, at W_2 between coupler and follower or its supplement: from orientation 1 to n if
        there is no defect, else at the orientations only.
    """

    driver: Dyad
    follower: Dyad
    link_angles: Floats
    kind: FourBarKind
    angles: Floats
    circuits: tuple[int, ...]
    branches: tuple[int, ...]
    direction: Direction | None
    in_order_on_circuit: bool
    transmission: float

    def placed_chain(self, body: Floats | None = None) -> PlacedChain:
        """Return the joints O (driver, fixed), A and B (on the body) and C with the body turned by float[3, 3]."""
        if body is None:
            raise UnsolvableError("a guided four-bar has its moving axes in the body; expected its orientations")
        ring = SCGraph(("ground", "driver", "body", "follower"), {
            "O": ("ground", "driver"), "A": ("driver", "body"), "B": ("body", "follower"), "C": ("follower", "ground"),
        }, ground="ground")  # fmt: skip
        moving = (body @ self.driver.moving, body @ self.follower.moving)
        directions = np.array([self.driver.fixed, *moving, self.follower.fixed])
        return PlacedChain(ring, np.zeros_like(directions), directions, Centre.FINITE)

    @property
    def circuit_defect(self) -> bool:
        """Whether orientations lie on different circuits: the linkage would have to be taken apart."""
        return len(set(self.circuits)) > 1

    @property
    def branch_defect(self) -> bool:
        """Whether orientations lie on different branches: the driver would have to pass a dead point."""
        return len(set(self.branches)) > 1

    @property
    def order_defect(self) -> bool:
        """Whether the driver, turning one way within its range, takes the orientations in another order."""
        return self.direction is None

    @property
    def defects(self) -> tuple[str, ...]:
        """Names of its defects: ``circuit``, ``branch``, ``order``."""
        defects = {"circuit": self.circuit_defect, "branch": self.branch_defect, "order": self.order_defect}
        return tuple(name for name, here in defects.items() if here)

    def __repr__(self) -> str:
        angles = ", ".join(f"{degrees(angle):.1f}" for angle in self.link_angles)
        return f"<GuidedFourBar: {self.kind.name}, links {angles} degrees, {numbered(len(self.defects), 'defect')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the four-bar as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "driver": self.driver.to_json(),
            "follower": self.follower.to_json(),
            "link_angles_deg": [degrees(angle) for angle in self.link_angles],
            "grashof": self.kind.grashof,
            "type": self.kind.name,
            "angles_deg": [degrees(angle) for angle in self.angles],
            "circuits": list(self.circuits),
            "branches": list(self.branches),
            "direction": self.direction,
            "in_order_on_circuit": self.in_order_on_circuit,
            "defects": list(self.defects),
            "transmission_deg": degrees(self.transmission),
        }


@dataclass(frozen=True, slots=True, eq=False)
class BodyMotion:
    """How the body turns as the driver takes it through the orientations.

    Attributes
    ----------
    angles : float[m]
        The driver's angle theta, radians, growing or falling all the way.
    quaternions : float[m, 4]
        Orientations of the body, scalar first; successive ones do not change sign.
    keys : tuple of int
        Places of the required orientations among them.
    """

    angles: Floats
    quaternions: Floats
    keys: tuple[int, ...]


class _Reach(NamedTuple):
    """Whether a driver passes 0, and whether pi; else it swings to where the linkage ends."""

    passes_zero: bool
    passes_pi: bool

    @property
    def full_turn(self) -> bool:
        return self.passes_zero and self.passes_pi


def four_bars(orientations: Orientations, dyads: Iterable[Dyad]) -> tuple[GuidedFourBar, ...]:
    """Return the four-bars of all pairs of dyads, with either of the two as driver, the best first.

    Best are those without defects, and of these those whose transmission angle stays furthest from 0 and 180
    degrees. Pairs with a link of no angle, or of 180 degrees, are left out.

    Parameters
    ----------
    orientations : Orientations
    dyads : iterable of Dyad
        Of these orientations.

    Examples
    --------
    >>> from synth.linkages.guidance import dyads_of_three
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> dyads = dyads_of_three(orientations, [(3, 1, 2), (-1, 2, 3)])
    >>> [four_bar.defects for four_bar in four_bars(orientations, dyads)]
    [(), ('branch', 'order')]
    """
    linkages = []
    for driver, follower in permutations(tuple(dyads), 2):
        links = _link_angles(driver, follower)
        if np.minimum(links, np.pi - links).min() > DOUBLE.same_configuration:
            linkages.append(four_bar_of(orientations, driver, follower))
    order = canonical_order([np.array([len(one.defects), -one.transmission]) for one in linkages])
    return tuple(linkages[place] for place in order)


def four_bar_of(orientations: Orientations, driver: Dyad, follower: Dyad) -> GuidedFourBar:
    """Return the four-bar of two dyads of the same orientations, with its defects.

    Parameters
    ----------
    orientations : Orientations
    driver, follower : Dyad
        `UnsolvableError` if a link has no angle, or one of 180 degrees.

    Examples
    --------
    >>> from synth.linkages.guidance import dyads_of_three
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> four_bar = four_bar_of(orientations, *dyads_of_three(orientations, [(3, 1, 2), (-1, 2, 3)]))
    >>> np.degrees(four_bar.link_angles).round(2).tolist(), four_bar.kind.name, four_bar.defects
    ([69.08, 21.81, 87.95, 46.21], 'crank-rocker', ())
    """
    links = _link_angles(driver, follower)
    if np.minimum(links, np.pi - links).min() <= DOUBLE.same_configuration:
        raise UnsolvableError("a link of this four-bar has no angle, or one of 180 degrees: two of its axes are one")
    m = orientations.matrices
    angles = _azimuths(driver.fixed, follower.fixed, m @ driver.moving)
    sides = _sides(follower.fixed, m @ driver.moving, m @ follower.moving)
    reach = _reach(links)
    circuits, branches = _places(angles, sides, reach)
    direction = _direction(angles, reach)
    usable = direction is not None and len(set(branches)) == 1
    passed = _passed(angles, direction) if usable and direction is not None else angles
    at_follower = transmission_spherical(links, passed)
    supplement = np.where(np.isnan(at_follower), 0.0, np.pi - at_follower)  # 0 where it does not close
    return GuidedFourBar(
        driver,
        follower,
        links,
        kind_of_spherical(links),
        angles,
        circuits,
        branches,
        direction,
        len(set(circuits)) == 1 and order_by_crank_angles(_along_circuit(angles, sides, reach)) is not None,
        float(np.fmin(at_follower, supplement).min()),
    )


def motion_of(orientations: Orientations, four_bar: GuidedFourBar, steps: int = 20) -> BodyMotion:
    """Return the motion of the body through its orientations; steps between two are equal in the driver's angle.

    Parameters
    ----------
    orientations : Orientations
    four_bar : GuidedFourBar
        `UnsolvableError` if it has a defect, or does not close all the way.
    steps : int, optional
        Steps between two orientations.

    Examples
    --------
    >>> from synth.linkages.guidance import dyads_of_three
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> four_bar = four_bar_of(orientations, *dyads_of_three(orientations, [(3, 1, 2), (-1, 2, 3)]))
    >>> motion_of(orientations, four_bar, 4).keys
    (0, 4, 8)
    """
    if four_bar.defects or four_bar.direction is None:
        raise UnsolvableError(f"this four-bar has defects ({', '.join(four_bar.defects)}): it cannot take the motion")
    keys = _unwrapped(four_bar.angles, four_bar.direction)
    parts = [np.linspace(a, b, steps, endpoint=False) for a, b in pairwise(keys.tolist())]
    angles = np.concatenate([*parts, keys[-1:]])
    matrices = _body_at(orientations, four_bar, angles)
    quaternions = Orientations.from_matrices(matrices).quaternions
    return BodyMotion(angles, facing_on(quaternions), tuple(range(0, len(angles), steps)))


def _link_angles(driver: Dyad, follower: Dyad) -> Floats:
    """Return gamma, alpha, eta, beta."""
    ground = angles_between(driver.fixed, follower.fixed)
    coupler = angles_between(driver.moving, follower.moving)
    return np.array([ground, driver.link_angle, coupler, follower.link_angle])


def _azimuths(axis: Floats, zero: Floats, vectors: Floats) -> Floats:
    """Return the angles of vectors about an axis from the plane through a direction, in [0, 2 pi)."""
    beside = np.cross(axis, zero)
    along = np.cross(beside, axis)
    return np.asarray(np.mod(np.arctan2(vectors @ beside, vectors @ along), _TURN))


def _sides(fixed: Floats, driven: Floats, following: Floats) -> npt.NDArray[np.int64]:
    """Return 1 where W_2 lies to the left of the arc from G_2 to W_1, 0 where it lies to the right."""
    return np.asarray(np.einsum("ni,ni->n", np.cross(fixed, driven), following) > 0.0, dtype=np.int64)


def _reach(links: Floats) -> _Reach:
    """Return which ends of its swing the driver passes."""
    return _Reach(*np.isnan(input_limits_spherical(links)).tolist())


def _places(angles: Floats, sides: npt.NDArray[np.int64], reach: _Reach) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return circuit and branch of each orientation.

    A driver that turns fully keeps its side, so the sides are the circuits, with a branch each. One that swings
    over one arc changes sides at its ends: one circuit of two branches. One that swings over either of two arcs,
    theta and -theta, has a circuit on each, of two branches.
    """
    if reach.full_turn:
        places = tuple(sides.tolist())
        return places, places
    if reach.passes_zero or reach.passes_pi:
        return (0,) * len(angles), tuple(sides.tolist())
    arcs = (angles > np.pi).astype(np.int64)
    return tuple(arcs.tolist()), tuple((2 * arcs + sides).tolist())


def _direction(angles: Floats, reach: _Reach) -> Direction | None:
    """Return how a driver turns to take angles in their order without leaving its arc."""
    if reach.full_turn:
        return order_by_crank_angles(angles)
    steps = np.diff(_counted(angles, reach))
    if np.all(steps > 0.0):
        return DIRECTIONS[0]
    return DIRECTIONS[1] if np.all(steps < 0.0) else None


def _counted(angles: Floats, reach: _Reach) -> Floats:
    """Return angles counted from pi where the driver passes 0: then it does not pass pi."""
    return np.asarray(np.mod(angles + np.pi, _TURN)) if reach.passes_zero else angles


def _along_circuit(angles: Floats, sides: npt.NDArray[np.int64], reach: _Reach) -> Floats:
    """Return how far round its circuit each orientation is, 0 to 2 pi: along the arc on one side, and back."""
    if reach.full_turn:
        return angles
    counted = _counted(angles, reach)
    return np.where(sides == 1, counted / 2.0, _TURN - counted / 2.0)


def _unwrapped(angles: Floats, direction: Direction) -> Floats:
    sign = 1.0 if direction == "ccw" else -1.0
    return np.asarray(angles[0] + sign * np.mod(sign * (angles - angles[0]), _TURN))


def _passed(angles: Floats, direction: Direction) -> Floats:
    """Return the ends of the motion, and 0 and pi where it passes them: between them cos theta is monotone."""
    first, last = _unwrapped(angles, direction)[[0, -1]]
    turns = np.pi * np.arange(np.ceil(min(first, last) / np.pi), np.floor(max(first, last) / np.pi) + 1)
    return np.concatenate([[first, last], turns])


def _body_at(orientations: Orientations, four_bar: GuidedFourBar, angles: Floats) -> Floats:
    """Return rotation matrices of the body at driver angles, on the branch of orientation 1."""
    driver, follower = four_bar.driver, four_bar.follower
    first = orientations.matrices[0]
    driven = rotated(first @ driver.moving, driver.fixed, angles - four_bar.angles[0])
    side = int(_sides(follower.fixed, driven[:1], (first @ follower.moving)[None])[0])
    links = four_bar.link_angles.copy()
    # a dyad that does not fit quite has another angle on the average
    links[1] = angles_between(driver.fixed, driven[0])
    psi = output_spherical(links, angles, 1 if side else -1)
    if np.isnan(psi).any():
        raise UnsolvableError("this four-bar does not close all the way: its dyads do not fit well enough")
    fixed, beta = follower.fixed, follower.link_angle
    out = rotated(-unit(across(driver.fixed, fixed)), fixed, psi)  # psi is counted from the ground link prolonged
    following = np.asarray(np.cos(beta) * fixed + np.sin(beta) * out)
    return turned((driver.moving[None], follower.moving[None]), (driven, following))


def turned(before: tuple[Floats, Floats], after: tuple[Floats, Floats]) -> Floats:
    """Return the rotations that take two directions, float[..., 3], to two others at the same angle."""
    return np.asarray(_frame(*after) @ np.swapaxes(_frame(*before), -1, -2))


def _frame(a: Floats, b: Floats) -> Floats:
    """Return right-handed frames, as columns: the first axis along a, the second in the plane of a and b."""
    normal = unit(np.cross(a, b))
    return np.stack([a, np.cross(normal, a), normal], axis=-1)


@dataclass(frozen=True, slots=True)
class ConicalForm:
    """A linkage with the joint lines of a four-bar, and the cones that its four axes are rulings of.

    Attributes
    ----------
    link_angles : tuple of float
        gamma, alpha, eta, beta, radians.
    cones, families : tuple of MappedLoop, tuple of FamilyOfCircles
        With lambda, circuit, signs of the projected angles; and intervals of cones.
    """

    link_angles: tuple[float, ...]
    cones: tuple[MappedLoop, ...]
    families: tuple[FamilyOfCircles, ...]

    def cones_json(self) -> list[dict[str, Any]]:
        """Return the cones as plain data."""
        return [self._in_json(cone, {"lambda_deg": degrees(cone.size)}, {"k": cone.turns}) for cone in self.cones]

    def families_json(self) -> list[dict[str, Any]]:
        """Return the intervals of cones as plain data."""
        return [
            self._in_json(family, {"interval_deg": [degrees(end) for end in family.interval]}, {})
            for family in self.families
        ]

    def _in_json(
        self, circle: MappedLoop | FamilyOfCircles, size: dict[str, Any], turns: dict[str, int]
    ) -> dict[str, Any]:
        return {
            "link_angles_deg": [degrees(angle) for angle in self.link_angles],
            **size,
            "circuit": circle.circuit,
            "signs": list(circle.signs),
            **turns,
            **({"caution": circle.caution} if circle.caution else {}),
        }


def conical_forms(four_bar: GuidedFourBar) -> tuple[ConicalForm, ...]:
    """Return the linkages on the joint lines of a four-bar that lie on a cone; none if it is not developable.

    Those with the least sum of link angles come first.

    Parameters
    ----------
    four_bar : GuidedFourBar

    Examples
    --------
    >>> from synth.linkages.guidance import dyads_of_three
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> four_bar = four_bar_of(orientations, *dyads_of_three(orientations, [(3, 1, 2), (-1, 2, 3)]))
    >>> all(form.cones or form.families for form in conical_forms(four_bar))
    True
    """
    every = supplementary(four_bar.link_angles)
    _, first = np.unique(every.round(9), axis=0, return_index=True)
    forms = []
    for angles in sorted((every[k] for k in first), key=lambda one: float(one.sum())):
        cone_map = map_to_cones(angles)
        if cone_map.cones or cone_map.families:
            forms.append(ConicalForm(cone_map.angles, cone_map.cones, cone_map.families))
    return tuple(forms)
