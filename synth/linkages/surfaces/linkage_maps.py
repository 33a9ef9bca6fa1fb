"""Linkages on cones or cylinders: of several loops, and those on the joint lines of a spherical four-bar.

A loop has a few surfaces, and all loops must have one in common, with the same sign for a link that two of them
use. A link of three joints or more whose sizes are all known is a loop of its own, and fixes the surface by
itself. Sizes are link angles, on cones, or lengths, on cylinders. Source: Hyatt et al. 2020, sections 2.3 and 7.
Theory: docs/theory/multiloop.md, docs/theory/four-bars.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import cos, degrees, inf
from typing import Any

import networkx as nx
import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, Pair, Surface, SurfaceLinkage, places_of_steps
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.linkages.fourbar.closing import ILL_CONDITIONED, checked_link_angles, spherical_differences, supplementary
from synth.linkages.surfaces import loop_maps
from synth.linkages.surfaces.circuit import HALF_TURN, circuits, link_angles, link_pairs, loop_steps, wrapped
from synth.linkages.surfaces.loop_sums import LoopRoots, loop_roots, put_together, sign_patterns, sum_rounding
from synth.linkages.surfaces.mapping import (
    SizedLinks,
    in_a_family,
    in_degrees,
    interval_json,
    is_in,
    is_size,
    joints_text,
    reach_at,
    signs_text,
    size_of,
    typical_size,
)


@dataclass(frozen=True, slots=True)
class LinkageMap(Printed):
    """The cones, or the cylinders, on which a linkage lies.

    Attributes
    ----------
    linkage : SurfaceLinkage
    surfaces : tuple of CommonSurface
    families : tuple of CommonFamily
        Intervals of cones or cylinders.
    """

    linkage: SurfaceLinkage
    surfaces: tuple[CommonSurface, ...]
    families: tuple[CommonFamily, ...]

    def rows(self) -> tuple[CommonSurface, ...]:
        """Return the numbered surfaces that are printed; of each family a typical one, amid its interval."""
        of_kind = Cone if self.linkage.kind == "cone" else Cylinder
        return (
            *self.surfaces,
            *(_member(self.linkage, one, of_kind(typical_size(one.interval))) for one in self.families),
        )

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        blocks = [block for number, one in enumerate(self.surfaces, 1) for block in self._of_surface(number, one)]
        for number, family in enumerate(self.families, len(self.surfaces) + 1):
            loops = "; ".join(
                f"{joints_text(loop.joints)}: {signs_text(signs)}, k {turns}"
                for loop, signs, turns in zip(self.linkage.chain.loops, family.signs, family.turns, strict=True)
            )
            low, high = family.interval
            every = f"lambda between {degrees(low):.10g} and {degrees(high):.10g} degrees"
            if self.linkage.kind == "cylinder":
                every = f"radius from {low:.10g} on"
            blocks.append(f"{self.linkage.kind} {number}: every {every}   ({loops})")
            blocks += [family.caution] if family.caution else []
        return blocks or [f"no {self.linkage.kind} is common to all loops"]

    def _of_surface(self, number: int, common: CommonSurface) -> list[Block]:
        chain, surface = self.linkage.chain, common.surface
        link_of = link_pairs(chain)
        loops = [
            (joints_text(loop.joints), circuit, signs_text(signs), str(turns))
            for loop, circuit, signs, turns in zip(
                chain.loops, common.circuits, common.signs, common.turns, strict=True
            )
        ]
        rows = [
            (plain(link_of[pair]), joints_text(pair), *(f"{size:.8g}" for size in sizes))
            for pair, sizes in _sizes_and_chords(self.linkage, common).items()
        ]
        heads = ["length"] if isinstance(surface, Cylinder) else ["angle (deg)", "chord"]
        blocks: list[Block] = [
            f"{surface.kind} {number}: {surface}"
            + ("" if isinstance(surface, Cylinder) else f", R {cos(surface.angle):.8g}"),
            *([common.caution] if common.caution else []),
            TableBlock(("loop", "circuit", "signs", "k"), loops, ["k"]),
            TableBlock(("link", "joints", *heads), rows, heads),
        ]
        if isinstance(surface, Cylinder):
            blocks.append(_coordinates_table(surface, common.places))
        return blocks

    def __repr__(self) -> str:
        links = numbered(len(self.linkage.chain), "link")
        return f"<LinkageMap: {links}, {numbered(len(self.surfaces), self.linkage.kind)}>"

    def to_json(self) -> dict[str, Any]:
        """Return plain data (docs/command-json.md): circuit, signs and k are lists with one item per loop."""
        on_cone = self.linkage.kind == "cone"
        return {
            "loops": [list(map(str, loop.joints)) for loop in self.linkage.chain.loops],
            "cones" if on_cone else "cylinders": [
                {
                    **_size_json(one.surface),
                    "circuit": list(one.circuits),
                    "signs": [list(signs) for signs in one.signs],
                    "k": list(one.turns),
                    "azimuths_deg": dict(zip(map(str, one.places), in_degrees(one.places.values()), strict=True)),
                    **self._sizes_json(one),
                    "residual_deg": degrees(one.residual),
                    "caution": one.caution or None,
                }
                for one in self.surfaces
            ],
            "families": [
                {
                    **interval_json(family.interval, angular=on_cone),
                    "signs": [list(signs) for signs in family.signs],
                    "k": list(family.turns),
                    "caution": family.caution or None,
                }
                for family in self.families
            ],
        }

    def _sizes_json(self, common: CommonSurface) -> dict[str, Any]:
        sizes = _sizes_and_chords(self.linkage, common)
        first = [[str(a), str(b), size[0]] for (a, b), size in sizes.items()]
        if isinstance(common.surface, Cylinder):
            points = _coordinates(common.surface, common.places)
            return {"link_lengths": first, "coordinates": {str(joint): at for joint, at in points.items()}}
        return {"link_angles_deg": first, "chords": [[str(a), str(b), size[1]] for (a, b), size in sizes.items()]}


def _size_json(surface: Surface) -> dict[str, float]:
    if isinstance(surface, Cylinder):
        return {"radius": surface.radius}
    angle = degrees(surface.angle)
    return {"lambda_deg": angle, "half_angle_deg": 90.0 - angle, "R": cos(surface.angle)}


def _sizes_and_chords(linkage: SurfaceLinkage, common: CommonSurface) -> dict[Pair, tuple[float, ...]]:
    """Return the lengths of links, or their angles in degrees and the chords of these."""
    sizes = sizes_on(linkage, common.surface, common.places)
    if isinstance(common.surface, Cylinder):
        return {pair: (size,) for pair, size in sizes.items()}
    return {pair: (in_degrees([size])[0], float(loop_maps.cone_chords(size))) for pair, size in sizes.items()}


def sizes_on(linkage: SurfaceLinkage, surface: Surface, places: Mapping[JointId, float]) -> dict[Pair, float]:
    """Return the link angles, radians, or lengths between all joints of each link on a surface."""

    def size(step: float) -> float:
        if isinstance(surface, Cylinder):
            return float(loop_maps.chords(step, surface.radius))
        return float(link_angles(step, surface.angle))

    return {(a, b): size(places[b] - places[a]) for a, b in link_pairs(linkage.chain) if a in places and b in places}


def _coordinates(surface: Cylinder, places: Mapping[JointId, float]) -> dict[JointId, list[float]]:
    """Return where joints are across the axis."""
    return dict(zip(places, loop_maps.joint_coordinates(surface.radius, list(places.values())).tolist(), strict=True))


def _coordinates_table(surface: Cylinder, places: Mapping[JointId, float]) -> TableBlock:
    """Return the azimuths and coordinates of joints as they are printed."""
    rows = [
        (plain(joint), *(f"{value + 0.0:.8g}" for value in (*in_degrees([places[joint]]), *at)))
        for joint, at in _coordinates(surface, places).items()
    ]
    heads = ["azimuth (deg)", "x", "y"]
    return TableBlock(("joint", *heads), rows, heads)


def by_sizes(linkage: SurfaceLinkage) -> SurfaceLinkage:
    """Return a linkage of steps on a surface as one of all its link angles or lengths; one of sizes unchanged.

    Parameters
    ----------
    linkage : SurfaceLinkage
        `UnsolvableError` if it has steps and no surface.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> steps = {(0, 1): np.pi / 2, (1, 2): np.pi / 2, (2, 3): np.pi / 2}
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> round(degrees(by_sizes(SurfaceLinkage(chain, steps=steps, surface=Cone(np.pi / 4))).angles[1, 2]), 9)
    60.0
    """
    if linkage.steps is None:
        return linkage
    if linkage.surface is None:
        missing = "lengths; expected 'radius'" if linkage.kind == "cylinder" else "link angles; expected 'lambda_deg'"
        raise UnsolvableError(f"steps without a {linkage.kind} have no {missing}")
    at = dict(zip(linkage.chain.joints, linkage.places(), strict=True))
    sizes = sizes_on(linkage, linkage.surface, at)
    if linkage.kind == "cylinder":
        return SurfaceLinkage(linkage.chain, lengths=sizes)
    return SurfaceLinkage(linkage.chain, angles=sizes)


def map_linkage(mechanism: MechanismLike, tolerance: float = 1e-7, surface: Surface | None = None) -> LinkageMap:
    """Return the surfaces of a linkage: from the sizes of links, or, for steps, its own surface or every one.

    Parameters
    ----------
    mechanism : SurfaceLinkage, or the path of its file
    tolerance : float, optional
        How well its loops must close together, radians; a loop of less than a turn in proportion.
    surface : Cone or Cylinder, optional
        For sizes of links: only this surface, of those on which they lie.

    Examples
    --------
    >>> map_linkage(SurfaceLinkage.loop(np.radians([120, 95, 45, 85])))
    <LinkageMap: 4 links, 2 cones>
    """
    linkage = mechanism_for("map_linkage", mechanism, SurfaceLinkage)
    if linkage.sizes is not None:
        by_lengths = linkage.lengths is not None
        surfaces, families = common_surfaces(linkage.chain, linkage.sizes, tolerance, lengths=by_lengths)
        if surface is None:
            return LinkageMap(linkage, surfaces, families)
        return LinkageMap(linkage, _on_chosen(linkage, surface, surfaces, families), ())
    places = np.array(linkage.places())
    loops = loop_steps(linkage.chain, places)
    mirror = -1 if loops[0].steps[0] < 0 else 1
    signs = tuple(tuple((mirror * np.sign(loop.steps)).astype(int).tolist()) for loop in loops)
    turns = tuple(int(mirror * loop.circuits.turns) for loop in loops)
    if linkage.surface is None:
        every = (0.0, np.pi / 2 if linkage.kind == "cone" else inf)
        return LinkageMap(linkage, (), (CommonFamily(every, signs, turns),))
    circuits = tuple(str(loop.circuits.names()) for loop in loops)
    residual = max(abs(float(loop.circuits.residual)) for loop in loops)
    named = dict(zip(linkage.chain.joints, places.tolist(), strict=True))
    return LinkageMap(linkage, (CommonSurface(linkage.surface, signs, turns, circuits, named, residual),), ())


@dataclass(frozen=True, slots=True)
class CommonSurface:
    """A cone or a cylinder on which all loops of a linkage lie.

    Attributes
    ----------
    surface : Cone or Cylinder
    signs : tuple of tuples of int
        Of the steps of each loop, in loop order; the first of the first loop is +.
    turns : tuple of int
        k of each loop.
    circuits : tuple of {"open", "crossed"}
    places : mapping of joint id to float
        Azimuths, radians; the first joint is at 0.
    residual : float
        Largest closure error of a loop, radians.
    caution : str
        The loops that close within the tolerance when they lie flat too, and so do not fix the surface; else
        empty.
    """

    surface: Surface
    signs: tuple[tuple[int, ...], ...]
    turns: tuple[int, ...]
    circuits: tuple[str, ...]
    places: Mapping[JointId, float]
    residual: float
    caution: str = ""


@dataclass(frozen=True, slots=True)
class CommonFamily:
    """Signs with which all loops close on every surface up to the one that the longest link ends.

    Attributes
    ----------
    interval : (float, float)
        lambda, radians, the least, 0, being flat; or radii, the greatest being infinite.
    signs, turns : tuple of tuples of int, tuple of int
    caution : str
        Where a loop closes on them within the rounding of its links only; else empty.
    of_sizes : tuple of int
        Signs of the steps of all sizes of links, in their order; none for a linkage of steps.
    """

    interval: tuple[float, float]
    signs: tuple[tuple[int, ...], ...]
    turns: tuple[int, ...]
    caution: str = ""
    of_sizes: tuple[int, ...] = ()


class _Cycle:
    """A closed run of joints, neighbours on one link: numbers of the pairs, and +1 or -1 by their order."""

    def __init__(self, joints: Sequence[JointId], pairs: Mapping[Pair, int], what: str) -> None:
        numbers, turned = [], []
        for a, b in zip(joints, [*joints[1:], joints[0]], strict=True):
            if (a, b) not in pairs and (b, a) not in pairs:
                raise InvariantError(
                    "sizes of links",
                    f"no {what} between joints {shown(a)} and {shown(b)}",
                    "one, as they follow each other in a loop",
                )
            numbers.append(pairs.get((a, b), pairs.get((b, a), 0)))
            turned.append(1 if (a, b) in pairs else -1)
        self.pairs, self.turned = np.array(numbers), np.array(turned, dtype=np.int8)


def common_surfaces(
    chain: SCGraph, sizes: Mapping[Pair, float], tolerance: float = 1e-7, *, lengths: bool = False
) -> tuple[tuple[CommonSurface, ...], tuple[CommonFamily, ...]]:
    """Return the cones, or cylinders, on which all loops of a linkage of known sizes lie, and families of them.

    Parameters
    ----------
    chain : SCGraph
        With its loops; their centres do not matter.
    sizes : mapping of (joint, joint) to float
        Link angles between two joints of one link, radians, between 0 and pi; or lengths: at least between those
        that follow each other in a loop.
    tolerance : float, optional
        Largest closure error of a loop whose steps are a turn or more, regardless of sign, radians; of a smaller
        loop it is less in proportion.
    lengths : bool, optional
        Whether the sizes are lengths: on cylinders.

    Raises
    ------
    InvariantError
        If a size is missing, out of range, or between joints of two links.
    UnsolvableError
        If the chain has no loops.

    Examples
    --------
    >>> linkage = SurfaceLinkage.loop(np.radians([120, 95, 45, 85]))
    >>> cones, _ = common_surfaces(linkage.chain, linkage.angles)
    >>> [round(float(np.degrees(cone.surface.angle)), 4) for cone in cones]
    [13.9984, 29.0445]
    """
    pairs, values = _checked_pairs(chain, sizes, lengths=lengths)
    cycles = _cycles(chain, pairs, "length" if lengths else "angle")
    unit, links = _unit_and_links(values, lengths=lengths)
    roots = [loop_roots(links.reach[cycle.pairs], links.base) for cycle in cycles]
    end = float(links.reach[np.concatenate([cycle.pairs for cycle in cycles])].min())
    loops = len(chain.loops)
    everywhere = [np.concatenate([r.family_signs, -r.family_signs]) for r in roots]
    closing = list(_agreeing(cycles, everywhere, len(values)))
    surfaces: list[CommonSurface] = []
    for size in _candidates(roots, end, links):
        steps = links.spans(size)
        half = steps > HALF_TURN  # half a turn has no sign
        patterns = [_closing(cycle, size, links, tolerance) for cycle in cycles]
        for signs in _agreeing(cycles, patterns, len(values)):
            if not (signs[half] < 0).any() and not in_a_family(signs, half, closing):
                caution = _caution(cycles, signs, links, tolerance)
                circle = size_of(size, links.base)
                surface = Cylinder(unit * circle) if lengths else Cone(circle)
                surfaces.append(_common_surface(chain, pairs, cycles, signs * steps, surface, caution))
    families = []
    for signs in closing:
        of_loops = tuple(tuple(_along(cycle, signs).astype(int).tolist()) for cycle in cycles[:loops])
        exact = all(not _weights(cycle, signs, links.reach).any() for cycle in cycles)
        within = f"{ILL_CONDITIONED}: the loops close here within the rounding of their links only"
        last = unit * size_of(end, links.base)
        interval = (last, np.inf) if lengths else (0.0, last)
        caution = "" if exact else within
        families.append(CommonFamily(interval, of_loops, (0,) * loops, caution, tuple(signs.tolist())))
    return tuple(surfaces), tuple(families)


def _unit_and_links(values: Floats, *, lengths: bool) -> tuple[float, SizedLinks]:
    """Return a unit of length, and the links in it for loop sums."""
    if not lengths:
        return 1.0, SizedLinks(loop_maps.cone_reach(values), 1)
    unit = loop_maps.unit_of(values) if len(values) else 1.0
    return unit, SizedLinks(loop_maps.cylinder_reach(values / unit), 0)


def _on_chosen(
    linkage: SurfaceLinkage, surface: Surface, surfaces: Iterable[CommonSurface], families: Iterable[CommonFamily]
) -> tuple[CommonSurface, ...]:
    """Return what lies on one surface, of all and of families; `UnsolvableError` if it is of the other kind."""
    if surface.kind != linkage.kind:
        sizes = "link angles" if linkage.kind == "cone" else "lengths"
        raise UnsolvableError(f"a linkage of {sizes} lies on {linkage.kind}s; expected one, got a {surface.kind}")
    size = size_of_surface(surface)
    on_it = [one for one in surfaces if is_size(size_of_surface(one.surface), size)]
    return (*on_it, *(_member(linkage, family, surface) for family in families if is_in(family.interval, size)))


def _member(linkage: SurfaceLinkage, family: CommonFamily, surface: Surface) -> CommonSurface:
    """Return a linkage of sizes on a surface of a family."""
    lengths = isinstance(surface, Cylinder)
    pairs, values = _checked_pairs(linkage.chain, linkage.sizes or {}, lengths=lengths)
    cycles = _cycles(linkage.chain, pairs, "length" if lengths else "angle")
    unit, links = _unit_and_links(values, lengths=lengths)
    steps = np.array(family.of_sizes) * links.spans(reach_at(size_of_surface(surface) / unit, links))
    return _common_surface(linkage.chain, pairs, cycles, steps, surface, family.caution)


def size_of_surface(surface: Surface) -> float:
    """Return lambda of a cone, radians, or the radius of a cylinder."""
    return surface.radius if isinstance(surface, Cylinder) else surface.angle


def _checked_pairs(chain: SCGraph, sizes: Mapping[Pair, float], *, lengths: bool) -> tuple[dict[Pair, int], Floats]:
    """Return the number of each pair, and the sizes in that order."""
    if not chain.loops:
        raise UnsolvableError("the chain has no loops; expected one or more, by their joints")
    known = link_pairs(chain)
    number: dict[Pair, int] = {}
    what, key = ("length", "lengths") if lengths else ("angle", "angles")
    for place, ((a, b), size) in enumerate(sizes.items()):
        named = f"the {what} between joints {shown(a)} and {shown(b)}"
        if (a, b) not in known and (b, a) not in known:
            raise InvariantError("one link", f"{named}: no link carries both", "joints of one link", (key, place))
        if (a, b) in number or (b, a) in number:
            raise InvariantError(f"one {what}", f"{named} occurs twice", "once", (key, place))
        if lengths and not 0.0 < size < np.inf:
            raise InvariantError("length", f"{named} is {size:.12g}", "above 0", (key, place))
        if not lengths and not 0.0 < size < np.pi:
            offender = f"{named} is {np.degrees(size):.12g} degrees"
            raise InvariantError("link angle", offender, "between 0 and 180", (key, place))
        number[a, b] = place
    return number, np.array(list(sizes.values()), dtype=float)


def _cycles(chain: SCGraph, pairs: Mapping[Pair, int], what: str) -> list[_Cycle]:
    """Return the loops of the chain as cycles of pairs, then cycles of pairs within a link."""
    cycles = [_Cycle(loop.joints, pairs, what) for loop in chain.loops]
    links = link_pairs(chain)
    within: dict[object, nx.Graph] = {}
    for pair in pairs:
        link = links.get(pair, links.get(pair[::-1]))
        within.setdefault(link, nx.Graph()).add_edge(*pair)
    for graph in within.values():
        cycles += [_Cycle(tuple(joints), pairs, what) for joints in nx.cycle_basis(graph)]
    return cycles


def _candidates(roots: Iterable[LoopRoots], end: float, links: SizedLinks) -> list[float]:
    """Return the sizes to try: the roots of the cycle with fewest or, where each has a family, those of all."""
    lists = list(roots)
    fixed = [r.size for r in lists if not len(r.family_loop)]
    sizes = min(fixed, key=len) if fixed else np.concatenate([r.size for r in lists])
    kept: list[float] = []
    longest = 2.0 * float(np.arctan2(1.0, np.sqrt(end)))
    for size in sorted(sizes.tolist()):
        known = kept and size - kept[-1] <= DOUBLE.closed * size
        flat = loop_maps.is_flat(np.arctan(np.sqrt(size)), longest) if links.base else not size
        if not flat and size <= end * (1 + 1e-9) and not known:
            kept.append(min(size, end))
    return kept if links.base else kept[::-1]


def _closing(cycle: _Cycle, size: float, links: SizedLinks, tolerance: float) -> npt.NDArray[np.int8]:
    """Return the sign patterns with which a cycle closes on a surface, along the cycle."""
    half = sign_patterns(len(cycle.pairs))
    patterns = np.concatenate([half, -half])
    return patterns[_closes(patterns, size, SizedLinks(links.reach[cycle.pairs], links.base), tolerance)]


def _closes(patterns: npt.NDArray[np.int8], size: float, links: SizedLinks, tolerance: float) -> npt.NDArray[np.bool_]:
    """Check which signed steps sum to a multiple of 2 pi, within a tolerance that shrinks with small loops."""
    steps = links.spans(size)
    sums = patterns @ steps
    allowed = tolerance * min(1.0, steps.sum() / (2.0 * np.pi))
    off = np.abs(sums - 2.0 * np.pi * np.rint(sums / (2.0 * np.pi)))
    rounding = float(sum_rounding(size, links.reach, np.ones(len(links.reach)), links.base))
    return np.asarray(off <= max(allowed, rounding))


def _weights(cycle: _Cycle, signs: npt.NDArray[np.int8], reach: Floats) -> Floats:
    """Return the signs of a cycle, those of equal links added up: none is left of one that closes everywhere."""
    return put_together(_along(cycle, signs), reach[cycle.pairs])[0]


def _caution(cycles: Sequence[_Cycle], signs: npt.NDArray[np.int8], links: SizedLinks, tolerance: float) -> str:
    """Return a caution that names the cycles that would close flat too, if they do not close everywhere.

    On a cylinder that is so large that it is flat, steps are in proportion to lengths.
    """

    def closes_flat(cycle: _Cycle) -> bool:
        own, along = SizedLinks(links.reach[cycle.pairs], links.base), _along(cycle, signs)
        if links.base:
            return bool(_closes(along[np.newaxis], 0.0, own, tolerance).any())
        lengths = own.reach**-0.5
        return bool(abs(along @ lengths) <= tolerance * lengths.sum() / (2.0 * np.pi))

    doubtful = [
        str(number + 1)
        for number, cycle in enumerate(cycles)
        if _weights(cycle, signs, links.reach).any() and closes_flat(cycle)
    ]
    if not doubtful:
        return ""
    loops = f"loop {doubtful[0]} closes" if len(doubtful) == 1 else f"loops {', '.join(doubtful)} close"
    size = "lambda" if links.base else "radius"
    return f"{ILL_CONDITIONED}: {loops} flat too, within the tolerance, so the {size} is undetermined"


def _along(cycle: _Cycle, signs: npt.NDArray[np.int8]) -> npt.NDArray[np.int8]:
    """Return signs along a cycle from those of pairs."""
    return np.asarray(signs[cycle.pairs] * cycle.turned)


def _agreeing(
    cycles: Sequence[_Cycle], patterns: Sequence[npt.NDArray[np.int8]], count: int
) -> Iterator[npt.NDArray[np.int8]]:
    """Yield all signs of pairs that give every cycle one of its patterns; first +, + for pairs in no cycle."""

    def extended(depth: int, signs: npt.NDArray[np.int8]) -> Iterator[npt.NDArray[np.int8]]:
        if depth == len(cycles):
            yield np.where(signs == 0, np.int8(1), signs)
            return
        cycle = cycles[depth]
        for pattern in patterns[depth]:
            of_pairs = pattern * cycle.turned
            old = signs[cycle.pairs]
            if depth == 0 and pattern[0] < 0:
                continue
            if ((old == 0) | (old == of_pairs)).all():
                more = signs.copy()
                more[cycle.pairs] = of_pairs
                yield from extended(depth + 1, more)

    yield from extended(0, np.zeros(count, dtype=np.int8))


def _common_surface(
    chain: SCGraph, pairs: Mapping[Pair, int], cycles: Sequence[_Cycle], steps: Floats, surface: Surface, caution: str
) -> CommonSurface:
    loops = len(chain.loops)
    of_loops = [steps[cycle.pairs] * cycle.turned for cycle in cycles]
    loop_circuits = [circuits(one) for one in of_loops]
    signed = {pair: float(steps[number]) for pair, number in pairs.items()}
    first = chain.loops[0].joints[0]
    places = places_of_steps(signed, tolerance=np.inf)
    return CommonSurface(
        surface,
        tuple(tuple(np.sign(one).astype(int).tolist()) for one in of_loops[:loops]),
        tuple(int(one.turns) for one in loop_circuits[:loops]),
        tuple(str(one.names()) for one in loop_circuits[:loops]),
        {joint: float(wrapped(places[joint] - places[first])) for joint in chain.joints if joint in places},
        float(max(abs(one.residual) for one in loop_circuits)),
        caution,
    )


@dataclass(frozen=True, slots=True)
class SupplementaryLinkages(Printed):
    """The 16 linkages that share the joint lines of a four-bar: itself, and 15 others.

    Attributes
    ----------
    turned : tuple of tuples of int
        The joints, from 1, whose other end is taken; none for the first linkage. Link i lies between joints i, i +
        1.
    maps : tuple of ConeMap
        The link angles and the cones of each.

    Examples
    --------
    >>> supplementary_linkages(np.radians([85, 120, 95, 45]))
    <SupplementaryLinkages: 16 linkages, 8 different>
    """

    turned: tuple[tuple[int, ...], ...]
    maps: tuple[loop_maps.ConeMap, ...]

    @property
    def distinct(self) -> int:
        """How many have angles of their own: those with all joints turned, or none, are alike."""
        return len({tuple(np.round(one.angles, 12)) for one in self.maps})

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        rows = [
            (
                " ".join(map(str, turned)) or "none",
                ", ".join(f"{angle:.6g}" for angle in in_degrees(one.angles)),
                f"{_fourth(one):.6g}",
                _cones(one),
            )
            for turned, one in zip(self.turned, self.maps, strict=True)
        ]
        heads = ("joints turned", "link angles (deg)", "T4 (deg)", "cones: lambda (half angle) (deg)")
        return [
            f"{numbered(len(self.maps), 'linkage')} on the same joint lines, "
            f"{self.distinct} with different link angles",
            TableBlock(heads, rows, ["T4 (deg)"]),
        ]

    def __repr__(self) -> str:
        return f"<SupplementaryLinkages: {numbered(len(self.maps), 'linkage')}, {self.distinct} different>"

    def to_json(self) -> dict[str, Any]:
        """Return the linkages as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "linkages": [
                {
                    "joints_turned": list(turned),
                    "angles_deg": in_degrees(one.angles),
                    "T4_deg": _fourth(one),
                    "cones": one.to_json()["cones"],
                    "families": one.to_json()["families"],
                }
                for turned, one in zip(self.turned, self.maps, strict=True)
            ],
            "different": self.distinct,
        }


def _fourth(cone_map: loop_maps.ConeMap) -> float:
    return in_degrees([float(spherical_differences(np.array(cone_map.angles))[3])])[0]


def _cones(cone_map: loop_maps.ConeMap) -> str:
    surfaces = [f"{degrees(cone.size):.8g} ({90.0 - degrees(cone.size):.8g}) {cone.circuit}" for cone in cone_map.cones]
    surfaces += [
        f"{degrees(low):.6g} to {degrees(high):.6g} "
        f"({90.0 - degrees(high):.6g} to {90.0 - degrees(low):.6g}) {family.circuit}"
        for family in cone_map.families
        for low, high in [family.interval]
    ]
    return ", ".join(surfaces) or "none"


def supplementary_linkages(angles: npt.ArrayLike) -> SupplementaryLinkages:
    """Return the linkages on the joint lines of a spherical four-bar, and the cones on which each lies.

    Parameters
    ----------
    angles : float[4]
        Link angles in loop order, radians, in range and able to close, else `InvariantError`.

    Examples
    --------
    >>> linkages = supplementary_linkages(np.radians([85, 120, 95, 45]))
    >>> len(linkages.maps), linkages.distinct, [len(cone_map.cones) for cone_map in linkages.maps[:4]]
    (16, 8, [2, 0, 2, 0])
    """
    checked = checked_link_angles(angles)
    if len(checked) != 4:
        raise InvariantError("four-bar", f"{len(checked)} link angles", "the four of a four-bar")
    turned = [tuple(joint + 1 for joint in range(4) if ends[joint]) for ends in product((0, 1), repeat=4)]
    return SupplementaryLinkages(tuple(turned), tuple(loop_maps.map_to_cones(one) for one in supplementary(checked)))
