"""A type with coordinates: a flat sheet of panels, or a configuration of it in space.

Theory: docs/theory/realisation.md.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any, Literal, get_args, overload

import numpy as np

from enumerate.strings.panel_strings import ChainString
from graphs.convert.conversions import Mechanism
from graphs.convert.panels import scd_of_placed_panels
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.identity.drawings import map_id
from graphs.input_limits import LEAST, MOST
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed
from graphs.rank.exact import exact_mobility
from graphs.rank.infinitesimal import infinitesimal_mobility
from graphs.tolerances import MARGIN, signed
from graphs.types import Floats
from synth.analysis.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.analysis.motion.branches import first_branch, search_for
from synth.analysis.motion.walk.step import Allowance
from synth.catalogue.realisation.conditions import ConditionErrors, DrawingConditions, choices_of_conditions
from synth.catalogue.realisation.drawing import PanelDrawing, drawings
from synth.catalogue.realisation.measures import ShapeFigures, figures_of, first_order_freedoms
from synth.catalogue.realisation.pattern import (
    Pattern,
    check_holes,
    check_search,
    listed,
    pattern_of,
    sheet_of_places,
    simplest_drawn,
)
from synth.catalogue.realisation.space import lifted, receded, with_finite_centres
from synth.catalogue.realisation.special.search import (
    OTHER_TYPE,
    SpecialSearch,
    SpecialWishes,
    search_special,
    turns_all,
)
from synth.catalogue.realisation.strips import drawn_string, folded_strip, is_strip, strips

Kind = Literal["sheet", "space"]

_TRIES = 12
_HEIGHTS = (1.0, 0.6, 0.3)
"""Fractions to which heights in space are reduced where the shape is not good. The map is affine, so panels stay
planar, and axes that meet go on meeting."""
_WORK, _STEPS = 10_000_000_000, 3
"""Allowance for steps of improvement, each at the cube of the number of coordinates: types of a hundred
vertices never use it up, one of a thousand does at once. Each realisation has some steps, whatever its size."""
_SMALLEST, _LARGEST = 1e2 * LEAST, 1e-2 * MOST
"""Sizes: a folded sheet is not quite as large as its drawing."""
_OTHER_QUESTION = "realise gives a type new coordinates, those of a sheet, and takes no branch"


class NotFoundError(UnsolvableError):
    """None of the drawings that were tried is of the type: more tries, or another seed, may find one."""


Lift = Callable[[Pattern, Floats, np.random.Generator], tuple[Floats, Floats]]
"""From a drawing to a configuration in space: places, and numbers above 0 at valleys."""


@dataclass(frozen=True)
class Realisation(Printed):
    """A type with coordinates.

    Attributes
    ----------
    kind : {"sheet", "space"}
    scd : SCDGraph
        The type.
    configuration : SheetConfiguration
        Its sheet with the coordinates.
    figures : ShapeFigures
    mobility : int
        Exact generic mobility of the type.
    freedoms : int or None
        First-order freedoms at this configuration; None where singular values do not decide.
    folds : bool or None
        For a flat sheet, whether a folding branch was found on which every crease turns. None in space.
    convex : bool
        Whether the border of the drawing is convex.
    bent : tuple of link id
        Panels that are not convex: three axes or more pass through one centre.
    number, tries : int
        Number of this try, and the largest number of tries.
    notes : tuple of str
        Choices that the input leaves open.
    condition_errors : ConditionErrors
        How well the drawing is flat-foldable and symmetric, where this was required.
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
    condition_errors: ConditionErrors = field(default_factory=ConditionErrors)

    @property
    def sheet(self) -> Sheet:
        """Its panels, in the order of the links; edge ``i`` is joint ``i`` in the order of ``scd.joints``.

        Then come borders. Valleys and mountains are those of the configuration, or of a folding branch of the flat
        sheet.
        """
        return self.configuration.drawn

    @property
    def rank(self) -> tuple[bool, bool, float]:
        """Key of the choice: whether it moves as the type, whether it folds, its quality."""
        moves = self.kind == "sheet" or self.freedoms == self.mobility
        return moves, self.folds is not False, self.figures.quality

    @property
    def moves_and_folds(self) -> bool:
        """Whether it moves as the type, and a flat sheet folds: only its shape could be better."""
        return all(self.rank[:2])

    @property
    def good(self) -> bool:
        """Whether the search can end with it."""
        return self.moves_and_folds and self.figures.quality >= 1.0

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
            **self.condition_errors.to_json(),
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        shape = self.figures
        sizes = str(self.scd).removeprefix(type(self.scd).__name__)
        lines = [f"note: {note}" for note in self.notes]
        lines += [
            f"{'flat sheet' if self.kind == 'sheet' else 'configuration in space'} of an SCD graph{sizes}",
            f"drawing  {map_id(self.scd)}, read back from the coordinates",
            f"corners {np.degrees(shape.least_angle):.3g} to {np.degrees(shape.greatest_angle):.3g} degrees, "
            f"shortest side {shape.edge_ratio:.2g} of the longest, vertices {shape.least_distance:.2g} of the "
            f"extent apart, panels planar to {shape.planarity:.0e}",
        ]
        if self.bent:
            lines.append(f"not convex: {listed('panel', self.bent)}, with three axes or more through one centre")
        if not self.convex:
            lines.append("the border is not convex")
        lines.append(f"mobility {self.mobility}, exact; {first_order_freedoms(self.freedoms)} at this configuration")
        if self.folds:
            lines.append("folds on every crease, with the mountain-valley assignment written")
        elif self.folds is False:
            tries = numbered(self.tries, "try", "tries")
            lines.append(f"{tries}, and none folds on every crease: on each some creases stay flat")
        return [*lines, *self.condition_errors.lines(), f"try {self.number + 1} of at most {self.tries}"]

    def __repr__(self) -> str:
        return f"<Realisation: {self.kind}, {self.sheet!r}>"


@overload
def realise(
    mechanism: MechanismLike | ChainString,
    *,
    kind: Kind = ...,
    size: float = ...,
    seed: int = ...,
    tries: int = ...,
    flat_foldable: bool = ...,
    symmetric: bool = ...,
    mode: str | None = ...,
    freedoms: None = ...,
) -> Realisation: ...


@overload
def realise(
    mechanism: MechanismLike,
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
    mechanism: MechanismLike | ChainString,
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
) -> Realisation | SpecialSearch:
    """Give a type coordinates, or search for realisations with special dimensions that move.

    Parameters
    ----------
    mechanism : SCDGraph, or a mechanism that has one; SCGraph; ChainString
        For an SC graph, whose links have no drawing, the SCD graph of fewest open edges is chosen, with a note;
        an R/- string, or an open chain of such panels, becomes a strip of panels.
    kind : {"sheet", "space"}, optional
        A flat sheet, or a configuration in space with every crease folded.
    size : float, optional
        The longer side of the bounding box of the drawing.
    seed : int, optional
        Another seed gives another drawing; the same gives the same.
    tries : int, optional
        Largest number of drawings. The first of good shape that folds is chosen, or else the best.
    flat_foldable : bool, optional
        For a sheet: every other sector about an inner vertex sums to 180 degrees, and reflections in the creases
        round a hole close.
    symmetric : bool, optional
        For a sheet: the drawing has the largest group of symmetries of the type with which it folds, or else the
        largest that was found. Each group gets the given number of tries.
    mode : str, optional
        For an R/- string: one of `ChainString.modes`, or the reverse of one; without it all points in which
        creases meet are on one side.
    freedoms : int, optional
        Search for a realisation that moves with so many freedoms although a generic one has fewer: families of
        special geometry are tried one after the other, flat sheets first, then axes in space
        (``kind="space"``: these alone). For an SC graph no panels are drawn.
    geometry : str, optional
        With `freedoms`: only families with this in their name.
    every : bool, optional
        With `freedoms`: try all families, not only until one moves.
    all_joints : bool, optional
        With `freedoms`: whether all joints have to move.

    Returns
    -------
    Realisation or SpecialSearch
        The second with `freedoms`: the families and the results, possibly none.

    Raises
    ------
    UnsolvableError
        If the mechanism has no drawing, its panels form a closed surface, it has no flat sheet, or it cannot be
        flat-foldable or symmetric.
    NotFoundError
        If nothing was found in all tries.
    InvariantError
        If an option is out of its range.

    Examples
    --------
    >>> from graphs.identity.drawings import mechanism_from_map_id
    >>> vertex = realise(mechanism_from_map_id("m1:a-b.ac-.b-d.cd-"))
    >>> vertex.sheet, vertex.folds, vertex.mobility
    (<Sheet: 4 faces, 4 creases, 5 vertices, flat>, True, 1)
    """
    source: Mechanism | ChainString = mechanism_for("realise", mechanism, Mechanism | ChainString)
    _check(kind, size)
    check_search(seed, tries)
    if freedoms is not None:
        if flat_foldable or symmetric or size != 1.0 or mode:
            what = "freedoms with flat_foldable, symmetric, size or mode"
            raise InvariantError("freedoms", what, "freedoms alone: the first two are among the families tried")
        if isinstance(source, ChainString):
            raise InvariantError("string", "special geometry of an R/- string", "a type with a loop")
        wishes = SpecialWishes(freedoms, kind == "sheet", seed, tries, geometry, every, all_joints)
        return search_special(source, wishes)
    if geometry or every or not all_joints:
        raise InvariantError("freedoms", "geometry, every or all_joints without freedoms", "a number of freedoms")
    if kind == "space" and (flat_foldable or symmetric):
        raise InvariantError("kind", "a flat-foldable or symmetric configuration in space", "a sheet")
    if isinstance(source, ChainString) and (flat_foldable or symmetric):
        raise InvariantError("string", "an R/- string that is flat-foldable or symmetric", "an SCD graph")
    if mode and not isinstance(source, ChainString):
        raise InvariantError("mode", f"the mode {shown(mode)} for {source!r}", "an R/- string with it")
    scd, notes = drawn_string(source, mode) if isinstance(source, ChainString) else simplest_drawn(source)
    pattern = pattern_of(scd)
    lift: Lift = lifted
    if kind == "sheet":
        check_holes(pattern)
    elif infinite := [pointing for pointing in pattern.pointings if pointing.infinite]:
        # centres at infinity are drawn as points, and recede in space
        pattern, lift = with_finite_centres(pattern), partial(receded, infinite)
    allowance = Allowance(max(_STEPS, _WORK // (2 * pattern.vertices) ** 3))
    task = _Task(kind, scd, pattern, map_id(scd), size, seed, tries, notes, lift, allowance)
    if not (flat_foldable or symmetric) and is_strip(pattern):
        return _best(replace(task, lift=folded_strip), [(DrawingConditions(), strips(pattern, seed, tries))])
    choices = choices_of_conditions(pattern, flat_foldable=flat_foldable, symmetric=symmetric)
    return _best(task, [(choice, drawings(pattern, seed, tries, choice, allowance)) for choice in choices])


_MOST_SHOWN, _FEW_TRIES = 12, 4
"""Links of the largest types whose sheet is shown in catalogues, and drawings that are tried of each."""


def sheet_of_type(mechanism: SCGraph) -> tuple[Sheet | None, str]:
    """Return a sheet of an SC or SCD graph, found quickly, and what there is to say of it.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph

    Returns
    -------
    (Sheet or None, str)
        A flat sheet if there is one, or else a configuration in space. Of an SC graph the second says how many
        open edges it has, where there is no sheet, why.

    Examples
    --------
    >>> from graphs.identity.drawings import mechanism_from_map_id
    >>> sheet_of_type(mechanism_from_map_id("m1:ab.ac.bd.cd"))
    (<Sheet: 4 faces, 4 creases, 5 vertices, flat>, 'sheet of 4 open edges')
    """
    if len(mechanism) > _MOST_SHOWN:
        return None, f"no sheet: more than {_MOST_SHOWN} links"
    reason = ""
    for kind in get_args(Kind):
        try:
            realised = realise(mechanism, kind=kind, tries=_FEW_TRIES)
        except UnsolvableError as error:
            reason = reason or f"no sheet: {error}"
            continue
        open_edges = numbered(realised.scd.counts.open_edges, "open edge")
        return realised.sheet, "" if isinstance(mechanism, SCDGraph) else f"sheet of {open_edges}"
    return None, reason


@dataclass(frozen=True)
class _Task:
    """A type to be realised, with the options."""

    kind: Kind
    scd: SCDGraph
    pattern: Pattern
    code: str
    size: float
    seed: int
    tries: int
    notes: tuple[str, ...]
    lift: Lift
    allowance: Allowance

    @cached_property
    def mobility(self) -> int:
        """The exact mobility of the type."""
        return exact_mobility(self.scd).mobility


def _best(task: _Task, sources: Sequence[tuple[DrawingConditions, Iterable[PanelDrawing]]]) -> Realisation:
    """Return the best realisation of the first source of drawings that gives one which folds, or else any."""
    reasons: dict[str, None] = {}
    best: Realisation | None = None
    for wishes, drawn in sources:
        of_source = _best_of(task, wishes, drawn, reasons)
        if best is None or (of_source is not None and of_source.folds is not False):
            best = of_source
        if best is not None and best.folds is not False:
            break
    used_up = "the search ended early: its allowance of work was used up"
    ended = (used_up,) if task.allowance.left <= 0 else ()
    if best is not None:
        return replace(best, notes=(*best.notes, *ended))
    reasons = reasons or {"no drawing without crossings in which creases point to their centres": None}
    why = "; ".join((*reasons, *ended))
    tries = numbered(task.tries * len(sources), "try", "tries")
    raise NotFoundError(f"no realisation was found in {tries}: {why}")


@dataclass(frozen=True, slots=True, eq=False)
class _Placed:
    """A drawing that has become a sheet, of which only the shape is known yet.

    The folds, float[J], are those of a lift; None for a flat sheet.
    """

    drawn: PanelDrawing
    sheet: Sheet
    folds: Floats | None
    figures: ShapeFigures


def _best_of(
    task: _Task, wishes: DrawingConditions, tried: Iterable[PanelDrawing], reasons: dict[str, None]
) -> Realisation | None:
    """Return the first good realisation of some drawings, or else the best.

    Shape is cheap to know, type and motion are not. So sheets of good shape are read back and folded at once, the
    others at the end, the best first: the first that moves and folds is it.
    """
    best: Realisation | None = None
    failed: list[tuple[int, str]] = []
    others: list[_Placed] = []
    for drawn in tried:
        try:
            for placed in _placed(task, drawn):
                others.append(placed)
                if placed.figures.quality < 1.0:
                    continue
                realised = _realised(task, wishes, others.pop())
                if realised.good:
                    return realised
                best = realised if best is None or _is_better(realised, best) else best
        except UnsolvableError as error:
            failed.append((drawn.number, str(error)))
    while others and (best is None or not best.moves_and_folds):
        most = max(placed.figures.quality for placed in others)
        placed = next(placed for placed in others if placed.figures.quality >= most - MARGIN)
        others.remove(placed)
        try:
            realised = _realised(task, wishes, placed)
        except UnsolvableError as error:
            failed.append((placed.drawn.number, str(error)))
            continue
        best = realised if best is None or _is_better(realised, best) else best
    reasons.update({reason: None for _, reason in sorted(failed)})
    return best


def _is_better(realised: Realisation, other: Realisation) -> bool:
    """Check whether a realisation ranks above another: of those that differ only by rounding neither does."""
    *verdict, quality = realised.rank
    *other_verdict, other_quality = other.rank
    return verdict > other_verdict or (verdict == other_verdict and quality > other_quality + MARGIN)


def _placed(task: _Task, drawn: PanelDrawing) -> Iterator[_Placed]:
    """Yield the sheets of a drawing: in space the steepest first.

    Raises `UnsolvableError` if it has no lift.
    """
    pattern = task.pattern
    places = drawn.places - drawn.places.min(axis=0)
    places = places * (1.0 / places.max())
    folds: Floats | None = None
    heights: tuple[float, ...] = (1.0,)
    if task.kind == "space":
        places, folds = task.lift(pattern, places, np.random.default_rng((task.seed, drawn.number)))
        heights = heights if task.lift is folded_strip else _HEIGHTS
    for height in heights:
        there = places * np.array([1.0, 1.0, height])[: places.shape[1]]
        sheet = sheet_of_places(pattern, task.size * there)
        yield _Placed(drawn, sheet, folds, figures_of(pattern, sheet, drawn.angles))


def _realised(task: _Task, wishes: DrawingConditions, placed: _Placed) -> Realisation:
    """Return the realisation of a placed drawing; UnsolvableError if it is of another type when it is read back."""
    drawn, pattern = placed.drawn, task.pattern
    sheet = placed.sheet if placed.folds is None else _lettered(placed.sheet, placed.folds)
    if map_id(scd_of_placed_panels(sheet)) != task.code:
        raise UnsolvableError(OTHER_TYPE)
    at = configuration_of_sheet(sheet)
    freedoms = infinitesimal_mobility(sheet, at.dual).dof
    at, folds = _folded(at) if task.kind == "sheet" else (at, None)
    return Realisation(
        kind=task.kind,
        scd=task.scd,
        configuration=at,
        figures=placed.figures,
        mobility=task.mobility,
        freedoms=freedoms,
        folds=folds,
        convex=drawn.convex,
        bent=tuple(link for link, bent in zip(pattern.links, pattern.bent, strict=True) if bent),
        number=drawn.number,
        tries=task.tries,
        notes=task.notes,
        condition_errors=wishes.errors(pattern, drawn.places),
    )


def _check(kind: str, size: float) -> None:
    if kind not in get_args(Kind):
        raise InvariantError("kind", f"the kind is {shown(kind)}", " or ".join(get_args(Kind)))
    if not _SMALLEST <= size <= _LARGEST:
        raise InvariantError("size", f"the size is {size:g}", f"a number from {_SMALLEST:g} to {_LARGEST:g}")


def _folded(at: SheetConfiguration) -> tuple[SheetConfiguration, bool]:
    """Return a flat sheet with the assignment of a folding branch on which every crease turns, if there is one."""
    joints = len(at.joints)
    branch = first_branch(at.linkage, turns_all, search_for(joints, np.ones(joints)))
    if branch is None:
        return at, False
    rates = signed(branch.rates)  # it folds as well to the other side: the first crease is a valley
    drawn, sheet = (_lettered(panels, rates) for panels in (at.drawn, at.sheet))
    return replace(at, given=drawn, drawn=drawn, sheet=sheet), True


def _lettered(sheet: Sheet, turns: Floats) -> Sheet:
    letters = "".join("V" if turn > 0.0 else "M" for turn in turns)
    return replace(sheet, assignments=letters + sheet.assignments[len(letters) :])
