"""Families of flat sheets whose members may fold although counts say no.

Each family draws the type with further conditions: flat-foldable vertices, a symmetry, straight lines, parallel
creases. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import radians

import numpy as np

from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.motion.walk.allowance import Allowance
from synth.realisation.drawing import drawings
from synth.realisation.pattern import Pattern
from synth.realisation.wanted.conditions import Condition
from synth.realisation.wanted.flat_folding import flat_folding
from synth.realisation.wanted.lines import bent_line, bundles, parallel_creases, straight_lines
from synth.realisation.wanted.ratios import agreeing_ratios, panels_between_vertices
from synth.realisation.wanted.symmetry import symmetries
from synth.realisation.wanted.wishes import Wishes

__all__ = ["SheetFamily", "sheet_families"]

_MODES = 4
"""So many choices of modes are tried for each start: signs have to agree round panels too, and are not asked."""
_BENT = (radians(10.0), radians(40.0))
"""Lines that a symmetry lets bend are bent by so much: the most even drawing has them all but straight."""


@dataclass(frozen=True)
class SheetFamily:
    """Flat sheets of a type that obey further conditions.

    Lines may be `bent` by a random angle; `ratios` of half-angle tangents may have to agree round panels, in
    random modes of the vertices.
    """

    name: str
    wishes: Wishes
    bent: bool = False
    ratios: bool = False

    def members(self, pattern: Pattern, seed: int, tries: int, work: Allowance) -> Iterator[tuple[int, Sheet]]:
        """Yield drawings as sheets, the longer side about 1, with the number of the try."""
        if not (self.bent or self.ratios):
            for drawn in drawings(pattern, seed, tries, self.wishes, work):
                yield drawn.number, _sheet(pattern, drawn.places)
            return
        for number in range(_MODES * tries if self.ratios else tries):
            random = np.random.default_rng((seed, number))
            wishes = replace(self.wishes, others=(*self.wishes.others, *self._random(pattern, random)))
            first = number + self.ratios  # the most even drawing has ratios of nothing
            for drawn in drawings(pattern, seed, 1, wishes, work, first=first):
                yield number, _sheet(pattern, drawn.places)
            if work.used_up:
                return

    def _random(self, pattern: Pattern, random: np.random.Generator) -> Iterator[Condition]:
        if self.ratios:
            yield agreeing_ratios(pattern, (random.random(len(pattern.inner)) < 0.5).tolist())
        if self.bent:
            condition = bent_line(pattern, float(random.uniform(*_BENT) * random.choice([-1.0, 1.0])))
            assert condition is not None
            yield condition


def _sheet(pattern: Pattern, places: Floats) -> Sheet:
    creases = len(pattern.creases)
    places = places - places.min(axis=0)
    places = places / places.max()
    return Sheet(
        pattern.vertices,
        tuple((int(a), int(b)) for a, b in pattern.edges),
        "U" * creases + "B" * (len(pattern.edges) - creases),
        pattern.panels,
        tuple(tuple(map(float, row)) for row in places),
    )


def sheet_families(pattern: Pattern) -> list[SheetFamily]:
    """Return the families that are tried, in their order; flat-foldable ones only where vertices can be.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> [one.name for one in sheet_families(fan)][:2]
    ['flat-foldable, lines 1 straight', 'flat-foldable, lines 2 straight']
    """
    conditions = _of_lines(pattern)
    groups, bendable = symmetries(pattern), bool(bundles(pattern))
    found = []
    for flat in (True, False) if _can_fold_flat(pattern) else (False,):
        head = ("flat-foldable",) if flat else ()
        found += [SheetFamily(", ".join((*head, name)), Wishes(flat, None, needed)) for name, needed in conditions]
        for group in groups:
            name = ", ".join((*head, str(group)))
            found.append(SheetFamily(name, Wishes(flat, group)))
            if bendable:
                found.append(SheetFamily(f"{name}, lines bent", Wishes(flat, group), bent=True))
        if flat:
            found += _with_ratios(pattern)
    return found


def _with_ratios(pattern: Pattern) -> list[SheetFamily]:
    """Return the families of flat-foldable sheets without other conditions, or with ratios that agree."""
    plain = SheetFamily("flat-foldable", Wishes(True))
    if not panels_between_vertices(pattern):
        return [plain]
    name = "flat-foldable, ratios that agree round panels"
    bent = SheetFamily(f"{name}, lines bent", Wishes(True), bent=True, ratios=True)
    return [plain, bent, SheetFamily(name, Wishes(True), ratios=True)]


def _of_lines(pattern: Pattern) -> list[tuple[str, tuple[Condition, ...]]]:
    """Return conditions on lines and parallel creases, with their names."""
    straight = [
        (f"lines {number} straight", (straight_lines(pattern, bundle),))
        for number, bundle in enumerate(bundles(pattern), 1)
    ]
    parallel = parallel_creases(pattern)
    if parallel is None:
        return [*straight]
    name = "opposite creases of panels parallel"
    both = [(f"{one}, {name}", (*conditions, parallel)) for one, conditions in straight]
    return [*both, (name, (parallel,)), *straight]


def _can_fold_flat(pattern: Pattern) -> bool:
    try:
        flat_folding(pattern)
    except UnsolvableError:
        return False
    return True
