"""Many types realised at once: a job for the runner of every enumerator (`enumerate.runner.running`).

A row says what became of a type, and holds its file. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from hashlib import sha256
from typing import Any, Literal

from enumerate.runner.job import Column, Row, Unit
from enumerate.strings.panel_strings import ChainString
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.native.documents import dumps
from graphs.files.patterns.fold import fold_text
from graphs.identity.drawings import map_id
from graphs.mechanism.sheet import Sheet
from synth.drawing.catalogue.entries import CatalogueEntry, catalogue_entries
from synth.drawing.mechanisms.orders import OrderOnCircle
from synth.realisation.realised import NotFoundError, Realised, realise

__all__ = ["COLUMNS", "Outcome", "RealisationJob", "summary_of"]

Outcome = Literal["realised", "not found", "refused"]

_TYPES = 4
"""Types of a unit."""
_WEIGHT = 1000
"""Of a type: it takes as long as so many rows of a list."""

COLUMNS: dict[str, Column] = {
    "number": int,
    "name": str,
    "outcome": str,
    "reason": str,
    "code": str,
    "mobility": int,
    "freedoms": int,
    "folds": bool,
    "least_angle_deg": float,
    "edge_ratio": float,
    "planarity": float,
    "least_distance": float,
    "try": int,
    "mechanism": str,
}
"""What a row holds: the place of a type among all, from 1, its name, what became of it, why not; then, of what was
realised, its id, figures and file (FOLD)."""


@dataclass(frozen=True)
class RealisationJob:
    """All types of a store, a list or a folder, realised.

    Attributes
    ----------
    source : str
        What `synth.drawing.catalogue.entries.catalogue_entries` reads.
    options : tuple of (str, value)
        Keyword arguments of `synth.realisation.realise`, JSON values.

    Raises
    ------
    FileError
        If the source cannot be read.

    Examples
    --------
    >>> RealisationJob("nowhere.jsonl").units()
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: nowhere.jsonl: cannot be read: No such file or directory; expected a readable file
    """

    source: str
    options: tuple[tuple[str, Any], ...] = ()

    def __getstate__(self) -> dict[str, Any]:
        """Return what goes to a worker: not the types, of which each unit has its own."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row; figures of what was not realised are None."""
        return COLUMNS

    @property
    def key(self) -> dict[str, Any]:
        """What the job is: a digest of the types, and the options."""
        digest = sha256()
        for entry in self._entries:
            digest.update(f"{entry.number} {entry.name}\n{_text_of(entry)}\n".encode())
        return {"realise": digest.hexdigest(), **dict(self.options)}

    @property
    def failures(self) -> list[str]:
        """What is wrong with files of a folder that could not be read."""
        return self._read[1]

    @property
    def _entries(self) -> list[CatalogueEntry]:
        return self._read[0]

    @cached_property
    def _read(self) -> tuple[list[CatalogueEntry], list[str]]:
        failures: list[str] = []
        return list(catalogue_entries(self.source, failures=failures)), failures

    def units(self) -> list[Unit]:
        """Units of a few types each."""
        starts = range(0, len(self._entries), _TYPES)
        portions = (self._entries[start : start + _TYPES] for start in starts)
        return [Unit(portion, _WEIGHT * len(portion)) for portion in portions]

    def work(self, payload: Iterable[CatalogueEntry]) -> list[Row]:
        """Return a row for each type of a unit."""
        return [_row(entry, dict(self.options)) for entry in payload]


def summary_of(rows: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Return how many types were realised, refused and not found, and which are which.

    Parameters
    ----------
    rows : iterable of mapping
        Of a job.

    Examples
    --------
    >>> row = {"number": 1, "name": "a", "outcome": "refused", "reason": "a closed surface", "code": None}
    >>> {name: value for name, value in summary_of([row]).items() if name != "types"}
    {'realised': 0, 'not_found': 0, 'refused': 1}
    """
    kept = ("number", "name", "outcome", "reason", "code")
    listed = [{name: row[name] for name in kept} for row in rows]
    outcomes = [one["outcome"].replace(" ", "_") for one in listed]
    return {**{name: outcomes.count(name) for name in ("realised", "not_found", "refused")}, "types": listed}


def _row(entry: CatalogueEntry, options: dict[str, Any]) -> Row:
    outcome: Outcome
    try:
        if isinstance(entry.mechanism, OrderOnCircle):
            raise UnsolvableError(
                "an order of joints round a cone, which has no panels: `synth template` takes it"
            )
        found, outcome, reason = realise(entry.mechanism, mode=entry.mode, **options), "realised", ""
    except SynthedraError as error:
        found, outcome, reason = None, "not found" if isinstance(error, NotFoundError) else "refused", str(error)
    told = {"number": entry.number, "name": entry.name, "outcome": outcome, "reason": reason, **_figures(found)}
    return tuple(told.get(column) for column in COLUMNS)


def _figures(found: Realised | None) -> dict[str, Any]:
    if found is None:
        return {}
    return {
        "code": map_id(found.scd),
        "mobility": found.mobility,
        "freedoms": found.freedoms,
        "folds": found.folds,
        "try": found.number,
        "mechanism": fold_text(found.sheet),
        **found.figures.to_json(),
    }


def _text_of(entry: CatalogueEntry) -> str:
    """Return what an entry is, as text; of a string its name says it, of an order what is said of it."""
    if isinstance(entry.mechanism, ChainString | OrderOnCircle):
        return f"{entry.name} {entry.said}"
    return fold_text(entry.mechanism) if isinstance(entry.mechanism, Sheet) else dumps(entry.mechanism)
