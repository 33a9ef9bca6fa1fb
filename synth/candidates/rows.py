"""Rows of conical candidates: names of columns, and values as text and numbers.

Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from enumerate.runner.job import Row
from graphs.arrays import Floats, Ints
from synth.candidates.values import four_bar_classes, half_turns, layers, loop_circuits
from synth.conformed.all_angles import (
    Allowed,
    OverAngles,
    Prepared,
    never_singular,
    orders_with_opposites,
    over_angles,
)
from synth.conformed.behaviours import Way, behaviour_of_motion, link_arcs
from synth.conformed.rates import ConformedChain, first_order
from synth.surfaces.circuit import wrapped
from synth.surfaces.cone import link_angles

__all__ = ["Shape", "order_rows", "placed_rows"]

_ALLOWED = {
    Allowed.BOTH: "both ways",
    Allowed.ONE: "one way",
    Allowed.ANGLES: "by angles",
    Allowed.UNKNOWN: "not known",
}


@dataclass(frozen=True)
class Shape:
    """A chain with one ground link, and what all its rows have in common.

    Attributes
    ----------
    chain : ConformedChain
    code : str
        Id of the chain.
    grounded : bool
        Whether a link is fixed; else nothing is said of ways.
    links : tuple of str
        Names in the order of rows.
    loops : tuple of tuples of int
        Joints of every loop, in loop order.
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

    @property
    def single(self) -> bool:
        """Whether the chain has one freedom by its count."""
        return len(self.chain.joints) == 3 * len(self.chain.loops) + 1

    @cached_property
    def prepared(self) -> Prepared:
        """What the analysis over all angles needs."""
        return Prepared.of(self.chain)

    @cached_property
    def _turned(self) -> list[int]:
        """Numbers of the chain's links, the ground first, in the order of rows."""
        own = [str(link) for link in self.chain.links]
        return [own.index(name) for name in self.links]

    def ways_text(self, words: Sequence[str]) -> str:
        """Return a word for each link, in the order of rows."""
        told = ["fixed", *words[1:]]
        return " ".join(f"{name}:{told[k]}" for name, k in zip(self.links, self._turned, strict=True))

    def columns(self, placed: bool, opposites: bool, cone: bool, slots: bool) -> dict[str, type]:
        """Return names and types of columns."""
        common = {"chain": str, "ground": str, "order": str}
        where = {"slots": str} if slots or not placed else {}
        circuits = {
            "symmetry": int,
            "loops": str,
            "circuits": str,
            "open_loops": int,
            "density": str,
            "turns": str,
        }
        ways = {"ways": str, "linkage": str} if self.grounded and (placed or self.single) else {}
        if not placed:
            rank = {"full_rank": bool} if self.single else {}
            if opposites:
                return {**common, **where, **circuits, "layers": int, **rank, **ways}
            many = {"one_way": int, "both_ways": int, "by_angles": int, "not_known": int} if ways else {}
            return {**common, **where, **circuits, "layers": int, "most_layers": int, **rank, **ways, **many}
        evaluated = {
            "azimuths_deg": str, "half_turns": str, "half_turn_steps": int, "layers": int, "rank": int,
            "freedoms": int, "singular": bool, "least_singular_value": float, "grashof": str, "grashof_loops": int,
        }  # fmt: skip
        angles = {"lambda_deg": float, "link_angles_deg": str} if cone else {}
        return {**common, **where, **circuits, **evaluated, **angles, **ways}

    def common(self, slots: Ints, opposites: bool) -> Iterator[tuple[Any, ...]]:
        """Yield chain, ground and order, slots of rows."""
        ground = str(self.chain.links[0]) if self.grounded else ""
        for row in slots.tolist():
            yield self.code, ground, self._order(row, opposites), " ".join(map(str, row))

    def _order(self, row: list[int], opposites: bool) -> str:
        if not opposites:
            return " ".join(self.names[i] for i in sorted(range(len(row)), key=row.__getitem__))
        half = len(row)
        told = sorted((slot % half, self.names[i] + "'" * (slot >= half)) for i, slot in enumerate(row))
        return " ".join(name for _, name in told)

    def circuit_texts(self, places: Floats) -> list[tuple[str, str, int, str, list[int]]]:
        """Return loops, circuits, how many are open, densities, and |k| of each loop, of each row."""
        found = loop_circuits(self.loops, places)
        open_ = np.stack([one.open for one in found], axis=-1)
        density = np.stack([one.density for one in found], axis=-1)
        turns = np.abs(np.stack([one.turns for one in found], axis=-1))
        loops = " ".join("-".join(self.names[i] for i in loop) for loop in self.loops)
        return [
            (loops, " ".join("open" if one else "crossed" for one in o), sum(o), _text(d), k)
            for o, d, k in zip(open_.tolist(), density.tolist(), turns.tolist(), strict=True)
        ]


def _text(values: Iterable[object]) -> str:
    return " ".join(map(str, values))


def order_rows(shape: Shape, slots: Ints, symmetry: Ints, opposites: bool) -> list[Row]:
    """Return rows of cyclic orders, or of orders with opposites.

    Parameters
    ----------
    shape : Shape
    slots : int64[r, J]
        On J slots, or 2 J.
    symmetry : int64[r]
    opposites : bool
    """
    joints = slots.shape[1]
    sets = slots[:, np.newaxis] if opposites else orders_with_opposites(slots)
    flat = sets.reshape(-1, joints)
    places = flat * (np.pi / joints)
    per_row = sets.shape[1]
    circuits = shape.circuit_texts(places)
    deep = layers(shape.chain, places).reshape(-1, per_row)
    full = never_singular(shape.prepared, places[::per_row]).tolist() if shape.single else []
    allowed = over_angles(shape.prepared, flat) if shape.grounded and shape.single else None
    made: list[Row] = []
    for i, start in enumerate(shape.common(slots, opposites)):
        mine = slice(i * per_row, (i + 1) * per_row)
        loops, names, count, density, _ = circuits[i * per_row]
        turns = np.array([one[-1] for one in circuits[mine]])
        row: list[Any] = [*start, int(symmetry[i]), loops, names, count, density, _ranges(turns)]
        row += [int(deep[i].min())] if opposites else [int(deep[i].min()), int(deep[i].max())]
        row += full[i : i + 1]
        if allowed is not None:
            row += _ways(shape, allowed, mine, opposites)
        made.append(tuple(row))
    return made


def _ranges(turns: Ints) -> str:
    """Return least and greatest number of turns of each loop."""
    low, high = turns.min(axis=0).tolist(), turns.max(axis=0).tolist()
    return _text(f"{a}" if a == b else f"{a}..{b}" for a, b in zip(low, high, strict=True))


def _ways(shape: Shape, found: OverAngles, mine: slice, opposites: bool) -> list[Any]:
    links = [_together(found.links[mine, n]) for n in range(found.links.shape[1])]
    linkage = _together(found.linkage[mine])
    words = [_ALLOWED[one].split()[-2 if one in (Allowed.BOTH, Allowed.ONE) else -1] for one in links]
    if opposites:
        signs = [_sign_of(found.signs[mine][0, list(joints)]) for joints in shape.chain.joints_of]
        sense = next((s for s, one in zip(signs[1:], links[1:], strict=True) if s and one == Allowed.ONE), 1)
        words = [
            {1: "outward", -1: "inward"}[s * sense] if s and one == Allowed.ONE else word
            for s, one, word in zip(signs, links, words, strict=True)
        ]
        return [shape.ways_text(words), _ALLOWED[linkage]]
    counts = np.bincount(found.linkage[mine], minlength=4)
    return [
        shape.ways_text(words),
        _ALLOWED[linkage],
        *(int(counts[one]) for one in (Allowed.ONE, Allowed.BOTH, Allowed.ANGLES, Allowed.UNKNOWN)),
    ]


def _sign_of(signs: npt.NDArray[np.int8]) -> int:
    """Return the certain sign of a link that goes one way."""
    return int(signs[np.abs(signs).argmax()])


def _together(found: npt.NDArray[np.int8]) -> Allowed:
    """Return what several orders with opposites allow together."""
    seen = set(found.tolist())
    if len(seen) == 1:
        return Allowed(seen.pop())
    either = Allowed.ANGLES in seen or {Allowed.ONE, Allowed.BOTH} <= seen
    return Allowed.ANGLES if either else Allowed.UNKNOWN


def placed_rows(
    shape: Shape, places: Floats, slots: Ints, symmetry: Ints, on_slots: bool, cone_angle: float | None
) -> list[Row]:
    """Return rows of joints at given azimuths.

    Parameters
    ----------
    shape : Shape
    places : float[r, J]
        Azimuths between 0 and 2 pi, radians.
    slots : int64[r, J]
        Slots, or the cyclic order.
    symmetry : int64[r]
    on_slots : bool
        Whether rows name the slots.
    cone_angle : float, optional
        lambda, radians.
    """
    chain = shape.chain
    motion = first_order(chain, places)
    rank = motion.rank()
    least = np.take_along_axis(motion.singular_values, rank[:, np.newaxis] - 1, -1)[:, 0]
    singular = rank < motion.singular_values.shape[-1]
    pairs, half = half_turns(chain, places)
    classes = four_bar_classes(shape.loops, places, cone_angle)
    circuits = shape.circuit_texts(places)
    deep = layers(chain, places).tolist()
    azimuths = np.degrees(places).round(12).tolist()
    angles = _link_angles(chain, places, pairs, cone_angle)
    ways = _placed_ways(shape, places) if shape.grounded else None
    joined = [f"{shape.names[a]}-{shape.names[b]}" for a, b in pairs]
    made: list[Row] = []
    for i, start in enumerate(shape.common(slots, False)):
        loops, names, count, density, turns = circuits[i]
        here = [joined[k] for k in np.flatnonzero(half[i]).tolist()]
        of_loops = [str(one[i]) for one in classes]
        row: list[Any] = [*(start if on_slots else start[:-1]), int(symmetry[i]), loops, names, count, density]
        row += [_text(turns), _text(f"{x:.12g}" for x in azimuths[i]), _text(here), len(here), deep[i]]
        row += [int(rank[i]), int(motion.freedoms[i]), bool(singular[i]), float(f"{least[i]:.9g}")]
        row += [_text(of_loops), of_loops.count("Grashof")]
        if angles is not None and cone_angle is not None:
            row += [round(float(np.degrees(cone_angle)), 10)]
            row += [_text(f"{name}:{x:.10g}" for name, x in zip(joined, angles[i], strict=True))]
        if ways is not None:
            row += ways[i]
        made.append(tuple(row))
    return made


def _link_angles(
    chain: ConformedChain, places: Floats, pairs: Sequence[tuple[int, int]], cone_angle: float | None
) -> list[list[float]] | None:
    """Return the link angles between joints of each link, degrees."""
    if cone_angle is None:
        return None
    first, second = (list(side) for side in zip(*pairs, strict=True))
    steps = wrapped(places[:, second] - places[:, first])
    found: list[list[float]] = np.degrees(link_angles(steps, cone_angle)).tolist()
    return found


def _placed_ways(shape: Shape, places: Floats) -> list[list[str]]:
    chain = shape.chain
    found = behaviour_of_motion(chain, places, first_order(chain, places), link_arcs(chain, places))
    word = {int(way): way.name.lower() for way in Way}
    known = (found.ways != Way.UNKNOWN).all(axis=-1).tolist()
    return [
        [
            shape.ways_text([word[one] for one in ways]),
            _ALLOWED[(Allowed.ONE if one_way else Allowed.BOTH) if told else Allowed.UNKNOWN],
        ]
        for ways, one_way, told in zip(found.ways.tolist(), found.one_way.tolist(), known, strict=True)
    ]
