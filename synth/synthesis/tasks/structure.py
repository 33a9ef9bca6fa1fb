"""Which types can do a task: all of a size, those left out counted by reasons, roles placed on the others.

Types are listed by the enumerators; families that move although a generic realisation is rigid come from the
generators of `synth.catalogue.patterns`. Every requirement is checked on every type, so that a task that no type fits
can say which of its requirements exclude each other. Guide: docs/guides/from-a-task.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, permutations
from typing import Any

import networkx as nx
import numpy as np

from enumerate.chains.jobs import chain_rows
from enumerate.chains.names import name_of
from enumerate.chains.query import ChainQuery
from enumerate.runner.job import ANY_NUMBER, Limits
from enumerate.sc.jobs import sc_rows
from enumerate.sc.query import SCQuery
from enumerate.scd.jobs import scd_rows
from graphs.convert.conversions import Mechanism, to_sc, to_scd
from graphs.errors import InvariantError, SynthedraError, numbered
from graphs.identity.chains import chain_from_id, chain_id, class_code, symmetries_of_links
from graphs.identity.drawings import mechanism_from_map_id
from graphs.joints.linkage import JointedLinkage
from graphs.joints.revolutes import revolutes_of
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed, TableBlock
from graphs.rank.exact import exact_mobility, independent_cycles, relative_mobilities
from graphs.rank.singular_values import null_space, rank_of
from graphs.tolerances import DOUBLE
from graphs.types import JointId, LinkId
from synth.analysis.motion.derivatives import BodyTree, dependence_on_axes
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns.generators import GENERATORS
from synth.synthesis.tasks.record import RolePair, Task, centres_text, limits_text

Placement = tuple[LinkId, ...]
"""The link of each role, in the order of the roles."""

_SIDES = 4
"""Most sides of a link of an enumerated SCD graph, joints and open edges together."""
PLANAR = "planar chains"
"""Chains all of whose axes are parallel; `chains` are spherical."""
_LEFT_OUT_FIRST = (
    "the same as another type", "links", "form", "kinds of joints", "loops", "mobility", "system", "centres",
    "open edges", "explicit centres", "implicit centres", "symmetry",
)  # fmt: skip
_OF_PLACEMENTS = ("distance", "no joint for a wish", "relative mobility")


@dataclass(frozen=True)
class CandidateType:
    """A type that a task looks at.

    Attributes
    ----------
    source : str
        Where it comes from: ``sc``, ``chains``, ``planar chains``, ``scd``, ``generators``.
    code : str
        Its id there: of a map, of a chain, or the name of a generator.
    mechanism : SCGraph
        Links, joints, loops with their centres.
    values : mapping of str to float, optional
        Parameters of a generator.
    made : Mechanism, optional
        What the generator makes of them.

    Examples
    --------
    >>> four_bar = CandidateType.of("chains", "k1:Cr")
    >>> four_bar.system, four_bar.mobility, four_bar.name
    ('spherical', 1, 'four-bar')
    """

    source: str
    code: str
    mechanism: SCGraph
    values: Mapping[str, float] | None = None
    made: Mechanism | None = None

    @classmethod
    def of(cls, source: str, code: str, task: Task | None = None) -> CandidateType:
        """Return the type of a source by its id; parameters of generators are those of the task."""
        if source == "generators":
            stated = {} if task is None or task.generators is None else task.generators.get(code, {})
            values = GENERATORS[code].values(stated)
            made = GENERATORS[code].make(**values)
            chain = revolutes_of(made).chain if isinstance(made, JointedLinkage) else to_sc(made)
            return cls(source, code, chain, values, made)
        if source in ("chains", PLANAR):
            graph = chain_from_id(code)
            bare = SCGraph(graph.nodes, list(graph.edges()))
            centre = Centre.FINITE if source == "chains" else Centre.INFINITE
            loops = [Loop(loop.joints, centre, at="all") for loop in independent_cycles(bare)]
            return cls(source, code, SCGraph(bare.nodes, bare.joints, loops))
        return cls(source, code, mechanism_from_map_id(code))

    @property
    def name(self) -> str:
        """The name by which the field knows it, else its id."""
        if self.source == "generators":
            return self.code
        return name_of(chain_id(self.mechanism)) or self.code

    @cached_property
    def mobility(self) -> int:
        """Exact generic mobility; of a generator the degrees of freedom that its source states."""
        if self.values is not None:
            return GENERATORS[self.code].freedoms(self.values)
        return exact_mobility(self.mechanism).mobility

    @property
    def bodies(self) -> tuple[LinkId, ...]:
        """Links that can have roles: not those between the revolutes that stand for one joint."""
        own = self.made.chain.nodes if isinstance(self.made, JointedLinkage) else self.mechanism.nodes
        return tuple(own)

    @property
    def joint_kinds(self) -> frozenset[str]:
        """Kinds of joints, by their letters."""
        if isinstance(self.made, JointedLinkage):
            return frozenset(kind.value for kind in self.made.kinds.values())
        return frozenset("R")

    @cached_property
    def system(self) -> str:
        """Kind of system: one centre, one at infinity, several, or a loop without any."""
        classes = self.mechanism.centre_classes()
        if self.mechanism.spatial_loops or not classes:
            return "spatial"
        if len(classes) > 1:
            return "hybrid"
        return "spherical" if classes[0].centre is Centre.FINITE else "planar"

    @cached_property
    def drawn(self) -> SCDGraph | None:
        """The SCD graph of the links, if the order of their sides is known: of sheets."""
        if isinstance(self.mechanism, SCDGraph):
            return self.mechanism
        try:
            return to_scd(self.made) if isinstance(self.made, Sheet) else None
        except SynthedraError:
            return None

    @cached_property
    def symmetry(self) -> int:
        """Number of automorphisms."""
        placed = len(self.mechanism)
        generators = symmetries_of_links(self.mechanism)
        links = list(self.mechanism.nodes)
        start = tuple(links)
        reached, front = {start}, [start]
        while front and len(reached) <= _MOST_SYMMETRIES:
            here = front.pop()
            images = [tuple(moved[link] for link in here) for moved in generators]
            front += [image for image in images if image not in reached]
            reached.update(images)
        return len(reached) if placed else 1

    @cached_property
    def relative(self) -> dict[frozenset[LinkId], int]:
        """Relative mobility of each two links: exact and generic; of a generator at its configuration."""
        return relative_mobilities(self.mechanism) if self.made is None else _relative_at(self.made)

    def joint_between(self, one: LinkId, other: LinkId) -> JointId | None:
        """Return the joint between two links; the first of several, None without one."""
        joints = self.mechanism.joints.items()
        return next((joint for joint, ends in joints if set(ends) == {one, other}), None)


_MOST_SYMMETRIES = 100_000


def _relative_at(made: Mechanism) -> dict[frozenset[LinkId], int]:
    """Return the relative mobility of each two links at the configuration of a mechanism, along its first branch.

    With several degrees of freedom all infinitesimal motions count.
    """
    at = configuration_of(made)
    linkage = at.linkage
    branch = next(iter(at.branches.branches), None) if at.branches is not None else None
    if branch is not None and branch.freedoms == 1:
        rates = branch.rates[:, None]
    else:
        rates = null_space(at.closure.at(linkage.angles)[1].toarray())
    tree = BodyTree(linkage)
    by_angles, _ = tree.at(linkage.angles).derivatives(dependence_on_axes(linkage))
    twists = {link: by_angles[row] @ rates for link, row in tree.row.items()}
    return {
        frozenset((one, other)): rank_of(np.asarray(twists[one] - twists[other]), DOUBLE.immobile, 1.0)
        for one, other in combinations(twists, 2)
    }


def listed_types(task: Task) -> Iterator[CandidateType]:
    """Yield all types of the sizes of a task, from each of its sources, in a fixed order."""
    assert task.links.most is not None
    sizes = range(max(task.links.least, 4), task.links.most + 1)
    for source in task.sources:
        if source == "generators":
            names = GENERATORS if task.generators is None else task.generators
            yield from (CandidateType.of(source, name, task) for name in GENERATORS if name in names)
            continue
        for links in sizes:
            yield from _of_size(task, source, links)


def _of_size(task: Task, source: str, links: int) -> Iterator[CandidateType]:
    if source == "chains":
        if ChainQuery(links, task.freedoms).possible:
            for row in chain_rows(links, task.freedoms):
                kinds = ("chains", PLANAR) if task.infinite or task.system == "planar" else ("chains",)
                yield from (CandidateType.of(kind, row["code"]) for kind in kinds)
    elif source == "sc":
        if SCQuery(links, task.freedoms, task.spatial, task.infinite).possible:
            rows = sc_rows(links, task.freedoms, spatial=task.spatial, infinite=task.infinite)
            yield from (CandidateType.of(source, row["code"]) for row in rows)
    elif SCQuery(links, task.freedoms, task.spatial, task.infinite).possible:
        rows = scd_rows(links, task.freedoms, _SIDES, spatial=task.spatial, infinite=task.infinite)
        yield from (CandidateType.of(source, row["code"]) for row in rows)


@dataclass(frozen=True, slots=True)
class Requirement:
    """One requirement of a task on types, or on placements of roles: its reason, how it is said, its check."""

    reason: str
    words: str
    admits: Callable[..., bool]


def requirements_on_types(task: Task) -> list[Requirement]:
    """Return what a task requires of a type, in the order in which reasons are counted."""
    of_form = {
        "space": lambda one: not isinstance(one.made, Sheet) or not GENERATORS[one.code].foldable,
        "sheet": lambda one: one.source == "scd" or isinstance(one.made, Sheet),
        "cone": lambda one: one.system == "spherical",
    }[task.form]
    every = [
        Requirement("links", f"{limits_text(task.links)} links", lambda one: len(one.bodies) in task.links),
        Requirement("form", f"form {task.form}", of_form),
        Requirement(
            "kinds of joints", f"joints {', '.join(task.joints)}", lambda one: one.joint_kinds <= set(task.joints)
        ),
        Requirement(
            "loops", f"{limits_text(task.loops)} loops", lambda one: one.mechanism.independent_loops in task.loops
        ),
        Requirement(
            "mobility",
            numbered(task.freedoms, "degree of freedom", "degrees of freedom"),
            lambda one: one.mobility == task.freedoms,
        ),
        Requirement("system", f"a {task.system} system", lambda one: task.system in ("any", one.system)),
        Requirement(
            "centres",
            f"{limits_text(task.centres)} centres",
            lambda one: len(one.mechanism.centre_classes()) in task.centres,
        ),
        Requirement(
            "open edges", f"{limits_text(task.open_edges)} open edges", lambda one: _open(one) in task.open_edges
        ),
        *_of_centres(FaceKind.EXPLICIT, task.explicit_centres),
        *_of_centres(FaceKind.IMPLICIT, task.implicit_centres),
        Requirement("symmetry", f"{limits_text(task.symmetry)} symmetries", lambda one: one.symmetry in task.symmetry),
    ]
    return sorted(every, key=lambda one: _LEFT_OUT_FIRST.index(one.reason))


def _of_centres(kind: FaceKind, limits: Limits) -> list[Requirement]:
    """Return the requirement on the number of centres of a kind of face, if there is one."""
    if limits == ANY_NUMBER:
        return []
    reason = f"{kind.value} centres"

    def admits(one: CandidateType) -> bool:
        scd = one.drawn
        return scd is not None and sum(scd.drawing.kind_of_face(face.index) is kind for face in scd.faces) in limits

    return [Requirement(reason, centres_text(limits, kind.value), admits)]


def _open(one: CandidateType) -> int:
    return one.mechanism.counts.open_edges if isinstance(one.mechanism, SCDGraph) else 0


def requirements_on_placements(task: Task) -> list[Requirement]:
    """Return what a task requires of the links that have roles, in the order in which reasons are counted."""
    at = {role: place for place, role in enumerate(task.roles)}

    def apart(pair: RolePair) -> Callable[[CandidateType, Placement], bool]:
        first, second = (at[role] for role in pair.roles)
        return lambda one, links: _distance(one, links[first], links[second]) in pair.limits

    def relative(pair: RolePair) -> Callable[[CandidateType, Placement], bool]:
        first, second = (at[role] for role in pair.roles)
        return lambda one, links: one.relative[frozenset((links[first], links[second]))] in pair.limits

    def joined(roles: tuple[str, str]) -> Callable[[CandidateType, Placement], bool]:
        first, second = (at[role] for role in roles)
        return lambda one, links: one.joint_between(links[first], links[second]) is not None

    return [
        *(Requirement("distance", f"joints between {pair}", apart(pair)) for pair in task.distances),
        *(
            Requirement(
                "no joint for a wish", f"a joint between {roles[0]} and {roles[1]}, which a wish names", joined(roles)
            )
            for roles in task.joint_roles
        ),
        *(Requirement("relative mobility", f"relative mobility of {pair}", relative(pair)) for pair in task.mobilities),
    ]


def _distance(one: CandidateType, first: LinkId, second: LinkId) -> int:
    return int(nx.shortest_path_length(one.mechanism, first, second))


@dataclass(frozen=True, slots=True)
class PlacedType:
    """A type with the placements of roles that a task admits.

    Attributes
    ----------
    type : CandidateType
    placements : tuple of tuple of link id
        The link of each role, in the order of the roles of the task.

    Examples
    --------
    >>> one = PlacedType(CandidateType.of("chains", "k1:Cr"), ((0, 1), (0, 2)))
    >>> one.type.code, len(one.placements)
    ('k1:Cr', 2)
    """

    type: CandidateType
    placements: tuple[Placement, ...]


@dataclass(frozen=True, repr=False)
class TaskStructure(Printed):
    """The types that a task admits, with placements of its roles; and how many it leaves out, by reasons.

    Attributes
    ----------
    task : Task
    types : int
        Number of types that were listed.
    placed : tuple of PlacedType
    left_out : mapping of str to int
        Numbers of types by the reason why they were left out; those of placements come last.
    placements : int
        Number of placements of the roles on types that no requirement on types leaves out.
    placements_left_out : mapping of str to int
        Numbers of placements by reasons.

    Examples
    --------
    >>> from enumerate.runner import Limits
    >>> task = Task(links=Limits(4, 6), sources=("sc",))
    >>> structure = structure_of(task)
    >>> structure.types, dict(structure.left_out), structure.placements
    (5, {'the same as another type': 1}, 29)
    """

    task: Task
    types: int
    placed: tuple[PlacedType, ...]
    left_out: Mapping[str, int]
    placements: int
    placements_left_out: Mapping[str, int]

    @property
    def admitted(self) -> int:
        """Number of admitted placements."""
        return sum(len(one.placements) for one in self.placed)

    def __repr__(self) -> str:
        placements = numbered(self.admitted, "placement")
        return f"<TaskStructure: {len(self.placed)} of {numbered(self.types, 'type')}, {placements}>"

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        of = numbered(self.types, "type")
        lines: list[Block] = [
            f"{len(self.placed)} of {of} can do it by structure; {numbered(self.admitted, 'placement')} of the roles"
        ]
        if self.left_out:
            lines.append("types left out: " + reasons_text(self.left_out))
        if self.placements_left_out:
            lines.append("placements left out: " + reasons_text(self.placements_left_out))
        rows = [
            (one.type.name, one.type.source, str(len(one.type.bodies)), one.type.system, str(len(one.placements)))
            for one in self.placed
        ]
        return [*lines, TableBlock(("type", "from", "links", "system", "placements"), rows, ("links", "placements"))]

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "types": self.types,
            "left_out": dict(self.left_out),
            "placements": self.placements,
            "placements_left_out": dict(self.placements_left_out),
            "admitted": [
                {
                    "type": one.type.code,
                    "name": one.type.name,
                    "from": one.type.source,
                    "links": len(one.type.bodies),
                    "system": one.type.system,
                    "mobility": one.type.mobility,
                    "placements": [
                        {role: str(link) for role, link in zip(self.task.roles, links, strict=True)}
                        for links in one.placements
                    ],
                }
                for one in self.placed
            ],
        }


def reasons_text(reasons: Mapping[str, int]) -> str:
    """Return numbers by reasons in words.

    >>> reasons_text({"mobility": 140, "symmetry": 2})
    '140 by mobility, 2 by symmetry'
    """
    plain = {
        "the same as another type": "the same as another type",
        "no joint for a wish": "without a joint for a wish",
    }
    return ", ".join(f"{number} {plain.get(reason, 'by ' + reason)}" for reason, number in reasons.items())


def structure_of(task: Task) -> TaskStructure:
    """List the types that a task admits, and place its roles.

    Parameters
    ----------
    task : Task

    Returns
    -------
    TaskStructure

    Raises
    ------
    InvariantError
        If no type meets all requirements: it names two that exclude each other, or one that no type meets.

    Examples
    --------
    >>> from enumerate.runner import Limits
    >>> structure_of(Task(links=Limits(4, 6), sources=("sc", "chains"), system="spherical"))
    <TaskStructure: 3 of 8 types, 21 placements>
    """
    of_types, of_placements = requirements_on_types(task), requirements_on_placements(task)
    listed = 0
    seen: set[Any] = set()
    left: Counter[str] = Counter()
    left_placements: Counter[str] = Counter()
    placements = 0
    placed: list[PlacedType] = []
    looked_at: list[CandidateType] = []
    for one in listed_types(task):
        listed += 1
        identity = _identity(task, one)
        if identity in seen:
            left["the same as another type"] += 1
            continue
        seen.add(identity)
        looked_at.append(one)
        failed = next((each.reason for each in of_types if not each.admits(one)), None)
        if failed is not None:
            left[failed] += 1
            continue
        every = _placements(task, one)
        placements += len(every)
        reasons = [
            next((each.reason for each in of_placements if not each.admits(one, links)), None) for links in every
        ]
        left_placements.update(reason for reason in reasons if reason is not None)
        kept = tuple(links for links, reason in zip(every, reasons, strict=True) if reason is None)
        if kept:
            placed.append(PlacedType(one, kept))
        else:  # the requirement that the placement which came farthest misses
            left[max((reason for reason in reasons if reason), key=_OF_PLACEMENTS.index, default="links")] += 1
    if not placed:
        raise _contradiction(task, looked_at, of_types, of_placements)
    order = (*_LEFT_OUT_FIRST, *_OF_PLACEMENTS)
    in_order = {reason: left[reason] for reason in order if left[reason]}
    of_roles = {reason: left_placements[reason] for reason in _OF_PLACEMENTS if left_placements[reason]}
    return TaskStructure(task, listed, tuple(placed), in_order, placements, of_roles)


def _placements(task: Task, one: CandidateType) -> list[Placement]:
    own = set(one.bodies)
    every = placements_of(one.mechanism, len(task.roles), alike=one.source not in ("scd", "generators"))
    return [links for links in every if own.issuperset(links)]


def _identity(task: Task, one: CandidateType) -> Any:
    """Return what two types share that differ by their drawing alone; sheets and special families are what they are."""
    special = one.source == "generators" and (
        task.form == "sheet"
        or len(one.bodies) not in task.links
        or exact_mobility(one.mechanism).mobility != one.mobility
    )
    return (one.source, one.code) if one.source == "scd" or special else class_code(one.mechanism)


def _contradiction(
    task: Task,
    looked_at: Sequence[CandidateType],
    of_types: Sequence[Requirement],
    of_placements: Sequence[Requirement],
) -> InvariantError:
    """Return the error of a task that no type meets: one requirement that none meets, or two that none meets both."""
    size = f"{limits_text(task.links)} links and {numbered(task.freedoms, 'degree of freedom', 'degrees of freedom')}"
    if not looked_at:
        return InvariantError("structure", f"{size} exclude each other: no type has them", "another number of links")
    every = [*of_types, *of_placements]
    missed: list[frozenset[int]] = []
    for one in looked_at:
        by_type = {place for place, each in enumerate(of_types) if not each.admits(one)}
        if not of_placements:
            missed.append(frozenset(by_type))
            continue
        for links in _placements(task, one):
            by_place = {len(of_types) + k for k, each in enumerate(of_placements) if not each.admits(one, links)}
            missed.append(frozenset(by_type | by_place))
    numbers: Iterable[tuple[int, ...]] = [
        *((place,) for place in range(len(every))),
        *combinations(range(len(every)), 2),
    ]
    for some in numbers:
        if all(any(place in off for place in some) for off in missed):
            if len(some) == 1:
                return InvariantError(
                    "structure", f"no type of {size} has {every[some[0]].words}", "another requirement"
                )
            first, second = (every[place].words for place in some)
            what = f"{first} and {second} exclude each other: no type of {size} has both"
            return InvariantError("structure", what, "one of them")
    return InvariantError(
        "structure", f"no type of {size} meets all requirements, though any two", "fewer requirements"
    )


def placements_of(mechanism: SCGraph, roles: int, *, alike: bool = True) -> list[Placement]:
    """Return placements of so many roles on different links, one of each orbit of the automorphisms.

    Parameters
    ----------
    mechanism : SCGraph
    roles : int
    alike : bool, optional
        Whether placements that an automorphism maps to each other count once. Members of an overconstrained family
        have less symmetry than their type, so of these all placements count.

    Returns
    -------
    list of tuple of link id
        The first of each orbit, by the order of the links.

    Examples
    --------
    Two roles on a four-bar: beside each other, or opposite.

    >>> from graphs.loops.loop import Loop
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> placements_of(ring, 2)
    [(0, 1), (0, 2)]
    """
    links = list(mechanism.nodes)
    number = {link: place for place, link in enumerate(links)}
    generators = []
    if alike and roles:
        generators = [[number[moved[link]] for link in links] for moved in symmetries_of_links(mechanism)]
    first = _first_of_orbits(permutations(range(len(links)), roles), generators)
    return [tuple(links[place] for place in one) for one in first]


def _first_of_orbits(
    tuples: Iterator[tuple[int, ...]], generators: Collection[Sequence[int]]
) -> Iterator[tuple[int, ...]]:
    """Yield the first tuple of each orbit, in their order: all others are reached from it by generators."""
    reached: set[tuple[int, ...]] = set()
    for one in tuples:
        if one in reached:
            continue
        yield one
        front = [one]
        reached.add(one)
        while front:
            here = front.pop()
            for moved in generators:
                image = tuple(moved[place] for place in here)
                if image not in reached:
                    reached.add(image)
                    front.append(image)
