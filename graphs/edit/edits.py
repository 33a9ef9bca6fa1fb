"""Edits of SC and SCD graphs, each with the change of mobility that the relative equations predict.

An edit returns a new graph; nothing is changed in place. Edits of SCD graphs keep the sides of the links. Source:
Wiener 2016, sections 4.2 and 6.3.2, Eqs. 5 to 7. Theory: docs/theory/edits.md.
"""

from collections.abc import Collection, Container, Hashable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from itertools import count, islice
from typing import Any

from graphs.count.equations import relative_cgk, relative_polyhedron, relative_spherical_system
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.loops.loop import Centre, Loop, cut_into_cycles, dependent_loop
from graphs.mechanism.drawing import FaceKind, Side
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.types import JointId, Joints, LinkId


@dataclass(frozen=True, slots=True)
class Edit:
    """A mechanism before and after an edit.

    Attributes
    ----------
    what : str
        The edit in words.
    before, graph : SCGraph
        The mechanism before and after.
    predicted : int
        The change of mobility by the relative equation, for the parts added and taken away.
    equation : str
        That equation.

    Examples
    --------
    >>> edit = lock_joint(SCGraph(3, [(0, 1), (1, 2)]), 0)
    >>> edit.what, edit.predicted, edit.counted, edit.equation
    ('lock joint 0', -1, -1, 'Eq. 6')
    """

    what: str
    before: SCGraph
    graph: SCGraph
    predicted: int
    equation: str

    @property
    def counted(self) -> int:
        """The change of mobility as the difference of the two counts."""
        before, after = (mobility_report(sc).mobility for sc in (self.before, self.graph))
        assert before is not None
        assert after is not None
        return after - before

    def to_json(self) -> dict[str, Any]:
        """Return the edit as plain data."""
        keys = ("what", "equation", "predicted", "counted")
        return {key: getattr(self, key) for key in keys} | counts_as_json(self.graph)


def counts_as_json(sc: SCGraph) -> dict[str, Any]:
    """Return the numbers of links and joints and the mobility of an edited graph as plain data."""
    return {"links": len(sc), "joints": len(sc.joints), "mobility": mobility_report(sc).mobility}


def fresh(used: Iterable[Hashable], number: int) -> list[int]:
    """Return new integer ids whose text is not used."""
    texts = {str(name) for name in used}
    unused = (candidate for candidate in count(len(texts)) if str(candidate) not in texts)
    return list(islice(unused, number))


def add_loop(
    sc: SCGraph,
    a: LinkId,
    b: LinkId,
    links: int,
    *,
    centre: Centre | str = Centre.FINITE,
    through: Sequence[JointId] | None = None,
) -> Edit:
    """Append a chain of new links between two links, and so close a loop.

    dM = 3 k - 2 (k + 1) for k links and a loop with a centre (Eq. 6), k - 5 for a spatial one (Eq. 5). Raises
    `InvariantError` if a or b is no link, or the loop is no cycle; `UnsolvableError` if a and b are not joined by
    one joint, without ``through``.

    Parameters
    ----------
    sc : SCGraph
    a, b : link ids
        Different links.
    links : int
        Number of new links, 0 for a joint only.
    centre : Centre, optional
        Of the new loop; ``"none"`` for a spatial one.
    through : sequence of joint ids, optional
        The rest of the loop, a path from a to b; by default the joint between them.

    Examples
    --------
    Wiener 4.2.5.1: three links and four joints add one freedom.

    >>> ring = SCGraph(6, [(i, (i + 1) % 6) for i in range(6)], [Loop(range(6))])
    >>> edit = add_loop(ring, 0, 1, 3)
    >>> edit.predicted, edit.counted
    (1, 1)
    """
    _check_links(sc, a, b)
    if links < 0:
        raise InvariantError("chain of links", f"a chain of {links} links", "0 or more")
    if through is None:
        between = list(sc[a][b]) if sc.has_edge(a, b) else []
        if len(between) != 1:
            wrong = f"links {shown(a)} and {shown(b)} have {numbered(len(between), 'joint')} between them"
            raise UnsolvableError(f"{wrong}: say which joints the new loop goes through")
        through = between
    new_links = fresh(sc.nodes, links)
    new_joints = fresh(sc.joints, links + 1)
    chain = [a, *new_links, b]
    joints = dict(sc.joints) | {joint: (chain[i], chain[i + 1]) for i, joint in enumerate(new_joints)}
    loop = Loop((*through, *new_joints), Centre(centre))
    spatial = loop.centre is Centre.NONE
    predicted = relative_cgk(links, links + 1, 6) if spatial else relative_spherical_system(links, links + 1)
    graph = SCGraph([*sc.nodes, *new_links], joints, [*sc.loops, loop], closing=sc.closing, ground=sc.ground)
    kind = "spatial" if spatial else "spherical" if loop.centre is Centre.FINITE else "planar"
    what = f"{kind} loop of {numbered(links, 'new link')} between {shown(a)} and {shown(b)}"
    return Edit(what, sc, graph, predicted, "Eq. 5" if spatial else "Eq. 6")


def add_ride_along(sc: SCGraph, a: LinkId, b: LinkId) -> Edit:
    """Append a ride-along to two adjacent links: two links, three joints, one finite centre, dM = 0.

    Parameters
    ----------
    sc : SCGraph
    a, b : link ids
        Links with one joint between them; else the errors are those of :func:`add_loop`.

    Examples
    --------
    >>> ring = SCGraph(4, [(i, (i + 1) % 4) for i in range(4)], [Loop(range(4))])
    >>> edit = add_ride_along(ring, 0, 1)
    >>> edit.predicted, edit.counted, len(edit.graph)
    (0, 0, 6)
    """
    edit = add_loop(sc, a, b, 2)
    return replace(edit, what=f"ride-along on {shown(a)} and {shown(b)}")


def add_crease(sc: SCGraph, link: LinkId, moved: Collection[JointId]) -> Edit:
    """Crease a link: part of its joints goes to a new link, which a new joint joins to the old one. dM = 1.

    A loop with a joint on either side of the crease passes the crease too.

    Parameters
    ----------
    sc : SCGraph
    link : link id
    moved : collection of joint ids
        The joints of the link that lie beyond the crease; none for a flap. InvariantError for other joints.

    Examples
    --------
    >>> ring = SCGraph(4, [(i, (i + 1) % 4) for i in range(4)], [Loop(range(4))])
    >>> edit = add_crease(ring, 0, [3])
    >>> edit.predicted, edit.counted, edit.graph.loops[0].joints
    (1, 1, (0, 1, 2, 3, 4))
    """
    _check_links(sc, link)
    beyond = set(moved)
    for joint in moved:
        if joint not in sc.joints or link not in sc.joints[joint]:
            wrong = f"joint {shown(joint)} is not at link {shown(link)}"
            raise InvariantError("crease", wrong, "one of its joints")
    (half,) = fresh(sc.nodes, 1)
    (crease,) = fresh(sc.joints, 1)
    joints = _moved_joints(sc, link, half, beyond)
    at_link = {joint for joint, ends in sc.joints.items() if link in ends}
    loops, closing = (_creased(some, at_link, beyond, crease) for some in (sc.loops, sc.closing))
    links, joints = [*sc.nodes, half], {**joints, crease: (link, half)}
    graph = SCGraph(links, joints, loops, closing=closing, ground=sc.ground)
    return Edit(f"crease in {shown(link)}", sc, graph, relative_spherical_system(1, 1), "Eq. 6")


def _creased(loops: Sequence[Loop], at_link: Set[Side], beyond: Set[Side], crease: JointId) -> list[Loop]:
    """Return loops; those with joints of the link on either side of its crease pass the crease too."""
    heres = [at_link & set(loop.joints) for loop in loops]
    return [
        replace(loop, joints=(*loop.joints, crease)) if here & beyond and here - beyond else loop
        for loop, here in zip(loops, heres, strict=True)
    ]


def _moved_joints(sc: SCGraph, link: LinkId, half: LinkId, moved: Container[object]) -> Joints:
    """Return the joints of a graph; those of a link that are moved end at its other half."""

    def end_of(joint: JointId, end: LinkId) -> LinkId:
        return half if end == link and joint in moved else end

    return {joint: (end_of(joint, a), end_of(joint, b)) for joint, (a, b) in sc.joints.items()}


def _joints_of_locked(sc: SCGraph, joint: JointId) -> Joints:
    """Return the joints but a locked one, its second link replaced by its first."""
    kept, gone = sc.joints[joint]
    return {
        other: (kept if a == gone else a, kept if b == gone else b)
        for other, (a, b) in sc.joints.items()
        if other != joint
    }


def lock_joint(sc: SCGraph, joint: JointId) -> Edit:
    """Lock a joint: its two links become one, the first. dM = -1 (thesis 6.3.2).

    Parameters
    ----------
    sc : SCGraph
    joint : joint id
        InvariantError if it is no joint; UnsolvableError if other joints join the same two links.

    Examples
    --------
    >>> ring = SCGraph(5, [(i, (i + 1) % 5) for i in range(5)], [Loop(range(5))])
    >>> edit = lock_joint(ring, 0)
    >>> edit.predicted, edit.counted, len(edit.graph)
    (-1, -1, 4)
    """
    if joint not in sc.joints:
        raise InvariantError("lock", f"{shown(joint)} is no joint", "one of the joints")
    kept, gone = sc.joints[joint]
    beside = [other for other in sc[kept][gone] if other != joint]
    if beside:
        raise UnsolvableError(f"joint {shown(beside[0])} joins the same two links as joint {shown(joint)}")
    joints = _joints_of_locked(sc, joint)
    loops = _contracted(sc.loops, joint, joints)
    closing = [
        loop
        for loop in _contracted(sc.closing, joint, joints)
        if not any(set(loop.joints) == set(other.joints) for other in loops)
    ]
    graph = SCGraph(
        [link for link in sc.nodes if link != gone],
        joints,
        loops,
        closing=closing,
        ground=kept if sc.ground == gone else sc.ground,
    )
    return Edit(f"lock joint {shown(joint)}", sc, graph, relative_spherical_system(-1, -1), "Eq. 6")


def _contracted(loops: Sequence[Loop], joint: JointId, joints: Joints) -> list[Loop]:
    """Take a joint out of loops; if a loop then passes a link twice, keep a part independent of the rest."""
    result = [tuple(other for other in loop.joints if other != joint) for loop in loops]
    for i, around in enumerate(result):
        parts = cut_into_cycles(around, joints)
        if len(parts) > 1:
            rest = [other for k, other in enumerate(result) if k != i]
            result[i] = next(part for part in parts if dependent_loop([*rest, part]) is None)
    return [replace(loop, joints=around) for loop, around in zip(loops, result, strict=True)]


def _check_links(sc: SCGraph, *links: LinkId) -> None:
    for link in links:
        if link not in sc:
            raise InvariantError("edit", f"{shown(link)} is no link", "one of the links")
    if len(set(links)) < len(links):
        raise InvariantError("edit", f"link {shown(links[0])} is named twice", "two different links")


_EQUATION = "Eq. 7"


def crease_link(scd: SCDGraph, link: LinkId, start: int, end: int | None = None) -> Edit:
    """Crease a link between two of its vertices, or from one to the middle of an open edge (thesis 4.2.2).

    dV = 0 and dE = -1 between vertices, dV = 1 and dE = 2 to an open edge. Raises `InvariantError` if there is no
    such link or vertex, if the vertices are neighbours, or the result breaks a rule; `UnsolvableError` if no open
    edge lies opposite.

    Parameters
    ----------
    scd : SCDGraph
    link : link id
    start, end : int
        Vertices of the link, as numbered in ``scd.vertices``. Without ``end`` the crease runs to the middle of the
        first open edge that does not end in ``start``.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> mesh = scd_from_panels([(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7)])
    >>> edit = crease_link(mesh, 0, mesh.vertices[0][0], mesh.vertices[0][2])
    >>> edit.predicted, edit.counted
    (1, 1)
    """
    _check_links(scd, link)
    sides, first = list(scd.rotation[link]), _place(scd, link, start)
    if end is None:
        second = _opposite_open_edge(scd, link, start, first)
        sides.insert(second, None)  # the open edge in two: the crease ends between its halves
        first += second <= first
        predicted = relative_polyhedron(1, 0, 2)
    else:
        second = _place(scd, link, end)
        apart = (second - first) % len(sides)
        if apart in (0, 1, len(sides) - 1):
            wrong = f"vertices {start} and {end} of link {shown(link)} are neighbours or equal"
            raise InvariantError("crease", wrong, "a diagonal")
        predicted = relative_polyhedron(0, 0, -1)
    (half,), (crease,) = fresh(scd.nodes, 1), fresh(scd.joints, 1)
    turned = sides[first + 1 :] + sides[: first + 1]
    cut = (second - first) % len(sides)
    beyond, kept = turned[:cut], turned[cut:]
    graph = _rebuilt(
        scd,
        links=[*scd.nodes, half],
        joints={**_moved_joints(scd, link, half, beyond), crease: (link, half)},
        rotation={**scd.rotation, link: [*kept, crease], half: [*beyond, crease]},
        loops=_creased(scd.loops, set(sides), set(beyond), crease),
        closing=_creased(scd.closing, set(sides), set(beyond), crease),
    )
    return Edit(f"crease in {shown(link)}", scd, graph, predicted, _EQUATION)


def make_implicit(scd: SCDGraph, loop: int) -> Edit:
    """Take the links off the centre of a loop: an open edge in each corner. dM = 0 (thesis 4.2.3).

    dV = n - 1, dC = 1, dE = 3 n for a loop of n joints.

    Parameters
    ----------
    scd : SCDGraph
    loop : int
        Index of the loop. InvariantError if there is no such loop, or its centre is not explicit.

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

    dV = 1 - k, dC = -1, dE = -3 k for k open edges.

    Parameters
    ----------
    scd : SCDGraph
    loop : int
        Index of the loop. InvariantError if there is none, its centre is not implicit, or the result breaks a
        rule (links of fewer than three sides, two explicit centres in a class).

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
        for _ in range(corner.open_edges):
            del sides[(sides.index(corner.leaving) + 1) % len(sides)]
    k = scd.faces[face].open_edges
    graph = _rebuilt(scd, rotation=rotation)
    what = f"explicit centre in {scd.loops[loop].label}"
    return Edit(what, scd, graph, relative_polyhedron(1 - k, -1, -3 * k), _EQUATION)


def ride_along(scd: SCDGraph, joint: JointId, sides: tuple[int, int] = (3, 3)) -> Edit:
    """Append a ride-along at an end of a joint where both its links have an open edge next to it. dM = 0.

    dV = n + m - 5, dE = 3 n + 3 m - 15 (thesis 4.2.4.3, with the parentheses that are missing there).

    Parameters
    ----------
    scd : SCDGraph
    joint : joint id
        UnsolvableError if no end of it has room, with the rule that stands in the way.
    sides : (int, int), optional
        n and m, the numbers of sides of the new links; InvariantError if they are fewer than three.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> edit = ride_along(scd_from_panels([(0, k, k % 6 + 1) for k in range(1, 7)]), 0)
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

    dV = 0, dE = 1: a rod between the links becomes an internal one, and one more is needed.

    Parameters
    ----------
    scd : SCDGraph
    joint : joint id
        InvariantError if it is no joint, or the result breaks a rule; UnsolvableError if other joints join the
        same two links, or a loop would pass the new link twice.

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
            raise UnsolvableError(f"{loop.label} would pass the locked links twice; try the SC graph")
    i, k = scd.rotation[kept].index(joint), scd.rotation[gone].index(joint)
    inserted = [*scd.rotation[gone][k + 1 :], *scd.rotation[gone][:k]]
    rotation: dict[LinkId, Sequence[Side]] = {link: sides for link, sides in scd.rotation.items() if link != gone}
    rotation[kept] = [*scd.rotation[kept][:i], *inserted, *scd.rotation[kept][i + 1 :]]

    def without(loop: Loop) -> Loop:
        return replace(loop, joints=tuple(other for other in loop.joints if other != joint))

    graph = _rebuilt(
        scd,
        links=[link for link in scd.nodes if link != gone],
        joints=_joints_of_locked(scd, joint),
        rotation=rotation,
        loops=[without(loop) for loop in scd.loops],
        closing=[without(loop) for loop in scd.closing],
        outer=_other_side_of(scd, joint),
        ground=kept if scd.ground == gone else scd.ground,
    )
    return Edit(f"lock joint {shown(joint)}", scd, graph, relative_polyhedron(0, 0, 1), _EQUATION)


def _rebuilt(scd: SCDGraph, **changes: Any) -> SCDGraph:
    """Return the graph with some of its parts changed."""
    keys = ("joints", "loops", "rotation", "outer", "closing", "ground")
    return SCDGraph(**({"links": scd.nodes} | {key: getattr(scd, key) for key in keys} | changes))


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
    face = scd.drawing.face_loops.index(loop) if loop in scd.drawing.face_loops else None
    if face is None or scd.drawing.kind_of_face(face) is not kind:
        raise InvariantError("edit", f"the centre of {scd.loops[loop].label} is not {kind.value}", kind.value)
    return face


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
    side = "right" if scd.joints[joint][0] == a else "left"  # the face on the left when going from b to a
    # the old name of the outer face may stand for the new loop now: it lies beyond the joint a-u
    in_outer = scd.drawing.face_at(joint, side) == scd.drawing.outer_face
    return _rebuilt(
        scd,
        links=[*scd.nodes, u, v],
        joints={**scd.joints, au: (a, u), uv: (u, v), vb: (v, b)},
        loops=[*scd.loops, Loop((joint, au, uv, vb), Centre.FINITE)],
        rotation={**rotation, **new},
        outer=(au, "right") if in_outer else scd.outer,
    )


def _other_side_of(scd: SCDGraph, joint: JointId) -> tuple[JointId, str] | None:
    """Name the outer face by a joint that is not to go."""
    if scd.outer is None or scd.outer[0] != joint:
        return scd.outer
    for corner in scd.faces[scd.drawing.outer_face].corners:
        other = corner.leaving
        if other is not None and other != joint:
            return other, "left" if scd.joints[other][0] == corner.link else "right"
    return None
