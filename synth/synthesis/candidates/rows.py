"""Rows of conical candidates: names of columns, and values, computed for many candidates at a time.

Layers, and values over all angles: `synth.linkages.conformed.rates_over_angles`; rank and behaviour:
`synth.linkages.conformed.rates`, `synth.linkages.conformed.behaviours`. Theory: docs/theory/conical-candidates.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from enumerate.runner.job import Column, JoinColumn, ListColumn, RangeColumn, Row
from graphs.mechanism.surfaces import Cone, Surface
from graphs.types import Floats, Ints
from synth.linkages.conformed.behaviours import Way, behaviour_of_motion, link_arcs
from synth.linkages.conformed.rates import ConformedChain, first_order
from synth.linkages.conformed.rates_over_angles import (
    Allowed,
    OverAngles,
    RateFormulas,
    layers,
    never_singular,
    orders_with_opposites,
    over_angles,
)
from synth.linkages.fourbar.closing import grashof_class, planar_differences, spherical_differences
from synth.linkages.surfaces.circuit import HALF_TURN, Circuits, circuits, link_angles, wrapped
from synth.linkages.surfaces.loop_maps import chords


def loop_circuits(loops: Sequence[Sequence[int]], places: npt.ArrayLike) -> tuple[Circuits, ...]:
    """Return the circuits of loops, each its joints in loop order, at azimuths float[..., J], radians."""
    azimuths = np.asarray(places, dtype=float)
    of_loops = []
    for loop in loops:
        around = azimuths[..., list(loop)]
        of_loops.append(circuits(wrapped((np.roll(around, -1, axis=-1) - around).round(12))))
    return tuple(of_loops)


def _steps(places: Floats, pairs: Sequence[tuple[int, int]]) -> Floats:
    """Return the steps between the joints of each pair, float[..., pairs], radians."""
    first, second = (list(side) for side in zip(*pairs, strict=True))
    return wrapped(places[..., second] - places[..., first])


def four_bar_classes(
    loops: Sequence[Sequence[int]], places: npt.ArrayLike, surface: Surface | None
) -> list[npt.NDArray[np.str_]]:
    """Return ``Grashof``, ``non-Grashof`` or ``folding`` for each loop of four joints; other loops are skipped.

    The class depends on the cone; without a surface it is that on a cylinder. Azimuths are float[..., J]. A
    crossed loop is Grashof on a cylinder; on a steep cone it need not be (docs/misprints.md 000-6).
    """
    azimuths = np.asarray(places, dtype=float)
    classes = []
    for loop in (loop for loop in loops if len(loop) == 4):
        around = azimuths[..., list(loop)]
        steps = wrapped(np.roll(around, -1, axis=-1) - around)
        if isinstance(surface, Cone):
            differences = spherical_differences(link_angles(steps, surface.angle))
        else:
            differences = planar_differences(chords(steps, 1.0))
        classes.append(grashof_class(differences))
    return classes


_OF_LINKAGE = {
    Allowed.BOTH: "both ways", Allowed.ONE: "one way", Allowed.ANGLES: "by angles", Allowed.UNKNOWN: "not known"
}  # fmt: skip
_OF_LINK = {Allowed.BOTH: "both", Allowed.ONE: "one", Allowed.ANGLES: "angles", Allowed.UNKNOWN: "not known"}

_WORDS = ListColumn(" ", kind=str)
_NUMBERS = ListColumn(" ")
_JOINTS = ListColumn(" ", "-", kind=str)
_JOINS = JoinColumn(" ", "-", ":", str)


class LoopCircuits(NamedTuple):
    """Loops, circuits, how many are open, densities, and |k| of each loop."""

    loops: tuple[tuple[str, ...], ...]
    circuits: tuple[str, ...]
    open_loops: int
    density: tuple[int, ...]
    turns: tuple[int, ...]


@dataclass(frozen=True)
class CandidateChain:
    """A chain with one ground link, its id, and the common properties of all its rows.

    `grounded`: a link is fixed; else rows have no senses of rotation. `links` are names in the order of rows,
    `loops` the joints of each loop in loop order.
    """

    chain: ConformedChain
    code: str
    grounded: bool
    links: tuple[str, ...]
    loops: tuple[tuple[int, ...], ...]

    @cached_property
    def names(self) -> list[str]:
        """Names of the joints."""
        return [str(joint) for joint in self.chain.joints]

    @cached_property
    def joins(self) -> tuple[tuple[str, ...], ...]:
        """The name of each joint with those of the two links that it joins."""
        links = [str(link) for link in self.chain.links]
        return tuple(
            (name, *(link for link, own in zip(links, self.chain.joints_of, strict=True) if joint in own))
            for joint, name in enumerate(self.names)
        )

    @property
    def single(self) -> bool:
        """Whether the mobility of the chain by count is 1."""
        return len(self.chain.joints) == 3 * len(self.chain.loops) + 1

    @cached_property
    def rate_formulas(self) -> RateFormulas:
        """The data of the analysis over all angles."""
        return RateFormulas(self.chain)

    def ways_of_links(self, words: Sequence[str]) -> tuple[tuple[str, str], ...]:
        """Return (link, word) for each link, in the order of rows; words are in the order of the chain."""
        word_of = dict(zip(map(str, self.chain.links), ["fixed", *words[1:]], strict=True))
        return tuple((name, word_of[name]) for name in self.links)

    def columns(self, placed: bool, opposites: bool, surface: Surface | None, slots: bool) -> dict[str, Column]:
        """Return names and types of columns."""
        columns: dict[str, Column] = {"chain": str, "ground": str, "joins": _JOINS, "order": _WORDS}
        if slots or not placed:
            columns["slots"] = _NUMBERS
        columns |= {
            "symmetry": int, "loops": _JOINTS, "circuits": _WORDS, "open_loops": int, "density": _NUMBERS,
            "turns": _NUMBERS if placed else RangeColumn(" ", ".."),
        }  # fmt: skip
        if placed:
            columns |= {
                "azimuths_deg": ListColumn(" ", kind=float), "half_turns": _JOINTS, "half_turn_steps": int,
                "layers": int, "rank": int, "freedoms": int, "singular": bool, "least_singular_value": float,
                "grashof": _WORDS, "grashof_loops": int,
            }  # fmt: skip
        else:
            columns |= {"layers": int} if opposites else {"layers": int, "most_layers": int}
            columns |= {"full_rank": bool} if self.single else {}
        if placed and surface is not None:
            size, sizes = ("lambda_deg", "link_angles_deg") if isinstance(surface, Cone) else ("radius", "link_lengths")
            columns |= {size: float} | ({"half_angle_deg": float} if isinstance(surface, Cone) else {})
            columns |= {sizes: ListColumn(" ", "-", ":", None)}
        if self.grounded and (placed or self.single):
            columns |= {"ways": ListColumn(" ", ":", kind=str), "linkage": str}
            if not (placed or opposites):
                columns |= dict.fromkeys(("one_way", "both_ways", "by_angles", "not_known"), int)
        return columns

    def common(self, slots: Ints, opposites: bool) -> Iterator[tuple[Any, ...]]:
        """Yield chain, ground, links of joints, order, slots of rows."""
        ground = str(self.chain.links[0]) if self.grounded else ""
        for row in slots.tolist():
            yield self.code, ground, self.joins, self._order(row, opposites), tuple(row)

    def _order(self, row: list[int], opposites: bool) -> tuple[str, ...]:
        if not opposites:
            return tuple(self.names[i] for i in sorted(range(len(row)), key=row.__getitem__))
        half = len(row)
        order = sorted((slot % half, self.names[i] + "'" * (slot >= half)) for i, slot in enumerate(row))
        return tuple(name for _, name in order)

    def circuits_of_loops(self, places: Floats) -> list[LoopCircuits]:
        """Return the circuits of all loops, of each row."""
        of_loops = loop_circuits(self.loops, places)
        open_ = np.stack([circuits.open for circuits in of_loops], axis=-1)
        density = np.stack([circuits.density for circuits in of_loops], axis=-1)
        turns = np.abs(np.stack([circuits.turns for circuits in of_loops], axis=-1))
        loops = tuple(tuple(self.names[i] for i in loop) for loop in self.loops)
        return [
            LoopCircuits(
                loops, tuple("open" if is_open else "crossed" for is_open in row), sum(row), tuple(d), tuple(k)
            )
            for row, d, k in zip(open_.tolist(), density.tolist(), turns.tolist(), strict=True)
        ]


def order_rows(candidate: CandidateChain, slots: Ints, symmetry: Ints, opposites: bool) -> list[Row]:
    """Return rows of cyclic orders, or of orders with opposites.

    `slots`, int64[r, J], are on J slots, or on 2 J with opposites; `symmetry` is int64[r].
    """
    joints = slots.shape[1]
    sets = slots[:, np.newaxis] if opposites else orders_with_opposites(slots)
    flat = sets.reshape(-1, joints)
    places = flat * (np.pi / joints)
    per_row = sets.shape[1]
    circuits = candidate.circuits_of_loops(places)
    deep = layers(candidate.chain, places).reshape(-1, per_row)
    full = never_singular(candidate.rate_formulas, places[::per_row]).tolist() if candidate.single else []
    allowed = over_angles(candidate.rate_formulas, flat) if candidate.grounded and candidate.single else None
    rows: list[Row] = []
    for i, start in enumerate(candidate.common(slots, opposites)):
        mine = slice(i * per_row, (i + 1) * per_row)
        turns = np.array([of_loops.turns for of_loops in circuits[mine]])
        ranges = tuple(zip(turns.min(axis=0).tolist(), turns.max(axis=0).tolist(), strict=True))
        row: list[Any] = [*start, int(symmetry[i]), *circuits[i * per_row][:-1], ranges]
        row += [int(deep[i].min())] if opposites else [int(deep[i].min()), int(deep[i].max())]
        row += full[i : i + 1]
        if allowed is not None:
            row += _ways(candidate, allowed, mine, opposites)
        rows.append(tuple(row))
    return rows


def _ways(candidate: CandidateChain, over: OverAngles, mine: slice, opposites: bool) -> list[Any]:
    """Return the ways of the links and the linkage, over all angles of one order; counts of sets of opposites."""
    links = [_together(over.links[mine, n]) for n in range(over.links.shape[1])]
    linkage = _together(over.linkage[mine])
    words = [_OF_LINK[allowed] for allowed in links]
    counts: list[int] = []
    if opposites:
        certain = [over.signs[mine][0, list(joints)] for joints in candidate.chain.joints_of]
        signs = [int(row[np.abs(row).argmax()]) for row in certain]
        one_way = [bool(sign) and allowed == Allowed.ONE for sign, allowed in zip(signs, links, strict=True)]
        sense = next((sign for sign, is_one in zip(signs[1:], one_way[1:], strict=True) if is_one), 1)
        words = [
            {1: "outward", -1: "inward"}[sign * sense] if is_one else word
            for sign, is_one, word in zip(signs, one_way, words, strict=True)
        ]
    else:
        numbers = np.bincount(over.linkage[mine], minlength=4)
        counts = [int(numbers[k]) for k in (Allowed.ONE, Allowed.BOTH, Allowed.ANGLES, Allowed.UNKNOWN)]
    return [candidate.ways_of_links(words), _OF_LINKAGE[linkage], *counts]


def _together(allowed: npt.NDArray[np.int8]) -> Allowed:
    """Return the common verdict of several orders with opposites."""
    seen = set(allowed.tolist())
    if len(seen) == 1:
        return Allowed(seen.pop())
    either = Allowed.ANGLES in seen or {Allowed.ONE, Allowed.BOTH} <= seen
    return Allowed.ANGLES if either else Allowed.UNKNOWN


def placed_rows(
    candidate: CandidateChain, places: Floats, slots: Ints, symmetry: Ints, on_slots: bool, surface: Surface | None
) -> list[Row]:
    """Return rows of joints at azimuths, float[r, J], between 0 and 2 pi, on a surface or on any.

    `slots`, int64[r, J], are slots, named in rows with `on_slots`, or the cyclic order; `symmetry` is int64[r].
    """
    chain = candidate.chain
    motion = first_order(chain, places)
    rank = motion.rank()
    least = np.take_along_axis(motion.singular_values, rank[:, np.newaxis] - 1, -1)[:, 0]
    singular = rank < motion.singular_values.shape[-1]
    pairs = sorted({pair for joints in chain.joints_of for pair in combinations(joints, 2)})
    half = np.abs(_steps(places, pairs)) > HALF_TURN  # such steps have no sign
    classes = four_bar_classes(candidate.loops, places, surface)
    circuits = candidate.circuits_of_loops(places)
    deep = layers(chain, places).tolist()
    azimuths = [tuple(float(f"{x:.12g}") for x in row) for row in np.degrees(places).round(12).tolist()]
    sizes = None if surface is None else _link_sizes(places, pairs, surface)
    ways = _placed_ways(candidate, places) if candidate.grounded else None
    joined = [(candidate.names[a], candidate.names[b]) for a, b in pairs]
    rows: list[Row] = []
    for i, start in enumerate(candidate.common(slots, False)):
        here = tuple(joined[k] for k in np.flatnonzero(half[i]).tolist())
        of_loops = tuple(str(of_loop[i]) for of_loop in classes)
        row: list[Any] = [*(start if on_slots else start[:-1]), int(symmetry[i]), *circuits[i]]
        row += [azimuths[i], here, len(here), deep[i]]
        row += [int(rank[i]), int(motion.freedoms[i]), bool(singular[i]), float(f"{least[i]:.9g}")]
        row += [of_loops, of_loops.count("Grashof")]
        if surface is not None and sizes is not None:
            row += _size_of(surface)
            row += [tuple((*pair, float(f"{x:.10g}")) for pair, x in zip(joined, sizes[i], strict=True))]
        if ways is not None:
            row += ways[i]
        rows.append(tuple(row))
    return rows


def _size_of(surface: Surface) -> list[float]:
    """Return lambda and the half angle of a cone, degrees, or the radius of a cylinder."""
    if isinstance(surface, Cone):
        angle = round(float(np.degrees(surface.angle)), 10)
        return [angle, round(90.0 - angle, 10)]
    return [surface.radius]


def _link_sizes(places: Floats, pairs: Sequence[tuple[int, int]], surface: Surface) -> list[list[float]]:
    """Return the link angles, degrees, or lengths between joints of each link."""
    steps = _steps(places, pairs)
    if isinstance(surface, Cone):
        sizes = np.degrees(link_angles(steps, surface.angle))
    else:
        sizes = chords(steps, surface.radius)
    return [list(map(float, row)) for row in sizes]


def _placed_ways(candidate: CandidateChain, places: Floats) -> list[list[Any]]:
    chain = candidate.chain
    behaviour = behaviour_of_motion(chain, places, first_order(chain, places), link_arcs(chain, places))
    word = {int(way): way.name.lower() for way in Way}
    known = (behaviour.ways != Way.UNKNOWN).all(axis=-1).tolist()
    return [
        [
            candidate.ways_of_links([word[way] for way in ways]),
            _OF_LINKAGE[(Allowed.ONE if one_way else Allowed.BOTH) if is_known else Allowed.UNKNOWN],
        ]
        for ways, one_way, is_known in zip(behaviour.ways.tolist(), behaviour.one_way.tolist(), known, strict=True)
    ]
