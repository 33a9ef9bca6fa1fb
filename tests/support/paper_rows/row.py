"""One figure of a paper, how it is asked here, and whether what comes out is what is printed."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from click.testing import CliRunner

import graphs
import synth
from synth.cli.main import main

__all__ = ["Row", "agrees", "value_of"]

CLOSE = 1e-6
"""How far a figure may be from one that no print has rounded."""


@dataclass(frozen=True)
class Row:
    """A figure of a paper.

    Attributes
    ----------
    place : str
        Where it stands in the paper.
    what : str
        What it is.
    ask : str
        A command, ``synth ...`` that prints JSON, or an expression of Python.
    figure : str
        An expression that takes the figure out of ``answer``, what was asked.
    printed : object
        The figure as printed; None if none is at hand.
    words : str
        What the paper says where that is more than a figure.
    right : object
        What ours has to be where it is not what is printed, or nothing is printed.
    within : float
        How far ours may be from it: half of the last place that is printed.
    misprint : str
        Its item in docs/misprints.md.
    second : str
        An expression that finds the figure in another way, out of the same answer.
    golden : str
        Entries of data/golden.json, as 000/eq5; with a third part, 001/table2/legs, that is where the printed figure is.
    remark : str
        What else there is to say.
    first : tuple of str
        Commands that write what is asked about.
    slow : bool
        It takes a second or more.
    why : str
        Why it cannot be done; then nothing is asked.
    same : Row
        The row of a paper that shows it; then nothing is asked here, that row's own test does.
    """

    place: str
    what: str
    ask: str = ""
    figure: str = "answer"
    printed: Any = None
    words: str = ""
    right: Any = None
    within: float = 0.0
    misprint: str = ""
    second: str = ""
    golden: str = ""
    remark: str = ""
    first: tuple[str, ...] = ()
    slow: bool = False
    why: str = ""
    same: Row | None = None

    @property
    def status(self) -> str:
        """Whether it is equal, holds, is a misprint, is not at hand, cannot be done, or is shown by another row."""
        if self.same:
            return "shown above"
        if self.why:
            return "cannot be done"
        if self.misprint:
            return "misprint"
        if self.printed is not None:
            return "equal"
        return "holds" if self.words else "none at hand"

    @property
    def due(self) -> Any:
        """What ours has to be, if no second way says so."""
        return self.printed if self.right is None else self.right


def value_of(row: Row) -> tuple[Any, Any]:
    """Return the figure of a row as it comes out now, and as it comes out in the second way, or None.

    The current folder has the project's data in it, and may be written to.
    """
    for command in row.first:
        _read(command, str(Path.cwd()))
    answer = _printed(row.ask) if row.ask.startswith("synth ") else _evaluated(row.ask, None)
    second = _plain(_evaluated(row.second, answer)) if row.second else None
    return _plain(_evaluated(row.figure, answer)), second


def agrees(found: Any, due: Any, within: float = 0.0) -> bool:
    """Tell whether a figure is what it has to be: words and whole numbers exactly, others to within a distance."""
    if isinstance(due, list | tuple):
        return (
            isinstance(found, list)
            and len(found) == len(due)
            and all(agrees(one, other, within) for one, other in zip(found, due, strict=True))
        )
    if isinstance(due, dict):
        return found.keys() == due.keys() and all(agrees(found[key], due[key], within) for key in due)
    if isinstance(due, float) and isinstance(found, int | float):
        return abs(found - due) <= (within or CLOSE)
    return type(found) is type(due) and bool(found == due)


@cache
def _read(command: str, _folder: str) -> str:
    """Return what a command prints in a folder, once for all rows that ask it."""
    result = CliRunner().invoke(main, shlex.split(command)[1:])
    assert result.exit_code in (0, 1), (command, result.output, result.exception)
    return result.output


def _printed(command: str) -> Any:
    output = _read(command, str(Path.cwd()))
    return json.loads(output) if "--json" in command else output


def _evaluated(expression: str, answer: Any) -> Any:
    """Return the value of an expression as it stands on the page, after the imports that the page names."""
    return eval(expression, {"answer": answer, "json": json, "np": np, "graphs": graphs, "synth": synth})


def _plain(value: Any) -> Any:
    """Return a value as JSON would have it."""
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(one) for one in value]
    return value if isinstance(value, bool | int | float | None) else str(value)
