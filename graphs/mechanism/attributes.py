"""Mechanisms as attributes of networkx graphs, so that they survive whatever networkx makes of the graph.

networkx copies the attributes of nodes and edges into every graph that it derives from another, and knows nothing of
loops and centres. So an SC or SCD graph keeps all that it is there, and nothing in it names a node: a loop is written
at each of its joints (`LoopPlace`), and links are referred to by numbers that their nodes carry. Renamed nodes, and
two mechanisms in one graph, are read back right; a loop that lost a joint shows it, since each place says of how many.

==========  =========================================================================================
attribute   what it is
==========  =========================================================================================
of a node   ``number``, the place of the link in the list of links; ``ground``, True at the fixed link;
            in SCD graphs ``sides``, the rotation of the link, and ``outer`` at one link: the joint which
            has the outer face on its left as it is left from this link
of an edge  ``joint``, the id of the joint, also its key; ``number``, its place among the joints; ``ends``,
            the numbers of its first and its second link; ``loops``, its places in loops
of a graph  ``special``, a mark of special geometry; ``centres_assumed``, True where that is so
==========  =========================================================================================

Theory: docs/theory/sc-graphs.md, which shows the layout by an example.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from math import inf
from typing import Any, NamedTuple, Self, TypeVar

import networkx as nx

from graphs.errors import InvariantError, numbered, shown
from graphs.loops.loop import Loop
from graphs.types import JointId, Joints, LinkId

__all__ = ["JOINT", "LINK", "MECHANISM", "BuiltWhole", "JointEdge", "LoopPlace", "MechanismParts"]
__all__ += ["carries_loops", "edges_of", "parts_of", "undirected"]

LINK = frozenset({"number", "ground", "sides", "outer"})
"""Attributes of nodes that belong to the mechanism; all others are the user's."""

JOINT = frozenset({"joint", "number", "ends", "loops"})
"""Attributes of edges that belong to the mechanism."""

MECHANISM = frozenset({"special", "centres_assumed"})
"""Attributes of the graph that belong to the mechanism."""


class LoopPlace(NamedTuple):
    """The place of a joint in a loop, with all that the loop is: an item of the edge attribute ``loops``.

    Plain tuples and lists are read too, and what follows ``place`` may be left out.

    Parameters
    ----------
    loop : hashable
        Tells loops apart: 0, 1, 2, ... in a graph that is a mechanism, closing loops after the independent ones.
    place : int
        Place of the joint in the cyclic order of the loop, from 0.
    of : int, optional
        Number of joints of the loop.
    centre : {"finite", "infinite", "none"}, optional
    name, at : str, optional
        Names of the loop and of its centre, as in `Loop`.
    closing : bool, optional
        Whether the loop depends on the others and yet carries a centre.

    Examples
    --------
    >>> LoopPlace(0, 2, of=4).centre
    'finite'
    """

    loop: Hashable
    place: int
    of: int | None = None
    centre: str = "finite"
    name: str | None = None
    at: str | None = None
    closing: bool = False


class BuiltWhole(nx.Graph):
    """A graph of networkx that is checked and frozen when it is built, and never filled afterwards.

    networkx makes an empty instance of the class of a graph and fills it, so that it passes no check. It gets a plain
    graph instead, ``nx.Graph`` or ``nx.MultiGraph``: a call without arguments returns one, and so does `copy`.

    Examples
    --------
    >>> from graphs.mechanism.polyhedron import PolyhedronModel
    >>> model = PolyhedronModel(2, [(0, 1)])
    >>> type(model.copy()) is type(PolyhedronModel()) is nx.Graph
    True
    """

    def __new__(cls, *args: object, **options: object) -> Self:
        """Return an instance, or a plain graph where networkx asks for an empty one to fill."""
        return object.__new__(cls) if args or options else _plain(cls)()

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy an instance as it is; without this, both would ask for an empty one."""
        return object.__new__, (type(self),), self.__dict__

    def copy(self, as_view: bool = False) -> nx.Graph:
        """Return a plain, mutable graph with the same attributes, or with ``as_view`` a view.

        The class, called with it, gives the same object again.
        """
        return super().copy(as_view=True) if as_view else _plain(type(self))(self)


def _plain(cls: type[nx.Graph]) -> type[nx.Graph]:
    """Return the class of networkx that a class of mechanisms is made of."""
    plain: type[nx.Graph] = nx.MultiGraph if issubclass(cls, nx.MultiGraph) else nx.Graph
    return plain


@dataclass(slots=True)
class MechanismParts:
    """What the attributes of a graph say: the arguments of `SCGraph` and `SCDGraph`."""

    links: list[LinkId]
    joints: dict[JointId, tuple[LinkId, LinkId]]
    loops: list[Loop] | None = None
    """None where no edge says to which loops it belongs."""
    has_ids: bool = True
    """Whether the ids of joints are those of the graph; else edges are numbered as networkx lists them."""
    closing: list[Loop] = field(default_factory=list)
    ground: LinkId | None = None
    special: Mapping[str, Any] | None = None
    centres_assumed: bool = False
    rotation: dict[LinkId, tuple[JointId | None, ...]] | None = None
    outer: tuple[JointId, str] | None = None


def carries_loops(graph: nx.Graph) -> bool:
    """Return whether an edge of a graph says to which loops it belongs, so that the graph describes a mechanism.

    Examples
    --------
    >>> carries_loops(nx.cycle_graph(4))
    False
    """
    return any("loops" in data for *_, data in graph.edges(data=True))


def undirected(graph: nx.Graph) -> nx.Graph:
    """Return an undirected graph itself, and a directed one without directions: both of a joint are one edge."""
    return graph.to_undirected() if graph.is_directed() else graph


def parts_of(graph: nx.Graph, *, loops: bool = True) -> MechanismParts:
    """Read a mechanism off the attributes of a graph.

    Parameters
    ----------
    graph : networkx.Graph
        Of any class, directed ones as their undirected ones; InvariantError if its attributes are no mechanism: a
        loop that lost a joint, joints with and without loops, two ground links.
    loops : bool, optional
        Read the loops too; not where others are stated.

    Examples
    --------
    >>> graph = nx.MultiGraph([(0, 1, {"loops": [("A", 0)]}), (0, 1, {"loops": [("A", 1)]})])
    >>> parts_of(graph).loops
    [Loop(joints=(0, 1), centre=<Centre.FINITE: 'finite'>, name=None, at=None)]
    """
    graph = undirected(graph)
    edges = edges_of(graph)
    links = [link for link, _ in _in_order(graph.nodes(data=True))]
    parts = MechanismParts(links, {edge.joint: edge.ends for edge in edges})
    parts.has_ids = has_ids(graph)
    if loops and any("loops" in edge.data for edge in edges):
        for edge in edges:
            if "loops" not in edge.data:
                raise InvariantError(
                    "loops of joints",
                    f"joint {shown(edge.joint)} has no attribute 'loops', and others have one",
                    "one at every joint, () where it is in no loop",
                    ("joints", edge.joint),
                )
        parts.loops, parts.closing = _loops_of(edges, parts.joints)
    grounds = [link for link, ground in graph.nodes(data="ground") if ground]
    parts.ground = _only(grounds, "ground is a link", "the ground link")
    parts.centres_assumed = bool(graph.graph.get("centres_assumed", False))
    parts.special = _special(graph)
    if any("sides" in data for _, data in graph.nodes(data=True)):
        _add_sides(parts, graph, edges)
    return parts


class JointEdge(NamedTuple):
    """An edge as a joint; ``called`` is how the sides of its links name it, which in two copies is twice the same."""

    joint: JointId
    ends: tuple[LinkId, LinkId]
    called: JointId
    data: Mapping[str, Any]


def edges_of(graph: nx.Graph) -> list[JointEdge]:
    """Return the joints with their attributes, in the order of their numbers where these tell them apart."""
    if graph.is_multigraph():
        rows = [((a, b), data.get("joint", key), data) for a, b, key, data in graph.edges(keys=True, data=True)]
    else:
        rows = [((a, b), data.get("joint"), data) for a, b, data in graph.edges(data=True)]
    rows = _in_order(rows)
    number = dict(graph.nodes(data="number"))
    edges = []
    for joint, ((a, b), called, data) in zip(_ids(rows), rows, strict=True):
        turned = tuple(data.get("ends", ())) == (number[b], number[a]) != (number[a], number[b])
        edges.append(JointEdge(joint, (b, a) if turned else (a, b), called, data))
    return edges


def _ids(rows: Sequence[tuple[tuple[LinkId, LinkId], JointId, Mapping[str, Any]]]) -> list[JointId]:
    """Return an id for each edge: its attribute ``joint``, else its key where the keys of such edges are distinct.

    An id that an earlier edge has, as in the second of two mechanisms in one graph, and that of an edge without one
    becomes the least number that is not used.
    """
    keys = [str(called) for _, called, data in rows if "joint" not in data and called is not None]
    keyed = len(keys) == len(set(keys)) == sum("joint" not in data for *_, data in rows)
    taken = {str(data["joint"]) for *_, data in rows if "joint" in data}
    ids: list[JointId] = []
    left: list[int] = []
    seen: set[str] = set()
    for _, called, data in rows:
        known = "joint" in data or (keyed and str(called) not in taken)
        if not known or str(called) in seen:
            left.append(len(ids))
            ids.append(None)
            continue
        seen.add(str(called))
        ids.append(called)
    free = (number for number in count() if str(number) not in seen)
    for place, number in zip(left, free, strict=False):
        ids[place] = number
    return ids


def has_ids(graph: nx.Graph) -> bool:
    """Return whether some edge has the id of a joint, or the keys of all edges tell them apart."""
    if any("joint" in data for *_, data in graph.edges(data=True)):
        return True
    if not graph.is_multigraph():
        return False
    return len({str(key) for *_, key in graph.edges(keys=True)}) == len(graph.edges)


_Row = TypeVar("_Row", bound=tuple[Any, ...])


def _in_order(rows: Iterable[_Row]) -> list[_Row]:
    """Put nodes or edges in the order of their numbers, where these tell them apart; those without one come last.

    The attributes are the last item of a row.
    """
    listed = list(rows)
    numbers = [row[-1]["number"] for row in listed if isinstance(row[-1].get("number"), int)]
    if len(set(numbers)) == len(numbers):
        listed.sort(key=lambda row: row[-1]["number"] if isinstance(row[-1].get("number"), int) else inf)
    return listed


def _loops_of(edges: Sequence[JointEdge], joints: Joints) -> tuple[list[Loop], list[Loop]]:
    """Put the loops together; return the independent ones and the closing ones."""
    found: dict[LoopPlace, list[tuple[int, JointId]]] = {}
    for edge in edges:
        for entry in _entries(edge.data["loops"], edge.joint):
            found.setdefault(entry._replace(place=0), []).append((entry.place, edge.joint))
    labels = [whole.loop for whole in found]
    if all(isinstance(label, int) for label in labels):
        found = dict(sorted(found.items(), key=lambda item: item[0].loop))  # type: ignore[arg-type, return-value]
    loops: list[Loop] = []
    closing: list[Loop] = []
    for whole, placed in found.items():
        copies = _copies(whole, placed, joints)
        for copy, around in enumerate(copies):
            # Two copies of a mechanism in one graph have centres of their own, whatever these are called.
            at = whole.at if whole.at is None or not copy else f"{whole.at} ({copy + 1})"
            (closing if whole.closing else loops).append(Loop(around, whole.centre, whole.name, at))  # type: ignore[arg-type]
    return loops, closing


def _entries(value: object, joint: JointId) -> list[LoopPlace]:
    """Return the places of a joint in loops, checked."""
    try:
        entries = [LoopPlace(*entry) for entry in value]  # type: ignore[attr-defined]
        hash(tuple(entries))
        if all(isinstance(entry.place, int) and isinstance(entry.of, int | None) for entry in entries):
            return entries
    except TypeError:
        pass
    what = f"joint {shown(joint)} has the attribute 'loops' {shown(value)}"
    raise InvariantError("loops of joints", what, "a list of (loop, place, ...)", ("joints", joint))


def _copies(whole: LoopPlace, placed: Sequence[tuple[int, JointId]], joints: Joints) -> list[tuple[JointId, ...]]:
    """Return the joints of a loop in order; several times where a graph holds several copies of it."""
    size = whole.of or len(placed)
    named = f"loop {shown(whole.name or whole.loop)}"
    parts = [placed]
    if len(placed) > size:
        together = nx.Graph(joints[joint] for _, joint in placed)
        parts = [
            [row for row in placed if joints[row[1]][0] in component] for component in nx.connected_components(together)
        ]
    for part in parts:
        if sorted(place for place, _ in part) != list(range(size)):
            if len(part) < size:
                what, then = f"{named} has {len(part)} of its {numbered(size, 'joint')}", "for a part of a mechanism"
            else:
                what, then = f"{named} has {len(part)} joints in {size} places", "for two mechanisms joined into one"
            raise InvariantError("loop is whole", what, f"each joint once; {then} try SCGraph(graph, loops=[...])")
    return [tuple(joint for _, joint in sorted(part, key=lambda row: row[0])) for part in parts]


def _only(links: Sequence[LinkId], rule: str, what: str) -> LinkId | None:
    """Return the one link of a list, if there is one."""
    if len(links) > 1:
        raise InvariantError(rule, f"links {shown(links[0])} and {shown(links[1])} are both {what}", "one link")
    return links[0] if links else None


def _special(graph: nx.Graph) -> Mapping[str, Any] | None:
    """Return the mark of special geometry, if it was made for a type of this size: of a part it says nothing."""
    mark = graph.graph.get("special")
    if not isinstance(mark, Mapping):
        return None
    return mark if (mark.get("links"), mark.get("joints")) == (len(graph), graph.number_of_edges()) else None


def _add_sides(parts: MechanismParts, graph: nx.Graph, edges: Sequence[JointEdge]) -> None:
    """Add the rotation of the links and the outer face."""
    joint_of: dict[LinkId, dict[JointId, JointId]] = {link: {} for link in parts.links}
    for edge in edges:
        for link in edge.ends:
            if joint_of[link].setdefault(edge.called, edge.joint) != edge.joint:
                raise InvariantError("rotation", f"link {shown(link)} has two joints {shown(edge.called)}", "one")
    parts.rotation = {}
    for link, data in graph.nodes(data=True):
        if "sides" not in data:
            raise InvariantError("rotation", f"link {shown(link)} has no attribute 'sides'", "one at every link")
        here = joint_of[link]
        parts.rotation[link] = tuple(None if side is None else here.get(side, side) for side in data["sides"])
    named = [link for link, data in graph.nodes(data=True) if data.get("outer") is not None]
    link = _only(named, "outer face", "where the outer face is named")
    if link is not None:
        joint = joint_of[link].get(graph.nodes[link]["outer"])
        if joint is None:
            raise InvariantError("outer face", f"link {shown(link)} lost the joint that names the outer face")
        parts.outer = (joint, "left" if parts.joints[joint][0] == link else "right")
