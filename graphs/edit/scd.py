"""Edits of SCD graphs: the sides of the links are kept, and Eq. 7 predicts the change of mobility.

Source: Wiener 2016, sections 4.2.2 to 4.2.4 and 6.3.2, Eq. 7. Edits of SC graphs, whose links have no shape,
are in :mod:`graphs.edit.sc`. Theory: docs/theory/edits.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from graphs.count.equations import relative_polyhedron
from graphs.edit.sc import Edit, fresh
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import FaceKind, Side
from graphs.mechanism.scd import SCDGraph
from graphs.types import JointId, LinkId

__all__ = ["crease_link", "lock_hinge", "make_explicit", "make_implicit", "ride_along"]

_EQUATION = "Eq. 7"


def crease_link(scd: SCDGraph, link: LinkId, start: int, end: int | None = None) -> Edit:
    """Crease a link between two of its vertices, or from a vertex to the open edge opposite. dM = 1.

    Parameters
    ----------
    scd : SCDGraph
    link : link id
    start, end : int
        Vertices of the link, as numbered in ``scd.vertices``. Without ``end`` the crease runs to the middle of the
        first open edge that does not end in ``start``.

    Returns
    -------
    Edit
        dV = 0 and dE = -1 between vertices, dV = 1 and dE = 2 to an open edge (thesis 4.2.2).

    Raises
    ------
    InvariantError
        If there is no such link or vertex, if the vertices are neighbours, or the result breaks a rule.
    UnsolvableError
        If no open edge lies opposite.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> mesh = scd_from_panels([(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7)])
    >>> corner, opposite = mesh.vertices[0][0], mesh.vertices[0][2]
    >>> edit = crease_link(mesh, 0, corner, opposite)
    >>> edit.predicted, edit.counted
    (1, 1)
    """
    sides, first = list(_sides(scd, link)), _place(scd, link, start)
    if end is None:
        second = _opposite_open_edge(scd, link, start, first)
        sides.insert(second, None)  # the open edge in two: the crease ends between its halves
        first += second <= first
        predicted = relative_polyhedron(1, 0, 2)
    else:
        second = _place(scd, link, end)
        apart = (second - first) % len(sides)
        if apart in (0, 1, len(sides) - 1):
            raise InvariantError(
                "crease", f"vertices {start} and {end} of link {shown(link)} are neighbours, or one", "a diagonal"
            )
        predicted = relative_polyhedron(0, 0, -1)
    (half,), (crease,) = fresh(scd.nodes, 1), fresh(scd.joints, 1)
    turned = sides[first + 1 :] + sides[: first + 1]
    cut = (second - first) % len(sides)
    beyond, kept = turned[:cut], turned[cut:]
    joints = {
        joint: tuple(half if one == link and joint in beyond else one for one in ends)
        for joint, ends in scd.joints.items()
    }

    def creased(loop: Loop) -> Loop:
        here = [joint for joint in sides if joint in loop.joints]
        parted = 0 < sum(joint in beyond for joint in here) < len(here)
        return replace(loop, joints=(*loop.joints, crease)) if parted else loop

    graph = _rebuilt(
        scd,
        links=[*scd.nodes, half],
        joints={**{joint: (a, b) for joint, (a, b) in joints.items()}, crease: (link, half)},
        rotation={**scd.rotation, link: [*kept, crease], half: [*beyond, crease]},
        loops=[creased(loop) for loop in scd.loops],
        closing=[creased(loop) for loop in scd.closing],
    )
    return Edit(f"crease in {shown(link)}", scd, graph, predicted, _EQUATION)


def make_implicit(scd: SCDGraph, loop: int) -> Edit:
    """Take the links off the centre of a loop: an open edge in each corner. dM = 0 (thesis 4.2.3).

    Parameters
    ----------
    scd : SCDGraph
    loop : int
        Index of the loop, whose centre is explicit.

    Returns
    -------
    Edit
        dV = n - 1, dC = 1, dE = 3 n for a loop of n joints.

    Raises
    ------
    InvariantError
        If there is no such loop or its centre is not explicit.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> edit = make_implicit(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]), 0)
    >>> edit.predicted, edit.counted, edit.graph.counts.implicit_centres
    (0, 0, 1)
    """
    face = _face_with(scd, loop, FaceKind.EXPLICIT)
    rotation = {link: list(sides) for link, sides in scd.rotation.items()}
    for corner in scd.faces[face].corners:
        rotation[corner.link].insert(rotation[corner.link].index(corner.leaving) + 1, None)
    n = len(scd.faces[face].corners)
    graph = _rebuilt(scd, rotation=rotation)
    what = f"implicit centre in {scd.loops[loop].label}"
    return Edit(what, scd, graph, relative_polyhedron(n - 1, 1, 3 * n), _EQUATION)


def make_explicit(scd: SCDGraph, loop: int) -> Edit:
    """Let the links of a loop reach its centre: the open edges in its face go. dM = 0.

    Parameters
    ----------
    scd : SCDGraph
    loop : int
        Index of the loop, whose centre is implicit.

    Returns
    -------
    Edit
        dV = 1 - k, dC = -1, dE = -3 k for k open edges.

    Raises
    ------
    InvariantError
        If there is no such loop, its centre is not implicit, or the result breaks a rule (links of fewer than
        three sides, two explicit centres in a class).

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> fan = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)])
    >>> make_explicit(make_implicit(fan, 0).graph, 0).graph.is_identical(fan)
    True
    """
    face = _face_with(scd, loop, FaceKind.IMPLICIT)
    rotation = {link: list(sides) for link, sides in scd.rotation.items()}
    for corner in scd.faces[face].corners:
        sides = rotation[corner.link]
        start = sides.index(corner.leaving)
        for _ in range(corner.open_edges):
            del sides[(start + 1) % len(sides)]
            start = sides.index(corner.leaving)
    k = scd.faces[face].open_edges
    graph = _rebuilt(scd, rotation=rotation)
    what = f"explicit centre in {scd.loops[loop].label}"
    return Edit(what, scd, graph, relative_polyhedron(1 - k, -1, -3 * k), _EQUATION)


def ride_along(scd: SCDGraph, joint: JointId, sides: tuple[int, int] = (3, 3)) -> Edit:
    """Append a ride-along at an end of a joint where both its links have an open edge next to it. dM = 0.

    Parameters
    ----------
    scd : SCDGraph
    joint : joint id
    sides : (int, int), optional
        n and m, the numbers of sides of the new links.

    Returns
    -------
    Edit
        dV = n + m - 5, dE = 3 n + 3 m - 15 (thesis 4.2.4.3, with the parentheses that are missing there).

    Raises
    ------
    InvariantError
        If there is no such joint or a new link has fewer than three sides.
    UnsolvableError
        If no end of the joint has room, with the rule that stands in the way.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> fan = scd_from_panels([(0, k, k % 6 + 1) for k in range(1, 7)])
    >>> edit = ride_along(fan, 0)
    >>> edit.predicted, edit.counted, len(edit.graph.loops)
    (0, 0, 2)
    """
    if joint not in scd.joints:
        raise InvariantError("ride-along", f"{shown(joint)} is no joint", "one of the joints")
    if min(sides) < 3:
        raise InvariantError("ride-along", f"a link of {min(sides)} sides", "three or more")
    why = "no open edges next to both sides of it"
    for a, b in (scd.joints[joint], scd.joints[joint][::-1]):
        i, k = scd.rotation[a].index(joint), scd.rotation[b].index(joint)
        after = (k + 1) % len(scd.rotation[b])
        if scd.rotation[a][i - 1] is None and scd.rotation[b][after] is None:
            try:
                graph = _with_ride_along(scd, joint, (a, i - 1), (b, after), sides)
            except InvariantError as error:
                why = str(error)
                continue
            n, m = sides
            predicted = relative_polyhedron(n + m - 5, 0, 3 * n + 3 * m - 15)
            return Edit(f"ride-along on {shown(a)} and {shown(b)}", scd, graph, predicted, _EQUATION)
    raise UnsolvableError(f"no room for a ride-along at joint {shown(joint)}: {why}")


def lock_hinge(scd: SCDGraph, joint: JointId) -> Edit:
    """Lock a joint: its two links become one polygon, that of the first. dM = -1 (thesis 6.3.2).

    Parameters
    ----------
    scd : SCDGraph
    joint : joint id

    Returns
    -------
    Edit
        dV = 0, dE = 1: a rod between the links becomes an internal one, and one more is needed.

    Raises
    ------
    InvariantError
        If there is no such joint, or the result breaks a rule.
    UnsolvableError
        If other joints join the same two links, or a loop would pass the new link twice.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> edit = lock_hinge(scd_from_panels([(0, k, k % 5 + 1) for k in range(1, 6)]), 0)
    >>> edit.predicted, edit.counted
    (-1, -1)
    """
    if joint not in scd.joints:
        raise InvariantError("lock", f"{shown(joint)} is no joint", "one of the joints")
    kept, gone = scd.joints[joint]
    if len(scd[kept][gone]) > 1:
        raise UnsolvableError(f"other joints join the same two links as joint {shown(joint)}")
    for loop in (*scd.loops, *scd.closing):
        ends = [link for other in loop.joints for link in scd.joints[other]]
        if joint not in loop.joints and kept in ends and gone in ends:
            raise UnsolvableError(
                f"{loop.label} would pass the locked links twice; lock the joint of the SC graph"
            )
    i, k = scd.rotation[kept].index(joint), scd.rotation[gone].index(joint)
    inserted = [*scd.rotation[gone][k + 1 :], *scd.rotation[gone][:k]]
    rotation: dict[LinkId, Sequence[Side]] = {link: sides for link, sides in scd.rotation.items() if link != gone}
    rotation[kept] = [*scd.rotation[kept][:i], *inserted, *scd.rotation[kept][i + 1 :]]
    joints = {
        other: (kept if a == gone else a, kept if b == gone else b)
        for other, (a, b) in scd.joints.items()
        if other != joint
    }

    def without(loop: Loop) -> Loop:
        return replace(loop, joints=tuple(other for other in loop.joints if other != joint))

    graph = _rebuilt(
        scd,
        links=[link for link in scd.nodes if link != gone],
        joints=joints,
        rotation=rotation,
        loops=[without(loop) for loop in scd.loops],
        closing=[without(loop) for loop in scd.closing],
        outer=_other_side_of(scd, joint),
        ground=kept if scd.ground == gone else scd.ground,
    )
    return Edit(f"lock joint {shown(joint)}", scd, graph, relative_polyhedron(0, 0, 1), _EQUATION)


def _rebuilt(scd: SCDGraph, **changes: Any) -> SCDGraph:
    """Return the graph with some of its parts changed."""
    parts: dict[str, Any] = {
        "links": scd.nodes,
        "joints": scd.joints,
        "loops": scd.loops,
        "rotation": scd.rotation,
        "outer": scd.outer,
        "closing": scd.closing,
        "ground": scd.ground,
    }
    return SCDGraph(**(parts | changes))


def _sides(scd: SCDGraph, link: LinkId) -> tuple[Side, ...]:
    if link not in scd:
        raise InvariantError("edit", f"{shown(link)} is no link", "one of the links")
    return scd.rotation[link]


def _place(scd: SCDGraph, link: LinkId, vertex: int) -> int:
    if vertex not in scd.vertices[link]:
        known = " ".join(map(str, scd.vertices[link]))
        raise InvariantError("edit", f"{shown(vertex)} is no vertex of link {shown(link)}", f"one of {known}")
    return scd.vertices[link].index(vertex)


def _opposite_open_edge(scd: SCDGraph, link: LinkId, vertex: int, place: int) -> int:
    """Return the index of the first open edge of a link that does not end in a vertex."""
    sides = scd.rotation[link]
    for step in range(2, len(sides)):
        index = (place + step) % len(sides)
        if sides[index] is None:
            return index
    raise UnsolvableError(f"link {shown(link)} has no open edge opposite vertex {vertex}")


def _face_with(scd: SCDGraph, loop: int, kind: FaceKind) -> int:
    if not 0 <= loop < len(scd.loops):
        raise InvariantError("edit", f"there is no loop {shown(loop)}", f"0 to {len(scd.loops) - 1}")
    if (
        loop not in scd.drawing.face_loops
        or scd.drawing.kind_of_face(scd.drawing.face_loops.index(loop)) is not kind
    ):
        raise InvariantError("edit", f"the centre of {scd.loops[loop].label} is not {kind.value}", kind.value)
    return scd.drawing.face_loops.index(loop)


def _with_ride_along(
    scd: SCDGraph, joint: JointId, at_a: tuple[LinkId, int], at_b: tuple[LinkId, int], sides: tuple[int, int]
) -> SCDGraph:
    """Put two links on two open edges that meet in the end of a joint, and join them there."""
    (a, i), (b, k) = at_a, at_b
    u, v = fresh(scd.nodes, 2)
    au, uv, vb = fresh(scd.joints, 3)
    rotation: Mapping[LinkId, list[Side]] = {link: list(row) for link, row in scd.rotation.items()}
    rotation[a][i] = au
    rotation[b][k] = vb
    new = {u: [uv, au, *[None] * (sides[0] - 2)], v: [vb, uv, *[None] * (sides[1] - 2)]}
    return _rebuilt(
        scd,
        links=[*scd.nodes, u, v],
        joints={**scd.joints, au: (a, u), uv: (u, v), vb: (v, b)},
        loops=[*scd.loops, Loop((joint, au, uv, vb), Centre.FINITE)],
        rotation={**rotation, **new},
        outer=_outer_after_ride_along(scd, joint, a, au),
    )


def _outer_after_ride_along(scd: SCDGraph, joint: JointId, a: LinkId, au: JointId) -> tuple[JointId, str] | None:
    """Name the outer face where its old name now stands for the new loop: it lies beyond the joint a-u."""
    side = "right" if scd.joints[joint][0] == a else "left"  # the face on the left when going from b to a
    in_outer = scd.drawing.face_at(joint, side) == scd.drawing.outer_face
    return (au, "right") if in_outer else scd.outer


def _other_side_of(scd: SCDGraph, joint: JointId) -> tuple[JointId, str] | None:
    """Name the outer face by a joint that is not to go."""
    if scd.outer is None or scd.outer[0] != joint:
        return scd.outer
    for corner in scd.faces[scd.drawing.outer_face].corners:
        other = corner.leaving
        if other is not None and other != joint:
            return other, "left" if scd.joints[other][0] == corner.link else "right"
    return None
