"""The types of an atlas as rows: a job for the runner of every enumerator.

Each kind of type is listed by its own job; its rows become rows of the atlas (`synth.atlas.made.filling`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

from enumerate.runner.job import Column, Job, Row, Unit
from synth.atlas.columns import COLUMNS, SCHEMA, stored_columns
from synth.atlas.made.filling import filled
from synth.atlas.made.plan import AtlasPlan

__all__ = ["AtlasJob"]

_REALISED = 1000
"""Weight of a type that gets coordinates: it takes as long as so many rows of a list."""


@dataclass(frozen=True)
class AtlasJob:
    """All types of a plan, as rows of an atlas."""

    plan: AtlasPlan

    def __getstate__(self) -> dict[str, Any]:
        """Return what goes to a worker, without jobs that have found their units."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row; what a kind of type does not have is None."""
        return stored_columns()

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"atlas": SCHEMA, **self.plan.key}

    @cached_property
    def _parts(self) -> Sequence[tuple[str, Job]]:
        return tuple(self.plan.parts())

    def units(self) -> list[Unit]:
        """Units of each part, in order; the strings are the last."""
        return list(self._units())

    def _units(self) -> Iterator[Unit]:
        for part, (kind, job) in enumerate(self._parts):
            weight = _REALISED if kind == "scd" and self.plan.realised else 1
            for unit in job.units():
                yield Unit((part, unit.payload), unit.weight * weight)
        listed = tuple(self.plan.strings())
        if listed:
            yield Unit((None, listed), len(listed))

    def work(self, payload: tuple[int | None, Any]) -> list[Row]:
        """Return the rows of a unit."""
        part, inner = payload
        if part is None:
            return [self._row("string", {"string": string}) for string in inner]
        kind, job = self._parts[part]
        columns = tuple(job.columns)
        return [self._row(kind, dict(zip(columns, row, strict=True))) for row in job.work(inner)]

    def _row(self, kind: str, listed: dict[str, Any]) -> Row:
        values = filled(kind, listed, realised=self.plan.realised)
        return tuple(values.get(column) for column in COLUMNS)
