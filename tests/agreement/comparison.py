"""Whether verbs that were asked about one configuration name the same one, and how many did."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import isclose
from typing import Any

from tests.agreement.verbs import VERBS, Outcome

__all__ = ["ALWAYS", "SAME_QUESTION", "Disagreement", "Table", "disagreements"]

ALWAYS = ("links", "joints", "loops", "precision", "precision_source", "flat")
"""Keys that are the same whatever the question is."""
SAME_QUESTION = ("branches", "branch", "freedoms", "immobile_joints")
"""Keys that may be null where the question is another one."""
_CLOSE = 1e-6
"""Two precisions that differ by less than this part are the same: units of the extent are sums."""
_TAKES_ANY = {verb.name for verb in VERBS if verb.takes_any}
_OTHER_COORDINATES = {verb.name for verb in VERBS if verb.other_coordinates}
_OF_THE_TYPE = ("links", "loops")
"""Keys that are the same with other coordinates; the number of joints follows."""

Who = tuple[str, str]
"""A verb and its door."""


@dataclass(frozen=True, slots=True)
class Disagreement:
    """What verbs say differently of one configuration.

    Attributes
    ----------
    key : str
        Which part of the answer, or "refused", "missing" or "fault".
    values : tuple of (str, tuple of who)
        Each value as text, with those who name it.
    """

    key: str
    values: tuple[tuple[str, tuple[Who, ...]], ...]

    def __str__(self) -> str:
        told = (f"{value} ({', '.join(' '.join(one) for one in who)})" for value, who in self.values)
        return f"{self.key}: {'; '.join(told)}"


def disagreements(outcomes: Mapping[Who, Outcome]) -> list[Disagreement]:
    """Return what verbs say differently of one configuration, key by key.

    A verb that is asked another question and says so is compared in what is the same for all questions. One that
    takes any configuration may refuse only where nothing moves, or where all of its kind refuse. One that answers for
    other coordinates is compared in what they leave as it is.
    """
    told = {who: one.configuration for who, one in outcomes.items() if one.configuration is not None}
    found = [_by_value(key, _values(key, told)) for key in (*ALWAYS, *SAME_QUESTION)]
    for kind in ("missing", "fault"):
        wrong = {who: one.why or kind for who, one in outcomes.items() if one.kind == kind}
        found.append(Disagreement(kind, tuple(_grouped(wrong))) if wrong else None)
    found += [_refused(outcomes, told), *_doors(outcomes)]
    return [one for one in found if one is not None]


def _values(key: str, told: Mapping[Who, dict[str, Any]]) -> dict[Who, Any]:
    """Return what each says under a key; those that are asked another question may say null."""
    return {
        who: one[key]
        for who, one in told.items()
        if (key in ALWAYS or one["other_question"] is None or one[key] is not None)
        and (key in _OF_THE_TYPE or who[0] not in _OTHER_COORDINATES)
    }


def _by_value(key: str, values: Mapping[Who, Any]) -> Disagreement | None:
    numbers: list[float] = []
    groups = tuple(_grouped({who: _text(key, value, numbers) for who, value in values.items()}))
    return Disagreement(key, groups) if len(groups) > 1 else None


def _text(key: str, value: Any, numbers: list[float]) -> str:
    """Return a value as text, the same for those that count as one; `numbers` are the precisions named so far."""
    if key == "precision" and isinstance(value, float):
        near = [one for one in numbers if isclose(one, value, rel_tol=_CLOSE)]
        numbers += [] if near else [value]
        return repr(near[0] if near else value)
    if key == "joints" and value is not None:
        return json.dumps(list(map(str, value)))
    if key == "immobile_joints" and value is not None:
        return json.dumps(sorted(map(str, value)))
    return json.dumps(value)


def _grouped(texts: Mapping[Who, str]) -> Iterator[tuple[str, tuple[Who, ...]]]:
    for text in dict.fromkeys(texts.values()):
        yield text, tuple(who for who, one in texts.items() if one == text)


def _refused(outcomes: Mapping[Who, Outcome], told: Mapping[Who, dict[str, Any]]) -> Disagreement | None:
    """Return who refuses a configuration that others of its kind take, though something moves."""
    refused = {who: one.why for who, one in outcomes.items() if one.kind == "refused" and who[0] in _TAKES_ANY}
    moving = {who: one for who, one in told.items() if who[0] in _TAKES_ANY and _moves(one)}
    if not refused or not moving:
        return None
    answers = {who: f"{one.get('freedoms')} degrees of freedom" for who, one in moving.items()}
    return Disagreement("refused", (*_grouped(refused), *_grouped(answers)))


def _moves(configuration: Mapping[str, Any]) -> bool:
    """Tell whether an answer says that something moves: with freedoms, or where these are not known on branches."""
    branches = configuration.get("branches") or {"number": 0}
    freedoms = configuration.get("freedoms")
    return bool(branches["number"] if freedoms is None else freedoms)


def _doors(outcomes: Mapping[Who, Outcome]) -> Iterator[Disagreement]:
    """Yield verbs that refuse in Python and answer at the command line, or the other way round."""
    for verb in VERBS:
        if verb.takes_any:
            continue
        kinds = {who: one.kind for who, one in outcomes.items() if who[0] == verb.name}
        if {"told", "refused"} <= set(kinds.values()):
            why = {who: outcomes[who].why or kind for who, kind in kinds.items()}
            yield Disagreement("refused", tuple(_grouped(why)))


@dataclass
class Table:
    """How many questions were compared: a row for each variant, and for each verb.

    Attributes
    ----------
    files : Counter
        Of each variant, how many mechanisms.
    variants, verbs : dict of str to Counter
        How many questions had each end: "compared", "another question", "refused", "indeterminate", "left out",
        "missing", "fault".
    differ : Counter
        Of each variant and of each verb, how many configurations there is a disagreement about.
    """

    files: Counter[str] = field(default_factory=Counter)
    variants: dict[str, Counter[str]] = field(default_factory=dict)
    verbs: dict[str, Counter[str]] = field(default_factory=dict)
    differ: Counter[str] = field(default_factory=Counter)

    def add(self, variant: str, outcomes: Mapping[Who, Outcome], found: Iterable[Disagreement]) -> None:
        """Count what came of one configuration."""
        kind = variant.split(maxsplit=1)[0] if variant.startswith("frame") else variant
        self.files[kind] += 1
        for (verb, _), outcome in outcomes.items():
            end = _end(outcome)
            self.variants.setdefault(kind, Counter())[end] += 1
            self.verbs.setdefault(verb, Counter())[end] += 1
        who = {verb for one in found for _, some in one.values for verb, _ in some}
        self.differ.update({kind} if who else ())
        self.differ.update(who)

    def __str__(self) -> str:
        heads = ("", "files", "questions", *_ENDS, "disagree")
        rows = [heads]
        for rows_of, files in ((self.variants, self.files), (self.verbs, Counter())):
            for name, ends in rows_of.items():
                numbers = (files[name] or "", ends.total(), *(ends[end] for end in _ENDS), self.differ[name])
                rows.append((name, *map(str, numbers)))
            rows.append(("",) * len(heads))
        widths = [max(len(row[column]) for row in rows) for column in range(len(heads))]
        return "\n".join(
            "  ".join(cell.rjust(wide) if column else cell.ljust(wide) for column, (cell, wide) in
                      enumerate(zip(row, widths, strict=True))).rstrip()
            for row in rows
        )  # fmt: skip


_ENDS = ("compared", "another question", "refused", "indeterminate", "left out", "missing", "fault")


def _end(outcome: Outcome) -> str:
    if outcome.configuration is None:
        return outcome.kind
    return "compared" if outcome.configuration.get("other_question") is None else "another question"
