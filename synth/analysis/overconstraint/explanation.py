"""Why a mechanism moves although counts say no. Theory: docs/theory/overconstraint.md."""

from dataclasses import dataclass
from math import degrees, isfinite
from typing import Any

from graphs.answer.report import power_of_ten
from graphs.count.equations import overconstraint
from graphs.count.report import mobility_report
from graphs.errors import check_argument, numbered, shown
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sc import SCGraph
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.tolerances import Tolerances
from graphs.types import JointId
from synth.analysis.motion.configuration import Configuration
from synth.analysis.moving._configuration_of import Movable, configuration_of
from synth.analysis.overconstraint import redundancy
from synth.analysis.overconstraint.herve import HerveClass, herve_class
from synth.analysis.overconstraint.mobility_of_joints import linkage_as_counted
from synth.analysis.overconstraint.reasons import reasons_of, turning_reasons

_LISTED = 12
"""Axes of which tolerances are printed; data has all."""

_OTHER_QUESTION = (
    "explain analyses the closure equations of one configuration, to first and second order, and no branch"
)


@dataclass(frozen=True, slots=True)
class IdleSet:
    """Loops that together hold redundant equations; without any of them they hold fewer.

    Attributes
    ----------
    loops : tuple of tuples of joint ids
    idle : int
        Equations that follow from the others of these loops.
    reasons : tuple of str
        The special geometry that was recognised; may be empty.
    """

    loops: tuple[tuple[JointId, ...], ...]
    idle: int
    reasons: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"loops": [list(loop) for loop in self.loops], "idle": self.idle, "reasons": list(self.reasons)}


@dataclass(frozen=True, slots=True, repr=False)
class Explanation(Printed):
    """Why a mechanism has more freedoms than equations allow. It prints as ``synth explain`` does.

    Attributes
    ----------
    configuration : Configuration
        The input.
    freedoms, count : int
        Degrees of freedom to first order, and M by the count that applies, as `synth.mobility` has it.
    idle, active : int
        Redundant equations, and those of them that constrain the motions at second order.
    sets : tuple of IdleSet
    tolerances : tuple of Tolerance
        Errors of axes, least first; none where nothing is redundant, or second order decides.
    smallest, gap : float
        The smallest singular value that counts, and its ratio to the largest that does not.
    herve : HerveClass or None
        Whether it is trivial, exceptional or paradoxical; None where nothing moves, and where that was not told.
    """

    configuration: Configuration
    freedoms: int
    count: int
    idle: int
    active: int
    sets: tuple[IdleSet, ...]
    tolerances: tuple[redundancy.Tolerance, ...]
    smallest: float
    gap: float
    herve: HerveClass | None = None

    @property
    def overconstraint(self) -> int:
        """H = freedoms - M, of first order (Wiener 2016, Eq. 8)."""
        return overconstraint(self.freedoms, self.count)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "freedoms": self.freedoms,
            "count": self.count,
            "h": self.overconstraint,
            "redundant": self.idle,
            "herve": None if self.herve is None else self.herve.to_json(),
            "active_at_second_order": self.active,
            "sets": [loops.to_json() for loops in self.sets],
            "tolerances": [
                {
                    "joint": axis.joint,
                    "turn_deg": degrees(axis.turn) if isfinite(axis.turn) else None,
                    "shift": axis.shift if isfinite(axis.shift) else None,
                }
                for axis in self.tolerances
            ],
            "smallest": self.smallest,
            "gap": self.gap if isfinite(self.gap) else None,
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        freedoms = numbered(self.freedoms, "infinitesimal degree of freedom", "infinitesimal degrees of freedom")
        # where second order constrains the motions the degrees of freedom are fewer, and so is h
        over = "" if self.active else f": h = {self.overconstraint}"
        head = f"{freedoms}, M = {self.count} by count{over}"
        evidence = f"singular-value gap {power_of_ten(self.gap)}" if isfinite(self.gap) else "no zero singular value"
        blocks: list[Block] = [f"{head}   ({evidence})", *([str(self.herve)] if self.herve else [])]
        if not self.idle:
            general = "no closure equation is redundant: a generic realisation has these degrees of freedom too"
            return [*blocks, general]
        count = numbered(self.idle, "redundant closure equation")
        if self.active:
            blocks.append(
                f"at second order {self.active} of {count} constrain the motions: "
                "this configuration is singular, and a regular one shows more"
            )
        else:
            blocks.append(f"{count}, at second order too")
        for idle in self.sets:
            names = "; ".join(", ".join(map(shown, loop)) for loop in idle.loops)
            why = ", ".join(idle.reasons) or "special geometry not recognised"
            loops = numbered(len(idle.loops), "loop")
            blocks.append(f"{numbered(idle.idle, 'redundant equation')} in {loops} of joints {names}: {why}")
        return [*blocks, *self._tolerances()]

    def _tolerances(self) -> list[Block]:
        if not self.tolerances:
            return []
        rows = [
            (plain(axis.joint), _figure(degrees(axis.turn)), _figure(axis.shift)) for axis in self.tolerances[:_LISTED]
        ]
        more = len(self.tolerances) - len(rows)
        errors = ("rotation, degrees", "translation")
        table = TableBlock(("axis", *errors), rows, errors)
        meaning = (
            "axis errors at which a redundant equation constrains as much as the weakest independent one; "
            "a hundredth of one requires play of a hundredth of the motion:"
        )
        others = numbered(more, "more axis", "more axes")
        return [meaning, table, *([f"and {others} with larger errors"] if more else [])]

    def __repr__(self) -> str:
        return f"<Explanation: h = {self.idle}, {numbered(len(self.sets), 'set')} of loops>"


def _count_of(graph: SCGraph) -> int:
    mobility = mobility_report(graph).mobility
    assert mobility is not None  # None only of a polyhedron model
    return mobility


def _figure(error: float) -> str:
    return f"{error:.3g}" if isfinite(error) else "any"


def explain(mechanism: Movable, *, precision: float | None = None) -> Explanation:
    """Find the loops of a mechanism with redundant equations, the reasons, and how far its axes may err.

    Parameters
    ----------
    mechanism : Mechanism or Linkage
        With coordinates; of a sheet with several frames the first that has them.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default by their digits, or as the geometry shows.

    Raises
    ------
    UnsolvableError
        If it has no coordinates.
    NumericalError
        If singular values do not decide the rank.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> answer = explain(generate("bennett").mechanism)
    >>> answer.freedoms, answer.count, answer.idle, answer.sets[0].reasons[0]
    (1, -2, 3, 'opposite links equal, lengths proportional to the sines of the twists (Bennett)')
    """
    check_argument("explain", mechanism, Movable)
    at = configuration_of(mechanism, precision=precision)
    counted = linkage_as_counted(at)
    linkage = counted.linkage
    order = redundancy.first_order_closure(linkage, at.tolerances)
    meant = Tolerances.of(at.precision.size)  # mended coordinates move, but are not all that they were meant to be
    seen = at.given if isinstance(at.given, JointedLinkage) else None
    active = redundancy.active_at_second_order(linkage, order)
    sets = tuple(
        IdleSet(
            tuple(counted.joints_of(linkage.loops[loop]) for loop in loops),
            number,
            tuple(reasons_of(linkage, loops, meant) or turning_reasons(linkage, order, loops, meant, seen)),
        )
        for loops, number in redundancy.smallest_sets(linkage, order)
    )
    freedoms, idle = order.rates.shape[1], order.stresses.shape[1]
    return Explanation(
        configuration=at,
        freedoms=freedoms,
        count=_count_of(linkage.graph),
        idle=idle,
        active=active,
        sets=sets,
        tolerances=counted.tolerances(order) if idle and freedoms and not active else (),
        smallest=order.smallest,
        gap=order.gap,
        herve=herve_class(at),
    )
