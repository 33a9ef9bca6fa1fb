"""A type with one centre as a linkage on a right cone: where its joint axes lie round it, the arcs of its links.

Theory: docs/theory/realisation.md, docs/theory/multiloop.md.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import degrees, isfinite, pi, radians
from typing import Any

import numpy as np

from graphs.convert.conversions import kind_in_words, to_sc
from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Pair, SurfaceLinkage
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.rank.exact import exact_mobility
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.realisation.measures import first_order_freedoms
from synth.catalogue.realisation.pattern import check_search
from synth.linkages.conformed.orders import CandidateRow, candidate_for
from synth.linkages.conformed.rates import ConformedChain, first_order
from synth.linkages.surfaces.circuit import link_pairs, loop_steps, wrapped
from synth.linkages.surfaces.linkage_maps import by_sizes, map_linkage

CONE_ANGLE = radians(30.0)
"""The default of lambda."""

_OTHER_QUESTION = "realise gives a type new coordinates, those on a cone, and takes no branch"
_VARIED = 0.35
_CLEAR = radians(15.0)
"""Least distance to aim at of a step within a link from zero and from a half turn, which has no sign."""
_MAPPED = 8
"""Most links of a loop whose cones are searched for: sign patterns double with each."""


@dataclass(frozen=True, slots=True)
class ConeRealisation(Printed):
    """A linkage on a cone, of a type with one centre; its joint axes are ruling lines.

    Attributes
    ----------
    linkage : SurfaceLinkage
        With its steps and lambda, as ``synth cone`` reads it.
    clear : float
        How near a step between two joints of a link comes to zero or to a half turn, radians.
    circuits : tuple of {"open", "crossed"}
        One per loop.
    mobility : int
        Exact generic mobility of the type.
    freedoms : int or None
        First-order freedoms at this configuration; None where singular values do not decide.
    cones : int or None
        How many cones the link arcs alone lead to, this one among them; None where they were not searched for.
    number, tries : int
        Number of this try, and the largest number of tries.
    """

    linkage: SurfaceLinkage
    clear: float
    circuits: tuple[str, ...]
    mobility: int
    freedoms: int | None
    cones: int | None
    number: int
    tries: int

    @property
    def cone_angle(self) -> float:
        """lambda, radians."""
        assert isinstance(self.linkage.surface, Cone)
        return self.linkage.surface.angle

    @property
    def arcs(self) -> dict[Pair, float]:
        """The arc of each link between two of its joints, radians."""
        return dict(by_sizes(self.linkage).angles or {})

    @property
    def rank(self) -> tuple[bool, float, int]:
        """Key of the choice: whether it moves as the type, how clear its steps are, how many loops are open."""
        return self.freedoms == self.mobility, min(self.clear, _CLEAR), self.circuits.count("open")

    @property
    def good(self) -> bool:
        """Whether the search can end with it."""
        return self.rank == (True, _CLEAR, len(self.circuits))

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        chain = self.linkage.chain
        return {
            "kind": "cone",
            "configuration": configuration_of(self.linkage).to_json(other_question=_OTHER_QUESTION),
            "lambda_deg": degrees(self.cone_angle),
            "half_angle_deg": 90.0 - degrees(self.cone_angle),
            "steps_deg": [[a, b, degrees(x)] for (a, b), x in (self.linkage.steps or {}).items()],
            "link_angles_deg": [[a, b, degrees(x)] for (a, b), x in self.arcs.items()],
            "loops": [list(loop.joints) for loop in chain.loops],
            "circuit": list(self.circuits),
            "clear_deg": degrees(self.clear),
            "mobility": self.mobility,
            "freedoms": self.freedoms,
            "cones_by_link_angles": self.cones,
            "try": self.number,
            "tries": self.tries,
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        chain = self.linkage.chain
        sizes = str(chain).removeprefix(type(chain).__name__)
        azimuths = zip(chain.joints, self.linkage.places(), strict=True)
        link_of = link_pairs(chain)
        rows = [
            (plain(link_of[pair]), plain(" ".join(map(str, pair))), f"{degrees(arc):.6g}")
            for pair, arc in self.arcs.items()
        ]
        return [
            f"linkage on a cone of lambda {degrees(self.cone_angle):.6g}° (half angle "
            f"{90.0 - degrees(self.cone_angle):.6g}°): {kind_in_words(chain)}{sizes}",
            "azimuths (deg)  " + ", ".join(f"{plain(joint)} {degrees(t):.6g}" for joint, t in azimuths),
            TableBlock(("link", "joints", "arc (deg)"), rows, numbers=["arc (deg)"]),
            "circuits " + ", ".join(self.circuits) + f"; all steps of links at least "
            f"{degrees(self.clear):.3g}° from 0° and from 180°",
            f"mobility {self.mobility}, exact; {first_order_freedoms(self.freedoms)} at this configuration",
            f"cones with these arcs were not searched for: a loop has more than {_MAPPED} links"
            if self.cones is None
            else f"cones with these arcs: {self.cones}, this one included",
            f"try {self.number + 1} of at most {self.tries}",
        ]

    def __repr__(self) -> str:
        return f"<ConeRealisation: lambda {degrees(self.cone_angle):.6g} degrees, {self.linkage.chain!r}>"


def realise_on_cone(
    mechanism: MechanismLike | CandidateRow, *, cone_angle: float = CONE_ANGLE, seed: int = 0, tries: int = 12
) -> ConeRealisation:
    """Lay the joint axes of a type with one centre round a right cone.

    Parameters
    ----------
    mechanism : anything that has an SC graph, or dict
        All its loops have one finite centre. A row of `conical_candidates`, or of a list of them in JSON lines, is
        laid in its own order of joints, as `realise_candidate` does.
    cone_angle : float, optional
        lambda, the angle between a ruling line and the plane perpendicular to the axis, radians.
    seed : int, optional
        Another seed gives another linkage; the same gives the same.
    tries : int, optional
        Largest number of linkages that are tried. The first that moves as its type does, with all loops open,
        is chosen, or else the best.

    Raises
    ------
    UnsolvableError
        If the type has no loop, a spatial one, or not one finite centre.
    InvariantError
        If an option is out of its range.
    ArgumentError
        If it is neither a mechanism nor a row of conical candidates.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> on_cone = realise_on_cone(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]))
    >>> on_cone.circuits, on_cone.freedoms, len(on_cone.arcs)
    (('open',), 1, 4)
    """
    if isinstance(mechanism, Mapping):
        order = candidate_for("realise_on_cone", mechanism)
        return realise_candidate(order.chain, order.azimuths, cone_angle=cone_angle, seed=seed, tries=tries)
    mechanism = mechanism_for("realise_on_cone", mechanism)
    _check_cone(cone_angle, seed, tries)
    chain = _about_one_centre(to_sc(mechanism))
    best = _best(chain, _placements(chain, seed, tries), cone_angle, tries)
    return replace(best, cones=_cones(best.linkage, cone_angle))


def realise_candidate(
    chain: SCGraph, azimuths: Sequence[float], *, cone_angle: float = CONE_ANGLE, seed: int = 0, tries: int = 12
) -> ConeRealisation:
    """Lay a conical candidate round a right cone: at its azimuths if it moves there, else near them, in their order.

    It is laid near them, too, if its arcs do not determine the cone: those of a kite lie on all cones of an interval.

    Parameters
    ----------
    chain : SCGraph
    azimuths : float[J]
        Of the joints, radians, in the order of the chain's joints: of a row of `conical_candidates`.
    cone_angle, seed, tries
        As for `realise_on_cone`, as are the errors.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> on_cone = realise_candidate(chain, np.radians([0, 90, 180, 270]))
    >>> on_cone.linkage.places(), on_cone.freedoms, on_cone.circuits
    ([0.0, 1.5707963267948966, 3.141592653589793, 4.71238898038469], 1, ('open',))
    """
    _check_cone(cone_angle, seed, tries)
    at = np.asarray(azimuths, dtype=float)
    best = _best(chain, iter([at]), cone_angle, tries)
    if best.freedoms == best.mobility and best.clear > _CLEAR_ENOUGH:
        try:
            return replace(best, cones=_cones(best.linkage, cone_angle))
        except UnsolvableError:  # arcs that fold flat, as those of a kite, fit all cones of an interval
            first = 1
    else:
        first = 0
    best = _best(chain, islice(_placements_near(at, seed, tries), first, None), cone_angle, tries)
    return replace(best, cones=_cones(best.linkage, cone_angle))


_CLEAR_ENOUGH = radians(1.0)
"""A candidate keeps its own azimuths if its steps are as far from zero and half a turn."""


def _check_cone(cone_angle: float, seed: int, tries: int) -> None:
    if not (isfinite(cone_angle) and 0.0 < cone_angle < pi / 2):
        raise InvariantError(
            "cone angle", f"lambda is {degrees(cone_angle):.6g} degrees", "more than 0 and less than 90"
        )
    check_search(seed, tries)


def _best(chain: SCGraph, placements: Iterator[Floats], cone_angle: float, tries: int) -> ConeRealisation:
    """Return the first linkage that moves as its type does, with clear steps and open loops, or else the best."""
    conformed, mobility = ConformedChain.of(chain), exact_mobility(chain).mobility
    best: ConeRealisation | None = None
    for number, places in enumerate(placements):
        motion = first_order(conformed, places)
        candidate = ConeRealisation(
            linkage=SurfaceLinkage.placed(chain, places.tolist(), Cone(cone_angle)),
            clear=_clear(chain, places),
            circuits=tuple(str(loop.circuits.names()) for loop in loop_steps(chain, places)),
            mobility=mobility,
            freedoms=None if motion.undecided else int(motion.freedoms),
            cones=None,
            number=number,
            tries=tries,
        )
        if best is None or candidate.rank > best.rank:
            best = candidate
        if best.good:
            break
    assert best is not None
    return best


def _about_one_centre(sc: SCGraph) -> SCGraph:
    """Return the chain with its loops; refuse one whose axes do not all meet in a point."""
    if not sc.loops:
        raise UnsolvableError("the type has no loops; expected a linkage whose axes meet in one centre")
    if sc.spatial_loops:
        raise UnsolvableError(
            f"the type has {numbered(sc.spatial_loops, 'loop')} without a centre; expected one centre of all axes"
        )
    centres = sc.centre_classes()
    if len(centres) > 1:
        raise UnsolvableError(
            f"the type has {len(centres)} centres; expected one; try its spherical analogue: "
            "synth convert --form spherical"
        )
    if centres[0].centre is Centre.INFINITE:
        raise UnsolvableError("the centre is at infinity, so the axes are on a cylinder; expected a finite centre")
    return SCGraph(list(sc), sc.joints, sc.loops, ground=sc.ground)


def _placements(chain: SCGraph, seed: int, tries: int) -> Iterator[Floats]:
    """Yield azimuths of the joints: those of each loop in turn, then in random orders.

    Gaps are never all alike: a loop of equal arcs is special, and changes branches where it folds together.
    """
    number = {joint: place for place, joint in enumerate(chain.joints)}
    along = dict.fromkeys(number[joint] for loop in chain.loops for joint in loop.joints)
    order = np.array([*along, *(place for place in number.values() if place not in along)])
    for attempt in range(tries):
        random = np.random.default_rng((seed, attempt))
        gaps = np.exp(_VARIED * random.standard_normal(len(order)))
        places = np.zeros(len(order))
        places[random.permutation(order) if attempt else order] = np.cumsum([0.0, *gaps[:-1]])
        yield 2.0 * np.pi * places / gaps.sum()


def _placements_near(azimuths: Floats, seed: int, tries: int) -> Iterator[Floats]:
    """Yield azimuths in the same cyclic order, with other gaps: each time another part of those of the candidate."""
    order = np.argsort(azimuths % (2.0 * np.pi), kind="stable")
    gaps = np.diff(np.append(azimuths[order], azimuths[order[0]] + 2.0 * np.pi) % (2.0 * np.pi)) % (2.0 * np.pi)
    for attempt in range(tries + 1):
        random = np.random.default_rng((seed, attempt))
        varied = gaps * (1.0 if attempt == 0 else np.exp(_VARIED * random.standard_normal(len(order))))
        places = np.empty(len(order))
        places[order] = np.cumsum([0.0, *varied[:-1]]) * (2.0 * np.pi / varied.sum())
        yield places


def _clear(chain: SCGraph, places: Floats) -> float:
    """Return how near steps between joints of a link come to zero or to a half turn."""
    at = dict(zip(chain.joints, places.tolist(), strict=True))
    steps = np.abs(wrapped([at[b] - at[a] for a, b in link_pairs(chain)]))
    return float(np.minimum(steps, np.pi - steps).min())


def _cones(linkage: SurfaceLinkage, angle: float) -> int | None:
    """Return the number of cones with these link arcs; None if there are too many links to search.

    Raises `UnsolvableError` if the cone that they were laid on is none of these.
    """
    if max(len(loop.joints) for loop in linkage.chain.loops) > _MAPPED:
        return None
    surfaces = [mapped.surface for mapped in map_linkage(by_sizes(linkage)).surfaces]
    angles = np.sort([surface.angle for surface in surfaces if isinstance(surface, Cone)])
    if not (np.abs(angles - angle) < DOUBLE.same_configuration).any():
        raise UnsolvableError(f"the link arcs do not lead back to lambda {degrees(angle):.6g} degrees")
    return 1 + int((np.diff(angles) > DOUBLE.same_configuration).sum())  # two roots near each other: one cone
