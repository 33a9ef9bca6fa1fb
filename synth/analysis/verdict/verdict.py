"""The verdict on the motion of a mechanism, its evidence, and its sentences.

In words the answer comes first, then branches, then evidence in the order of its weight. A statement without a
qualifier is proved; a numerical one says how far it was traced. Theory: docs/theory/verdict.md.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from math import degrees
from typing import Any, Literal

import networkx as nx

from graphs.errors import numbered
from graphs.mechanism.sc import SCGraph
from graphs.plain_data import fields_to_json
from graphs.tolerances import DOUBLE
from graphs.types import JointId, LinkId
from synth.analysis.motion.assigned_branch import Marked
from synth.analysis.motion.configuration import Configuration, at_most, listed
from synth.analysis.motion.germ import Certainty

Basis = Literal["motion", "pose", "generic", "count"]


@dataclass(frozen=True, slots=True)
class MotionBranch:
    """One motion branch from the configuration of a file.

    Attributes
    ----------
    signs : str
        How each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all.
    freedoms : int or None
    certainty : {"proved", "numerical", "not known"}
    immobile_joints : tuple of joint ids
        Joints that are immobile on it.
    followed : float
        How far the joint that moves most was followed, radians.
    misfit : float or None
        Largest displacement of a vertex, in units of the extent, in the mechanism that has this branch; 0 where
        the coordinates have it as they are written, None without vertices.
    from_folded : (float, float) or None
        For a branch found at a folded state: the largest fold angles there, and at the end of the way back towards
        the flat state, radians.
    """

    signs: str
    freedoms: int | None
    certainty: Certainty
    immobile_joints: tuple[JointId, ...]
    followed: float
    misfit: float | None = None
    from_folded: tuple[float, float] | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(
            self,
            keys={"followed": "followed_deg", "from_folded": "from_folded_deg"},
            followed=degrees(self.followed),
            from_folded=None if self.from_folded is None else tuple(map(degrees, self.from_folded)),
        )


@dataclass(frozen=True, slots=True)
class AsWritten:
    """What holds for the coordinates exactly as they are written; freedoms are None where they are unknown."""

    freedoms: int | None
    certainty: Certainty


@dataclass(frozen=True, slots=True)
class WithinPrecision:
    """What holds for some mechanism within the precision of the coordinates: four times their error.

    That nothing moves is proved if no rates nearly agree, and numerical if for all that do the nearest mechanism
    is farther off or none was found. The misfit is the largest displacement of a vertex, in units of the extent,
    in the mechanism found; of a rigid pattern in the nearest one that moves, beyond the precision; None where no
    mechanism was found nearby, with vertices displaced by up to what was `searched`, in units of the extent. The
    precision is the error of a coordinate, in these units too.
    """

    freedoms: int | None
    certainty: Certainty
    misfit: float | None
    precision: float
    searched: float | None = None


@dataclass(frozen=True, slots=True)
class FreedomBounds:
    """What holds where not all branches were searched for: bounds of their number and of their freedoms.

    Attributes
    ----------
    branches : int
        There are at least so many branches.
    stated : (int, int)
        Freedoms of the stated branch: at least as many as were shown by tracing, at most as many as there are
        infinitesimal ones at its end.
    freest : (int, int)
        Freedoms of the branch that has most: at least those of a branch that was traced, or is known since the
        sheet folds along parallel straight lines; at most the infinitesimal ones at the configuration.
    """

    branches: int
    stated: tuple[int, int]
    freest: tuple[int, int]

    @property
    def settled(self) -> bool:
        """Whether there are no other branches: the stated one has all infinitesimal freedoms."""
        return self.stated[0] == self.freest[1]

    def to_json(self) -> dict[str, int]:
        """Return plain data."""
        return {
            "branches_at_least": self.branches,
            "freedoms_at_least": self.stated[0],
            "freedoms_at_most": self.stated[1],
            "freest_at_least": self.freest[0],
            "freest_at_most": self.freest[1],
        }


@dataclass(frozen=True, slots=True)
class BranchCount:
    """How many motion branches there are, listed or not.

    Attributes
    ----------
    kinds : Counter
        How many of them have how many freedoms; None where these are unknown.
    at_least : bool
        Whether there may be more: neither a proof nor a second method shows that there are not.
    proved : bool
        Whether the number is proved.

    Examples
    --------
    >>> BranchCount(Counter({1: 3, 2: 1}), False, True).to_json()
    {'count': 4, 'at_least': False, 'proved': True}
    """

    kinds: Counter[int | None]
    at_least: bool
    proved: bool

    @property
    def count(self) -> int:
        """Their number."""
        return self.kinds.total()

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"count": self.count, "at_least": self.at_least, "proved": self.proved}


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether a mechanism moves, in a sentence and in numbers.

    Attributes
    ----------
    freedoms : int or None
        Of the branch through a folded configuration; of the branch that the marks of a flat sheet choose, or the
        most that any has; else of the type. None if unknown.
    basis : {"motion", "pose", "generic", "count"}
        Motion: followed, or proved from the configuration on. Pose: a regular configuration, at which rates are
        motions. Generic: the exact rank of a generic realisation. Count: a formula.
    certainty : {"proved", "numerical", "not known"}
    text : str
    branches : tuple of MotionBranch
        Motion branches, where they were looked for; those that the search had nothing left to follow are left out.
    exhaustive : bool
        Whether there are no other branches.
    immobile_joints : tuple of joint ids
        Joints that are immobile on every branch.
    clusters : tuple of tuple of link ids
        Links that move as one on every branch, where they are several.
    places : mapping of joint id to two points
        Ends of immobile creases, in the unit of the coordinates.
    as_written : AsWritten or None
        What holds exactly as written; None for a type, and where motion was not looked for.
    within_precision : WithinPrecision or None
        What holds within the precision of the coordinates of a crease pattern: the verdict is about that.
    further : int or None
        If the search ended at its allowance: how many beginnings of branches it had found and not followed; there
        may be more. None if it came to its end.
    bounds : FreedomBounds or None
        Where not all branches were searched for, or one motion stands for all.
    count : BranchCount or None
        How many branches there are, of which only so many as can be read are listed; None where one motion stands
        for all.

    Examples
    --------
    >>> import synth
    >>> verdict = synth.mobility(synth.generate("miura", rows=2, columns=2).mechanism).verdict
    >>> verdict, verdict.exhaustive, len(verdict.branches)
    (<Verdict: 1 degree of freedom, proved>, True, 2)
    """

    freedoms: int | None
    basis: Basis
    certainty: Certainty
    text: str
    branches: tuple[MotionBranch, ...] = ()
    exhaustive: bool = False
    immobile_joints: tuple[JointId, ...] = ()
    clusters: tuple[tuple[LinkId, ...], ...] = ()
    places: dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]] = field(default_factory=dict)
    as_written: AsWritten | None = None
    within_precision: WithinPrecision | None = None
    further: int | None = None
    bounds: FreedomBounds | None = None
    count: BranchCount | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        places = [{"joint": joint, "ends": list(map(list, ends))} for joint, ends in self.places.items()]
        return {
            "freedoms": self.freedoms,
            "basis": self.basis,
            "certainty": self.certainty,
            "branches": [branch.to_json() for branch in self.branches],
            "exhaustive": self.exhaustive,
            **self._count_to_json(),
            "not_followed": self.further,
            "bounds": None if self.bounds is None else self.bounds.to_json(),
            "immobile_joints": list(self.immobile_joints),
            "immobile_places": places,
            "clusters": [list(cluster) for cluster in self.clusters],
            "as_written": None if self.as_written is None else asdict(self.as_written),
            "within_precision": None if self.within_precision is None else asdict(self.within_precision),
            "text": self.text,
        }

    def _count_to_json(self) -> dict[str, Any]:
        """Return how many branches there are, whether at least so many, and whether that is proved."""
        if self.count is not None:
            return self.count.to_json()
        if self.bounds is None:
            number = len(self.branches) if self.basis in ("motion", "pose") else None
            return {"count": number, "at_least": not self.exhaustive, "proved": self.exhaustive}
        return {"count": self.bounds.branches, "at_least": not self.bounds.settled, "proved": False}

    def __str__(self) -> str:
        return self.text

    @property
    def summary(self) -> str:
        """Degrees of freedom and certainty in a few words."""
        freedoms = "degrees of freedom unknown" if self.freedoms is None else in_words(self.freedoms)
        return f"{freedoms}, {self.certainty}"

    def __repr__(self) -> str:
        return f"<Verdict: {self.summary}>"


def clusters_of(graph: SCGraph, immobile: Sequence[JointId]) -> tuple[tuple[LinkId, ...], ...]:
    """Return links that immobile joints make one, in the order of the graph."""
    together = nx.Graph()
    together.add_edges_from(graph.joints[joint] for joint in immobile)
    order = {link: place for place, link in enumerate(graph)}
    clusters = [tuple(sorted(links, key=order.__getitem__)) for links in nx.connected_components(together)]
    return tuple(sorted(clusters, key=lambda links: order[links[0]]))


_ASSIGNMENT = {
    "has": " with the given mountain-valley assignment",
    "none has": ", but not with the given assignment (proved)",
    "none found": ", but no branch with the given assignment was found",
}
_TO_GO_ON = "The search for branches ended at its work limit; try synth mobility --more."


@dataclass(frozen=True, slots=True)
class MotionFindings:
    """What a verdict on a motion is written from.

    The verdict states the degrees of freedom of the branch `stated`; `complete` says whether the search for
    branches came to its end; `generic` is the mobility of the type; `immobile` are the joints that are so on every
    branch; `marked` says whether a branch begins with the given mountain-valley assignment; `written` is what
    holds exactly as written, if that differs; `bounds` are given where not all branches were searched for; `count`
    where they were.
    """

    at: Configuration
    branches: tuple[MotionBranch, ...]
    stated: MotionBranch | None
    freedoms: int | None
    certainty: Certainty
    complete: bool
    generic: int | None
    immobile: tuple[JointId, ...] = ()
    marked: Marked | None = None
    written: AsWritten | None = None
    bounds: FreedomBounds | None = None
    count: BranchCount | None = None

    @property
    def kinds(self) -> Counter[int | None]:
        """How many branches have how many freedoms."""
        return Counter(branch.freedoms for branch in self.branches) if self.count is None else self.count.kinds


def flaps_of(graph: SCGraph) -> list[JointId]:
    """Return the joints that are in no loop: the links beyond such a joint turn freely."""
    pairs = nx.Graph()
    pairs.add_nodes_from(graph.nodes)
    between: dict[frozenset[object], list[JointId]] = {}
    for joint, ends in graph.joints.items():
        between.setdefault(frozenset(ends), []).append(joint)
        pairs.add_edge(*ends)
    bridges = {frozenset(pair) for pair in nx.bridges(pairs)}
    return [joints[0] for pair, joints in between.items() if pair in bridges and len(joints) == 1]


def text_of_motion(findings: MotionFindings) -> str:
    """Return the verdict in sentences; degrees of freedom of 0 are rigid, None unknown."""
    freedoms, branch, immobile = findings.freedoms, findings.stated, findings.immobile
    if freedoms is None and (branch is None or findings.certainty == "not known"):
        return _unknown(findings)
    if freedoms == 0:
        return f"Rigid{findings.at.doubt}."
    flaps = flaps_of(findings.at.linkage.graph)
    rest = len(findings.at.joints) - len(flaps)
    if flaps and freedoms == len(flaps) and immobile and len(immobile) == rest:
        at = f"at the flap {_noun(flaps)} {listed(flaps)}"
        return f"Rigid except for flaps: {in_words(freedoms)}, {at}. {_immobile(immobile)}"
    sentences = [_answer(findings), *_branches(findings), *_bounds(findings)]
    if immobile:
        sentences.append(_immobile(immobile))
    if findings.certainty != "proved":
        sentences.append("Not proved." if branch is None else f"Numerical: {_traced(branch)}.")
    sentences += _overconstrained(findings.generic, freedoms)
    return " ".join([*sentences, *_allowance(findings)])


def in_words(freedoms: int) -> str:
    """Return a number of degrees of freedom in words."""
    return numbered(freedoms, "degree of freedom", "degrees of freedom")


def _unknown(findings: MotionFindings) -> str:
    """Return the verdict where no motion was found, and none excluded."""
    if findings.written is not None and findings.written.freedoms == 0:
        within = f"within the drawing's precision, {findings.at.precision}"
        return f"Unknown: no motion found {within}, and none excluded. Exactly as written it is rigid."
    none = f"Unknown: no motion found, and none excluded{findings.at.doubt}."
    return " ".join([none, *_allowance(findings)])


def _answer(findings: MotionFindings) -> str:
    """Return the first sentence: whether it moves, from where, and with how many degrees of freedom."""
    moves = "Rigid-foldable" if findings.at.has_panels else "Mobile"
    start = "from the flat state" if findings.at.flat else "from this configuration"
    count, freedoms = "degrees of freedom unknown", findings.freedoms
    if freedoms is None and findings.bounds is not None:
        count = _between(*findings.bounds.stated)
    if freedoms is not None:
        count = in_words(freedoms)
        if findings.marked != "has" and any(other != freedoms for other in findings.kinds):
            most = findings.complete and None not in findings.kinds
            count = f"up to {count}" if most else f"{count} on the freest branch found"
    assignment = "" if findings.marked is None else _ASSIGNMENT[findings.marked]
    if findings.marked == "has":
        first = f"{moves} {start}{assignment}: {count}"
    else:
        first = f"{moves} {start}: {count}{assignment}"
    misfit = None if findings.stated is None else findings.stated.misfit
    if not misfit:
        return f"{first}."
    moved = f"vertices moved by at most {at_most(misfit)} of the extent"
    return f"{first}, within the drawing's precision ({moved}). {_as_written(findings.written)}"


def _as_written(written: AsWritten | None) -> str:
    """Return what would be without the precision."""
    if written is None or written.freedoms is None:
        return "Whether it folds exactly as written is unknown."
    if not written.freedoms:
        return "Exactly as written it would be rigid."
    return f"Exactly as written it has {in_words(written.freedoms)}."


def _branches(findings: MotionFindings) -> list[str]:
    """Return the sentence that counts the branches, where there are several."""
    kinds, kind = findings.kinds, "folding branch" if findings.at.flat else "motion branch"
    certain = findings.complete and (findings.count is None or not findings.count.at_least)
    if kinds.total() < 2:
        return []
    count = ("" if certain else "At least ") + numbered(kinds.total(), kind, f"{kind}es")
    if len(kinds) == 1:
        return [f"{count}."]
    most_first = sorted(kinds.items(), key=lambda item: -(item[0] or 0))
    each = [f"{number} with {'unknown' if freedoms is None else freedoms} DOF" for freedoms, number in most_first]
    return [f"{count}: {', '.join(each)}."]


def _bounds(findings: MotionFindings) -> list[str]:
    """Return the sentence on the branches that were not searched for: how many at least, how free at most."""
    bounds = findings.bounds
    counted = findings.count is not None and not findings.count.at_least
    if bounds is None or bounds.settled or counted:
        return []
    kind = "folding branch" if findings.at.flat else "motion branch"
    freest = _between(*bounds.freest)
    if findings.kinds.total() > 1:
        return [f"The freest {kind} has {freest}."]
    there = "is at least 1" if bounds.branches == 1 else f"are at least {bounds.branches}"
    return [f"Not all {kind}es were searched for: there {there}, and the freest has {freest}."]


def _between(least: int, most: int) -> str:
    """Return bounds of a number of degrees of freedom in words."""
    return in_words(least) if least == most else f"at least {least} and at most {in_words(most)}"


def _immobile(joints: Sequence[JointId]) -> str:
    return f"Immobile {_noun(joints)}: {listed(joints)}."


def _noun(joints: Sequence[JointId]) -> str:
    return "joint" if len(joints) == 1 else "joints"


def _traced(branch: MotionBranch) -> str:
    """Return how far a branch was traced, and how well loops close there."""
    back = ""
    if branch.from_folded is not None:
        folded, small = map(degrees, branch.from_folded)
        back = f"found folded by {folded:.3g}° and traced back to {small:.2g}°; "
    return f"{back}traced to {degrees(branch.followed):.3g}°, loop-closure residual below {DOUBLE.closed:.0e}"


def _overconstrained(generic: int | None, freedoms: int | None) -> list[str]:
    """Return the sentence that compares with a generic realisation of the type, if that has fewer."""
    if generic is None or freedoms is None or freedoms <= generic:
        return []
    type_has = "is rigid" if generic <= 0 else f"has {in_words(generic)}"
    return [f"Overconstrained: a generic realisation {type_has} (M = {generic}, h = {freedoms - generic})."]


def _allowance(findings: MotionFindings) -> list[str]:
    """Return the sentence on a search that ended at its allowance, with the way to go on."""
    ended = not findings.complete and findings.at.branches is not None and not findings.at.more
    return [_TO_GO_ON] if ended else []
