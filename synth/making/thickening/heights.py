"""Heights of the hinges of thick panels: linear conditions of vertices and panels, one linear programme.

The heights of the hinges round a vertex make its linkage an overconstrained spatial one: of Bennett for four creases,
of Myard for five, plane-symmetric of Bricard for six. Source: Y. Chen, R. Peng, Z. You, "Origami of thick panels",
Science 349 (2015), 396-400. Theory: docs/theory/thick-panels.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi, sin

import numpy as np
import scipy.optimize
import scipy.sparse
from scipy.spatial.transform import Rotation

from graphs.convert.duality import SheetMechanism
from graphs.errors import UnsolvableError, numbered
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space, precision_of
from graphs.mechanism.sheet import Sheet
from graphs.rank.singular_values import row_space
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats

Row = Mapping[int, float]
"""Coefficients of the heights of joints, whose sum with them is zero."""

_NAMED = 6
"""The number of vertices or panels that an error names."""


@dataclass(frozen=True, slots=True)
class ThickVertex:
    """A vertex whose hinges have heights.

    Attributes
    ----------
    vertex : int
    joints : tuple of int
        The creases in counterclockwise order; for five and six the first lies in the plane of symmetry.
    linkage : str
        ``Bennett``, ``Myard`` or ``Bricard``; empty for none of these.
    rows : tuple of mapping of joint to float
        Coefficients of linear conditions on the heights.
    ends : tuple of int
        A vertex on each crease, the farther end.
    directions : tuple of (float, float)
        Of the creases, outwards.
    fault : str
        Why the vertex is none of these linkages; empty if it is one.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> thick_vertices(at.sheet, at.mechanism, at.tolerances)[0].linkage
    'Bennett'
    """

    vertex: int
    joints: tuple[int, ...]
    linkage: str
    rows: tuple[Row, ...]
    ends: tuple[int, ...]
    directions: tuple[tuple[float, float], ...]
    fault: str = ""

    @property
    def of_motion(self) -> bool:
        """Whether heights are to be those of one motion of the thin vertex: it has more than four creases."""
        return len(self.joints) > 4


@dataclass(frozen=True, slots=True)
class HingeHeights:
    """Heights of hinges and panels over the plane of the sheet, in units of the thickness.

    Attributes
    ----------
    hinges : mapping of joint to float
    undersides : tuple of float
        The underside of each panel.
    vertices : tuple of ThickVertex
    residual : float
        The largest error of a condition.
    of_motion : bool
        Whether vertices of more than four creases keep one motion of the thin sheet.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> hinge_heights(at.sheet, at.mechanism, at.tolerances).residual < 1e-9
    True
    """

    hinges: Mapping[int, float]
    undersides: tuple[float, ...]
    vertices: tuple[ThickVertex, ...]
    residual: float
    of_motion: bool = False


def bennett_rows(joints: Sequence[int], sectors: Sequence[float], same: bool) -> tuple[Row, Row]:
    """Return the conditions on the heights round a flat-foldable vertex of four creases.

    Parameters
    ----------
    joints : sequence of 4 int
        Creases in order round the vertex.
    sectors : sequence of 4 float
        The angle from each crease to the next, radians.
    same : bool
        Whether the second and the fourth crease fold to the same side.

    Returns
    -------
    tuple of mapping of joint to float
        Satisfied by the heights 0, 1, 1 + r, r with r = +-sin(second sector) / sin(first sector), + if `same`.

    Examples
    --------
    >>> bennett_rows([0, 1, 2, 3], [pi / 2] * 4, True)
    ({0: 1.0, 1: -1.0, 2: 1.0, 3: -1.0}, {0: 1.0, 1: -2.0, 2: 1.0})
    """
    ratio = (1.0 if same else -1.0) * sin(sectors[1]) / sin(sectors[0])
    a, b, c, d = joints
    # The lengths of Bennett's linkage are differences of heights: opposite ones are equal with opposite signs.
    return {a: 1.0, b: -1.0, c: 1.0, d: -1.0}, {a: ratio, b: -1.0 - ratio, c: 1.0}


def thick_vertices(sheet: Sheet, mechanism: SheetMechanism, tolerances: Tolerances) -> tuple[ThickVertex, ...]:
    """Return the conditions of all vertices inside a flat sheet.

    Parameters
    ----------
    sheet : Sheet
        Flat, with an assignment.
    mechanism : SheetMechanism
        Of the sheet.
    tolerances : Tolerances
        Of its coordinates.

    Raises
    ------
    UnsolvableError
        If there are loops round holes.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> [one.vertex for one in thick_vertices(at.sheet, at.mechanism, at.tolerances)]
    [5, 6, 9, 10]
    """
    corners = in_space(sheet.coordinates or ())
    ends = {joint: {v for piece in pieces for v in piece} for joint, pieces in mechanism.pieces.items()}
    vertices = []
    for loop in (*mechanism.sc.loops, *mechanism.sc.closing):
        joints = [int(joint) for joint in loop.joints]  # type: ignore[call-overload]
        common = set.intersection(*(ends[joint] for joint in joints))
        if loop.centre is not Centre.FINITE or len(common) != 1:
            raise UnsolvableError(f"the loop of creases {_listed(joints)} is not round a vertex; expected no holes")
        vertex = common.pop()
        # Along a crease of several pieces the farther end lies on the same side unless the crease passes the vertex.
        tips = [max(ends[joint] - common - {vertex}, key=lambda v: float(np.hypot(*(corners[v] - corners[vertex])[:2])))
                for joint in joints]  # fmt: skip
        towards = (corners[tips] - corners[vertex])[:, :2]
        angles = np.arctan2(towards[:, 1], towards[:, 0]) % (2 * pi)
        order = np.argsort(angles)
        round_it = [joints[i] for i in order]
        sectors = np.diff([*angles[order], angles[order[0]] + 2 * pi])
        within = tolerances.same_configuration + 4 * _error_of_directions(corners, towards)
        linkage, first, rows, fault = _linkage(vertex, round_it, sectors, sheet.assignments, within)
        turned = np.roll(order, -first)
        outwards = (towards / np.linalg.norm(towards, axis=1, keepdims=True))[turned].tolist()
        vertices.append(
            ThickVertex(
                vertex, tuple(joints[i] for i in turned), linkage, rows, tuple(tips[i] for i in turned),
                tuple((x, y) for x, y in outwards), fault,
            )
        )  # fmt: skip
    return tuple(sorted(vertices, key=lambda one: one.vertex))


def _error_of_directions(corners: Floats, towards: Floats) -> float:
    """Return the error of the direction of the shortest crease, by that of a coordinate."""
    return float(precision_of(corners.tolist()).size / np.hypot(*towards.T).min())


def _listed(numbers: Sequence[int]) -> str:
    more = len(numbers) - _NAMED
    return ", ".join(map(str, numbers[:_NAMED])) + (f" and {more} more" if more > 0 else "")


def _linkage(
    vertex: int, joints: list[int], sectors: Floats, letters: str, within: float
) -> tuple[str, int, tuple[Row, ...], str]:
    """Return the linkage of a vertex by its creases, counterclockwise, and the sectors after them.

    With it the place of its first crease and its conditions; without one the reason.
    """
    marks = [letters[joint] for joint in joints]
    degree, none = len(joints), tuple[Row, ...]()
    if degree == 4:
        off = float(sectors[0] + sectors[2] - pi)
        if abs(off) > within:
            wrong = f"opposite sectors add up to {_degrees_off(off)} degrees"
            return "", 0, none, f"vertex {vertex}: {wrong}; expected 180, the condition of Bennett's linkage"
        if abs(marks.count("M") - marks.count("V")) != 2:
            count = numbered(marks.count("M"), "mountain")
            return "", 0, none, f"vertex {vertex}: {count} of 4 creases; expected 1 or 3"
        return "Bennett", 0, bennett_rows(joints, sectors.tolist(), marks[1] == marks[3]), ""
    kept = ", or a motion that some heights keep" if degree > 4 else ""
    if degree not in (5, 6):
        return "", 0, none, f"vertex {vertex} has {numbered(degree, 'crease')}; expected 4, 5 or 6{kept}"
    for first in range(degree):
        turned = np.roll(sectors, -first)
        here, seen = joints[first:] + joints[:first], marks[first:] + marks[:first]
        mirrored = np.abs(turned - turned[::-1]).max() <= within and seen[1:] == seen[:0:-1]
        symmetric = _mirrored_rows(here, turned, seen, within) if mirrored else None
        if symmetric is not None:
            return "Myard" if degree == 5 else "Bricard", first, symmetric, ""
    rule = "sectors" + (" of Myard's linkage" if degree == 5 else "") + " and assignment symmetric about a crease"
    return "", 0, none, f"vertex {vertex} of {degree} creases suits no linkage; expected {rule}{kept}"


def _degrees_off(off: float) -> str:
    """Return 180 degrees and an angle, in radians, with as many digits as tell it from 180."""
    whole = f"{np.degrees(pi + off):.6g}"
    return whole if whole != "180" else f"180 {'+' if off > 0.0 else '-'} {np.degrees(abs(off)):.1g}"


def needs_motion(vertices: Sequence[ThickVertex]) -> bool:
    """Return whether heights have to keep one motion of the thin sheet, so that vertices agree.

    Those of five and six creases that share a crease with another choose paths that need not agree. Vertices of five
    and more creases of no known linkage may keep a motion too; those of fewer cannot.
    """
    shared = [joint for one in vertices if one.of_motion for joint in one.joints]
    return len(set(shared)) < len(shared) or any(one.fault and one.of_motion for one in vertices)


def of_motion(vertex: ThickVertex, joints: Sequence[int], angles: Floats) -> ThickVertex:
    """Return a vertex with the conditions on its heights h that keep a motion of the thin vertex.

    From panel to panel round it, crossing creases k, the common normals of neighbouring axes are the normals n of
    panels, as long as the difference of heights. They close if the sum of h(k) (n(k) - n(k + 1)) is zero, which is
    linear in the heights, in each frame. All heights may be equal; if nothing else is left, no heights keep it.

    Parameters
    ----------
    vertex : ThickVertex
    joints : sequence of int
        Of the sheet, in the order of the angles.
    angles : float[F, J]
        Fold angles of the motion, radians.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> vertex = thick_vertices(at.sheet, at.mechanism, at.tolerances)[0]
    >>> len(of_motion(vertex, list(at.mechanism.sc.joints), synth.move(at.sheet).path.angles).rows)
    2
    """
    place = {joint: number for number, joint in enumerate(joints)}
    turned, normals = np.tile(np.eye(3), (len(angles), 1, 1)), []
    for joint, direction in zip(vertex.joints, vertex.directions, strict=True):
        normals.append(turned[:, :, 2])
        vectors = -angles[:, [place[joint]]] * np.array([*direction, 0.0])
        turned = turned @ Rotation.from_rotvec(vectors).as_matrix()
    across = np.stack(normals, axis=2)
    across = (across - np.roll(across, -1, axis=2)).reshape(-1, len(normals))
    rows = row_space(across).T
    return replace(vertex, rows=tuple(dict(zip(vertex.joints, row.tolist(), strict=True)) for row in rows))


def _mirrored_rows(
    joints: Sequence[int], sectors: Floats, marks: Sequence[str], within: float
) -> tuple[Row, ...] | None:
    """Return the conditions of a vertex that is symmetric about its first crease, None if it is not Myard's."""
    rows: list[Row] = [{joints[1]: 1.0, joints[-1]: -1.0}, {joints[2]: 1.0, joints[-2]: -1.0}]
    if len(joints) == 6:
        return tuple(rows)
    # Myard's linkage is two of Bennett's with a common twist, a right angle. Rates w of the three kinds of creases
    # satisfy w1 : w3 = -2 : 1 with a positive sign of the second length, 2 : 1 with a negative one.
    same = marks[1] == marks[2]
    if abs(sectors[1] - pi / 2) > within or (marks[0] == marks[2]) is same:
        return None
    ratio = (1.0 if same else -1.0) / sin(sectors[0])
    rows.append({joints[0]: ratio, joints[1]: -1.0 - ratio, joints[2]: 1.0})
    return tuple(rows)


def hinge_heights(
    sheet: Sheet, mechanism: SheetMechanism, tolerances: Tolerances, angles: Floats | None = None
) -> HingeHeights:
    """Return heights of hinges with the lowest risers: one linear programme over the sheet.

    A valley is at least at the upper side of both its panels, a mountain at most at their underside.

    Parameters
    ----------
    sheet : Sheet
        Flat, with an assignment.
    mechanism : SheetMechanism
        Of the sheet.
    tolerances : Tolerances
        Of its coordinates.
    angles : float[F, J], optional
        Fold angles of a motion of the sheet, radians, which vertices of more than four creases keep.

    Raises
    ------
    UnsolvableError
        If a vertex suits no linkage, or no heights keep the motion; if conditions exclude each other, with the
        vertices and panels of a dual certificate (Farkas' lemma).

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> heights = hinge_heights(at.sheet, at.mechanism, at.tolerances)
    >>> len(heights.hinges), len(heights.undersides)
    (12, 9)
    """
    vertices = thick_vertices(sheet, mechanism, tolerances)
    if angles is not None:
        joints = [int(str(joint)) for joint in mechanism.sc.joints]
        vertices = tuple(of_motion(one, joints, angles) if one.of_motion else one for one in vertices)
    for one in vertices:
        if one.fault and len(one.rows) in (0, len(one.joints) - 1):  # no conditions, or none but equal heights left
            raise UnsolvableError(one.fault)
    columns = {joint: place for place, joint in enumerate(mechanism.sc.joints)}
    hinges, panels = len(columns), len(mechanism.panels)
    equal = _matrix([{columns[j]: c for j, c in row.items()} for one in vertices for row in one.rows], hinges + panels)
    above, least, costs, of_panel = [], [], np.zeros(hinges + panels), []
    for joint, links in mechanism.sc.joints.items():
        sign = 1.0 if sheet.assignments[joint] == "V" else -1.0  # type: ignore[index]
        for panel in (int(str(link)) for link in links):
            above.append({hinges + panel: sign, columns[joint]: -sign})
            least.append(-1.0 if sign > 0 else 0.0)
            of_panel.append(panel)
            costs[columns[joint]] += sign
            costs[hinges + panel] -= sign
    bounds: list[tuple[float | None, float | None]] = [(None, None)] * (hinges + panels)
    bounds[hinges] = (0.0, 0.0)
    unequal = _matrix(above, hinges + panels)
    programme = {"A_eq": equal, "b_eq": np.zeros(equal.shape[0])} if equal.shape[0] else {}
    best = scipy.optimize.linprog(costs, unequal, np.array(least), bounds=bounds, method="highs", **programme)
    if best.status:
        raise UnsolvableError(_contradiction(equal, unequal, np.array(least), vertices, of_panel))
    levels = np.where(np.abs(best.x) <= DOUBLE.closed * np.abs(best.x).max(initial=1.0), 0.0, best.x)
    residual = max(float(np.abs(equal @ levels).max(initial=0.0)), float((unequal @ levels - least).max(initial=0.0)))
    return HingeHeights(
        {joint: float(levels[place]) for joint, place in columns.items()},  # type: ignore[misc]
        tuple(levels[hinges:].tolist()), vertices, residual, angles is not None,
    )  # fmt: skip


def _contradiction(
    equal: scipy.sparse.csr_matrix, unequal: scipy.sparse.csr_matrix, least: Floats, vertices: Sequence[ThickVertex],
    of_panel: Sequence[int],
) -> str:  # fmt: skip
    """Return which vertices and panels exclude each other: the support of the dual of the least violation."""
    rows, size = unequal.shape
    slack = scipy.sparse.hstack([unequal, -scipy.sparse.eye(rows)]).tocsr()
    held = scipy.sparse.hstack([equal, scipy.sparse.csr_matrix((equal.shape[0], rows))]).tocsr()
    bounds = [(None, None)] * size + [(0.0, None)] * rows
    costs = np.concatenate([np.zeros(size), np.ones(rows)])
    nearest = scipy.optimize.linprog(costs, slack, least, held, np.zeros(held.shape[0]), bounds, method="highs")
    # Multipliers are 0 or of the order of 1 / coefficients, so the root of the rounding parts them.
    weight = np.abs(nearest.ineqlin.marginals)
    strong = weight > np.sqrt(np.finfo(float).eps) * weight.max()
    panels = sorted({of_panel[row] for row in np.flatnonzero(strong).tolist()})
    owners = [one.vertex for one in vertices for _ in one.rows]
    multipliers = np.abs(nearest.eqlin.marginals)
    there = np.flatnonzero(multipliers > np.sqrt(np.finfo(float).eps) * multipliers.max(initial=1.0))
    at = sorted({owners[row] for row in there.tolist()})
    return (
        f"no heights of the hinges: the conditions of {'vertex' if len(at) == 1 else 'vertices'} {_listed(at)} and "
        f"of {'panel' if len(panels) == 1 else 'panels'} {_listed(panels)} (each valley one thickness above each "
        f"mountain) exclude each other"
    )


def _matrix(rows: Sequence[Mapping[int, float]], columns: int) -> scipy.sparse.csr_matrix:
    places = [(number, column, value) for number, row in enumerate(rows) for column, value in row.items()]
    where, which, values = zip(*places, strict=True) if places else ((), (), ())
    return scipy.sparse.csr_matrix((values, (where, which)), shape=(len(rows), columns))
