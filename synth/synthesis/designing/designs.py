"""Designs: found from wishes, judged, and compared; `design` is what `synth design` calls.

A design is a success if its configurations are closed, its rules hold, the verdict says that it moves, and a motion
passes its configurations on one branch in their order, panels beside each other. Theory: docs/theory/design.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from html import escape
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np

from graphs.answer.mobility import counts_and_ranks
from graphs.convert.conversions import Mechanism
from graphs.errors import InvariantError, SynthedraError, UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.plain_data import fields_to_json
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Floats, LinkId
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.verdict._mobility import verdict_of_motion
from synth.catalogue.patterns.generators import GENERATORS
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text
from synth.making.viewer.pages import html_page
from synth.synthesis.designing.defects import Defect, DefectKind, sentence_of
from synth.synthesis.designing.dimensions import Designable, Dimensions, dimensions_of, family_begun_at
from synth.synthesis.designing.placement import DesignConfiguration
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.search import FoundDesign, found_from, seeded, start_of
from synth.synthesis.designing.targets import beside_target
from synth.synthesis.designing.tracing import TracedMotion, collision_on_the_way, traced, traced_together
from synth.synthesis.designing.wish_files import read_wishes
from synth.synthesis.designing.wishes import POSE, PointsOn, Unit, Wishes

STARTS = 8
"""Starts of a search by default: some seconds for a linkage of a few links."""
SPREAD = 0.1
"""How far starts are off the mechanism, radians of axes, parts of edges and parameters: other ends of the search, and
mostly the same assembly mode."""
FIGURE_HEADS = ("wish", "miss", "depends most on (change per unit)")
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
_STYLE = (
    "body{font-family:sans-serif;margin:2em;max-width:60em}td,th{text-align:left;padding:.2em .8em}"
    "figure{display:inline-block;margin:1em}svg{max-width:26em;height:auto}"
)
MET_DIGITS = 9
"""Decimals of a miss by which designs are compared: so many agree among processors (docs/theory/design.md)."""
_MET = 1e-9
"""A wish that misses by less, in radians or parts of the extent, is met: one of these digits."""


@dataclass(frozen=True, slots=True)
class WishFigure:
    """By how much a design misses a wish, in radians or the unit of the file, and how that depends on dimensions.

    `sensitivity` holds the largest change of the measured numbers for a unit change of each dimension (a radian of an
    axis, a length of a vertex, a unit of a parameter), inputs held: which cuts must be exact.
    """

    wish: str
    unit: Unit
    miss: float
    part: float
    sensitivity: Mapping[str, float]

    @property
    def met(self) -> bool:
        """Whether the wish is met to rounding."""
        return self.part <= _MET

    @property
    def text(self) -> str:
        """The miss in words."""
        if self.met:
            return "met"
        return f"{degrees(self.miss):.3g}°" if self.unit == "angle" else f"{self.miss:.3g}"

    def to_json(self) -> dict[str, Any]:
        """Return plain data, angles in degrees."""
        miss = degrees(self.miss) if self.unit == "angle" else self.miss
        return {
            "wish": self.wish,
            "unit": self.unit,
            "miss": miss,
            "met": self.met,
            "sensitivity": dict(self.sensitivity),
        }

    def record(self) -> dict[str, Any]:
        """Return what a store holds, radians: the fields by name."""
        return fields_to_json(self)


@dataclass(frozen=True, repr=False)
class Design(Printed):
    """A mechanism with new dimensions, with its figures against each wish.

    Attributes
    ----------
    start : int
        Number of the start that led to it.
    numbers : float[n]
        Those of its `Dimensions`.
    mechanism : Mechanism
    figures : tuple of WishFigure
    error : float
        Largest loop-closure residual of its configurations, and miss of a rule.
    freedoms : int or None
        By the verdict; None if it has none.
    verdict : str
        Its sentence, or why there is none.
    defects : tuple of Defect
        Why it is no success; none of a success.
    angles : mapping of str to mapping of str to float
        Joint angles at each configuration, radians.
    traced : bool
        Whether its configurations were traced.
    inputs : tuple of float
        Angles of the driven joint at the configurations as they are passed, radians, not wrapped.
    settled : bool
        Whether the search ended where no step makes the design better, or brings it nearer to its start; False if it
        ended with the last of its steps.

    Examples
    --------
    >>> from synth.synthesis.designing.sizes import LinkArc
    >>> from synth.synthesis.designing.wishes import Goal
    >>> from synth.catalogue.patterns import generate
    >>> wish = LinkArc(joints=("0", "1"), goal=Goal(equals=1.0))
    >>> best = design(generate("four-bar").mechanism, Wishes((wish,)), starts=1).best
    >>> best.success, best.freedoms, best.figures[0].text
    (True, 1, 'met')
    """

    start: int
    numbers: Floats
    mechanism: Mechanism
    figures: tuple[WishFigure, ...]
    error: float
    freedoms: int | None
    verdict: str
    defects: tuple[Defect, ...]
    angles: Mapping[str, Mapping[str, float]]
    traced: bool = False
    inputs: tuple[float, ...] = ()
    settled: bool = False

    @property
    def closed(self) -> bool:
        """Whether all configurations are closed, and rules hold."""
        return self.error <= DOUBLE.closed

    @property
    def moves(self) -> bool:
        """Whether the verdict says that it moves."""
        return bool(self.freedoms)

    @property
    def success(self) -> bool:
        """Whether it is closed, moves, and its motion has no defects."""
        return not self.defects

    @property
    def miss(self) -> float:
        """The largest miss of a wish, in radians or parts of the extent."""
        return max((figure.part for figure in self.figures), default=0.0)

    @property
    def faults(self) -> tuple[str, ...]:
        """Why it is no success, in sentences: to be printed, and read by nobody."""
        return tuple(map(sentence_of, self.defects))

    def __repr__(self) -> str:
        misses = "all wishes met" if self.miss <= _MET else f"largest miss {self.miss:.1e}"
        return f"<Design: {misses}, {'success' if self.success else '; '.join(self.faults)}>"

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = [f"design from start {self.start}: {'; '.join(self.faults) or 'success'}"]
        lines += [self.verdict] if self.moves else []
        lines.append(f"loop-closure residual {self.error:.1e}")
        if not self.settled:
            lines.append(
                "the search ended with its last step, before it settled: on another machine it may end elsewhere; "
                "a run with --begin goes on from there"
            )
        return [*lines, TableBlock(FIGURE_HEADS, self.rows())]

    def rows(self, most: int = 3) -> list[tuple[str, str, str]]:
        """Return the row of each wish, with so many dimensions on which it depends most."""
        rows = []
        for figure in self.figures:
            ranked = sorted(figure.sensitivity.items(), key=lambda item: (-round(item[1], 6), item[0]))
            rows.append((figure.wish, figure.text, ", ".join(f"{name}: {value:.3g}" for name, value in ranked[:most])))
        return rows

    def record(self) -> dict[str, Any]:
        """Return what a row of a store holds, radians: `DesignSearch.of_record` makes the design of it again."""
        return {
            "numbers": self.numbers.tolist(),
            "figures": [one.record() for one in self.figures],
            "error": self.error,
            "freedoms": self.freedoms,
            "verdict": self.verdict,
            "defects": [one.to_json() for one in self.defects],
            "traced": self.traced,
            "inputs": list(self.inputs),
            "angles": {name: dict(angles) for name, angles in self.angles.items()},
            "settled": self.settled,
        }

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "start": self.start,
            "success": self.success,
            "defects": [one.to_json() for one in self.defects],
            "faults": list(self.faults),
            "miss": self.miss,
            "residual": self.error,
            "freedoms": self.freedoms,
            "settled": self.settled,
            "verdict": self.verdict,
            "figures": [figure.to_json() for figure in self.figures],
            "configurations": {
                name: {joint: degrees(angle) for joint, angle in angles.items()} for name, angles in self.angles.items()
            },
        }


@dataclass(frozen=True, repr=False)
class Designs(Printed):
    """All designs of a search: successes that no other one beats in every wish, best first; then the rest.

    Attributes
    ----------
    pareto : tuple of Design
    others : tuple of Design
        Other successes.
    failures : tuple of Design
        What is no success, nearest to the wishes first.
    starts : int
        How many starts were made.

    Examples
    --------
    >>> from synth.synthesis.designing.wishes import Goal, JointAngle, WishedConfiguration
    >>> from synth.catalogue.patterns import generate
    >>> wish = JointAngle(at="open", joint="2", goal=Goal(equals=0.4))
    >>> wishes = Wishes((wish,), (WishedConfiguration("open", {"0": 0.3}),))
    >>> found = design(generate("four-bar").mechanism, wishes, starts=1)
    >>> found, found.pareto[0].success
    (<Designs: 1 success from 1 start>, True)
    """

    pareto: tuple[Design, ...]
    others: tuple[Design, ...]
    failures: tuple[Design, ...]
    starts: int

    @property
    def best(self) -> Design | None:
        """The first of the Pareto list; None without a success."""
        return self.pareto[0] if self.pareto else None

    def __repr__(self) -> str:
        successes = len(self.pareto) + len(self.others)
        return f"<Designs: {numbered(successes, 'success', 'successes')} from {numbered(self.starts, 'start')}>"

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        successes = len(self.pareto) + len(self.others)
        first = f"{numbered(successes, 'design')} from {numbered(self.starts, 'start')}"
        if not successes:
            first = f"no design from {numbered(self.starts, 'start')}"
            lines: list[Block] = [first]
            if self.failures:
                nearest = self.failures[0]
                lines.append(f"nearest: largest miss {nearest.miss:.2e}; {'; '.join(nearest.faults)}")
            return lines
        best = self.pareto[0]
        first += ", all wishes met" if best.miss <= _MET else f"; largest miss of the first {best.miss:.2e}"
        rows = [(str(one.start), f"{one.miss:.1e}", f"{one.error:.0e}") for one in self.pareto]
        table = TableBlock(("start", "largest miss", "residual"), rows, ("start",))
        return [first, *best.blocks(), *([table] if len(rows) > 1 else [])]

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "starts": self.starts,
            "designs": [one.to_json() for one in self.pareto],
            "others": [one.to_json() for one in self.others],
            "failures": [one.to_json() for one in self.failures],
        }


def design(
    mechanism: Designable,
    wishes: Wishes | str | Path,
    *,
    starts: int = STARTS,
    spread: float = SPREAD,
    seed: int = 0,
    report: Callable[[Design], None] | None = None,
) -> Designs:
    """Find dimensions of a mechanism with which its motion is as wished.

    Parameters
    ----------
    mechanism : Mechanism, str, Path or Generator
        With coordinates: hinged solids, a linkage on a cone, a crease pattern; or a generator, or its name.
    wishes : Wishes, str or Path
        Or their file (docs/native-json.md).
    starts : int, optional
        How many searches are made; the first begins with the mechanism as it is, the others beside it, at random.
    spread : float, optional
        How far beside: radians of directions, parts of lengths and parameters.
    seed : int, optional
    report : callable, optional
        Called with each design as it is found.

    Returns
    -------
    Designs

    Raises
    ------
    UnsolvableError
        If the mechanism has no coordinates, nothing of it may change, or its type cannot move.
    InvariantError
        If wishes name what is not there, or contradict each other.

    Examples
    --------
    A spherical four-bar whose follower is to turn by 50 degrees while the crank turns by 40:

    >>> from math import radians
    >>> from synth.synthesis.designing import Goal, JointAngle, WishedConfiguration
    >>> from synth.catalogue.patterns import generate
    >>> wish = JointAngle(at="open", joint="3", goal=Goal(equals=radians(50)))
    >>> wishes = Wishes((wish,), (WishedConfiguration("open", {"0": radians(40)}),))
    >>> best = design(generate("four-bar").mechanism, wishes, starts=1).best
    >>> best.figures[0].met, best.moves
    (True, True)
    """
    wished = read_wishes(wishes) if isinstance(wishes, str | Path) else wishes
    search = DesignSearch(mechanism, wished, spread, seed)
    found: list[Design] = []
    for start in range(starts):
        one = search.design(start)
        if one is not None:
            found.append(one)
            if report is not None:
                report(one)
    return compared(found, starts)


class DesignSearch:
    """A search for designs, start by start; what a start gives depends on the mechanism, wishes and its number.

    Parameters
    ----------
    mechanism, wishes, spread, seed
        As of `design`.
    beginnings : sequence of float[n], optional
        Numbers of designs with which the first starts begin, one each.
    ground : link id, optional
        The link that stays, as of `dimensions_of`.
    freedoms : int, optional
        Degrees of freedom that designs are to have; by default those of the mechanism, which must move then.

    Attributes
    ----------
    family : Dimensions
    problem : DesignProblem

    Examples
    --------
    >>> from synth.synthesis.designing.sizes import LinkArc
    >>> from synth.synthesis.designing.wishes import Goal
    >>> from synth.catalogue.patterns import generate
    >>> wish = LinkArc(joints=("0", "1"), goal=Goal(equals=1.0))
    >>> DesignSearch(generate("four-bar").mechanism, Wishes((wish,))).design(0)
    <Design: all wishes met, success>
    """

    def __init__(
        self,
        mechanism: Designable,
        wishes: Wishes,
        spread: float = SPREAD,
        seed: int = 0,
        beginnings: Sequence[Floats] = (),
        ground: LinkId | None = None,
        freedoms: int | None = None,
    ) -> None:
        generator = GENERATORS.get(mechanism) if isinstance(mechanism, str) else None
        self.family: Dimensions = dimensions_of(
            generator or mechanism,
            fixed=wishes.fixed,
            parameters=wishes.parameters,
            bounds=wishes.bounds,
            closed_form=wishes.closed_form,
            ground=ground,
        )
        self.problem = DesignProblem(self.family, wishes)
        self.spread, self.seed = spread, seed
        numbers = len(self.family.start)
        if any(len(one) != numbers for one in beginnings):
            raise InvariantError("beginnings", "designs of another mechanism", f"{numbers} numbers each")
        self.beginnings = beginnings
        kept = freedoms is None
        self.freedoms = _freedoms_to_keep(self.family.mechanism(self.family.start)) if kept else freedoms

    def begun_at(self, mechanism: HingedSolids | SurfaceLinkage) -> DesignSearch:
        """Return the same search begun at another mechanism of the type: the problem, and its unit, stay one.

        Parameters
        ----------
        mechanism : HingedSolids or SurfaceLinkage
            Of the chain of this search; on a cone, if that is.

        Raises
        ------
        UnsolvableError
            If what may change are neither axes nor azimuths: rules and folded states of a sheet are read off it.

        Examples
        --------
        >>> from math import radians
        >>> from synth.synthesis.designing.wishes import Goal, JointAngle, WishedConfiguration
        >>> from synth.catalogue.patterns import generate
        >>> wish = JointAngle(at="open", joint="3", goal=Goal(equals=radians(50)))
        >>> wishes = Wishes((wish,), (WishedConfiguration("open", {"0": radians(40)}),))
        >>> search = DesignSearch(generate("four-bar").mechanism, wishes)
        >>> search.begun_at(search.design(0).mechanism).design(0).miss < 1e-12
        True
        """
        other = copy(self)
        other.family = family_begun_at(self.family, mechanism)
        other.problem = self.problem.begun_at(other.family)
        return other

    def design(self, start: int) -> Design | None:
        """Return the design of a start, judged; None where numbers of a start make no mechanism."""
        rng = seeded(f"{self.seed} {len(self.problem.start)}", start)
        stated = start < len(self.beginnings)
        numbers = self.beginnings[start] if stated else start_of(self.problem, start, self.spread, rng)
        found = found_from(self.problem, numbers, rng, follow=start % 2 == 0)
        return None if found is None else judged(self.problem, found, start, self.freedoms)

    def placed(self, one: Design, name: str) -> Sheet | None:
        """Return the sheet of a design at a configuration, where the fixed panel stays; None of other mechanisms."""
        problem = self.problem
        made = one.mechanism
        if not isinstance(made, Sheet):
            return None
        angles = [one.angles[name][str(joint)] for joint in problem.frame.joints]
        configuration = DesignConfiguration(problem.frame, self.family.linkage(one.numbers), np.array(angles))
        corners = np.zeros((made.vertices, 3))
        corners[problem.frame.placed] = configuration.places(problem.frame.all_vertices()).values.reshape(-1, 3)
        return replace(made, coordinates=tuple(map(tuple, corners.tolist())), frames=None)

    def page(self, one: Design) -> str:
        """Return a page of HTML about a design: its figures, and its configurations beside their targets.

        Raises `UnsolvableError` if the mechanism cannot be drawn.

        Examples
        --------
        >>> from synth.synthesis.designing.sizes import LinkArc
        >>> from synth.synthesis.designing.wishes import Goal
        >>> from synth.catalogue.patterns import generate
        >>> wish = LinkArc(joints=("0", "1"), goal=Goal(equals=1.0))
        >>> search = DesignSearch(generate("four-bar").mechanism, Wishes((wish,)))
        >>> "arc between joints 0 and 1" in search.page(search.design(0))
        True
        """
        parts = [(POSE, draw(one.mechanism, numbers=True, caption=None))]
        for name in self.problem.asked:
            sheet = self.placed(one, name)
            if sheet is not None:
                targets = [
                    wish.target
                    for wish in self.problem.wishes.wishes
                    if isinstance(wish, PointsOn) and wish.at == name and not wish.points
                ]
                shown = beside_target(sheet, targets[0]) if targets else sheet
                parts.append((name, draw(shown, "folded", numbers=False, caption=None)))
        figures = "\n".join(
            f"<figure>{svg_text(scene)}<figcaption>{escape(name)}</figcaption></figure>" for name, scene in parts
        )
        rows = "\n".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in one.rows())
        heads = "".join(f"<th>{head}</th>" for head in FIGURE_HEADS)
        lines = "".join(f"<p>{escape(str(line))}</p>" for line in one.blocks() if isinstance(line, str))
        body = f"<h1>Design</h1>{lines}<table><tr>{heads}</tr>{rows}</table>{figures}"
        return html_page(_POLICY, f"<title>Design</title><style>{_STYLE}</style>", body)

    def of_record(self, start: int, record: Mapping[str, Any]) -> Design:
        """Return the design of a record that `Design.record` made."""
        numbers = np.array(record["numbers"], dtype=float)
        return Design(
            start,
            numbers,
            self.family.mechanism(numbers),
            tuple(WishFigure(**figure) for figure in record["figures"]),
            record["error"],
            record["freedoms"],
            record["verdict"],
            tuple(map(Defect.of_json, record["defects"])),
            record["angles"],
            record["traced"],
            tuple(record["inputs"]),
            record["settled"],
        )


def _judgement(mechanism: Mechanism) -> tuple[int | None, str]:
    """Return the degrees of freedom of a mechanism by the verdict, None without one, and its sentence."""
    try:
        verdict = verdict_of_motion(configuration_of(mechanism))
    except SynthedraError as error:
        return None, str(error)
    return verdict.freedoms, verdict.text


def _freedoms_to_keep(mechanism: Mechanism) -> int | None:
    """Return the degrees of freedom with which a search begins, None if they are not known.

    Raises `UnsolvableError` if neither the mechanism nor a generic one of its type moves: no dimensions help.
    """
    freedoms, _ = _judgement(mechanism)
    if freedoms == 0:
        counted = counts_and_ranks(mechanism)
        generic = counted.mobility if counted.exact is None else counted.exact.mobility
        if generic is not None and generic <= 0:
            which = f"the mechanism is rigid, and so is a generic one of its type (M = {generic})"
            raise UnsolvableError(f"{which}; try one that moves, synth generate lists some")
    return freedoms


def judged(problem: DesignProblem, found: FoundDesign, start: int, wanted: int | None = None) -> Design:
    """Return what was found as a design: with its verdict, defects, and figures; `wanted` are degrees of freedom."""
    mechanism = problem.family.mechanism(found.numbers)
    freedoms, sentence = _judgement(mechanism)
    names = problem.frame.joints
    angles = {
        one.name: {str(joint): float(angle) for joint, angle in zip(names, at, strict=True)}
        for one, at in zip(problem.wishes.configurations, found.angles, strict=True)
    }
    motion = _motion(problem, found, freedoms)
    if wanted and freedoms and freedoms != wanted:
        motion = TracedMotion((Defect(DefectKind.FREEDOMS, values=(freedoms, wanted)),))
    opened = () if found.error <= DOUBLE.closed else (Defect(DefectKind.OPEN, values=(found.error,)),)
    immobile = () if freedoms else (Defect(DefectKind.IMMOBILE, reason=sentence),)
    return Design(
        start, found.numbers, mechanism, _figures(problem, found), found.error, freedoms, sentence,
        (*opened, *immobile, *motion.defects), angles, motion.traced, motion.inputs, found.settled,
    )  # fmt: skip


def _motion(problem: DesignProblem, found: FoundDesign, freedoms: int | None) -> TracedMotion:
    """Return the motion through all configurations, with its defects.

    One degree of freedom is driven by one joint, several by as many inputs, if configurations have so many.
    """
    wishes = problem.wishes
    at_start = wishes.from_start or any(POSE in wish.configurations for wish in wishes.wishes)
    closure = problem.frame.closure(found.step.design)
    zero = found.step.design.linkage.angles
    if problem.family.sheet is not None and not zero.any():
        at_start = False  # a flat sheet is singular: many branches meet there
    against = _against_assignment(problem, found)
    if against is not None:
        return TracedMotion((against,))
    passed = {one.name: at for one, at in zip(wishes.configurations, found.angles, strict=True)}
    names = [*([POSE] if at_start else []), *problem.asked]
    angles = [*([zero] if at_start else []), *(passed[name] for name in problem.asked)]
    if not angles or max(found.errors, default=0.0) > DOUBLE.closed:
        return TracedMotion()
    one, drivers = TracedMotion(), problem.together
    goals = np.zeros((0, len(drivers)))
    if len(angles) > 1 and freedoms == 1 and problem.drivers:
        one, driver = _best_driven(problem, closure, names, angles)
        drivers, goals = [driver], np.array(one.inputs)[1:, None]
    elif len(angles) > 1 and freedoms == len(drivers):
        one, goals = traced_together(closure, names, angles, drivers), np.array(angles)[1:, drivers]
    if problem.family.sheet is None or one.defects:
        return one
    collision = problem.frame.collision(found.step.design)
    crossed = collision_on_the_way(closure, names, angles, goals, drivers, collision)
    if crossed is None and freedoms == 1 and not zero.any():  # back towards the flat sheet, which is singular
        turns = _NEAR_FLAT * angles[0][(driver := int(np.abs(angles[0]).argmax()))]
        ends = (names[0], "the flat sheet")
        crossed = collision_on_the_way(closure, ends, angles[:1], np.array([[turns]]), [driver], collision)
    return one if crossed is None else replace(one, defects=(crossed,))


def _best_driven(
    problem: DesignProblem, closure: ClosureEquations, names: Sequence[str], angles: Sequence[Floats]
) -> tuple[TracedMotion, int]:
    """Return the first joint that may be driven without defects, and these; else the first joint and its defects."""
    first: tuple[TracedMotion, int] | None = None
    for joint in problem.drivers:
        one = traced(closure, names, angles, joint, in_order=problem.wishes.in_order), joint
        first = first or one
        if not one[0].defects:
            return one
    assert first is not None
    return first


_NEAR_FLAT = 0.1
"""Part of the largest fold angle to which a sheet is unfolded when collisions are looked for: the flat state itself is
singular, and the driven path may leave its branch near it."""
_SIGN = {"M": -1.0, "V": 1.0}


def _against_assignment(problem: DesignProblem, found: FoundDesign) -> Defect | None:
    """Return which creases of a sheet fold against their assignment at a configuration; None if none does."""
    sheet = problem.family.sheet
    if sheet is None or not found.angles:
        return None
    letters = [sheet.assignments[int(str(joint))] for joint in problem.frame.joints]
    signs = np.array([_SIGN.get(letter, 0.0) for letter in letters])
    wrong = (np.array(found.angles) * signs < -DOUBLE.immobile).any(axis=0)
    creases = tuple(str(joint) for joint, off in zip(problem.frame.joints, wrong, strict=True) if off)
    return Defect(DefectKind.ASSIGNMENT, parts=creases) if creases else None


def _figures(problem: DesignProblem, found: FoundDesign) -> tuple[WishFigure, ...]:
    step, start, figures = found.step, 0, []
    slopes = reduced(problem, found)
    for wish, rows in zip(problem.wishes.wishes, step.rows, strict=True):
        here = slice(start, start + rows)
        start += rows
        miss = wish.size(step.wishes[here])
        by = np.sqrt((slopes[here] ** 2).sum(axis=0))
        sensitivity = {
            name: float(np.sqrt((by[problem.family.of == place] ** 2).sum()))
            for place, name in enumerate(problem.family.names)
        }
        part = miss / wish.scale(problem.frame.extent)
        figures.append(WishFigure(str(wish), wish.unit, miss, part, sensitivity))
    return tuple(figures)


def reduced(problem: DesignProblem, found: FoundDesign) -> Floats:
    """Return the derivatives of all misses by the numbers, configurations closed, inputs held: float[rows, n].

    With rules other numbers follow, as little as that needs: their part across the rules is left out.
    """
    step, numbers = found.step, problem.numbers
    follows = np.linalg.lstsq(step.by_closure[:, numbers:], step.by_closure[:, :numbers], rcond=DOUBLE.zero)[0]
    slopes = step.by_wishes[:, :numbers] - step.by_wishes[:, numbers:] @ follows
    return np.asarray(slopes - (slopes @ _inverse(step.by_rules[:, :numbers])) @ step.by_rules[:, :numbers])


def _inverse(matrix: Floats) -> Floats:
    """Return the pseudoinverse of a matrix float[m, n]: float[n, m]."""
    return np.asarray(np.linalg.lstsq(matrix, np.eye(len(matrix)), rcond=DOUBLE.zero)[0])


def compared(found: Sequence[Design], starts: int) -> Designs:
    """Return designs in order: the Pareto list of successes, others, failures."""
    ranked = sorted(found, key=lambda one: (round(one.miss, MET_DIGITS), one.start))
    successes = [one for one in ranked if one.success]
    parts = [np.array([max(figure.part, _MET) for figure in one.figures]) for one in successes]
    pareto: list[Design] = []
    others: list[Design] = []
    for place, one in enumerate(successes):
        beaten = any(
            (parts[other] <= parts[place] + _MET).all() and (parts[other] < parts[place] - _MET).any()
            for other in range(len(successes))
        )
        (others if beaten else pareto).append(one)
    failures = tuple(one for one in ranked if not one.success)
    return Designs(tuple(pareto), tuple(others), failures, starts)
