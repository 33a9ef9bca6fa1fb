"""Joints of all kinds as vertices and rods, with points on lines and planes: the model of Wampler's count.

A link is a body of three vertices or more, and its rods; a joint is vertices that both its links have, or points
of one on a line or in a plane of the other. Source: Wampler, Larson, Erdman 2007, Eqs. 5 to 7. Theory:
docs/theory/joints.md.
"""

from collections.abc import Iterator
from itertools import combinations

from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.loops.loop import Centre
from graphs.mechanism.polyhedron import PointConstraint, PolyhedronModel, RemoteCentre
from graphs.types import JointId, LinkId

_BODY = 3  # vertices that fix a body: with two it could turn about their line


def points_of(linkage: JointedLinkage) -> PolyhedronModel:
    """Return the vertices and rods of a type, with a remote centre S_{+3} for each loop that has a centre.

    A link with two spherical joints, to two other links, and no others is one rod, as in the source: without its
    spin.

    Parameters
    ----------
    linkage : JointedLinkage

    Examples
    --------
    >>> from graphs.count.equations import mobility_of_model
    >>> from graphs.mechanism.sc import SCGraph
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> rod = JointedLinkage(ring, {1: JointKind.SPHERICAL, 2: JointKind.SPHERICAL})
    >>> rod.mobility, mobility_of_model(points_of(rod))
    (2, 1)
    """
    model = _Model(linkage)
    for joint, (first, second) in linkage.chain.joints.items():
        model.join(joint, linkage.kinds[joint], first, second)
    model.complete(set(rods_between_balls(linkage)))
    centres = [
        RemoteCentre(3, tuple((f"{j}:1", f"{j}:2") for j in loop.joints) if loop.centre is Centre.FINITE else ())
        for loop in linkage.chain.centred_loops
    ]
    held = {constraint.vertex for constraint in (*model.on_line, *model.on_plane)}
    vertices = dict.fromkeys(vertex for body in model.bodies.values() for vertex in body)
    return PolyhedronModel(
        sorted(vertices, key=held.__contains__),  # vertices that span lines and planes first
        model.rods,
        centres=centres,
        on_line=model.on_line,
        on_plane=model.on_plane,
    )


def rods_between_balls(linkage: JointedLinkage) -> Iterator[LinkId]:
    """Yield the links that have two spherical joints, to two other links, and no other joints."""
    at: dict[LinkId, list[tuple[JointKind, LinkId]]] = {link: [] for link in linkage.chain.nodes}
    for joint, (first, second) in linkage.chain.joints.items():
        at[first].append((linkage.kinds[joint], second))
        at[second].append((linkage.kinds[joint], first))
    for link, beside in at.items():
        balls = {other for kind, other in beside if kind is JointKind.SPHERICAL}
        if len(beside) == len(balls) == 2:
            yield link


class _Model:
    """The model as it grows: the vertices of each link, pairs of them that have to be joined by a rod."""

    def __init__(self, linkage: JointedLinkage) -> None:
        self.bodies: dict[LinkId, list[str]] = {link: [] for link in linkage.chain.nodes}
        self.rods: list[tuple[str, str]] = []
        self.on_line: list[PointConstraint] = []
        self.on_plane: list[PointConstraint] = []
        self._partner: dict[str, str] = {}

    def join(self, joint: JointId, kind: JointKind, first: LinkId, second: LinkId) -> None:
        """Give both links of a joint its vertices."""
        names = [f"{joint}:{number}" for number in range(1, 7)]
        mine, theirs = self.bodies[first], self.bodies[second]
        if kind is JointKind.REVOLUTE:
            mine += names[:2]
            theirs += names[:2]
            self._partner[names[1]] = names[0]
        elif kind is JointKind.SPHERICAL:
            mine += names[:1]
            theirs += names[:1]
        elif kind is JointKind.UNIVERSAL:
            mine += names[:2]
            theirs += [names[0], names[2]]
            self.rods.append((names[1], names[2]))
        else:
            mine += names[:3]
            theirs += names[3:]
            line, plane = (names[0], names[1]), tuple(names[:3])
            if kind is JointKind.PLANAR:
                self.on_plane += [PointConstraint(vertex, plane) for vertex in names[3:]]
            else:
                self.on_line += [PointConstraint(vertex, line) for vertex in names[3:5]]
            if kind is JointKind.PRISMATIC:
                self.on_plane.append(PointConstraint(names[5], plane))

    def complete(self, slim: set[LinkId]) -> None:
        """Join the vertices of each link by 3 V - 6 rods, those of a revolute among them; of slim ones by one."""
        known = {frozenset(rod) for rod in self.rods}
        for link, body in self.bodies.items():
            if link not in slim:
                body.extend(f"{link}'{number}" for number in range(_BODY - len(body)))
            for rod in self._braced(body):
                if frozenset(rod) not in known:
                    known.add(frozenset(rod))
                    self.rods.append(rod)

    def _braced(self, body: list[str]) -> Iterator[tuple[str, str]]:
        """Yield the rods of a body: each vertex after the third has one to its partner, or else to the third."""
        yield from combinations(body[:_BODY], 2)
        for vertex in body[_BODY:]:
            third = self._partner.get(vertex, body[2])
            others = [corner for corner in body[:_BODY] if corner != third][:2]
            yield from ((vertex, corner) for corner in (third, *others))
