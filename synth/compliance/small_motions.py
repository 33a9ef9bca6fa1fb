"""Small motions about an equilibrium: modes and frequencies of links with masses.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, pi

import numpy as np
import scipy.linalg

from graphs.convert.duality import mechanism_of_sheet
from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.geometry import unit
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.rank.singular_values import inertia
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats, LinkId
from synth.compliance.equilibrium import Equilibrium
from synth.compliance.springs import ElasticLinkage
from synth.motion.linkage import PosedLinkage
from synth.motion.placement import joints_outwards, link_motions

__all__ = ["Mass", "Masses", "SmallMotion", "mass_matrix", "sheet_masses", "small_motions"]


@dataclass(frozen=True, slots=True)
class Mass:
    """A point mass on a link. Several on a link are a body: any inertia can be made of them.

    Attributes
    ----------
    link : link id
    mass : float
        Less than 0 for what a body lacks; not of a link in all.
    point : (float, float, float)
        Where it is at the pose given, in the coordinates of the file.

    Examples
    --------
    >>> Mass("door", 1.5, (0.4, 0.0, 1.0)).mass
    1.5
    """

    link: LinkId
    mass: float
    point: tuple[float, float, float]


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

    def checked(self, linkage: PosedLinkage) -> None:
        """Refuse links that are none, and numbers that are none.

        Raises
        ------
        InvariantError
        """
        links = list(linkage.graph.nodes)
        for link in [*(one.link for one in self.points), *([] if self.ground is None else [self.ground])]:
            if link not in linkage.graph:
                raise InvariantError("link", f"{shown(link)} is no link", known(links, str(link)))
        sums: dict[LinkId, float] = {}
        for one in self.points:
            if not isfinite(one.mass) or not all(map(isfinite, one.point)):
                told = f"link {shown(one.link)} has {one.mass!r} at {shown(list(one.point))}"
                raise InvariantError("mass", told, "a number and three coordinates")
            sums[one.link] = sums.get(one.link, 0.0) + one.mass
        for link, total in sums.items():
            if total <= 0.0:
                raise InvariantError("mass", f"link {shown(link)} has {total:g} in all", "more than 0")


@dataclass(frozen=True, slots=True)
class SmallMotion:
    """A mode of small motions: rates of the joints, the largest 1, and cycles per unit of time.

    Where the equilibrium is unstable along it, the frequency is None and `growth` the rate at which the motion
    grows, per unit of time.
    """

    frequency: float | None
    growth: float | None
    rates: Floats


def small_motions(elastic: ElasticLinkage, at: Equilibrium, masses: Masses) -> list[SmallMotion]:
    """Return the modes of small motions about an equilibrium without driven joints, slowest first.

    Raises `InvariantError` as :meth:`Masses.checked` does, `UnsolvableError` if some motion moves no mass.
    """
    masses.checked(elastic.linkage)
    tangent = elastic.tangent(at.angles)
    mass = tangent.rates.T @ mass_matrix(elastic.linkage, at.angles, masses) @ tangent.rates
    if not (inertia(mass, DOUBLE.clear**2).signs > 0).all():  # squares of speeds
        raise UnsolvableError("some motion moves no mass: expected masses on the links that move")
    curvature = elastic.bent(at.angles, tangent, tangent.rates, ()).curvature
    squares, vectors = scipy.linalg.eigh(curvature, mass)
    return [
        _mode(square, tangent.rates @ vector) for square, vector in zip(squares.tolist(), vectors.T, strict=True)
    ]


def mass_matrix(linkage: PosedLinkage, angles: Floats, masses: Masses) -> Floats:
    """Return the inertia of a linkage at joint angles: float[J, J], mass times squared unit of the coordinates.

    Half of r^T M r is the kinetic energy at joint rates r along which loops stay closed. Angles, radians, are
    those of a closed pose.
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
    for one in masses.points:
        rotation, shift = (each[0] for each in motions[one.link])
        place_now = rotation @ ((np.array(one.point) - linkage.middle) / linkage.extent) + shift
        turning, sliding = twists[one.link][:3], twists[one.link][3:]
        velocity = (np.cross(turning.T, place_now) + sliding.T) * linkage.extent
        matrix += one.mass * velocity @ velocity.T
    return matrix


def sheet_masses(sheet: Sheet, density: float) -> tuple[Mass, ...]:
    """Return the masses of the panels of a sheet, thin and all of one stuff.

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
    >>> round(sum(one.mass for one in sheet_masses(square, 0.5)), 12)
    2.0
    """
    if sheet.frames is not None:
        sheet = sheet.frames.first_placed()
    if sheet.coordinates is None:
        raise UnsolvableError("masses of panels need coordinates, and the sheet has none")
    corners = in_space(sheet.coordinates)
    whole = with_all_edges(sheet)
    made = []
    for link, faces in enumerate(mechanism_of_sheet(whole).panels):
        for face in faces:
            made += _lamina(link, corners[list(whole.faces[face])], density)
    return tuple(made)


def _lamina(link: int, corners: Floats, density: float) -> list[Mass]:
    """Return the masses of a plane panel, a fan of triangles from a corner; those turned back count as less."""
    doubled = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0])
    areas = doubled @ unit(doubled.sum(axis=0)) / 2.0
    made = []
    for area, one, other in zip(areas.tolist(), corners[1:-1], corners[2:], strict=True):
        for a, b in ((corners[0], one), (one, other), (other, corners[0])):
            x, y, z = ((a + b) / 2.0).tolist()
            made.append(Mass(link, density * area / 3.0, (x, y, z)))
    return made


def _mode(square: float, rates: Floats) -> SmallMotion:
    largest = rates[leading(rates)]
    rate = abs(square) ** 0.5
    if square < 0.0:
        return SmallMotion(None, rate, rates / largest)
    return SmallMotion(rate / (2.0 * pi), None, rates / largest)
