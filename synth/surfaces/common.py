"""Cones or cylinders that all loops of a linkage share (Hyatt et al. 2020, section 7).

A loop has a few surfaces, and all loops must have one in common, with the same sign for a link that two of them
use. A link of three joints or more whose sizes are all given is a loop of its own, and fixes the surface by
itself. Sizes are link angles, on cones, or lengths, on cylinders. Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, Pair, Surface, places_of_steps
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.fourbar.rounding import ILL_CONDITIONED
from synth.surfaces.circuit import HALF_TURN, circuits, wrapped
from synth.surfaces.cone import cone_reach, is_flat
from synth.surfaces.cylinder import cylinder_reach
from synth.surfaces.loop_sums import LoopRoots, loop_roots, put_together, sign_patterns, sum_rounding
from synth.surfaces.mapping import SizedLinks, size_of
from synth.surfaces.several_loops import link_pairs

__all__ = ["CommonFamily", "CommonSurface", "common_surfaces"]


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
        Which loops do not tell the surface, since they close within the tolerance when they lie flat too; else
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
    signs : tuple of tuples of int
    turns : tuple of int
    caution : str
        Where a loop closes on them within the rounding of its links only; else empty.
    """

    interval: tuple[float, float]
    signs: tuple[tuple[int, ...], ...]
    turns: tuple[int, ...]
    caution: str = ""


@dataclass(frozen=True, slots=True)
class _Cycle:
    """A closed run of joints, neighbours on one link: numbers of the pairs, and +1 or -1 by their order."""

    pairs: npt.NDArray[np.intp]
    turned: npt.NDArray[np.int8]


def common_surfaces(
    chain: SCGraph, sizes: Mapping[Pair, float], tolerance: float = 1e-7, *, lengths: bool = False
) -> tuple[tuple[CommonSurface, ...], tuple[CommonFamily, ...]]:
    """Return the cones, or cylinders, on which all loops of a linkage of given links lie.

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

    Returns
    -------
    (tuple of CommonSurface, tuple of CommonFamily)

    Raises
    ------
    InvariantError
        If a size is missing, out of range, or between joints of two links.
    UnsolvableError
        If the chain has no loops.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> chain = SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)])), [Loop(tuple("OABC"))])
    >>> pairs = [("O", "A"), ("A", "B"), ("B", "C"), ("C", "O")]
    >>> cones, _ = common_surfaces(chain, dict(zip(pairs, np.radians([120, 95, 45, 85]))))
    >>> [round(float(np.degrees(cone.surface.angle)), 4) for cone in cones]
    [13.9984, 29.0445]
    >>> cylinders, _ = common_surfaces(chain, dict(zip(pairs, [4, 3, 5, 1])), lengths=True)
    >>> [round(cylinder.surface.radius, 4) for cylinder in cylinders]
    [2.5361, 2.5909]
    """
    pairs, given = _checked_pairs(chain, sizes, lengths=lengths)
    cycles = _cycles(chain, pairs, "length" if lengths else "angle")
    unit = float(2.0 ** np.frexp(given.max())[1]) if lengths and len(given) else 1.0
    links = SizedLinks(cylinder_reach(given / unit), 0) if lengths else SizedLinks(cone_reach(given), 1)
    roots = [loop_roots(links.reach[cycle.pairs], links.base) for cycle in cycles]
    end = float(links.reach[np.concatenate([cycle.pairs for cycle in cycles])].min())
    loops = len(chain.loops)
    everywhere = [np.concatenate([r.family_signs, -r.family_signs]) for r in roots]
    closing = list(_agreeing(cycles, everywhere, len(given)))
    found: list[CommonSurface] = []
    for size in _candidates(roots, end, links):
        steps = links.spans(size)
        half = steps > HALF_TURN  # half a turn has no sign
        patterns = [_closing(cycle, size, links, tolerance) for cycle in cycles]
        for signs in _agreeing(cycles, patterns, len(given)):
            if not (signs[half] < 0).any() and not _in_a_family(signs, half, closing):
                caution = _caution(cycles, signs, links, tolerance)
                circle = size_of(size, links.base)
                surface = Cylinder(unit * circle) if lengths else Cone(circle)
                found.append(_common_surface(chain, pairs, cycles, signs * steps, surface, caution))
    families = []
    for signs in closing:
        of_loops = tuple(tuple(_along(cycle, signs).astype(int).tolist()) for cycle in cycles[:loops])
        exact = all(not _weights(cycle, signs, links.reach).any() for cycle in cycles)
        within = f"{ILL_CONDITIONED}: the loops close here within the rounding of their links only"
        last = unit * size_of(end, links.base)
        interval = (last, np.inf) if lengths else (0.0, last)
        families.append(CommonFamily(interval, of_loops, (0,) * loops, "" if exact else within))
    return tuple(found), tuple(families)


def _checked_pairs(
    chain: SCGraph, sizes: Mapping[Pair, float], *, lengths: bool
) -> tuple[dict[Pair, int], Floats]:
    """Return the number of each pair, and the sizes in that order."""
    if not chain.loops:
        raise UnsolvableError("the chain has no loops; name them")
    known = link_pairs(chain)
    number: dict[Pair, int] = {}
    what, key = ("length", "lengths") if lengths else ("angle", "angles")
    for place, ((a, b), size) in enumerate(sizes.items()):
        named = f"the {what} between joints {shown(a)} and {shown(b)}"
        if (a, b) not in known and (b, a) not in known:
            raise InvariantError("one link", f"{named}: no link carries both", "joints of one link", (key, place))
        if (a, b) in number or (b, a) in number:
            raise InvariantError(f"one {what}", f"{named} is given twice", "once", (key, place))
        if lengths and not 0.0 < size < np.inf:
            raise InvariantError("length", f"{named} is {size:.12g}", "above 0", (key, place))
        if not lengths and not 0.0 < size < np.pi:
            told = f"{named} is {np.degrees(size):.12g} degrees"
            raise InvariantError("link angle", told, "between 0 and 180", (key, place))
        number[a, b] = place
    return number, np.array(list(sizes.values()), dtype=float)


def _cycles(chain: SCGraph, pairs: Mapping[Pair, int], what: str) -> list[_Cycle]:
    """Return the loops of the chain as cycles of pairs, then cycles of pairs within a link."""
    made = [_cycle(loop.joints, pairs, what) for loop in chain.loops]
    links = link_pairs(chain)
    within: dict[object, nx.Graph] = {}
    for pair in pairs:
        link = links.get(pair, links.get(pair[::-1]))
        within.setdefault(link, nx.Graph()).add_edge(*pair)
    for graph in within.values():
        made += [_cycle(tuple(joints), pairs, what) for joints in nx.cycle_basis(graph)]
    return made


def _cycle(joints: Sequence[JointId], pairs: Mapping[Pair, int], what: str) -> _Cycle:
    numbers, turned = [], []
    for a, b in zip(joints, [*joints[1:], joints[0]], strict=True):
        if (a, b) not in pairs and (b, a) not in pairs:
            raise InvariantError(
                "sizes of links",
                f"no {what} between joints {shown(a)} and {shown(b)}",
                "one: they follow in a loop",
            )
        numbers.append(pairs.get((a, b), pairs.get((b, a), 0)))
        turned.append(1 if (a, b) in pairs else -1)
    return _Cycle(np.array(numbers), np.array(turned, dtype=np.int8))


def _candidates(roots: Iterable[LoopRoots], end: float, links: SizedLinks) -> list[float]:
    """Return the sizes to try: the roots of the cycle with fewest or, where each has a family, those of all."""
    lists = list(roots)
    fixed = [r.size for r in lists if not len(r.family_loop)]
    sizes = min(fixed, key=len) if fixed else np.concatenate([r.size for r in lists])
    kept: list[float] = []
    longest = 2.0 * float(np.arctan2(1.0, np.sqrt(end)))
    for size in sorted(sizes.tolist()):
        known = kept and size - kept[-1] <= DOUBLE.closed * size
        flat = is_flat(np.arctan(np.sqrt(size)), longest) if links.base else not size
        if not flat and size <= end * (1 + 1e-9) and not known:
            kept.append(min(size, end))
    return kept if links.base else kept[::-1]


def _closing(cycle: _Cycle, size: float, links: SizedLinks, tolerance: float) -> npt.NDArray[np.int8]:
    """Return the sign patterns with which a cycle closes on a surface, along the cycle."""
    half = sign_patterns(len(cycle.pairs))
    patterns = np.concatenate([half, -half])
    return patterns[_closes(patterns, size, SizedLinks(links.reach[cycle.pairs], links.base), tolerance)]


def _closes(
    patterns: npt.NDArray[np.int8], size: float, links: SizedLinks, tolerance: float
) -> npt.NDArray[np.bool_]:
    """Tell which signed steps sum to a multiple of 2 pi, within a tolerance that shrinks with small loops."""
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
    """Say which cycles would close flat too, if they do not close everywhere.

    On a cylinder that is so large that it is flat, steps are in proportion to lengths.
    """

    def closes_flat(cycle: _Cycle) -> bool:
        own, along = SizedLinks(links.reach[cycle.pairs], links.base), _along(cycle, signs)
        if links.base:
            return bool(_closes(along[np.newaxis], 0.0, own, tolerance).any())
        lengths = own.reach**-0.5
        return bool(abs(along @ lengths) <= tolerance * lengths.sum() / (2.0 * np.pi))

    told = [
        str(number + 1)
        for number, cycle in enumerate(cycles)
        if _weights(cycle, signs, links.reach).any() and closes_flat(cycle)
    ]
    if not told:
        return ""
    size = "lambda" if links.base else "radius"
    return f"{ILL_CONDITIONED}: loop {', '.join(told)} closes flat too, within the tolerance, and tells no {size}"


def _along(cycle: _Cycle, signs: npt.NDArray[np.int8]) -> npt.NDArray[np.int8]:
    """Return signs along a cycle from those of pairs."""
    return np.asarray(signs[cycle.pairs] * cycle.turned)


def _agreeing(
    cycles: Sequence[_Cycle], patterns: Sequence[npt.NDArray[np.int8]], count: int
) -> Iterator[npt.NDArray[np.int8]]:
    """Yield all signs of pairs that give every cycle one of its patterns; the first of the first cycle is +.

    Pairs in no cycle have +.
    """

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
    chain: SCGraph,
    pairs: Mapping[Pair, int],
    cycles: Sequence[_Cycle],
    steps: Floats,
    surface: Surface,
    caution: str,
) -> CommonSurface:
    loops = len(chain.loops)
    of_loops = [steps[cycle.pairs] * cycle.turned for cycle in cycles]
    found = [circuits(one) for one in of_loops]
    signed = {pair: float(steps[number]) for pair, number in pairs.items()}
    first = chain.loops[0].joints[0]
    places = places_of_steps(signed, tolerance=np.inf)
    return CommonSurface(
        surface,
        tuple(tuple(np.sign(one).astype(int).tolist()) for one in of_loops[:loops]),
        tuple(int(one.turns) for one in found[:loops]),
        tuple(str(one.names()) for one in found[:loops]),
        {joint: float(wrapped(places[joint] - places[first])) for joint in chain.joints if joint in places},
        float(max(abs(one.residual) for one in found)),
        caution,
    )


def _in_a_family(
    signs: npt.NDArray[np.int8], half: npt.NDArray[np.bool_], families: Sequence[npt.NDArray[np.int8]]
) -> bool:
    """Tell whether signs, or their mirror image, are those of a family but for steps of half a turn."""
    rest = ~half
    return any((signs[rest] == turn * family[rest]).all() for family in families for turn in (1, -1))
