"""Defects of designs by their kinds, with the configurations, panels or creases that they concern; sentences last.

Whatever compares or counts designs asks for the kind. Sentences are made by `sentence_of` where they are printed, and
nothing reads them. Theory: docs/theory/design.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from enum import Enum
from typing import Any

from graphs.errors import numbered


class DefectKind(Enum):
    """What can be wrong with a design; where there are several, the first in this order is what is counted.

    The first three are the defects of Chase and Mirth (1993): of a mechanism that moves, but cannot be used so.

    Examples
    --------
    >>> DefectKind("circuit").title
    'configurations on several circuits'
    """

    CIRCUIT = "circuit"
    BRANCH = "branch"
    ORDER = "order"
    INPUTS = "inputs"
    COLLISION = "collision"
    ASSIGNMENT = "assignment"
    FREEDOMS = "freedoms"
    OPEN = "open"
    UNTRACED = "untraced"
    IMMOBILE = "immobile"
    NO_MEMBER = "no-member"

    @property
    def title(self) -> str:
        """What is counted of designs with this defect, in words."""
        return _TITLES[self]

    @property
    def of_motion(self) -> bool:
        """Whether the mechanism moves as it is to, and only its configurations are out of reach, or out of order."""
        return self in (DefectKind.CIRCUIT, DefectKind.BRANCH, DefectKind.ORDER)

    @property
    def precedence(self) -> int:
        """Its place among the kinds: of several defects the one with the lowest is counted."""
        return list(DefectKind).index(self)


@dataclass(frozen=True, slots=True)
class Defect:
    """One thing that is wrong with a design.

    Attributes
    ----------
    kind : DefectKind
    configurations : tuple of str
        By name: those on another circuit; or the two between which it happens; or the one where it does.
    reference : str
        The configuration on whose circuit they are not.
    parts : tuple of str
        Panels that pass through each other, creases that fold against the assignment.
    values : tuple of float
        Degrees of freedom that the design has, and those that it is to have; the loop-closure residual.
    reason : str
        What was said by others: the verdict on a mechanism that does not move, the error of a start.

    Examples
    --------
    >>> back = Defect(DefectKind.BRANCH, ("pose 2", "pose 3"))
    >>> back.to_json(), Defect.of_json(back.to_json()) == back
    ({'kind': 'branch', 'configurations': ['pose 2', 'pose 3']}, True)
    """

    kind: DefectKind
    configurations: tuple[str, ...] = ()
    reference: str = ""
    parts: tuple[str, ...] = ()
    values: tuple[float, ...] = ()
    reason: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md): the kind, and the fields that say something."""
        data: dict[str, Any] = {"kind": self.kind.value}
        for name in (field.name for field in fields(self)[1:]):
            value = getattr(self, name)
            if value:
                data[name] = list(value) if isinstance(value, tuple) else value
        return data

    @classmethod
    def of_json(cls, data: Mapping[str, Any]) -> Defect:
        """Return the defect that `to_json` made these data of."""
        configurations, parts, values = (tuple(data.get(name, ())) for name in ("configurations", "parts", "values"))
        reference, reason = (data.get(name, "") for name in ("reference", "reason"))
        return cls(DefectKind(data["kind"]), configurations, reference, parts, values, reason)


def first_kind(defects: Iterable[Defect]) -> DefectKind | None:
    """Return the kind of some defects that is counted; None of a sound design."""
    return min((one.kind for one in defects), key=lambda kind: kind.precedence, default=None)


def kinds_of(defects: Iterable[Defect]) -> str:
    """Return the values of the kinds of some defects, for a column of a store.

    >>> kinds_of([Defect(DefectKind.OPEN, values=(1e-6,)), Defect(DefectKind.IMMOBILE)])
    'open immobile'
    """
    return " ".join(one.kind.value for one in defects)


def sentence_of(defect: Defect) -> str:
    """Return what is printed of a defect.

    Parameters
    ----------
    defect : Defect

    Examples
    --------
    >>> sentence_of(Defect(DefectKind.CIRCUIT, ("pose 3", "pose 4"), reference="pose"))
    'on another circuit than pose: pose 3, pose 4'
    """
    return SENTENCES[defect.kind](defect)


_MOST_CREASES = 6
"""Creases that a sentence names; a sheet may have thousands, and the record holds all."""


def _collision(defect: Defect) -> str:
    where = "between" if len(defect.configurations) > 1 else "at"
    panels = " and ".join(defect.parts)
    return f"panels {panels} pass through each other {where} {' and '.join(defect.configurations)}"


def _against_assignment(defect: Defect) -> str:
    fold = " folds" if len(defect.parts) == 1 else " fold"
    creases = numbered(len(defect.parts), "crease") + fold
    return f"{creases} against the assignment: {', '.join(defect.parts[:_MOST_CREASES])}"


def _freedoms(defect: Defect) -> str:
    has, wanted = map(int, defect.values)
    return f"{numbered(has, 'degree of freedom', 'degrees of freedom')} at the pose; expected {wanted}"


SENTENCES: dict[DefectKind, Callable[[Defect], str]] = {
    DefectKind.CIRCUIT: lambda one: f"on another circuit than {one.reference}: {', '.join(one.configurations)}",
    DefectKind.BRANCH: lambda one: f"the driven joint turns back between {' and '.join(one.configurations)}",
    DefectKind.ORDER: lambda _: "the driven joint passes the configurations out of order",
    DefectKind.INPUTS: lambda one: "the inputs of {} do not lead straight to {}".format(*one.configurations),
    DefectKind.COLLISION: _collision,
    DefectKind.ASSIGNMENT: _against_assignment,
    DefectKind.FREEDOMS: _freedoms,
    DefectKind.OPEN: lambda one: f"loop-closure residual {one.values[0]:.1e}",
    DefectKind.UNTRACED: lambda _: "the configurations could not be traced",
    DefectKind.IMMOBILE: lambda one: one.reason,
    DefectKind.NO_MEMBER: lambda one: one.reason,
}
"""What is printed of a defect of each kind."""

_TITLES = {
    DefectKind.CIRCUIT: "configurations on several circuits",
    DefectKind.BRANCH: "a driven joint that turns back",
    DefectKind.ORDER: "configurations out of order",
    DefectKind.INPUTS: "inputs that do not lead straight on",
    DefectKind.COLLISION: "panels that pass through each other",
    DefectKind.ASSIGNMENT: "creases that fold against the assignment",
    DefectKind.FREEDOMS: "other degrees of freedom",
    DefectKind.OPEN: "loops that do not close",
    DefectKind.UNTRACED: "configurations that could not be traced",
    DefectKind.IMMOBILE: "a design that does not move",
    DefectKind.NO_MEMBER: "no member that moves",
}
