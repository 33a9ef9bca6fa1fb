"""Mobility at a configuration: infinitesimal freedoms where the coordinates are, with the evidence.

Special geometry may lower the rank of the closure equations at the axes as they lie: what is gained over the
generic mobility is the overconstraint h (Wiener 2016, Eq. 8). A vertex whose creases lie in one plane has more
infinitesimal freedoms than it can use. Lengths are in units of the extent, so that the precision of the
coordinates says what each singular value may owe to errors. Theory: docs/theory/pose.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import InvariantError, UnsolvableError
from graphs.geometry import unit
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import (
    Precision,
    extent_of,
    in_space,
    off_panel_planes,
    off_plane,
    precision_of,
    precision_of_axes,
    precision_of_sheet,
)
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.dissection import sparse_spectrum
from graphs.rank.exact import SignedLoops, closure_of, independent_cycles, signed_loops
from graphs.rank.realisation import Reals, join
from graphs.rank.rods import numbered_columns, velocity_constraints
from graphs.rank.singular_values import NEARLY, Spectrum, singular_values, spectrum
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats, Ints, JointId

_DENSE = 500
"""Up to this many joints all singular values are computed: dense, they take time with the cube of the joints. Beyond,
the smallest are found by dissection, which gives the same verdict."""
_SHORT = 5e-3
"""A nearly mobile mechanism has an error of this part of a typical crease at most: errors of points count by the angles
that they turn axes by, so where creases are short the extent alone would allow too much."""
_SPREAD = 1e-2
"""Points that are this close to a plane, in units of the extent, may be meant to lie in it: a hundredth is seen on
paper. What is farther off is a panel that is not planar, and its distance no error."""


@dataclass(frozen=True, slots=True)
class InfinitesimalMobility:
    """Infinitesimal degrees of freedom at a configuration.

    Attributes
    ----------
    dof : int or None
        Infinitesimal degrees of freedom; None where the singular values do not decide: indeterminate.
    self_stresses : int or None
        Equations minus rank: how many closure equations are redundant here.
    spectrum : Spectrum
        The evidence, with how certain it is.
    flat : bool
        Whether all vertices lie in one plane, within their precision.
    precision : Precision
        Of the coordinates; singular values are judged by it.
    flat_loops : int
        Loops with a centre whose axes lie in one plane, which gives them one freedom more than when folded.
    """

    dof: int | None
    self_stresses: int | None
    spectrum: Spectrum
    flat: bool
    precision: Precision
    flat_loops: int = 0

    def to_json(self) -> dict[str, Any]:
        """Return plain data (docs/command-json.md); a report adds h, the overconstraint against its count."""
        return {
            "dof": self.dof,
            "certainty": self.spectrum.certainty,
            "gap": self.spectrum.gap if np.isfinite(self.spectrum.gap) else None,
            "self_stresses": self.self_stresses,
            "nearly_mobile": self.spectrum.nearly,
            "near_noise": list(self.spectrum.undecided),
            "precision": self.precision.size,
            "flat": self.flat,
            "flat_loops": self.flat_loops,
        }


def infinitesimal_mobility(
    sheet: Sheet, mechanism: SheetMechanism | None = None, *, hinge_flat: bool = False
) -> InfinitesimalMobility:
    """Return the infinitesimal degrees of freedom of a crease pattern at its coordinates.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, any unit of length.
    mechanism : SheetMechanism, optional
        The mechanism of this sheet, so that it is not made again.
    hinge_flat : bool, optional
        Make hinges of flat edges too.

    Raises
    ------
    UnsolvableError, InvariantError
        If the sheet has no coordinates; if a hinge has no length.

    Examples
    --------
    >>> corners = ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1))
    >>> flat = infinitesimal_mobility(Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners))
    >>> flat.dof, flat.self_stresses, flat.flat  # one freedom more than folded
    (2, 1, True)
    """
    mechanism = mechanism or mechanism_of_sheet(sheet, hinge_flat=hinge_flat)
    loops = _loops_of(mechanism)
    matrix = closure_at_configuration(sheet, mechanism, loops)
    assert sheet.coordinates is not None
    points = _centred(sheet.coordinates)
    precision = precision_of_sheet(sheet)
    error = _error_of_axes(points, mechanism)
    nearly = _nearly(points, mechanism, off_panel_planes(sheet))
    places = _places_of_rows(points, mechanism, loops)
    evidence = _spectrum(matrix, places, error * precision.size, error * nearly)
    equations, unknowns = matrix.shape
    found = _mobility(evidence, unknowns, equations, points, precision)
    return replace(found, flat_loops=_flat_loops(points, mechanism, loops, precision))


def infinitesimal_mobility_of_axes(
    sc: SCGraph, axes: Mapping[JointId, tuple[Sequence[float], Sequence[float]]], precision: Precision | None = None
) -> InfinitesimalMobility:
    """Return the infinitesimal degrees of freedom of a linkage by its joint axes.

    Every loop closes with six equations here, so centres need not be exact.

    Parameters
    ----------
    sc : SCGraph
    axes : mapping of joint id to (point, direction)
        Three coordinates each, any unit of length; `InvariantError` if an axis has no direction.
    precision : Precision, optional
        Of points, in units of their extent, and of directions; without it as many digits as they have.

    Examples
    --------
    >>> planar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> places = [(0, 0, 0), (3, 0, 0), (4, 2, 0), (0, 1, 0)]
    >>> infinitesimal_mobility_of_axes(planar, {i: (place, (0, 0, 1)) for i, place in enumerate(places)}).dof
    1
    """
    points = np.array([axes[joint][0] for joint in sc.joints], dtype=float).reshape(-1, 3)
    directions = np.array([axes[joint][1] for joint in sc.joints], dtype=float).reshape(-1, 3)
    for joint in np.array(list(sc.joints), dtype=object)[~directions.any(axis=1)]:
        raise InvariantError("axis", f"the axis of joint {joint!r} has no direction", "a vector that is not zero")
    near = _centred(points.tolist())
    lines = {
        joint: join((*p, 1.0), (*(p + u), 1.0), Reals())
        for joint, p, u in zip(sc.joints, near, unit(directions), strict=True)
    }
    if precision is None:
        precision = precision_of_axes(points, directions)
    closure = closure_of(SCGraph(sc.nodes, sc.joints), lines, {}, Reals())
    matrix = _matrix(closure.rows, len(closure.joints)).toarray()
    evidence = spectrum(matrix, 2 * precision.size, 2 * NEARLY)
    return _mobility(evidence, len(sc.joints), 6 * sc.independent_loops, points, precision)


def infinitesimal_mobility_of_model(model: PolyhedronModel) -> InfinitesimalMobility:
    """Return the infinitesimal degrees of freedom of a polyhedron model at its coordinates.

    Links of four vertices or more get a virtual apex, since their vertices may be coplanar.

    Parameters
    ----------
    model : PolyhedronModel
        With coordinates.

    Raises
    ------
    UnsolvableError, InvariantError
        If it has no coordinates, or the bars of a scissors element do not cross there; if a rod has no length.

    Examples
    --------
    >>> corners = {0: (0, 0, 0), 1: (1, 0, 0), 2: (1, 1, 0), 3: (0, 1, 0)}  # a square shears, and folds
    >>> infinitesimal_mobility_of_model(PolyhedronModel(4, [(0, 1), (1, 2), (2, 3), (3, 0)], coordinates=corners)).dof
    2
    """
    if not model.coordinates:
        raise UnsolvableError("degrees of freedom at a configuration require coordinates, and the model has none")
    places = _centred(tuple(model.coordinates.values()))
    near: dict[Any, Any] = dict(zip(model.coordinates, map(tuple, places.tolist()), strict=True))
    for a, b in model.edges:
        if near[a] == near[b]:
            raise InvariantError("rod", f"the rod between vertices {a!r} and {b!r} has no length")
    rows, points = velocity_constraints(model, near, Reals())
    numbered, columns = numbered_columns(rows)
    matrix = _matrix(numbered, max(columns, 1))
    middle = np.array([np.mean([near.get(vertex, (0.0, 0.0, 0.0)) for vertex, _ in row], axis=0) for row in rows])
    precision = precision_of(list(model.coordinates.values()))
    # Entries are differences of coordinates, so all have their error.
    error = np.full(matrix.shape[1], np.sqrt(2))
    evidence = _spectrum(matrix, middle, error * precision.size, error * NEARLY)
    whole = _of_the_whole(places, precision) if model.ground is None else 0
    return _mobility(evidence, 3 * points - whole, len(rows), places, precision)


def _of_the_whole(points: Floats, precision: Precision) -> int:
    """Return the freedoms that points have as one body: 6, 5 if they are in line, 3 if there is one only."""
    spread = spectrum(points, 2 * precision.size).rank
    return {0: 3, 1: 5}.get(6 if spread is None else spread, 6)


def _spectrum(matrix: scipy.sparse.csr_matrix, places: Floats, error: Floats, nearly: Floats) -> Spectrum:
    """Return the rank of a matrix of any size; places are those of its rows."""
    if matrix.shape[1] <= _DENSE:
        return spectrum(matrix.toarray(), error, nearly)
    return sparse_spectrum(matrix, places, error, nearly)


def _mobility(
    evidence: Spectrum, unknowns: int, equations: int, points: Floats, precision: Precision
) -> InfinitesimalMobility:
    rank = evidence.rank
    return InfinitesimalMobility(
        None if rank is None else unknowns - rank,
        None if rank is None else equations - rank,
        evidence,
        off_plane(points) <= Tolerances.of(precision.size).flat,
        precision,
    )


def _ends(mechanism: SheetMechanism) -> Ints:
    """Return the vertices at the ends of each hinge: int[J, 2]."""
    return np.array(list(mechanism.hinges.values()), dtype=np.int64).reshape(-1, 2)


def _lengths(points: Floats, mechanism: SheetMechanism) -> Floats:
    ends = _ends(mechanism)
    return np.asarray(np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1))


def _error_of_axes(points: Floats, mechanism: SheetMechanism) -> Floats:
    """Return the error of the axis of each hinge, its moments if need be, for an error 1 of coordinates."""
    error = np.sqrt(2) / _lengths(points, mechanism)
    spatial = mechanism.sc.independent_loops > len(mechanism.loop_vertices)
    return np.asarray(error * (1 + np.sqrt(3)) if spatial else error)


def _nearly(points: Floats, mechanism: SheetMechanism, off_panels: float) -> float:
    """Return the error of coordinates that counts as nearly mobile: a small one, or one that panels show."""
    if not mechanism.hinges:
        return NEARLY
    small = min(NEARLY, _SHORT * float(np.median(_lengths(points, mechanism))))
    return max([small, *(2 * off for off in (off_panels, off_plane(points)) if off <= _SPREAD)])


def _loops_of(mechanism: SheetMechanism) -> SignedLoops:
    """Return the loops of a sheet's mechanism, those with a centre first."""
    return signed_loops(mechanism.sc, independent_cycles(mechanism.sc))


def _flat_loops(points: Floats, mechanism: SheetMechanism, loops: SignedLoops, precision: Precision) -> int:
    """Count the loops with a centre whose axes lie in one plane, within the precision."""
    ends = _ends(mechanism)
    centred = np.array([loop.has_centre for loop in mechanism.sc.loops], dtype=bool)
    flat = 0
    for numbers, joints, _ in loops.by_length():
        around = joints[numbers < len(centred)]
        around = around[centred[numbers[numbers < len(centred)]]]
        if joints.shape[1] > 2 and len(around):
            corners = points[ends[around].reshape(len(around), -1)]
            sizes = singular_values(corners - corners.mean(axis=1, keepdims=True))
            noise = 2 * precision.size * corners.shape[1] ** 0.5 + DOUBLE.flat * sizes[:, 0]
            flat += int((sizes[:, 2] <= noise).sum())
    return flat


def closure_at_configuration(
    sheet: Sheet, mechanism: SheetMechanism, loops: SignedLoops | None = None
) -> scipy.sparse.csr_matrix:
    """Return the closure equations of a sheet's mechanism at its coordinates: sparse float[rows, joints].

    Three for each loop about a vertex, six for any other, as `graphs.rank.exact.closure_of` has them; the loops are
    those of the mechanism. Raises `UnsolvableError` if the sheet has no coordinates, `InvariantError` if a hinge
    has no length.
    """
    if sheet.coordinates is None:
        raise UnsolvableError("degrees of freedom at a configuration require coordinates, and the sheet has none")
    loops = loops or _loops_of(mechanism)
    twists = _twists(_centred(sheet.coordinates), mechanism)
    rows_of = _rows_of_loops(mechanism, loops)
    first = np.cumsum(rows_of) - rows_of
    parts = []
    for numbers, joints, signs in loops.by_length():
        for rows in (3, 6):
            these = rows_of[numbers] == rows
            values = twists[joints[these], :rows] * signs[these][..., None]
            row = first[numbers[these], None, None] + np.arange(rows)
            column = np.broadcast_to(joints[these][..., None], values.shape)
            parts.append((values.ravel(), np.broadcast_to(row, values.shape).ravel(), column.ravel()))
    shape = (int(rows_of.sum()), len(mechanism.sc.joints))
    if not parts:
        return scipy.sparse.csr_matrix(shape)
    data, row, column = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    matrix = scipy.sparse.csr_matrix((data, (row, column)), shape=shape)
    matrix.eliminate_zeros()
    return matrix


def _rows_of_loops(mechanism: SheetMechanism, loops: SignedLoops) -> Ints:
    """Return the number of equations of each loop."""
    about_vertex = np.arange(len(loops.begin) - 1) < len(mechanism.loop_vertices)
    return np.where(about_vertex, 3, 6)


def _centred(coordinates: Sequence[Sequence[float]]) -> Floats:
    """Return coordinates in space, in units of their extent, about their middle: float[n, 3]."""
    points = in_space(coordinates)
    if len(points):
        points -= points.mean(axis=0)
    return points / (extent_of(points) or 1.0)


def _twists(places: Floats, mechanism: SheetMechanism) -> Floats:
    """Return the direction of each hinge and its moment: float[J, 6]."""
    ends = _ends(mechanism)
    lengths = _lengths(places, mechanism)
    for hinge in np.flatnonzero(lengths == 0.0).tolist():
        (a, b), part = ends[hinge].tolist(), ("edges", list(mechanism.hinges)[hinge])
        raise InvariantError("hinge", f"the crease between vertices {a} and {b} has no length", part=part)
    near = places[ends[:, 0]]
    far = near + (places[ends[:, 1]] - near) / lengths[:, None]
    return np.concatenate([far - near, np.cross(near, far)], axis=1)


def _matrix(rows: Sequence[Mapping[int, float]], columns: int) -> scipy.sparse.csr_matrix:
    entries = [(i, j, value) for i, row in enumerate(rows) for j, value in row.items()]
    at, to, values = zip(*entries, strict=True) if entries else ((), (), ())
    return scipy.sparse.csr_matrix((np.array(values, dtype=float), (at, to)), shape=(len(rows), columns))


def _places_of_rows(points: Floats, mechanism: SheetMechanism, loops: SignedLoops) -> Floats:
    """Return the middle of the hinges of the loop of each row."""
    middles = points[_ends(mechanism)].sum(axis=1) / 2
    places = np.zeros((len(loops.begin) - 1, 3))
    for numbers, joints, _ in loops.by_length():
        places[numbers] = middles[joints].mean(axis=1)
    return np.repeat(places, _rows_of_loops(mechanism, loops), axis=0)
