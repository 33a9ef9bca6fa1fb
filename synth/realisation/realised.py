"""A type as a thing: a flat sheet of panels, or a pose of it in space.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Literal, get_args, overload

import numpy as np

from enumerate.strings.panel_strings import ChainString
from graphs.convert.table import Mechanism, to_scd
from graphs.errors import InvariantError, UnsolvableError, check_argument, shown
from graphs.identity.drawings import map_id
from graphs.limits import LEAST, MOST
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed
from graphs.rank.exact import exact_mobility
from graphs.rank.pose import pose_mobility
from graphs.tolerances import DOUBLE, MARGIN, signed
from graphs.types import Floats
from synth.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.motion.branches import first_branch, search_for
from synth.motion.walk.allowance import Allowance
from synth.realisation.drawing import Drawn, drawings
from synth.realisation.figures import ShapeFigures, figures_of
from synth.realisation.forms.strips import drawn_string, folded_strip, is_strip, strips
from synth.realisation.pattern import Pattern, pattern_of
from synth.realisation.refusing import check_holes
from synth.realisation.simplest import simplest_drawn
from synth.realisation.space.lifting import lifted
from synth.realisation.space.receding import receded, with_finite_centres
from synth.realisation.special.answer import SpecialSearch
from synth.realisation.special.search import SpecialWishes, search_special
from synth.realisation.wanted.wishes import Kept, Wishes, wishes_for

__all__ = ["Kind", "NotFoundError", "Realised", "realise"]

Kind = Literal["sheet", "space"]

_TRIES = 12
_HEIGHTS = (0.6, 0.3)
"""Parts of its heights to which a pose in space is flattened where its shape is not good. The map is affine, so
panels stay planar, and axes that meet go on meeting."""
_WORK, _STEPS = 10_000_000_000, 3
"""Cubes of the number of coordinates that steps of improvement may go through: types of a hundred vertices never
come to the end of them, one of a thousand does at once. Each realisation has some steps, whatever its size."""
_SMALLEST, _LARGEST = 1e2 * LEAST, 1e-2 * MOST
"""Sizes: what is folded in space is not quite as large as it is drawn."""
_OTHER_QUESTION = "realise gives a type new coordinates, those of a sheet, and takes no branch"
_USED_UP = "the search ended, its allowance of work was used up"


class NotFoundError(UnsolvableError):
    """None of the drawings that were tried is of the type: more tries, or another seed, may find one."""


Raised = Callable[[Pattern, Floats, np.random.Generator], tuple[Floats, Floats]]
"""What makes a pose in space of a drawing: places, and numbers above 0 at valleys."""


@dataclass(frozen=True)
class Realised(Printed):
    """A type with coordinates.

    Attributes
    ----------
    kind : {"sheet", "space"}
    scd : SCDGraph
        The type.
    configuration : SheetConfiguration
        Its sheet where it lies.
    figures : ShapeFigures
    mobility : int
        Exact generic mobility of the type.
    freedoms : int or None
        First-order freedoms at this pose; None where singular values do not tell.
    folds : bool or None
        Of a flat sheet: whether a way was found to fold it in which every crease turns. None in space.
    convex : bool
        Whether the border of the drawing is convex.
    bent : tuple of link id
        Panels that are not convex: three axes or more pass through one centre.
    number, tries : int
        Which try it is, and how many drawings were tried.
    notes : tuple of str
        What was chosen where the input leaves it open.
    kept : Kept
        How well the drawing is flat-foldable, and symmetric, where it was to be.
    """

    kind: Kind
    scd: SCDGraph
    configuration: SheetConfiguration
    figures: ShapeFigures
    mobility: int
    freedoms: int | None
    folds: bool | None
    convex: bool
    bent: tuple[Any, ...]
    number: int
    tries: int
    notes: tuple[str, ...] = ()
    kept: Kept = field(default_factory=Kept)

    @property
    def sheet(self) -> Sheet:
        """Its panels, in the order of the links; edge ``i`` is joint ``i`` in the order of ``scd.joints``.

        Then come borders. Valleys and mountains are those of the pose, or of a way to fold the flat sheet.
        """
        return self.configuration.drawn

    @property
    def rank(self) -> tuple[bool, bool, float]:
        """What it is chosen by: whether it moves as it should, whether it folds, its quality."""
        quality = self.figures.quality
        return self.kind == "sheet" or self.freedoms == self.mobility, self.folds is not False, quality

    @property
    def good(self) -> bool:
        """Whether no better one need be looked for."""
        moves, folds, quality = self.rank
        return moves and folds and quality >= 1.0

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "kind": self.kind,
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "drawing": map_id(self.scd),
            "figures": self.figures.to_json(),
            "mobility": self.mobility,
            "freedoms": self.freedoms,
            "folds": self.folds,
            "convex_border": self.convex,
            "bent_panels": list(self.bent),
            "try": self.number,
            "tries": self.tries,
            "notes": list(self.notes),
            **self.kept.to_json(),
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        shape = self.figures
        told = [f"note: {note}" for note in self.notes]
        told += [
            f"{'a flat sheet' if self.kind == 'sheet' else 'a pose in space'} of {self.scd}",
            f"drawing  {map_id(self.scd)}, read back from the coordinates",
            f"corners {np.degrees(shape.least_angle):.3g} to {np.degrees(shape.greatest_angle):.3g} degrees, "
            f"shortest side {shape.edge_ratio:.2g} of the longest, vertices {shape.least_distance:.2g} of the "
            f"extent apart, panels plane to {shape.planarity:.0e}",
        ]
        if self.bent:
            names = ", ".join(shown(link) for link in self.bent)
            told.append(f"not convex: panel(s) {names}, of which three axes or more pass through one centre")
        if not self.convex:
            told.append("the border is not convex")
        told.append(f"mobility {self.mobility}, exact; {self._freedoms()} at this pose")
        if self.folds is not None:
            told.append(self._folding())
        told += self.kept.lines()
        told.append(f"try {self.number + 1} of {self.tries}")
        return list(told)

    def _freedoms(self) -> str:
        found = "an unknown number of" if self.freedoms is None else str(self.freedoms)
        return f"{found} first-order freedom(s)"

    def _folding(self) -> str:
        if self.folds:
            return "folds with every crease turning, as mountains and valleys say"
        return f"no folding drawing found in {self.tries} tries: on each some creases stay flat"

    def __repr__(self) -> str:
        return f"<Realised: {self.kind}, {self.sheet!r}>"


@overload
def realise(
    mechanism: Mechanism | ChainString,
    *,
    kind: Kind = ...,
    size: float = ...,
    seed: int = ...,
    tries: int = ...,
    flat_foldable: bool = ...,
    symmetric: bool = ...,
    mode: str | None = ...,
    freedoms: None = ...,
) -> Realised: ...


@overload
def realise(
    mechanism: Mechanism,
    *,
    kind: Kind = ...,
    seed: int = ...,
    tries: int = ...,
    freedoms: int,
    geometry: str = ...,
    every: bool = ...,
    all_joints: bool = ...,
) -> SpecialSearch: ...


def realise(
    mechanism: Mechanism | ChainString,
    *,
    kind: Kind = "sheet",
    size: float = 1.0,
    seed: int = 0,
    tries: int = _TRIES,
    flat_foldable: bool = False,
    symmetric: bool = False,
    mode: str | None = None,
    freedoms: int | None = None,
    geometry: str = "",
    every: bool = False,
    all_joints: bool = True,
) -> Realised | SpecialSearch:
    """Give a type coordinates, or look for members of special dimensions that move.

    Parameters
    ----------
    mechanism : SCDGraph, or what has one; SCGraph; ChainString
        Of an SC graph without a drawing of its links, the SCD graph of fewest open edges is taken, which is told;
        of an R/- string a strip of panels, and of an open chain of such panels too.
    kind : {"sheet", "space"}, optional
        A flat sheet, or a pose in space with every crease folded.
    size : float, optional
        The longer side of the box round the drawing.
    seed : int, optional
        Other seeds give other drawings; the same gives the same.
    tries : int, optional
        How many drawings are tried at most. The first of good shape that folds is taken, or the best.
    flat_foldable : bool, optional
        Of a sheet: every other sector about an inner vertex sums to 180 degrees, and reflections in the creases
        round a hole close.
    symmetric : bool, optional
        Of a sheet: the drawing has the largest group of symmetries of the type with which it folds, or else with
        which one was found. Each group is tried so many times.
    mode : str, optional
        Of an R/- string: which of `ChainString.modes`, or one that is its reverse; without it all points in which
        creases meet lie on one side.
    freedoms : int, optional
        Look for a member that moves with so many freedoms although a general one has fewer: families of special
        geometry are tried one after the other, flat sheets first, then axes in space (``kind="space"``: these
        alone). Of an SC graph no panels are drawn.
    geometry : str, optional
        With `freedoms`: only families with this in their name.
    every : bool, optional
        With `freedoms`: try all families, not only until one moves.
    all_joints : bool, optional
        With `freedoms`: whether all joints have to move.

    Returns
    -------
    Realised or SpecialSearch
        The second with `freedoms`: what was tried and found, none being an answer too.

    Raises
    ------
    UnsolvableError
        If the mechanism has no drawing, its panels close to a surface without a border, it has no flat sheet, or
        it cannot be flat-foldable or symmetric.
    NotFoundError
        If nothing was found in so many tries.
    InvariantError
        If an option is out of its range.

    Examples
    --------
    >>> from graphs.identity.drawings import mechanism_from_map_id
    >>> vertex = realise(mechanism_from_map_id("m1:a-b.ac-.b-d.cd-"))
    >>> vertex.sheet, vertex.folds, vertex.mobility
    (<Sheet: 4 faces, 4 creases, 5 vertices, flat>, True, 1)
    """
    check_argument("realise", mechanism, Mechanism | ChainString)
    _check(kind, size, seed, tries)
    if freedoms is not None:
        if flat_foldable or symmetric or size != 1.0 or mode:
            told = "freedoms with flat_foldable, symmetric, size or mode"
            raise InvariantError("freedoms", told, "freedoms alone: the first two are among the families tried")
        search = SpecialWishes(freedoms, kind == "sheet", seed, tries, geometry, every, all_joints)
        return _special(mechanism, search)
    if geometry or every or not all_joints:
        raise InvariantError("freedoms", "geometry, every or all_joints without freedoms", "a number of freedoms")
    if kind == "space" and (flat_foldable or symmetric):
        raise InvariantError("kind", "a pose in space that is flat-foldable or symmetric", "a sheet")
    if isinstance(mechanism, ChainString) and (flat_foldable or symmetric):
        raise InvariantError("string", "an R/- string that is flat-foldable or symmetric", "an SCD graph")
    if mode and not isinstance(mechanism, ChainString):
        raise InvariantError("mode", f"the mode {shown(mode)} of {mechanism!r}", "a mode of an R/- string only")
    if isinstance(mechanism, ChainString):
        scd, notes = drawn_string(mechanism, mode)
    else:
        scd, notes = simplest_drawn(mechanism)
    pattern = pattern_of(scd)
    raised: Raised = lifted
    if kind == "sheet":
        check_holes(pattern)
    elif any(one.infinite for one in pattern.pointings):
        pattern, raised = with_finite_centres(pattern), partial(_receded, pattern)
    allowance = Allowance(max(_STEPS, _WORK // (2 * pattern.vertices) ** 3))
    asked = _Asked(kind, scd, pattern, map_id(scd), size, seed, tries, notes, raised, allowance)
    if not (flat_foldable or symmetric) and is_strip(asked.pattern):
        return _best(replace(asked, raised=folded_strip), [(Wishes(), strips(asked.pattern, seed, tries))])
    wishes = wishes_for(asked.pattern, flat_foldable=flat_foldable, symmetric=symmetric)
    some = asked.allowance
    return _best(asked, [(one, drawings(asked.pattern, seed, tries, one, some)) for one in wishes])


@dataclass(frozen=True, slots=True)
class _Asked:
    """What is to be realised, and how; in space, centres at infinity are drawn as points."""

    kind: Kind
    scd: SCDGraph
    pattern: Pattern
    code: str
    size: float
    seed: int
    tries: int
    notes: tuple[str, ...]
    raised: Raised
    allowance: Allowance

    @property
    def ended(self) -> tuple[str, ...]:
        """A word on a search that ended too early."""
        return (_USED_UP,) if self.allowance.left <= 0 else ()


def _receded(
    given: Pattern, pattern: Pattern, places: Floats, random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Return a pose in which centres that were drawn as points are at infinity, as they are in what is given."""
    return receded(pattern, tuple(one for one in given.pointings if one.infinite), places, random)


def _best(asked: _Asked, sources: Sequence[tuple[Wishes, Iterable[Drawn]]]) -> Realised:
    """Return the best realisation of the first source of drawings that gives one which folds, or else one."""
    reasons: dict[str, None] = {}
    first: Realised | None = None
    for wishes, drawn in sources:
        best = _best_of(asked, wishes, drawn, reasons)
        if best is not None and best.folds is not False:
            return replace(best, notes=(*best.notes, *asked.ended))
        first = first or best
    if first is not None:
        return replace(first, notes=(*first.notes, *asked.ended))
    why = "; ".join(reasons) or "no drawing without crossings in which creases point to their centres"
    why = "; ".join((why, *asked.ended))
    raise NotFoundError(f"not found in {asked.tries * len(sources)} tries: {why}")


def _best_of(asked: _Asked, wishes: Wishes, tried: Iterable[Drawn], reasons: dict[str, None]) -> Realised | None:
    best: Realised | None = None
    for drawn in tried:
        try:
            found = replace(_shaped(asked, drawn), kept=wishes.kept(asked.pattern, drawn.places))
        except UnsolvableError as error:
            reasons[str(error)] = None
            continue
        if best is None or _is_better(found, best):
            best = found
        if best.good:
            break
    return best


def _is_better(one: Realised, other: Realised) -> bool:
    """Tell whether one ranks above another: of those that are as good but for rounding neither does."""
    *said, quality = one.rank
    *before, least = other.rank
    return said > before or (said == before and quality > least + MARGIN)


def _shaped(asked: _Asked, drawn: Drawn) -> Realised:
    """Return what a drawing gives; in space the first pose of good shape, or else the best, steep ones first."""
    best = _realised(asked, drawn, 1.0)
    for height in _HEIGHTS:
        if best.good or asked.kind == "sheet" or asked.raised is folded_strip:
            break
        found = _realised(asked, drawn, height)
        best = found if _is_better(found, best) else best
    return best


def _realised(asked: _Asked, drawn: Drawn, height: float) -> Realised:
    """Return what a drawing gives; refuse one that is of another type when it is read back."""
    sheet = _placed(asked, drawn, height)
    if map_id(to_scd(sheet)) != asked.code:
        raise UnsolvableError("the axes of a loop meet that the type does not ask to")
    at = configuration_of_sheet(sheet)
    at, folds = _folded(at) if asked.kind == "sheet" else (at, None)
    pattern = asked.pattern
    return Realised(
        kind=asked.kind,
        scd=asked.scd,
        configuration=at,
        figures=figures_of(pattern, sheet, drawn.angles),
        mobility=exact_mobility(asked.scd).mobility,
        freedoms=pose_mobility(sheet).dof,
        folds=folds,
        convex=drawn.convex,
        bent=tuple(link for link, bent in zip(pattern.links, pattern.bent, strict=True) if bent),
        number=drawn.number,
        tries=asked.tries,
        notes=asked.notes,
    )


def _special(mechanism: Mechanism | ChainString, search: SpecialWishes) -> SpecialSearch:
    """Return what a search for special geometry finds; strings have no loops."""
    if isinstance(mechanism, ChainString):
        raise InvariantError("string", "special geometry of an R/- string", "a type with a loop")
    return search_special(mechanism, search)


def _check(kind: str, size: float, seed: int, tries: int) -> None:
    if kind not in get_args(Kind):
        raise InvariantError("kind", f"the kind is {shown(kind)}", " or ".join(get_args(Kind)))
    if not _SMALLEST <= size <= _LARGEST:
        raise InvariantError("size", f"the size is {size:g}", f"a number from {_SMALLEST:g} to {_LARGEST:g}")
    if seed < 0 or tries < 1:
        raise InvariantError("tries", f"seed {seed}, tries {tries}", "a seed of 0 or more, one try or more")


def _placed(asked: _Asked, drawn: Drawn, height: float) -> Sheet:
    """Return the panels with coordinates of the size that is asked for; in space, heights times a number."""
    pattern = asked.pattern
    places = drawn.places - drawn.places.min(axis=0)
    places = places * (1.0 / places.max())
    creases, turns = len(pattern.creases), None
    if asked.kind == "space":
        places, turns = asked.raised(pattern, places, np.random.default_rng((asked.seed, drawn.number)))
        places[:, 2] *= height
    sheet = Sheet(
        pattern.vertices,
        tuple((int(a), int(b)) for a, b in pattern.edges),
        "U" * creases + "B" * (len(pattern.edges) - creases),
        pattern.panels,
        tuple(tuple(map(float, row)) for row in asked.size * places),
    )
    return sheet if turns is None else _lettered(sheet, turns)


def _folded(at: SheetConfiguration) -> tuple[SheetConfiguration, bool]:
    """Return a flat sheet with the mountains and valleys of a way to fold in which every crease turns, if any.

    It folds as well to the other side: the first crease is a valley.
    """
    joints = len(at.joints)
    way = first_branch(at.linkage, _turns_all, search_for(joints, np.ones(joints)))
    if way is None:
        return at, False
    drawn, sheet = (_lettered(one, signed(way.rates)) for one in (at.drawn, at.sheet))
    return replace(at, given=drawn, drawn=drawn, sheet=sheet), True


def _turns_all(rates: Floats) -> bool:
    return bool(np.abs(rates).min(initial=1.0) > DOUBLE.zero_rate)


def _lettered(sheet: Sheet, turns: Floats) -> Sheet:
    letters = "".join("V" if turn > 0.0 else "M" for turn in turns)
    return replace(sheet, assignments=letters + sheet.assignments[len(letters) :])
