"""What is compared of the verdicts on two guises of one pattern: numbers, ways, immobile creases as lines of the drawing."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, fields

from graphs.errors import SynthedraError
from synth.analysis.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.analysis.verdict._mobility import verdict_of_motion
from tests.invariance.guises import Guise

__all__ = ["Answer", "answer_to", "differences"]


@dataclass(frozen=True, slots=True)
class Answer:
    """A verdict, less all that the numbering of a file decides.

    `ways` says how many there are with how many freedoms, None for those that are not known, and how many creases
    of the pattern move on each.
    """

    refused: bool = False
    freedoms: int | None = None
    certainty: str = ""
    exhaustive: bool = False
    complete: bool = False
    ways: tuple[tuple[tuple[str, str], int], ...] = ()
    marked: str | None = None
    immobile: frozenset[frozenset[int]] = frozenset()


def answer_to(guise: Guise) -> Answer:
    """Return the verdict on a guise, in the names of the pattern."""
    try:
        at = configuration_of_sheet(guise.sheet)
        verdict = verdict_of_motion(at)
    except SynthedraError:
        return Answer(refused=True)
    ways: Counter[tuple[str, str]] = Counter()
    for way in verdict.branches:
        moving = set(at.joints) - set(way.immobile_joints)
        ways[str(way.freedoms), str(len(_lines(moving, at, guise)))] += 1
    found = at.branches
    return Answer(
        freedoms=verdict.freedoms,
        certainty=verdict.certainty,
        exhaustive=verdict.exhaustive,
        complete=found is not None and found.complete,
        ways=tuple(sorted(ways.items())),
        marked=at.marked.marked,
        immobile=_lines(verdict.immobile_joints, at, guise),
    )


def _lines(joints, at: SheetConfiguration, guise: Guise) -> frozenset[frozenset[int]]:
    """Return the edges of the pattern that joints are."""
    pieces = at.dual.pieces
    return frozenset(guise.edges[frozenset(edge)] for joint in joints for edge in pieces[joint])


def differences(one: Answer, other: Answer) -> list[str]:
    """Return the names of what differs."""
    return [part.name for part in fields(Answer) if getattr(one, part.name) != getattr(other, part.name)]
