"""The mobility report: degrees of freedom at the configuration, exact rank, counts, and notes."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from graphs.count.applicability import equation_titles
from graphs.count.equations import overconstraint
from graphs.count.report import MobilityReport
from graphs.errors import numbered
from graphs.mechanism.sc import ARRANGEMENTS, CENTRES_ASSUMED
from graphs.mechanism.sheet import Reading
from graphs.printing import Block, Printed, TableBlock, html_of, plain
from graphs.rank.exact import ExactMobility
from graphs.rank.infinitesimal import InfinitesimalMobility
from graphs.tolerances import DOUBLE

_COUNTS = {
    "vertices": "vertices V",
    "implicit_centres": "implicit centres C",
    "edges": "rods E",
    "external_edges": "external edges",
    "internal_edges": "internal edges",
    "spatial_loops": "spatial loops",
    "flaps": "flaps",
    "interior_vertices": "interior vertices",
    "parts": "parts",
    "freedoms": "joint freedoms",
    "passive": "passive degrees of freedom",
    "revolutes": "equivalent revolute joints",
    "general_member": "degrees of freedom of a random realisation",
    "remote": "sum of k over remote centres",
    "on_plane": "points on planes P",
    "on_line": "points on lines L",
    "scissors": "scissors X",
}


RODS_ALONE = "; the rank of rods is not the mobility where remote centres are declared, since rods in a plane leave it"
"""The end of the note on an exact rank that the count answers for."""


@dataclass(frozen=True, slots=True, repr=False)
class MobilityAnswer(MobilityReport, Printed):
    """The mobility of one mechanism, with its evidence; it prints as ``synth mobility`` does.

    Attributes
    ----------
    exact : ExactMobility or None
        The generic mobility by rank, with its primes; None if it was left out or could not be found (a warning
        says why).
    infinitesimal : InfinitesimalMobility or None
        The infinitesimal degrees of freedom at the coordinates, with the gap of the singular values; None without
        coordinates.
    reading : Reading or None
        What was done to a drawing when it was read, with places; None if nothing was traced.
    overconstraint : int or None
        h = degrees of freedom at the configuration - M (Wiener 2016, Eq. 8).

    Notes
    -----
    The other attributes are those of :class:`graphs.count.report.MobilityReport`, the answer by count.
    """

    exact: ExactMobility | None = None
    infinitesimal: InfinitesimalMobility | None = None
    reading: Reading | None = None

    @classmethod
    def of(cls, report: MobilityReport) -> MobilityAnswer:
        """Return the answer that a report by count begins."""
        return cls(**{part.name: getattr(report, part.name) for part in fields(MobilityReport)})

    @property
    def overconstraint(self) -> int | None:
        """H = degrees of freedom at the configuration - M, where both are known."""
        if self.infinitesimal is None or self.infinitesimal.dof is None or self.mobility is None:
            return None
        return overconstraint(self.infinitesimal.dof, self.mobility)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        counted = super(MobilityAnswer, self).to_json()
        notes = {key: counted.pop(key) for key in ("repairs", "warnings")}
        infinitesimal = None
        if self.infinitesimal is not None:
            ranks = self.infinitesimal.to_json()
            infinitesimal = {"dof": ranks.pop("dof"), "gap": ranks.pop("gap"), "h": self.overconstraint, **ranks}
        exact = None if self.exact is None else self.exact.to_json()
        reading = None if self.reading is None else self.reading.to_json()
        return {**counted, "exact": exact, "pose": infinitesimal, **notes, "reading": reading}

    def blocks(self, *, verbose: bool = False) -> list[Block]:
        """Return the lines that are printed, first what was left out of a drawing; verbose adds the table."""
        return [*self.unread(), *self.evidence(verbose=verbose)]

    def unread(self) -> list[Block]:
        """Return the line that says what was left out of a drawing, if anything was."""
        return [self.reading.warning] if self.reading is not None and self.reading.warning else []

    def evidence(self, *, verbose: bool = False, with_h: bool = True) -> list[Block]:
        """Return ranks and counts as lines, strongest first, with h; verbose adds the table of all equations."""
        blocks: list[Block] = [] if self.infinitesimal is None else [_infinitesimal_line(self, with_h=with_h)]
        if self.exact is not None:
            rank = f"exact rank {self.exact.rank} modulo two primes"
            blocks.append(f"generic realisation: mobility {self.exact.mobility}   ({rank})")
        assumed = CENTRES_ASSUMED in self.warnings
        kind = "kinematic chain, with the centres assumed" if assumed else self.mechanism_class
        blocks.append(f"by count: mobility M = {plain(self.mobility)}   ({kind})")
        blocks.append(_equations_line(self, hint=not verbose))
        if verbose:
            titles = equation_titles()
            rows = [
                (titles[name], plain(equation.value), "yes" if equation.applies else "no", equation.why)
                for name, equation in self.equations.items()
            ]
            blocks.append(TableBlock(("equation", "M", "applies", "why"), rows, ["M"]))
        known = [
            ("links N", self.links),
            ("joints J", self.joints),
            ("loops L", self.loops),
            ("assumed centres" if assumed else "centres", self.centres),
            *((title, self.counts.get(key)) for key, title in _COUNTS.items()),
        ]
        blocks.append(", ".join(f"{title} {value}" for title, value in known if value is not None))
        if self.arrangement not in (None, "none", "single") and not assumed:
            blocks.append(f"arrangement of centres: {self.arrangement} ({ARRANGEMENTS[self.arrangement]})")
        reading = self.reading or Reading()
        blocks += [f"repaired: {reading.with_places(note)}" for note in self.repairs if note != reading.left_out]
        blocks += [f"note: {note}" for note in self.warnings]
        return blocks

    def _repr_html_(self) -> str:
        return html_of(self.blocks(verbose=True))

    def __repr__(self) -> str:
        return f"<MobilityAnswer: M = {self.mobility}, {self.mechanism_class}>"


def _infinitesimal_line(answer: MobilityAnswer, *, with_h: bool) -> str:
    """Return the line on the infinitesimal degrees of freedom at the configuration."""
    infinitesimal = answer.infinitesimal
    assert infinitesimal is not None
    if infinitesimal.dof is None:
        return "at this configuration: indeterminate"
    gap = infinitesimal.to_json()["gap"]
    evidence = "no zero singular value" if gap is None else f"singular-value gap {power_of_ten(gap)}"
    state = "flat state: fewer once folded; " if _is_only_flat(answer) else ""
    over = f"h = {answer.overconstraint}, " if with_h and answer.overconstraint is not None else ""
    freedoms = numbered(infinitesimal.dof, "infinitesimal degree of freedom", "infinitesimal degrees of freedom")
    return f"at this configuration: {freedoms}   ({state}{over}{evidence})"


def _equations_line(answer: MobilityAnswer, *, hint: bool) -> str:
    """Return the line that names the equations of mobility which apply; with its value where that is not M."""
    names, titles = [], equation_titles()
    for name, equation in answer.equations.items():
        if equation.applies and equation.value is not None:
            value = "" if equation.value == answer.mobility else f": {equation.value}"
            names.append(f"{titles[name]}{value}")
    every = f"   (--verbose: all {len(answer.equations)} equations)" if hint else ""
    return f"equations that apply: {'; '.join(names) or 'none'}{every}"


def power_of_ten(number: float) -> str:
    """Return a number to one digit, its power of ten without sign and zeros that say nothing: ``6e14``."""
    digit, power = f"{number:.0e}".split("e")
    return f"{digit}e{int(power)}"


def notes_on_singular_values(infinitesimal: InfinitesimalMobility) -> list[str]:
    """Return the notes on the certainty of degrees of freedom at a configuration."""
    evidence = infinitesimal.spectrum
    if infinitesimal.dof is None:
        near = ", ".join(f"{value:.1e}" for value in evidence.undecided[:3])
        why = f"singular values near the noise: {near}" if near else "two counts of small values differ"
        return [f"indeterminate at this configuration: {why}; precision of the coordinates: {infinitesimal.precision}"]
    notes = []
    if min(evidence.largest_zero, infinitesimal.precision.size) > DOUBLE.closed:
        zeros = f"singular values up to {evidence.largest_zero:.0e} are noise"
        notes.append(f"coordinates precise to {infinitesimal.precision}: {zeros}")
    if evidence.nearly:
        more = numbered(evidence.nearly, "more degree of freedom", "more degrees of freedom")
        notes.append(f"nearly mobile: {more} if small strains are allowed")
    return notes


def _is_only_flat(answer: MobilityAnswer) -> bool:
    """Return whether a sheet owes degrees of freedom to its flat state."""
    here, over = answer.infinitesimal, answer.overconstraint
    return here is not None and here.flat and bool(here.flat_loops) and (over is None or over > 0)
