"""Verdicts on all guises of patterns compared, and how many differ: a table."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from time import process_time

from graphs.mechanism.sheet import Sheet
from tests.invariance.answers import Answer, answer_to, differences
from tests.invariance.guises import COMPARED_WITH, NOT_COMPARED, guises_of

__all__ = ["Comparison", "Table", "comparisons"]


@dataclass(frozen=True, slots=True)
class Comparison:
    """The verdicts on a pattern and on a guise of it, and the names of what differs."""

    pattern: str
    guise: str
    here: Answer
    there: Answer
    differ: list[str]

    def __str__(self) -> str:
        parts = [f"{name}: {getattr(self.here, name)} / {getattr(self.there, name)}" for name in self.differ]
        return f"{self.pattern} | {self.guise} | {'; '.join(parts)}"


def comparisons(
    patterns: Iterable[tuple[str, Sheet]], guises: Iterable[str] | None = None, seconds: float | None = None
) -> Iterator[Comparison]:
    """Yield the verdicts on each pattern and its guises; patterns that take more processor time are left out."""
    for name, sheet in patterns:
        answers: dict[str, Answer] = {}
        for guise_name, guise in guises_of(sheet, guises):
            begun = process_time()
            answers[guise_name] = answer_to(guise)
            if guise_name == "as it is" and seconds is not None and process_time() - begun > seconds:
                break
            if guise_name in NOT_COMPARED:
                continue
            here = answers[COMPARED_WITH.get(guise_name, "as it is")]
            there = answers[guise_name]
            yield Comparison(name, guise_name, here, there, differences(here, there))


@dataclass
class Table:
    """How many guises were compared, and how many verdicts differ: of each guise a row."""

    patterns: set[str] = field(default_factory=set)
    compared: Counter[str] = field(default_factory=Counter)
    differ: Counter[str] = field(default_factory=Counter)

    def add(self, one: Comparison) -> None:
        """Count a comparison."""
        self.patterns.add(one.pattern)
        self.compared[one.guise] += 1
        self.differ[one.guise] += bool(one.differ)

    def __str__(self) -> str:
        rows = [(guise, self.compared[guise], self.differ[guise]) for guise in self.compared]
        rows.append((f"all, of {len(self.patterns)} patterns", self.compared.total(), self.differ.total()))
        return "\n".join(f"{name:28}{count:>9}{other:>9}" for name, count, other in [("", "compared", "differ"), *rows])
