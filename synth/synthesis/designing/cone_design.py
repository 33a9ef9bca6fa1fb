"""Linkages designed for a cone of a stated half angle: which of them stay outside, or inside, for a stated turn.

Places of joints on a grid are sorted by their first-order behaviour, all at once; those that leave the surface on
the wanted side are moved all round their circuits. Where none of them keeps to the side for the turn, azimuths of
others change by the search of this room until they do: points of links at angles of the driving joint are to be on that
side. Theory: docs/theory/behaviour.md, docs/theory/moving.md.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, permutations, product
from math import degrees, isfinite, pi, radians, sin, tau
from typing import Any, Literal

import numpy as np

from enumerate.chains.names import chain_named
from graphs.edit.named import link_named
from graphs.errors import InvariantError, NumericalError, UnsolvableError, numbered, shown
from graphs.files.formats import read
from graphs.geometry import crossing
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, ring
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, LinkId
from synth.analysis.moving.on_surface import SurfaceMotion, move_on_surface
from synth.analysis.moving.senses import Sense
from synth.linkages.conformed.behaviours import Way, behaviour, link_arcs
from synth.linkages.conformed.linkage_behaviour import OnSurface
from synth.linkages.conformed.rates import ConformedChain
from synth.synthesis.designing.dimensions import ConeDimensions
from synth.synthesis.designing.placement import Derived, DesignConfiguration, DesignFrame, stacked
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.search import found_from, seeded
from synth.synthesis.designing.wishes import Goal, GoalWish, Wish, WishedConfiguration, Wishes

_SLOTS, _LEAST_GAP = 36, 2
"""Places that joints of candidates may have round the axis, and the least distance of two joints."""
_GRID = tau / _SLOTS
_LISTED = 4
"""Joints of linkages of which all places are listed."""
_SAMPLES = 20_000
"""Candidates of a chain with more joints than can be listed."""
_ERRORS = (1.0, 2.0, 3.0, 4.0, 5.0)
"""Errors of azimuths, degrees, up to which behaviour is tested."""
_CHANGED = 2
"""Linkages whose azimuths change, at most: those that come nearest to the turn."""
_ALONG = (0.25, 0.5, 0.75)
"""Parts of the arcs of links at which the search looks."""
_AT, _SPARE = 4, radians(0.3)
"""Angles of the driving joint at which the search looks, and by how much points are to be on the side."""
_CHAINS = {4: ("four-bar",), 6: ("watt", "stephenson")}
Side = Literal["outside", "inside"]


@dataclass(frozen=True, kw_only=True)
class ConeSide(GoalWish):
    """The angle of points of a link from the axis of the cone, radians: at least the half angle outside.

    Attributes
    ----------
    at : str
        Name of a configuration.
    ends : (str, str)
        The joints at the ends of the arc of the link.
    link : str
    parts : tuple of float
        Parts of the arc at which points are.
    goal : Goal
        Radians.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(ConeSide(at="turned", link="2", ends=("1", "2"), parts=(0.5,), goal=Goal(at_least=0.5)))
    side of link 2 at turned
    """

    link: str
    ends: tuple[str, str]
    parts: tuple[float, ...]
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check the link and the joints."""
        frame.row(self.link)
        for joint in self.ends:
            frame.joint(joint)

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the angles."""
        frame, design = configuration.frame, configuration.design
        lines, by_lines = design.linkage.directions, design.dependence.arrays[0]
        azimuths, slopes = [], []
        for name in self.ends:
            joint = frame.joint(name)
            x, _, z = lines[joint]
            by = -crossing(lines[joint]) @ by_lines[6 * joint : 6 * joint + 3]
            azimuths.append(np.arctan2(x, z))
            slopes.append((z * by[0] - x * by[2]) / (x * x + z * z))
        span = np.remainder(azimuths[1] - azimuths[0] + pi, tau) - pi
        height, rim = lines[frame.joint(self.ends[0]), 1], float(np.hypot(x, z))
        rows = []
        for part in self.parts:
            azimuth, by = azimuths[0] + part * span, (1.0 - part) * slopes[0] + part * slopes[1]
            place = np.array([rim * np.sin(azimuth), height, rim * np.cos(azimuth)])
            along = np.array([rim * np.cos(azimuth), 0.0, -rim * np.sin(azimuth)])
            there = configuration.direction(frame.row(self.link), place, along[:, None] * by)
            across = float(np.hypot(there.values[0], there.values[2]))
            rows.append(there.through(np.array([np.arccos(-there.values[1])]), np.array([[0.0, 1.0 / across, 0.0]])))
        return stacked(rows)

    def __str__(self) -> str:
        return f"side of link {self.link} at {self.at}"


@dataclass(frozen=True, slots=True)
class ConeDesign:
    """A linkage on a cone that does what was asked of it, with its margins.

    Attributes
    ----------
    linkage : OnSurface
    chain : str
        The name of its chain.
    motion : SurfaceMotion
    reach : float
        Turn of the driving joint through which the links keep to the side, radians; negative backward.
    gap : float
        Least distance of two joints round the axis, radians.
    holds : float
        Largest error of the azimuths, degrees, at which it still leaves the cone on the side, to first order.

    Examples
    --------
    >>> first, *_ = design_on_cone(np.radians(25), np.radians(60), tries=2).designs
    >>> first.chain, len(first.arcs)
    ('four-bar', 4)
    """

    linkage: OnSurface
    chain: str
    motion: SurfaceMotion
    reach: float
    gap: float
    holds: float

    @property
    def arcs(self) -> dict[LinkId, float]:
        """How far each link goes round the cone, radians."""
        chain = self.motion.chain
        lengths = link_arcs(chain, np.asarray(self.linkage.places))[:, 1].tolist()
        return dict(zip(chain.links, lengths, strict=True))

    @property
    def meets(self) -> tuple[float, ...]:
        """Turns of the driving joint on the way at which another circuit meets this one, radians."""
        low, high = sorted((0.0, self.reach))
        return tuple(turn for turn in self.motion.meets if low <= turn <= high)

    @property
    def range(self) -> float:
        """The whole range of the driving joint, radians; a turn, where it turns all round."""
        motion = self.motion
        return tau if motion.turns_fully else motion.forward.limit - motion.backward.limit


@dataclass(frozen=True, eq=False, repr=False)
class ConeDesigns(Printed):
    """Linkages on a cone of a half angle that keep to one side of it for a turn of the driving joint.

    Attributes
    ----------
    half_angle, size : float
        Of the cone, radians; length of its ruling lines.
    side : "outside" or "inside"
    turn : float
        Turn of the driving joint for which links stay there, radians.
    links : tuple of link id
        The links that do; all moving ones if it is empty.
    designs : tuple of ConeDesign
        Those with the largest margins first.
    possible, moved : int
        Number of candidates that leave on that side to first order, and of those that were moved.
    changed : int
        Number of those whose azimuths changed until they kept to the side.

    Examples
    --------
    >>> design_on_cone(np.radians(25), np.radians(60), tries=2).moved
    2
    """

    half_angle: float
    size: float
    side: Side
    turn: float
    links: tuple[str, ...]
    designs: tuple[ConeDesign, ...]
    possible: int
    moved: int
    changed: int = 0

    @property
    def rim(self) -> float:
        """Radius of the rim, in the unit of the size."""
        return self.size * sin(self.half_angle)

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        cone = Cone(pi / 2 - self.half_angle)
        which = "all moving links" if not self.links else "link " + ", ".join(map(plain, self.links))
        found = numbered(len(self.designs), "linkage")
        first = f"{found}: {which} {self.side} the cone for {degrees(self.turn):g}° of the driving joint or more"
        sizes = f"{cone}; ruling lines {self.size:g} mm, radius of the rim {self.rim:.4g} mm"
        search = (
            f"moved {self.moved} of {numbered(self.possible, 'linkage')} on a grid of {degrees(_GRID):g}° that leave "
            f"the cone {'outward' if self.side == 'outside' else 'inward'} to first order; others may do it too"
        )
        if self.changed:
            search += f"; changed azimuths of {self.changed} until links kept to the side"
        heads = (
            "no", "chain", "joint azimuths (deg)", "link sizes at the rim (mm)", "driver", self.side + " to",
            "to spare", "range", "joints apart (mm)", "holds to", "note",
        )  # fmt: skip
        rows = [self._row(number, design) for number, design in enumerate(self.designs, start=1)]
        table: list[Block] = [TableBlock(heads, rows, ("no", *heads[5:-1]))] if rows else []
        return [first, sizes, *table, search]

    def _row(self, number: int, design: ConeDesign) -> tuple[str, ...]:
        azimuths = " ".join(f"{round(degrees(place), 1):g}" for place in design.linkage.places)
        sizes = ", ".join(f"{plain(link)}: {self.rim * arc:.1f}" for link, arc in design.arcs.items())
        holds = "less than 1°" if design.holds < _ERRORS[0] else f"±{design.holds:g}°"
        turns = ", ".join(f"{degrees(turn):.1f}°" for turn in design.meets)
        note = f"another circuit meets it at {turns}" if turns else ""
        whole = "all round" if design.motion.turns_fully else f"{degrees(design.range):.1f}°"
        return (
            str(number), design.chain, azimuths, sizes, plain(design.motion.driver), f"{degrees(design.reach):.1f}°",
            f"{degrees(abs(design.reach) - self.turn):.1f}°", whole, f"{self.rim * design.gap:.1f}", holds, note,
        )  # fmt: skip

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "half_angle_deg": degrees(self.half_angle),
            "lambda_deg": 90.0 - degrees(self.half_angle),
            "size": self.size,
            "rim_radius": self.rim,
            "side": self.side,
            "turn_deg": degrees(self.turn),
            "links": list(self.links),
            "possible": self.possible,
            "moved": self.moved,
            "changed": self.changed,
            "designs": [
                {
                    "chain": design.chain,
                    "ground": design.motion.chain.links[0],
                    "driver": str(design.motion.driver),
                    "azimuths_deg": {
                        str(joint): degrees(place)
                        for joint, place in zip(design.motion.chain.joints, design.linkage.places, strict=True)
                    },
                    "rim_sizes": {str(link): self.rim * arc for link, arc in design.arcs.items()},
                    "reach_deg": degrees(design.reach),
                    "range_deg": degrees(design.range),
                    "joints_apart": self.rim * design.gap,
                    "holds_to_deg": design.holds,
                    "meets_deg": list(map(degrees, design.meets)),
                }
                for design in self.designs
            ],
        }

    def __repr__(self) -> str:
        return f"<ConeDesigns: {numbered(len(self.designs), 'linkage')}>"


def design_on_cone(
    half_angle: float,
    turn: float,
    *,
    links: Literal[4, 6] = 4,
    side: Side = "outside",
    keeping: Sequence[str] = (),
    least_range: float = 0.0,
    size: float = 120.0,
    count: int = 8,
    tries: int = 60,
    seed: int = 0,
) -> ConeDesigns:
    """Find linkages on a cone whose links stay outside, or inside, for a turn of the driving joint.

    Parameters
    ----------
    half_angle : float
        Between the axis and a ruling line, radians; lambda is its complement.
    turn : float
        Turn of the driving joint from the conformed position, in one sense, radians.
    links : {4, 6}, optional
        Number of links, the fixed one too: four-bars, or the chains of Watt and Stephenson, each fixed link.
    side : {"outside", "inside"}, optional
    keeping : sequence of str, optional
        Links that have to stay on that side; by default all that move.
    least_range : float, optional
        The whole range that the driving joint must have, radians.
    size : float, optional
        Length of the ruling lines, millimetres.
    count, tries : int, optional
        Largest numbers of linkages to return, and to move.
    seed : int, optional
        Random seed for six links; four-bars on the grid are all looked at.

    Returns
    -------
    ConeDesigns
        Azimuths of joints are multiples of ten degrees, no two nearer than twenty; where no such linkage keeps
        to the side, there are some whose azimuths were changed until they did.

    Raises
    ------
    InvariantError
        If an angle, a size or a number is out of range, or there is no such link.

    Examples
    --------
    >>> designs = design_on_cone(np.radians(25), np.radians(60), tries=4)
    >>> all(abs(design.reach) >= np.radians(60) for design in designs.designs)
    True
    """
    _check(half_angle, turn, links, side, size, min(count, tries))
    cone, sign = Cone(pi / 2 - half_angle), Way.OUTWARD if side == "outside" else Way.INWARD
    designs: list[ConeDesign] = []
    short: list[tuple[ConeDesign, ConformedChain, list[int]]] = []
    possible = moved = changed = 0
    chains = list(_chains(links, keeping))
    share = max(1, tries // len(chains))
    for name, chain in chains:
        prepared = ConformedChain.of(chain)
        numbers = [prepared.links.index(link_named(chain, link)) for link in keeping]
        rows = _without_half_turns(prepared, _candidates(len(prepared.joints), seed))
        leaving = rows[_leaves(prepared, np.asarray(rows * _GRID, dtype=np.float64), numbers)]
        possible += len(leaving)
        for row in _spread(leaving, share):
            moved += 1
            design = _moved(name, OnSurface(chain, (row * _GRID).tolist(), cone), prepared, numbers, sign)
            if design is None or design.range < least_range:
                continue
            if abs(design.reach) >= turn:
                designs.append(design)
            elif design.reach:
                short.append((design, prepared, numbers))
    designs.sort(key=_order)
    short.sort(key=lambda one: -round(abs(one[0].reach), 9))
    for design, prepared, numbers in [] if designs else short[: min(_CHANGED, count)]:
        better = _changed(design, prepared, numbers, sign, turn)
        if better is not None and abs(better.reach) >= turn and better.range >= least_range:
            changed += 1
            designs.append(better)
    return ConeDesigns(half_angle, size, side, turn, tuple(keeping), tuple(designs[:count]), possible, moved, changed)


def _changed(
    design: ConeDesign, chain: ConformedChain, numbers: Sequence[int], way: Way, turn: float
) -> ConeDesign | None:
    """Return a linkage nearby whose links keep to the side for the turn, by least squares; None if there is none."""
    cone, places = design.linkage.surface, np.asarray(design.linkage.places)
    assert isinstance(cone, Cone)
    half = pi / 2 - cone.angle
    goal = Goal(at_least=half + _SPARE) if way == Way.OUTWARD else Goal(at_most=half - _SPARE)
    angles = np.copysign(turn, design.reach) * np.arange(1, _AT + 1) / _AT
    driver = str(design.motion.driver)
    names = [f"turned {number}" for number in range(_AT)]
    configurations = tuple(
        WishedConfiguration(name, {driver: angle}) for name, angle in zip(names, angles.tolist(), strict=True)
    )
    arcs = link_arcs(chain, places)
    wishes: list[Wish] = []
    for number in numbers or range(1, len(chain.links)):
        joints = list(chain.joints_of[number])
        first, last = (
            joints[int(np.abs(_wrapped(places[joints] - azimuth)).argmin())]
            for azimuth in (arcs[number, 0], arcs[number].sum())
        )
        ends = (str(chain.joints[first]), str(chain.joints[last]))
        wishes += [
            ConeSide(at=one.name, link=str(chain.links[number]), ends=ends, parts=_ALONG, goal=goal)
            for one in configurations
        ]
    family = ConeDimensions(design.linkage, fixed=["cone_angle", str(chain.joints[0])])
    problem = DesignProblem(family, Wishes(tuple(wishes), configurations, driver=driver))
    found = found_from(problem, family.start, seeded("cone", 0))
    if found is None or found.error > DOUBLE.closed:
        return None
    moved = [float(places[0]), *found.numbers.tolist()]
    if _least_gap(np.array(moved)) < _LEAST_GAP * _GRID / 2:
        return None
    return _moved(design.chain, OnSurface(design.linkage.chain, moved, cone), chain, numbers, way)


def _wrapped(angles: Floats) -> Floats:
    return np.asarray(np.remainder(angles + pi, tau) - pi)


def _order(design: ConeDesign) -> tuple[float, ...]:
    """Return a key by which linkages are sorted: those that meet no other circuit, with large margins, first."""
    return bool(design.meets), -design.holds, -round(design.gap, 9), -round(abs(design.reach), 9)


def _check(half_angle: float, turn: float, links: int, side: str, size: float, least: int) -> None:
    if not (isfinite(half_angle) and 0.0 < half_angle < pi / 2):
        raise InvariantError("half angle", f"the half angle is {degrees(half_angle):g} degrees", "between 0 and 90")
    if not 0.0 < turn <= tau:
        raise InvariantError("turn", f"a turn of {degrees(turn):g} degrees", "more than 0, and 360 at most")
    if links not in _CHAINS:
        raise InvariantError("links", f"{links} links", "4 or 6")
    if side not in ("outside", "inside"):
        raise InvariantError("side", f"{shown(side)} is no side of a cone", "outside or inside")
    if not (isfinite(size) and size > 0.0):
        raise InvariantError("size", f"ruling lines of length {size:g}", "a positive length")
    if least < 1:
        raise InvariantError("count", f"{least} linkages", "1 or more")


def _chains(links: int, keeping: Collection[str]) -> Iterator[tuple[str, SCGraph]]:
    """Yield the chains of a number of links, each with each ground link that is another to its symmetry."""
    if links == 4:
        yield "four-bar", ring(4)
        return
    for name in _CHAINS[links]:
        chain = read(chain_named(name))
        assert isinstance(chain, SCGraph)
        seen = set()
        for link in chain:
            around = tuple(sorted(chain.degree(other) for other in chain.neighbors(link)))
            if (chain.degree(link), around) not in seen and str(link) not in keeping:
                seen.add((chain.degree(link), around))
                yield name, SCGraph(list(chain), chain.joints, chain.loops, ground=link)


def _candidates(joints: int, seed: int) -> Ints:
    """Return places of joints on the grid, int[C, J]: all for few joints, else a sample of them."""
    if joints <= _LISTED:
        rows = np.array([(0, *rest) for rest in permutations(range(1, _SLOTS), joints - 1)])
    else:
        random = np.random.default_rng([seed, joints])
        order = np.argsort(random.random((_SAMPLES, _SLOTS - 1)), axis=1)[:, : joints - 1] + 1
        rows = np.column_stack([np.zeros(_SAMPLES, dtype=np.int64), order])
    mirrored = -rows % _SLOTS
    first = np.argmax(rows != mirrored, axis=1)[:, None]  # a mirror image moves alike, the driver the other way
    rows = rows[(np.take_along_axis(rows, first, 1) <= np.take_along_axis(mirrored, first, 1))[:, 0]]
    return np.asarray(rows[_gaps(rows) >= _LEAST_GAP])


def _gaps(rows: Ints) -> Ints:
    """Return the least distance of two joints round the axis, in steps of the grid: int[C]."""
    ordered = np.sort(rows, axis=-1)
    return np.asarray(np.diff(ordered, axis=-1, append=ordered[..., :1] + _SLOTS).min(axis=-1))


def _without_half_turns(chain: ConformedChain, rows: Ints) -> Ints:
    """Return the places at which no link spans half a turn, which could curve either way."""
    pairs = [pair for joints in chain.joints_of for pair in combinations(joints, 2)]
    half = np.any([(rows[:, a] - rows[:, b]) % _SLOTS == _SLOTS // 2 for a, b in pairs], axis=0)
    return np.asarray(rows[~half])


def _leaves(chain: ConformedChain, places: Floats, numbers: Sequence[int]) -> Flags:
    """Return which linkages leave the cone on one side to first order: all moving links, or those of some numbers."""
    first_order = behaviour(chain, places)
    if not numbers:
        return np.asarray(first_order.one_way)
    ways = first_order.ways[..., list(numbers)]
    return np.asarray((np.abs(ways) == 1).all(axis=-1) & (ways == ways[..., :1]).all(axis=-1))


def _spread(rows: Ints, count: int) -> Ints:
    """Return some candidates: half of them among those with the widest gaps, the others among all."""
    order = np.lexsort((*rows.T[::-1], -_gaps(rows))) if len(rows) else np.zeros(0, dtype=np.int64)
    wide = order[_evenly(min(len(order), 2 * count), (count + 1) // 2)]
    other = np.setdiff1d(order, wide, assume_unique=True)
    return np.asarray(rows[np.concatenate([wide, other[_evenly(len(other), count // 2)]])])


def _evenly(number: int, count: int) -> Ints:
    """Return places of a list of a length, evenly spread."""
    return np.unique(np.linspace(0, number - 1, min(number, count)).round().astype(np.int64))


def _moved(name: str, linkage: OnSurface, chain: ConformedChain, numbers: Sequence[int], way: Way) -> ConeDesign | None:
    """Return a linkage moved all round; None if it has another freedom, or its curve is lost."""
    try:
        motion = move_on_surface(linkage)
    except (UnsolvableError, InvariantError, NumericalError):  # nothing drives it, or more than one freedom
        return None
    links = [chain.links[number] for number in numbers or range(1, len(chain.links))]
    reach = max((_reach(sense, links, way) for sense in (motion.backward, motion.forward)), key=abs)
    places = np.array(linkage.places)
    return ConeDesign(linkage, name, motion, reach, _least_gap(places), _holds(chain, places, numbers))


def _reach(sense: Sense, links: Sequence[LinkId], way: Way) -> float:
    """Return the turn of the driving joint up to which links keep to a side from the beginning; 0 if they do not."""
    ends = []
    for link in links:
        stretches = sense.ways[link]
        if not stretches or stretches[0].way not in (way, Way.STILL):
            return 0.0
        ends += [stretches[0].end] if stretches[0].way == way else []
    return min(ends, key=abs, default=0.0)


def _least_gap(places: Floats) -> float:
    ordered = np.sort(np.remainder(places, tau))
    return float(np.diff(ordered, append=ordered[0] + tau).min())


def _holds(chain: ConformedChain, places: Floats, numbers: Sequence[int]) -> float:
    """Return the largest of some errors of azimuths, degrees, each either way, that leave the behaviour as it is."""
    signs = np.array(list(product((-1.0, 1.0), repeat=len(places))))
    held = 0.0
    for error in _ERRORS:
        if not _leaves(chain, places + radians(error) * signs, numbers).all():
            break
        held = error
    return held
