"""Whether a crease pattern folds flat, as far as that takes a moment: a line of `synth mobility`."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from graphs.errors import InvariantError, NumericalError, UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from synth.analysis.layering.counting.problem import LayerProblem
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.orders import FlatFolding, flat_folding

_PANELS, _PAIRS, _VARIABLES = 300, 20_000, 60
"""Panels, pairs of panels over cells, and variables of a problem up to which orders are counted in a moment."""


class _TooLargeError(Exception):
    """More would have to be counted than takes a moment."""


@dataclass(frozen=True, slots=True)
class FlatFoldability:
    """Whether a pattern folds flat.

    Attributes
    ----------
    foldable : bool or None
        None where its layer orders were not counted.
    orders : int or None
        Their number; None where it was not counted.
    fault : str
        Why it does not fold flat; empty where it does, or that is not known.
    folding : FlatFolding or None
        All of the answer; None where the orders were not counted.

    Examples
    --------
    >>> print(FlatFoldability(True, 5, ""))
    flat-foldable: 5 layer orders
    """

    foldable: bool | None
    orders: int | None
    fault: str
    folding: FlatFolding | None = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        """Return the line that is printed."""
        if self.foldable is None:
            return "locally flat-foldable, and the folded image closes; synth layers counts its layer orders"
        if not self.foldable:
            return f"not flat-foldable: {self.fault}"
        return f"flat-foldable: {numbered(self.orders or 0, 'layer order')}"

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"foldable": self.foldable, "orders": self.orders, "fault": self.fault or None}


def flat_foldability(sheet: Sheet, *, variables: int = _VARIABLES) -> FlatFoldability | None:
    """Return whether a sheet folds flat; None where that is no question, or the sheet is large.

    Parameters
    ----------
    sheet : Sheet
        Without faces or creases, in space or in several parts it is no question.
    variables : int, optional
        Variables of a problem up to which orders are counted.

    Examples
    --------
    >>> import synth
    >>> print(flat_foldability(synth.read("data/patterns/bird-base.fold")))
    flat-foldable: 2 layer orders
    """

    def count(problems: Sequence[LayerProblem]) -> Sequence[int]:
        if max((problem.variables for problem in problems), default=0) > variables:
            raise _TooLargeError
        return list(map(counted, problems))

    def check(pairs: int) -> None:
        if pairs > _PAIRS:
            raise _TooLargeError

    if len(sheet.faces) > _PANELS:
        return None
    try:
        answer = flat_folding(sheet, count, explain=False, check=check)
    except _TooLargeError:
        return FlatFoldability(None, None, "")
    except (UnsolvableError, NumericalError, InvariantError):
        return None
    if not answer.mechanism.hinges:
        return None
    return FlatFoldability(answer.foldable, answer.orders, answer.fault, answer)
