"""The SC graph: links, joints, and independent loops with their spherical centres.

Source: Wiener 2016, section 3.3 (the SC connectivity graph). Theory: docs/theory/sc-graphs.md.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, NoReturn

import networkx as nx

from graphs.errors import InvariantError, numbered, shown
from graphs.ids import JointId, LinkId
from graphs.loops.classes import CentreClass, centre_classes
from graphs.loops.cycle_space import check_independent, dependent_loop
from graphs.loops.loop import Centre, Loop, cyclic_order
from graphs.mechanism.special import SpecialGeometry

__all__ = ["SCGraph"]


class SCGraph(nx.MultiGraph):
    """A type of mechanism: a link-joint graph with independent loops, each with its centre.

    Nodes are links (panels), edges are revolute joints (creases), edge keys are joint ids. The graph is
    frozen once built: an edit makes a new graph. networkx functions for multigraphs accept it;
    :meth:`copy` gives a plain, mutable ``nx.MultiGraph``.

    Parameters
    ----------
    links : int or iterable of link ids, optional
        Names of the links, or how many there are (then they are 0, 1, 2, ...).
    joints : mapping of joint id to (link, link), or iterable of (link, link), optional
        The joints; ids are 0, 1, 2, ... where none are given. Two links may share several joints.
    loops : iterable of Loop, optional
        Independent loops. A loop's joints may come in any order; they are stored in cyclic order. Independent
        cycles that are left out are spatial.
    closing : iterable of Loop, optional
        Loops that *depend* on the others and yet carry a centre: the last face of a closed surface, or the
        outer one of concentric loops (thesis 3.3.6).
    ground : link id, optional
        The fixed link; without it the graph is a kinematic chain.
    special : SpecialGeometry, optional
        A mark that members of special dimensions move. The type is the same with and without it.

    Attributes
    ----------
    centres_assumed : bool
        Whether nobody gave the centres, and each face of an embedding was taken for a loop with one.

    Raises
    ------
    InvariantError
        Naming what breaks which invariant: link names distinct as text, joints between
        two different known links, each loop one cycle, loops independent over GF(2), closing loops dependent
        on them and independent of each other, finite and infinite centres never forced to be one.

    Examples
    --------
    Watt's six-bar chain has two centres:

    >>> watt = SCGraph(
    ...     6,
    ...     [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)],
    ...     loops=[Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))],
    ... )
    >>> len(watt.centre_classes()), watt.independent_loops
    (2, 2)
    >>> import networkx as nx
    >>> nx.is_biconnected(nx.Graph(watt))
    True
    """

    loops: tuple[Loop, ...]
    closing: tuple[Loop, ...]
    ground: LinkId | None
    special: SpecialGeometry | None
    centres_assumed: bool = False

    def __init__(
        self,
        links: int | Iterable[LinkId] | None = None,
        joints: Mapping[Any, tuple[LinkId, LinkId]] | Iterable[tuple[LinkId, LinkId]] = (),
        loops: Iterable[Loop] = (),
        *,
        closing: Iterable[Loop] = (),
        ground: LinkId | None = None,
        special: SpecialGeometry | None = None,
    ) -> None:
        super().__init__()
        self.loops, self.closing, self.ground, self.special = (), (), None, special
        self._joints: dict[JointId, tuple[LinkId, LinkId]] = {}
        if links is None:
            return  # networkx makes an empty instance of the class before it fills a view
        self._add_links(range(links) if isinstance(links, int) else links)
        self._add_joints(joints)
        self.loops = self._ordered(loops, "loops")
        self.closing = self._ordered(closing, "closing")
        self._check_loops()
        if ground is not None and ground not in self:
            raise InvariantError(
                "ground is a link",
                f"ground {shown(ground)} is no link",
                "one of the links",
                ("ground", ground),
            )
        self.ground = ground
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
        self.add_nodes_from(texts.values())

    def _add_joints(self, joints: Mapping[Any, tuple[LinkId, LinkId]] | Iterable[tuple[LinkId, LinkId]]) -> None:
        pairs = joints.items() if isinstance(joints, Mapping) else enumerate(joints)
        texts: set[str] = set()
        adjacency = self._adj  # filled as networkx would: one dict of keys for both directions
        for joint, (a, b) in pairs:
            if a not in adjacency or b not in adjacency or a == b or joint is None or str(joint) in texts:
                self._refuse_joint(joint, a, b)
            texts.add(str(joint))
            self._joints[joint] = (a, b)
            keys = adjacency[a].get(b)
            if keys is None:
                adjacency[a][b] = adjacency[b][a] = {joint: {}}
            else:
                keys[joint] = {}

    def _refuse_joint(self, joint: JointId, a: LinkId, b: LinkId) -> NoReturn:
        part = ("joints", joint)
        for link in (a, b):
            if link not in self:
                raise InvariantError(
                    "joint ends are links", f"joint {shown(joint)} ends at {shown(link)}", "a link", part
                )
        if a == b:
            raise InvariantError(
                "no self-joint", f"joint {shown(joint)} joins link {shown(a)} to itself", "two links", part
            )
        raise InvariantError(
            "distinct joints", f"joint {shown(joint)} occurs twice, or has no id", "distinct ids", part
        )

    def _ordered(self, loops: Iterable[Loop], part: str) -> tuple[Loop, ...]:
        ordered = []
        for index, loop in enumerate(loops):
            try:
                order = cyclic_order(loop, self._joints)
            except InvariantError as error:
                error.part = (part, index)
                raise
            ordered.append(loop if order == loop.joints else replace(loop, joints=order))
        return tuple(ordered)

    def _check_loops(self) -> None:
        check_independent(self.loops)
        for index, loop in enumerate(self.closing):
            self._check_closing(loop, ("closing", index))
        if (culprit := dependent_loop([x.joints for x in self.closing])) is not None:
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

    # ---- what networkx asks for ---------------------------------------------------------------------

    def copy(self, as_view: bool = False) -> nx.MultiGraph:
        """Return a plain, mutable ``nx.MultiGraph`` with the same links and joints (or a view, if asked)."""
        return super().copy(as_view=True) if as_view else nx.MultiGraph(self)

    def to_undirected_class(self) -> Any:
        """Return the class of undirected copies: a plain multigraph, since loops do not survive editing."""
        return nx.MultiGraph

    def to_directed_class(self) -> Any:
        """Return the class of directed copies."""
        return nx.MultiDiGraph

    # ---- what it is ---------------------------------------------------------------------------------

    @property
    def joints(self) -> Mapping[JointId, tuple[LinkId, LinkId]]:
        """Joint id to its two links, in the order given (read-only)."""
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
        """Number of independent loops without a centre, given or left over."""
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
        self,
        links: Mapping[Any, LinkId] | None = None,
        joints: Mapping[Any, JointId] | None = None,
    ) -> SCGraph:
        """Return the same mechanism under other names; what a mapping leaves out keeps its name."""
        of_link, of_joint = dict(links or {}), dict(joints or {})
        new_joints = {
            of_joint.get(j, j): (of_link.get(a, a), of_link.get(b, b)) for j, (a, b) in self._joints.items()
        }
        return SCGraph(
            [of_link.get(n, n) for n in self.nodes],
            new_joints,
            _renamed(self.loops, of_joint),
            closing=_renamed(self.closing, of_joint),
            ground=None if self.ground is None else of_link.get(self.ground, self.ground),
            special=self.special,
        )

    def marked(self, special: SpecialGeometry | None) -> SCGraph:
        """Return the same mechanism with a mark of special geometry, or without one."""
        return SCGraph(
            self.nodes, self._joints, self.loops, closing=self.closing, ground=self.ground, special=special
        )

    def is_identical(self, other: object) -> bool:
        """Tell whether two objects are the same graph, ids and all (this is not isomorphism).

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
        return (
            f"{type(self).__name__} with {len(self)} links, {len(self._joints)} joints, "
            f"{len(self.centred_loops)} centred and {self.spatial_loops} spatial loops"
            f"{'' if self.special is None else f', {self.special}'}"
        )


def _renamed(loops: Sequence[Loop], of_joint: Mapping[JointId, JointId]) -> list[Loop]:
    return [Loop(tuple(of_joint.get(j, j) for j in x.joints), x.centre, x.name, x.at) for x in loops]


def _loop_identity(loops: Sequence[Loop]) -> set[tuple[frozenset[Hashable], Centre, str | None, str | None]]:
    return {(frozenset(x.joints), x.centre, x.name, x.at) for x in loops}
