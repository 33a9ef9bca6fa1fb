"""The SC graph: links, joints, and independent loops with their spherical centres, and how these are arranged.

Centres are the vertices of a graph, joints that pass two of them its edges: Bowen's classes of origami mechanisms
are shapes of that graph. A mark of special geometry says that some realisations move which counts say are rigid.
Sources: Wiener 2016, section 3.3 (the SC connectivity graph) and 6.1.4; Bowen and others 2013, and Wiener's Tables
4 and 5, which show the classes by examples: the rules are those of docs/theory/vertex-edge-graphs.md. Theory:
docs/theory/sc-graphs.md, docs/theory/realisation.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, pairwise
from types import MappingProxyType
from typing import Any, Literal, NoReturn

import networkx as nx
from networkx.classes.reportviews import OutEdgeView

from graphs.errors import InvariantError, numbered, shown
from graphs.loops.classes import CentreClass, centre_classes
from graphs.loops.loop import Centre, Loop, cyclic_order, dependent_loop
from graphs.mechanism.attributes import (
    JOINT,
    LINK,
    MECHANISM,
    BuiltWhole,
    LoopPlace,
    MechanismParts,
    edges_of,
    parts_of,
    undirected,
)
from graphs.types import JointId, LinkId


@dataclass(frozen=True, slots=True)
class SpecialGeometry:
    """Degrees of freedom of realisations whose dimensions obey conditions that the type does not state.

    It is a remark on the type, which stays the same: ids, mobility and tests of equality do not depend on it.

    Parameters
    ----------
    freedoms : int
        Degrees of freedom of the finite motion of a realisation that obeys the conditions, 1 or more.
    conditions : sequence of str
        What is special, such as ``flat-foldable`` or ``two triples of parallel axes (Sarrus)``; one or more.

    Examples
    --------
    >>> str(SpecialGeometry(1, ["line symmetry"]))
    '1 freedom by special geometry: line symmetry'
    """

    freedoms: int
    conditions: tuple[str, ...]

    def __init__(self, freedoms: int, conditions: Sequence[str]) -> None:
        if freedoms < 1:
            raise InvariantError("special", f"special geometry with {freedoms} freedoms", "1 or more")
        texts = tuple(conditions)
        if not texts or not all(isinstance(text, str) and text for text in texts):
            raise InvariantError("special", f"the conditions are {shown(list(texts))}", "one text or more")
        object.__setattr__(self, "freedoms", freedoms)
        object.__setattr__(self, "conditions", texts)

    def __str__(self) -> str:
        return f"{numbered(self.freedoms, 'freedom')} by special geometry: {', '.join(self.conditions)}"


CENTRES_ASSUMED = (
    "a link-joint graph without centres: each face of a drawing is assumed to have a finite one, which decides M"
)
"""The note on a link-joint graph that was read without centres."""


class SCGraph(BuiltWhole, nx.MultiGraph):
    """A type of mechanism: a link-joint graph with independent loops, each with its centre.

    Nodes are links (panels), edges are revolute joints (creases), edge keys are joint ids. All that it is stands in
    attributes of its nodes and edges (:mod:`graphs.mechanism.attributes`), so whatever networkx makes of it still
    has it: a plain ``nx.MultiGraph``, which every function that takes a mechanism reads back, as ``SCGraph(graph)``
    does. The graph is frozen once built: to change it, change a copy, and build a graph of that.

    Parameters
    ----------
    links : int, iterable of link ids, or networkx.Graph
        Names of the links, or how many there are (then they are 0, 1, 2, ...). A graph of networkx with the
        attributes of a mechanism is that mechanism; one without them has the joints only, and needs loops.
    joints : mapping of joint id to (link, link), or iterable of (link, link) or (link, link, key), optional
        The joints; ids of bare pairs are 0, 1, 2, ..., and so are those of triples unless the keys are distinct.
        Two links may share several joints.
    loops : iterable of Loop or sequence of link ids, optional
        Independent loops. A loop's joints may come in any order; they are stored in cyclic order. A sequence of
        links is the loop through them, with a finite centre. Independent cycles that are left out are spatial.
    closing : iterable of Loop, optional
        Loops that *depend* on the others and yet carry a centre: the last face of a closed surface, or the outer
        one of concentric loops (Wiener 3.3.6).
    ground : link id, optional
        The fixed link; without it the graph is a kinematic chain.
    special : SpecialGeometry, optional
        A mark that realisations of special dimensions move. The type is the same with and without it.
    centres_assumed : bool, optional
        Whether the input had no centres, and each face of an embedding was taken for a loop with one.

    Raises
    ------
    InvariantError
        Naming what breaks which invariant: link names distinct as text, joints between two different known links,
        each loop one cycle, loops independent over GF(2), closing loops dependent on them and independent of each
        other, finite and infinite centres never forced to be one; of a graph of networkx also a loop that has lost
        a joint, and cycles of a graph without loops.

    Examples
    --------
    >>> pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    >>> watt = SCGraph(6, pairs, loops=[Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))])
    >>> len(watt.centre_classes()), watt.independent_loops
    (2, 2)
    >>> renamed = nx.relabel_nodes(watt, {0: "frame"})
    >>> SCGraph(renamed).is_identical(watt.relabel({0: "frame"}))
    True
    """

    loops: tuple[Loop, ...]
    closing: tuple[Loop, ...]
    ground: LinkId | None
    special: SpecialGeometry | None

    def __init__(
        self,
        links: int | Iterable[LinkId] | nx.Graph,
        joints: Mapping[Any, tuple[LinkId, LinkId]] | Iterable[tuple[LinkId, ...]] = (),
        loops: Iterable[Loop | Sequence[LinkId]] | None = None,
        *,
        closing: Iterable[Loop] | None = None,
        ground: LinkId | None = None,
        special: SpecialGeometry | None = None,
        centres_assumed: bool = False,
    ) -> None:
        """Build the graph from links, joints and loops, or from a graph of networkx; parameters: see the class."""
        super().__init__()
        source = undirected(links) if isinstance(links, nx.Graph) else None
        if source is not None:
            parts = _read(source, joints, loops, closing)
            links, joints, loops, closing = parts.links, parts.joints, parts.loops, parts.closing
            ground = parts.ground if ground is None else ground
            special = _mark(parts) if special is None else special
            centres_assumed = parts.centres_assumed or centres_assumed
        self._joints: dict[JointId, tuple[LinkId, LinkId]] = {}
        self._add_links(range(links) if isinstance(links, int) else links)
        self._add_joints(joints)
        self.loops = self._ordered(loops or (), "loops")
        self.closing = self._ordered(closing or (), "closing")
        self._check_loops()
        if ground is not None and ground not in self:
            raise InvariantError(
                "ground is a link", f"ground {shown(ground)} is no link", "one of the links", ("ground", ground)
            )
        self.ground, self.special = ground, special
        self._write_attributes(centres_assumed=centres_assumed)
        if source is not None:
            self._keep_attributes(source)
        nx.freeze(self)

    # ---- construction -------------------------------------------------------------------------------

    def _add_links(self, links: Iterable[LinkId]) -> None:
        texts: dict[str, LinkId] = {}
        for link in links:
            if link is None or str(link) in texts:
                raise InvariantError(
                    "distinct links",
                    f"link {shown(link)} occurs twice, or has no name",
                    "distinct names",
                    ("links", link),
                )
            texts[str(link)] = link
        nodes, adjacency = self._node, self._adj  # filled as networkx would
        for number, link in enumerate(texts.values()):
            nodes[link] = {"number": number}
            adjacency[link] = {}

    def _add_joints(self, joints: Mapping[Any, tuple[LinkId, LinkId]] | Iterable[tuple[Any, ...]]) -> None:
        # networkx's views of edges are mappings too, to the attributes
        if isinstance(joints, Mapping) and not isinstance(joints, OutEdgeView):
            pairs: Iterable[tuple[JointId, tuple[LinkId, LinkId]]] = joints.items()
        else:
            pairs = _with_ids(tuple(joints))
        texts: set[str] = set()
        nodes, adjacency = self._node, self._adj  # one dict of keys for both directions
        for joint, (a, b) in pairs:
            if a not in adjacency or b not in adjacency or a == b or joint is None or str(joint) in texts:
                self._refuse_joint(joint, a, b)
            ends = nodes[a]["number"], nodes[b]["number"]
            data = {"joint": joint, "number": len(texts), "ends": ends, "loops": ()}
            texts.add(str(joint))
            self._joints[joint] = (a, b)
            keys = adjacency[a].get(b)
            if keys is None:
                adjacency[a][b] = adjacency[b][a] = {joint: data}
            else:
                keys[joint] = data

    def _refuse_joint(self, joint: JointId, a: LinkId, b: LinkId) -> NoReturn:
        part = ("joints", joint)
        for link in (a, b):
            if link not in self:
                counted = len(self) > 0 and list(self) == list(range(len(self))) and link == len(self)
                expected = f"a link; links count from 0 to {len(self) - 1}" if counted else "a link"
                raise InvariantError(
                    "joint ends are links", f"joint {shown(joint)} ends at {shown(link)}", expected, part
                )
        if a == b:
            raise InvariantError(
                "no self-joint", f"joint {shown(joint)} joins link {shown(a)} to itself", "two links", part
            )
        raise InvariantError(
            "distinct joints", f"joint {shown(joint)} occurs twice, or has no id", "distinct ids", part
        )

    def _loop_through(self, links: Sequence[LinkId]) -> Loop:
        """Return the loop through links in their order, each joined to the next by one joint."""
        around = []
        for a, b in zip(links, [*links[1:], *links[:1]], strict=True):
            between = list(self._adj[a].get(b, ())) if a in self else []
            if len(between) != 1:
                joints = f"links {shown(a)} and {shown(b)} share {numbered(len(between), 'joint')}"
                raise InvariantError("loop is a cycle", f"loop through links {shown(list(links))}: {joints}", "one")
            around += between
        return Loop(tuple(around))

    def _ordered(self, loops: Iterable[Loop | Sequence[LinkId]], part: str) -> tuple[Loop, ...]:
        ordered = []
        for index, stated in enumerate(loops):
            loop = stated if isinstance(stated, Loop) else self._loop_through(tuple(stated))
            try:
                order = cyclic_order(loop, self._joints)
            except InvariantError as error:
                error.part = (part, index)
                raise
            ordered.append(loop if order == loop.joints else replace(loop, joints=order))
        return tuple(ordered)

    def _check_loops(self) -> None:
        if (culprit := dependent_loop([x.joints for x in self.loops])) is not None:
            raise InvariantError(
                "independent loops",
                f"{self.loops[culprit].label} is the sum of others",
                "independent loops",
                ("loops", culprit),
            )
        for index, loop in enumerate(self.closing):
            self._check_closing(loop, ("closing", index))
        if self.closing and (culprit := dependent_loop([x.joints for x in self.closing])) is not None:
            raise InvariantError(
                "closing loop",
                f"{self.closing[culprit].label} is a sum of other closing loops",
                "independent closing loops",
                ("closing", culprit),
            )
        self.centre_classes()

    def _check_closing(self, loop: Loop, part: tuple[str, int]) -> None:
        rule = "closing loop"
        if not loop.has_centre:
            raise InvariantError(rule, f"{loop.label} has no centre", "one: it closes nothing else", part)
        if any(set(loop.joints) == set(other.joints) for other in self.loops):
            raise InvariantError(rule, f"{loop.label} is among the loops already", "a sum of several", part)
        if dependent_loop([x.joints for x in (*self.loops, loop)]) is None:
            raise InvariantError(rule, f"{loop.label} does not depend on the loops", "a sum of them", part)

    def _write_attributes(self, *, centres_assumed: bool) -> None:
        """Write what the mechanism is where networkx keeps it; see :mod:`graphs.mechanism.attributes`."""
        if self.ground is not None:
            self._node[self.ground]["ground"] = True
        adjacency, joints = self._adj, self._joints
        for index, loop in enumerate((*self.loops, *self.closing)):
            rest = (len(loop.joints), loop.centre.value, loop.name, loop.at, index >= len(self.loops))
            for place, joint in enumerate(loop.joints):
                a, b = joints[joint]
                data = adjacency[a][b][joint]
                data["loops"] = (*data["loops"], LoopPlace(index, place, *rest))
        if centres_assumed:
            self.graph["centres_assumed"] = True
        if self.special is not None:
            # The size is that of the type which is marked: of a part of it the mark says nothing.
            mark = {"freedoms": self.special.freedoms, "conditions": self.special.conditions}
            self.graph["special"] = {**mark, "links": len(self), "joints": len(self._joints)}

    def _keep_attributes(self, source: nx.Graph) -> None:
        """Keep the attributes of the graph that this one was built of, but for those of the mechanism."""
        self.graph |= {key: value for key, value in source.graph.items() if key not in MECHANISM}
        for link, data in source.nodes(data=True):
            self._node[link] |= {key: value for key, value in data.items() if key not in LINK}
        for edge in edges_of(source):
            a, b = edge.ends
            own = self._adj[a][b][edge.joint]
            own |= {key: value for key, value in edge.data.items() if key not in JOINT}

    # ---- what it is ---------------------------------------------------------------------------------

    @property
    def centres_assumed(self) -> bool:
        """Whether the input had no centres, and each face of an embedding was taken for a loop with one."""
        return bool(self.graph.get("centres_assumed", False))

    @property
    def notes(self) -> tuple[str, ...]:
        """What an answer about it has to say: whether its centres are assumed."""
        return (CENTRES_ASSUMED,) * self.centres_assumed

    @property
    def joints(self) -> Mapping[JointId, tuple[LinkId, LinkId]]:
        """Joint id to its two links, in their order (read-only)."""
        return MappingProxyType(self._joints)

    @cached_property
    def components(self) -> int:
        """Number of connected components c."""
        return int(nx.number_connected_components(self))

    @property
    def independent_loops(self) -> int:
        """Number of independent loops, L = J - N + c."""
        return len(self._joints) - len(self) + self.components

    @cached_property
    def centred_loops(self) -> tuple[Loop, ...]:
        """The independent loops that have a centre (closing loops not counted)."""
        return tuple(loop for loop in self.loops if loop.has_centre)

    @property
    def spatial_loops(self) -> int:
        """Number of independent loops without a centre, listed in `loops` or not."""
        return self.independent_loops - len(self.centred_loops)

    @property
    def is_closed(self) -> bool:
        """Whether some loop depends on others and yet carries a centre (closed surface, concentric loops)."""
        return bool(self.closing)

    @cached_property
    def _classes(self) -> tuple[CentreClass, ...]:
        return centre_classes((*self.loops, *self.closing))

    def centre_classes(self) -> tuple[CentreClass, ...]:
        """Return the classes of loops that share a centre; see :func:`graphs.loops.classes.centre_classes`.

        Loop indices count the independent loops first, then the closing ones.
        """
        return self._classes

    def parallel_joints(self) -> tuple[tuple[JointId, ...], ...]:
        """Return the groups of joints that join one pair of links; each is rigid unless collinear."""
        if sum(map(len, self._adj.values())) == 2 * len(self._joints):
            return ()
        groups: dict[frozenset[LinkId], list[JointId]] = {}
        for joint, ends in self._joints.items():
            groups.setdefault(frozenset(ends), []).append(joint)
        return tuple(tuple(group) for group in groups.values() if len(group) > 1)

    # ---- new graphs from this one -------------------------------------------------------------------

    def with_loops(self, loops: Iterable[Loop], closing: Iterable[Loop] = ()) -> SCGraph:
        """Return the SC graph with the same links and joints and other loops."""
        return SCGraph(self.nodes, self._joints, loops, closing=closing, ground=self.ground)

    def relabel(
        self, links: Mapping[Any, LinkId] | None = None, joints: Mapping[Any, JointId] | None = None
    ) -> SCGraph:
        """Return the same mechanism under other names; what a mapping leaves out keeps its name."""
        of_link, of_joint = dict(links or {}), dict(joints or {})
        new_joints = {of_joint.get(j, j): (of_link.get(a, a), of_link.get(b, b)) for j, (a, b) in self._joints.items()}
        return SCGraph(
            [of_link.get(n, n) for n in self.nodes],
            new_joints,
            _renamed(self.loops, of_joint),
            closing=_renamed(self.closing, of_joint),
            ground=None if self.ground is None else of_link.get(self.ground, self.ground),
            special=self.special,
            centres_assumed=self.centres_assumed,
        )

    def marked(self, special: SpecialGeometry | None) -> SCGraph:
        """Return the same mechanism with a mark of special geometry, or without one."""
        return SCGraph(
            self.nodes,
            self._joints,
            self.loops,
            closing=self.closing,
            ground=self.ground,
            special=special,
            centres_assumed=self.centres_assumed,
        )

    def is_identical(self, other: object) -> bool:
        """Return whether two objects are the same graph, ids and all (this is not isomorphism).

        The order of links and joints, and the start and direction of a loop, do not matter.
        """
        return type(self) is type(other) and self._identity() == other._identity()

    def _identity(self) -> tuple[Any, ...]:
        return (
            set(self.nodes),
            {joint: frozenset(ends) for joint, ends in self._joints.items()},
            _loop_identity(self.loops),
            _loop_identity(self.closing),
            self.ground,
        )

    def __repr__(self) -> str:
        """Return the class and the numbers of links, joints and centres."""
        return f"<{type(self).__name__}: {', '.join(self._features())}>"

    def _features(self) -> list[str]:
        """Return what a short description names."""
        special = () if self.special is None else (str(self.special),)
        return [
            numbered(len(self), "link"),
            numbered(len(self._joints), "joint"),
            numbered(len(self.centre_classes()), "centre"),
            *special,
        ]

    def __str__(self) -> str:
        """Return the short description that is printed."""
        return (
            f"{type(self).__name__} with {len(self)} links, {len(self._joints)} joints, "
            f"{len(self.centred_loops)} centred and {self.spatial_loops} spatial loops"
            f"{'' if self.special is None else f', {self.special}'}"
        )


def _with_ids(pairs: Sequence[tuple[Any, ...]]) -> Iterable[tuple[JointId, tuple[LinkId, LinkId]]]:
    """Return ids and links of joints: the keys of triples where they are distinct, else 0, 1, 2, ..."""
    sizes = {len(pair) if isinstance(pair, tuple | list) else 0 for pair in pairs}
    if sizes <= {2}:
        return enumerate(pairs)
    if not sizes <= {2, 3}:
        odd = next(pair for pair in pairs if not isinstance(pair, tuple | list) or len(pair) not in (2, 3))
        raise InvariantError("joint ends are links", f"a joint is {shown(odd)}", "(link, link), or with a key")
    keys = {str(pair[2]) for pair in pairs if len(pair) == 3 and pair[2] is not None}
    ids = [pair[2] for pair in pairs] if len(keys) == len(pairs) else range(len(pairs))
    return zip(ids, ((pair[0], pair[1]) for pair in pairs), strict=True)


def _read(
    graph: nx.Graph, joints: Any, loops: Iterable[Loop | Sequence[LinkId]] | None, closing: Iterable[Loop] | None
) -> MechanismParts:
    """Read the parts of a mechanism off a graph of networkx; loops that are stated take precedence."""
    if tuple(joints):
        raise InvariantError("joints", "joints beside a graph that has its own", "a graph alone, or links and joints")
    parts = parts_of(graph, loops=loops is None)
    if loops is not None:
        parts.loops, parts.closing = list(loops), list(closing or ())  # type: ignore[arg-type]
        if not parts.has_ids and any(isinstance(loop, Loop) for loop in parts.loops):
            raise InvariantError(
                "loops",
                "the edges of the graph have no ids by which a Loop could name them",
                "loops by their links, such as (0, 1, 2, 3), or a MultiGraph with distinct keys",
            )
    elif parts.loops is None:
        forest = nx.Graph()
        forest.add_nodes_from(parts.links)
        forest.add_edges_from(parts.joints.values())
        cycles = len(parts.joints) - len(parts.links) + nx.number_connected_components(forest)
        if cycles:
            what = f"the graph has {numbered(cycles, 'independent cycle')} and no loops"
            raise InvariantError("loops", what, "loops=[...], [] if all are spatial; synth.read(graph) assumes centres")
    return parts


def _mark(parts: MechanismParts) -> SpecialGeometry | None:
    """Return the mark of special geometry that a graph carries."""
    mark = parts.special
    return None if mark is None else SpecialGeometry(mark["freedoms"], mark["conditions"])


def _renamed(loops: Sequence[Loop], of_joint: Mapping[JointId, JointId]) -> list[Loop]:
    return [Loop(tuple(of_joint.get(j, j) for j in x.joints), x.centre, x.name, x.at) for x in loops]


def _loop_identity(loops: Sequence[Loop]) -> set[tuple[frozenset[Hashable], Centre, str | None, str | None]]:
    return {(frozenset(x.joints), x.centre, x.name, x.at) for x in loops}


Arrangement = Literal[
    "none", "single", "separate", "coupled", "linear", "tree", "loop", "periodic", "doubly periodic", "network"
]

ARRANGEMENTS: dict[Arrangement, str] = {
    "none": "no loop has a centre",
    "single": "one centre",
    "separate": "centres that no joints connect",
    "coupled": "two centres on one joint",
    "linear": "three centres or more in a row",
    "tree": "centres in rows that part, none closed",
    "loop": "rows of centres that close once",
    "periodic": "a part repeated three times or more, each joined to the next: in one direction",
    "doubly periodic": "the same in two directions: a mesh of three by three centres or more",
    "network": "centres in several closed rows that do not repeat so",
}
"""What each class is, in words."""

# Parts that make a row: of two joined to each other any two squares side by side would be doubly periodic.
_REPEATED = 3


def arrangement_of(sc: SCGraph) -> Arrangement:
    """Return the class of the arrangement of a mechanism's centres, a key of `ARRANGEMENTS`."""
    graph = centre_graph(sc)
    if len(graph) < 2:
        return "single" if len(graph) else "none"
    if not nx.is_connected(graph):
        return "separate"
    cycles = graph.number_of_edges() - len(graph) + 1
    if not cycles:
        if len(graph) == 2:
            return "coupled"
        return "linear" if max(degree for _, degree in graph.degree) == 2 else "tree"
    if cycles == 1:
        return "loop"
    directions = _directions([set(graph[vertex]) for vertex in range(len(graph))])
    return "doubly periodic" if directions > 1 else "periodic" if directions else "network"


def centre_graph(sc: SCGraph) -> nx.Graph:
    """Return the graph of centres: an edge between two that a joint passes."""
    graph = nx.Graph()
    passing: dict[object, list[int]] = {}
    for number, one in enumerate(sc.centre_classes()):
        graph.add_node(number)
        for joint in one.joints:
            passing.setdefault(joint, []).append(number)
    graph.add_edges_from(pair for centres in passing.values() for pair in pairwise(centres))
    return graph


def _directions(near: Sequence[set[int]]) -> int:
    """Return in how many directions a graph is a part repeated: a Cartesian product with a path, or with two.

    Factors of a product are classes of edges: opposite ones in a square are in one class, and so are two at a
    vertex that are in no square together (Feder 1992). A class is a direction of repetition if without its edges
    the graph falls into three parts or more that are a row, each joined to the next vertex by vertex. The graph is
    given by the neighbours of each vertex.
    """
    edges = [(a, b) for a, neighbours in enumerate(near) for b in neighbours if a < b]
    number = {pair: place for place, (a, b) in enumerate(edges) for pair in ((a, b), (b, a))}
    together: list[tuple[int, int]] = []
    for vertex, neighbours in enumerate(near):
        for one, other in combinations(neighbours, 2):
            first, second = number[vertex, one], number[vertex, other]
            squares = near[one] & near[other]
            if other in near[one] or len(squares) == 1:
                together.append((first, second))
            else:
                for across in squares - neighbours:
                    if across != vertex:
                        together += [(first, number[other, across]), (second, number[one, across])]
    class_of = _merged(len(edges), together)
    enough = (_REPEATED - 1) * len(near) / _REPEATED  # edges between as many parts
    large = [one for one, size in Counter(class_of).items() if size >= enough]
    return sum(_is_direction(len(near), edges, class_of, one) for one in large)


def _merged(count: int, pairs: Iterable[tuple[int, int]]) -> list[int]:
    """Return for each number below a count the least of those that pairs join it to."""
    least = list(range(count))
    for first, second in pairs:
        one, other = first, second
        while least[one] != one:
            least[one] = one = least[least[one]]
        while least[other] != other:
            least[other] = other = least[least[other]]
        least[max(one, other)] = min(one, other)
    for one in range(count):
        least[one] = least[least[one]]
    return least


def _is_direction(vertices: int, edges: Sequence[tuple[int, int]], class_of: Sequence[int], one: int) -> bool:
    """Return whether a graph is a row of parts, each joined to the next by the edges of one class, vertex by vertex.

    A part repeated all round is no row: it has no ends.
    """
    inside = [edge for edge, which in zip(edges, class_of, strict=True) if which != one]
    part_of = _merged(vertices, inside)
    sizes = Counter(part_of)
    if len(sizes) < _REPEATED or len(set(sizes.values())) > 1:
        return False
    joined: dict[tuple[int, int], dict[int, int]] = {}
    for (a, b), which in zip(edges, class_of, strict=True):
        if which == one:
            first, last = sorted((a, b), key=part_of.__getitem__)
            if part_of[first] == part_of[last]:
                return False
            joined.setdefault((part_of[first], part_of[last]), {})[first] = last
    row = nx.Graph(list(joined))
    if len(joined) != len(sizes) - 1 or not nx.is_connected(row) or max(degree for _, degree in row.degree) > 2:
        return False
    within: dict[int, set[tuple[int, int]]] = {part: set() for part in sizes}
    for a, b in inside:
        within[part_of[a]] |= {(a, b), (b, a)}
    return all(
        len(to) == len(set(to.values())) == sizes[first] and {(to[a], to[b]) for a, b in within[first]} == within[last]
        for (first, last), to in joined.items()
    )
