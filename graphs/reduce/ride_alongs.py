"""Reducing adjunct addenda: ride-alongs taken off one by one, to a fixed point.

A *ride-along addendum* is two binary links u, v appended to two adjacent links a, b so that the four meet in one
centre; its relative mobility is 0. An *adjunct addendum* is a chain of them. Source: Wiener 2016, sections 4.2.4
and 4.2.5. Theory: docs/theory/reduction.md.
"""

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import networkx as nx

from graphs.convert.conversions import to_sc
from graphs.count.report import mobility_report
from graphs.edit.edits import counts_as_json
from graphs.errors import InvariantError, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.identity.chains import chain_id
from graphs.identity.leaves import ColouredGraph
from graphs.identity.numbering import labels_of
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.printing import Block, Printed, plain
from graphs.reduce.reduced_drawing import drawn_as
from graphs.reduce.working_graph import RULES, ReductionTerms, Removal, TakenAddendum, WorkingGraph, take_all
from graphs.types import JointId, LinkId


class _FourBar(NamedTuple):
    """A four-bar of a block, and the class of the loops that it is a sum of."""

    links: frozenset[LinkId]
    centre_class: int


@dataclass(frozen=True, slots=True)
class _Choice:
    """A block that came down to one four-bar: its last loop, here as a four-bar, and all that could stay."""

    last: int
    here: _FourBar
    there: tuple[_FourBar, ...]

    @property
    def classes(self) -> frozenset[int]:
        return frozenset(one.centre_class for one in self.there)


def links_of_loops_that_stay(
    work: WorkingGraph, addenda: Sequence[TakenAddendum], protected: Collection[LinkId]
) -> frozenset[LinkId]:
    """Return the links of four-bars that should have stayed, if others did; the reduction is then done again.

    A finite centre stays before one at infinity, a centre of its own before one that other blocks have too. If
    several shared centres are still equal, canonical labels of the remaining graph decide: that choice has no
    meaning, but does not depend on the order in which links and joints are listed.
    """
    choices = [_most_general(work, choice) for choice in _choices(work, addenda, protected)]
    labels = _labels(work, choices, protected) if any(len(choice.classes) > 1 for choice in choices) else {}
    stay: set[LinkId] = set()
    for choice in choices:
        chosen = min(choice.there, key=lambda four_bar: labels.get(four_bar.centre_class, 0))
        if chosen.centre_class != choice.here.centre_class:
            stay |= chosen.links
    return frozenset(stay)


def _choices(work: WorkingGraph, addenda: Sequence[TakenAddendum], protected: Collection[LinkId]) -> list[_Choice]:
    """Return the blocks that came down to one four-bar.

    A link that is protected or lies in another block cannot go; a four-bar can be the last if it has all of these.
    """
    taken_off: dict[int, list[_FourBar]] = defaultdict(list)
    for removal, _, onto in addenda:
        four_bar = _FourBar(frozenset((*removal.links, *onto)), work.class_of[removal.dropped])
        taken_off[work.block_of[removal.joints[1]]].append(four_bar)
    choices = []
    for loop in work.kept_loops()[0]:
        joints = work.loops[loop]
        block = work.block_of[next(iter(joints))]
        if loop not in work.class_of or len(joints) != 4 or work.loops_in_block[block] != 1:
            continue
        links = frozenset(link for joint in joints for link in work.joints[joint])
        fixed = {link for link in links if link in protected or work.degree[link] > 2}
        here = _FourBar(links, work.class_of[loop])
        choices.append(_Choice(loop, here, (here, *(one for one in taken_off[block] if fixed <= one.links))))
    return choices


def _most_general(work: WorkingGraph, choice: _Choice) -> _Choice:
    """Keep the four-bars of the most general kind: of one class, unless several shared classes are equal."""
    classes = work.original.centre_classes()
    # a class is shared if it has loops in several blocks, which a file says by naming their centre
    blocks = {which: {work.block_of[joint] for joint in classes[which].joints} for which in choice.classes}
    kinds = {which: (_is_planar(work, which), len(blocks[which]) > 1) for which in choice.classes}
    best = min(kinds.values())
    there = [one for one in choice.there if kinds[one.centre_class] == best]
    _, shared = best
    return _Choice(choice.last, choice.here, tuple(there if shared else there[:1]))


def _is_planar(work: WorkingGraph, which: int) -> bool:
    return work.original.centre_classes()[which].centre is Centre.INFINITE


def _labels(work: WorkingGraph, choices: Sequence[_Choice], protected: Collection[LinkId]) -> Mapping[int, int]:
    """Return canonical labels of the classes in the graph of the remaining links, joints and classes."""
    colours: list[tuple[object, ...]] = []
    edges: list[tuple[int, int]] = []

    def node(*colour: object) -> int:
        colours.append(colour)
        return len(colours) - 1

    link_at = {link: node("link", link == work.original.ground, link in protected) for link in work.degree}
    joint_at = {joint: node("joint") for joint in work.joints}
    edges += [(joint_at[joint], link_at[end]) for joint, ends in work.joints.items() for end in ends]
    open_choices = [choice for choice in choices if len(choice.classes) > 1]
    class_at: dict[int, int] = {}
    for which, loops in _loops_of_classes(work, choices).items():
        number_closing = sum(loop in work.closing for loop in loops)
        class_at[which] = node("class", _is_planar(work, which), len(loops), number_closing)
        joints = set().union(*(work.loops[loop] for loop in loops))
        edges += [(class_at[which], joint_at[joint]) for joint in joints]
    for choice in open_choices:
        four_bar = node("open")
        edges += [(four_bar, joint_at[joint]) for joint in work.loops[choice.last]]
        edges += [(four_bar, class_at[which]) for which in choice.classes]
    palette = {colour: i for i, colour in enumerate(sorted(set(colours), key=repr))}
    labels = labels_of(ColouredGraph(len(colours), edges, [palette[colour] for colour in colours]))
    return {which: labels[place] for which, place in class_at.items()}


def _loops_of_classes(work: WorkingGraph, choices: Sequence[_Choice]) -> dict[int, list[int]]:
    """Return the loops of each class after the choices; none for open ones."""
    independent, closing = work.kept_loops()
    class_of = {loop: work.class_of[loop] for loop in (*independent, *closing) if loop in work.class_of}
    for choice in choices:
        del class_of[choice.last]
        if len(choice.classes) == 1:
            class_of[choice.last] = choice.there[0].centre_class
    loops: dict[int, list[int]] = {which: [] for choice in choices for which in choice.classes}
    for loop, which in class_of.items():
        loops.setdefault(which, []).append(loop)
    return loops


# Links up to which the id of what is left is printed: that of more fills lines, and nobody compares it.
_MOST_NAMED = 60
_MOST_SHOWN = 200  # steps that are listed: four screens; data has all


@dataclass(frozen=True, slots=True)
class ReductionStep:
    """One addendum taken off.

    Attributes
    ----------
    removed : (link, link)
        u and v.
    onto : (link, link)
        a and b, the links they were appended to: a is joined to u, b to v.
    joints : (joint, joint, joint)
        a-u, u-v and v-b.
    joint : joint id or None
        The joint a-b that takes their place; None for a dyad.
    sits_on : int or None
        The step that takes off a or b later on: this addendum sits on that one.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> squares = [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10)]
    >>> [step] = reduce(scd_from_panels(squares)).steps
    >>> step.removed, step.onto, step.sits_on
    ((0, 1), (2, 3), None)
    """

    removed: tuple[LinkId, LinkId]
    onto: tuple[LinkId, LinkId]
    joints: tuple[JointId, JointId, JointId]
    joint: JointId | None
    sits_on: int | None


@dataclass(frozen=True, slots=True)
class Reduction(Printed):
    """A reduced mechanism, and how it came about.

    Attributes
    ----------
    original, graph : SCGraph
        Before and after. Of an SCD graph the reduced one is an SCD graph too, unless dyads leave a drawing that
        breaks one of its rules.
    rule : str
    steps : tuple of ReductionStep
        In the order in which they were taken.
    removals : tuple of Removal
        The same, with the data to undo them.
    """

    original: SCGraph
    graph: SCGraph
    rule: str
    steps: tuple[ReductionStep, ...]
    removals: tuple[Removal, ...]
    _work: WorkingGraph

    def undo(self, steps: int | None = None) -> SCGraph:
        """Put back the links of the last steps, by default of all; then it is the original, ids included.

        Raise ValueError if there are fewer steps.
        """
        number = len(self.removals) if steps is None else steps
        if not 0 <= number <= len(self.removals):
            raise ValueError(f"cannot undo {number} of {len(self.removals)} steps")
        last = self.removals[len(self.removals) - number :]
        for removal in reversed(last):
            self._work.put_back(removal)
        graph = self._work.graph()
        for removal in last:
            self._work.repeat(removal)
        return _with_drawing(self.original, graph)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was assumed of the mechanism, and what of it is not in what is left."""
        lost = isinstance(self.original, SCDGraph) and not isinstance(self.graph, SCDGraph)
        left = "what is left of the drawing is no SCD graph, so the sides of the links are left out"
        return (*self.original.notes, *([left] if lost else []))

    def chains(self) -> list[nx.DiGraph]:
        """Return the adjunct addenda: a tree of steps each, from the one on the mechanism outwards."""
        forest = nx.DiGraph()
        forest.add_nodes_from(range(len(self.steps)))
        for i, step in enumerate(self.steps):
            if step.sits_on is not None:
                forest.add_edge(step.sits_on, i)
        return [forest.subgraph(sorted(part)).copy() for part in nx.weakly_connected_components(forest)]

    def blocks(self) -> list[Block]:
        """Return the lines that are printed: the steps of each adjunct addendum in order, and what is left."""
        counts: list[Block] = [
            f"{when:6}  links {len(sc)}, joints {len(sc.joints)}, mobility {mobility_report(sc).mobility}"
            for when, sc in (("before", self.original), ("after", self.graph))
        ]
        counts += [f"note: {note}" for note in self.notes]
        if not self.steps:
            return [*counts, "nothing to take off"]
        chains = self.chains()
        addenda = numbered(len(chains), "adjunct addendum", "adjunct addenda")
        head = f"{numbered(len(self.steps), 'step')} in {addenda}"
        if len(self.steps) > _MOST_SHOWN:
            more = f"more than {_MOST_SHOWN} steps: --json (in Python to_json) lists them"
            return [*counts, head, more, self._left()]
        headed = 1 < len(chains) < len(self.steps)  # addenda of one step each need no heads
        steps: list[Block] = []
        for place, chain in enumerate(chains, 1):
            lines = self._in_order(chain)
            steps += [f"addendum {place}", *("  " + line for line in lines)] if headed else lines
        return [*counts, head, *steps, self._left()]

    def _in_order(self, chain: nx.DiGraph) -> list[str]:
        """List the steps of an adjunct addendum in their order, each with the later one on whose links it is."""
        lines = []
        for number in sorted(chain):
            step = self.steps[number]
            u, v, a, b = map(plain, (*step.removed, *step.onto))
            later = "" if step.sits_on is None else f" (sits on step {step.sits_on + 1})"
            lines.append(f"step {number + 1}: links {u}, {v} on {a}, {b}{later}")
        return lines

    def _left(self) -> str:
        """Say what is left: its loops by their centres, its links, and the id of its chain unless that is long."""
        sc = self.graph
        words = {Centre.FINITE: "spherical", Centre.INFINITE: "planar", Centre.NONE: "spatial"}
        kinds = Counter(words[loop.centre] for loop in sc.loops if loop.centre is not Centre.NONE)
        kinds += Counter({"spatial": sc.spatial_loops})
        links, number = numbered(len(sc), "link"), kinds.total()
        if number == 1:
            line = f"one {next(iter(kinds))} loop {'of' if len(sc.joints) == len(sc) else 'and'} {links}"
        else:
            listed = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
            line = f"{number or 'no'} loops{f' ({listed})' if listed else ''}, {links}"
        return f"left: {line}" + (f", {chain_id(sc)}" if len(sc) <= _MOST_NAMED else "")

    def __repr__(self) -> str:
        return f"<Reduction: {self.original!r} to {self.graph!r}, {numbered(len(self.steps), 'step')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the reduction as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "rule": self.rule,
            "before": counts_as_json(self.original),
            "after": counts_as_json(self.graph),
            "steps": [
                {"removed": list(step.removed), "onto": list(step.onto), "joints": list(step.joints)}
                | {"joint": step.joint, "sits_on": step.sits_on}
                for step in self.steps
            ],
            "notes": list(self.notes),
        }


def reduce(
    mechanism: MechanismLike, *, rule: str = "ride-along", fully: bool = False, keep: Iterable[LinkId] = ()
) -> Reduction:
    """Take off ride-alongs (or dyads) until none is left. The mobility stays.

    Ride-along reduction takes linear time and, up to isomorphism, gives the same graph in whichever order the
    parts of the mechanism are listed (docs/theory/reduction.md). Dyad reduction promises neither.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
        Its SC graph is reduced; an SCD graph becomes an SCD graph, where links that go leave open edges.
    rule : {"ride-along", "dyad"}, optional
        ``"ride-along"``: a and b are joined, and the cycle a-u-v-b is a sum of loops of one class.
        ``"dyad"``: a and b need not be joined; some loop through u and v has a centre.
    fully : bool, optional
        Take off an addendum even where its block then has no loop left.
    keep : iterable of link ids, optional
        Links that stay: inputs, outputs. The ground link always stays.

    Raises
    ------
    InvariantError
        If a link to keep is not there, or the rule is not known.

    Examples
    --------
    A double strip of three by two squares is a four-bar with a ride-along:

    >>> from graphs.convert.panels import scd_from_panels
    >>> squares = [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10)]
    >>> reduction = reduce(scd_from_panels(squares))
    >>> len(reduction.graph), [step.removed for step in reduction.steps]
    (4, [(0, 1)])
    """
    mechanism = mechanism_for("reduce", mechanism)
    if rule not in RULES:
        raise InvariantError("rule", f"the rule {shown(rule)}", "one of " + ", ".join(RULES))
    original = mechanism if isinstance(mechanism, SCDGraph) else to_sc(mechanism)
    sc = to_sc(mechanism)
    protected = set(keep)
    for link in protected:
        if link not in sc:
            raise InvariantError("keep", f"{shown(link)} is to be kept and is no link", "one of the links")
    if sc.ground is not None:
        protected.add(sc.ground)
    terms = ReductionTerms(rule, fully, frozenset(protected))
    work = WorkingGraph(sc)
    addenda = take_all(work, terms)
    if rule == "ride-along" and not fully and (stay := links_of_loops_that_stay(work, addenda, terms.protected)):
        work = WorkingGraph(sc)
        addenda = take_all(work, ReductionTerms(rule, fully, terms.protected | stay))
    graph = _with_drawing(original, work.graph())
    return Reduction(original, graph, rule, _steps(addenda), tuple(one.removal for one in addenda), work)


def _with_drawing(original: SCGraph, graph: SCGraph) -> SCGraph:
    """Return a graph with what is left of the drawing of the original, if that is an SCD graph.

    Dyads that were no ride-alongs may leave a drawing that breaks a rule; then the SC graph is all that is left.
    """
    if not isinstance(original, SCDGraph):
        return graph
    try:
        return drawn_as(original, graph)
    except InvariantError:
        return graph


def _steps(addenda: Sequence[TakenAddendum]) -> tuple[ReductionStep, ...]:
    """Add to each step the one it sits on: the first that takes off one of its two bases."""
    taker = {link: i for i, one in enumerate(addenda) for link in one.removal.links}
    steps = []
    for removal, joint, onto in addenda:
        later = [taker[link] for link in onto if link in taker]
        steps.append(ReductionStep(removal.links, onto, removal.joints, joint, min(later, default=None)))
    return tuple(steps)
