"""Many types realised at once: a job for the runner of every enumerator, and the folder where its files go.

A row says whether a type was realised, and holds its file; beside the folder is the store of all rows, by which a
run is resumed. Theory: docs/theory/realisation.md.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any, Literal

from enumerate.runner.job import Column, Job, Row, Unit, packed, row_as_dict
from enumerate.runner.store import SqliteSink, read_rows
from enumerate.strings.panel_strings import ChainString
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.atomic import check_new_folder, make_folder, write_text
from graphs.files.native import dumps
from graphs.files.patterns.fold import fold_text
from graphs.identity.drawings import map_id
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from synth.catalogue.realisation._realise import NotFoundError, realise
from synth.linkages.conformed.orders import OrderOnCircle
from synth.making.drawing.list_pages import CatalogueEntry, catalogue_entries


def store_beside(folder: Path) -> Path:
    """Return the path of the store of a folder: beside it, with the ending .sqlite."""
    return folder.with_name(folder.name + ".sqlite")


class RealisationFolder:
    """A sink: a FOLD file for each row that holds one, named by its number, and a store of all rows.

    With `resume` it continues an existing folder; otherwise an existing folder or store is refused. `tell`
    receives a line on the state of the store (`SqliteSink`), `looking` the part of the store that has been looked
    through.
    """

    def __init__(
        self,
        folder: str | Path,
        *,
        resume: bool = False,
        tell: Callable[[str], None] | None = None,
        looking: Callable[[float], None] = lambda part: None,
    ) -> None:
        self._folder, self._resume = Path(folder), resume
        self._store = SqliteSink(store_beside(self._folder), resume=resume, tell=tell, looking=looking)
        self._columns: tuple[str, ...] = ()

    def start(self, job: Job) -> Collection[int]:
        """Open the store, make the folder; return the units that are done.

        Raise FileError if the folder cannot be made, StoreError if the store is that of another job.
        """
        if not (self._resume and self._folder.is_dir()):
            check_new_folder(self._folder)
        self._columns = tuple(job.columns)
        units = self._store.start(job)
        make_folder(self._folder)
        return units

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write the files of a unit, then its rows: every row of the store has its file."""
        for row in rows:
            self._write(row)
        self._store.take(number, rows, seconds)

    def finish(self) -> None:
        """Mark the store complete; files that were removed since are written again."""
        self._store.finish()
        for row in read_rows(self._store.path) if self._resume else ():
            self._write(row, again=False)

    def abort(self) -> None:
        """Close the store; what is there stays."""
        self._store.abort()

    def _write(self, row: Row, *, again: bool = True) -> None:
        values = row_as_dict(self._columns, row)
        path = self._folder / f"{values['number']:07d}.fold"
        if values["mechanism"] is not None and (again or not path.exists()):
            write_text(path, values["mechanism"], force=True)


Outcome = Literal["realised", "not found", "refused"]

_WEIGHT, _JOINTS = 1000, 10
"""Weight of an SCD graph of so many joints: it takes as long as so many rows of a list. Half of it grows as the
square of the number of joints."""
_UNDRAWN, _CONDITIONS = 8, 3
"""How many times as long an SC graph takes, of which panels round one centre are bent; and conditions on sheets."""
_UNIT = 40_000
"""Weight of a unit: about a second, so that a run that is stopped has little to do again."""

COLUMNS: dict[str, Column] = {
    "number": int, "name": str, "outcome": str, "reason": str, "code": str, "mobility": int, "freedoms": int,
    "folds": bool, "least_angle_deg": float, "edge_ratio": float, "planarity": float, "least_distance": float,
    "try": int, "mechanism": str,
}  # fmt: skip
"""Values of a row: the number of a type, from 1, its name, the outcome and its reason; then, if it was realised,
its id, figures and file (FOLD), else None."""


@dataclass(frozen=True)
class RealisationJob:
    """All types of a store, a list or a folder, realised.

    `source` is anything that `synth.making.drawing.list_pages.catalogue_entries` reads (FileError if it cannot be
    read); `options` are keyword arguments of `synth.catalogue.realisation.realise`, JSON values. `unit_weight` is the
    weight of a unit, in rows of a list that take as long; a type that takes longer is one by itself.
    """

    source: str
    options: tuple[tuple[str, Any], ...] = ()
    unit_weight: int = _UNIT
    columns = COLUMNS

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for a worker: without the types, of which each unit has its own."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the job: a digest of the types and how many are in each unit, and the options."""
        digest = sha256(repr([len(unit.payload) for unit in self.units()]).encode())
        for entry in self._read[0]:
            digest.update(f"{entry.number} {entry.name}\n{_text_of(entry)}\n".encode())
        return {"realise": digest.hexdigest(), **dict(self.options)}

    @property
    def failures(self) -> list[str]:
        """Errors of the files of a folder that could not be read."""
        return self._read[1]

    @cached_property
    def _read(self) -> tuple[list[CatalogueEntry], list[str]]:
        failures: list[str] = []
        return list(catalogue_entries(self.source, failures=failures)), failures

    def units(self) -> list[Unit]:
        """Units of about a second each."""
        options = dict(self.options)
        return list(packed(((entry, _weight_of(entry, options)) for entry in self._read[0]), self.unit_weight))

    def work(self, payload: Iterable[CatalogueEntry]) -> list[Row]:
        """Return a row for each type of a unit."""
        return [_row(entry, dict(self.options)) for entry in payload]


def summary_of(rows: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Return how many types of some rows were realised, refused and not found, and which are which."""
    kept = ("number", "name", "outcome", "reason", "code")
    types = [{name: row[name] for name in kept} for row in rows]
    outcomes = [row["outcome"].replace(" ", "_") for row in types]
    return {**{name: outcomes.count(name) for name in ("realised", "not_found", "refused")}, "types": types}


def _weight_of(entry: CatalogueEntry, options: Mapping[str, Any]) -> int:
    """Return about how many rows of a list take as long as the realisation of a type."""
    mechanism = entry.mechanism
    if not isinstance(mechanism, SCGraph):
        return _WEIGHT
    weight = _WEIGHT * (1.0 + (len(mechanism.joints) / _JOINTS) ** 2) / 2.0
    undrawn = _UNDRAWN if not isinstance(mechanism, SCDGraph) else 1
    conditions = _CONDITIONS if options.get("flat_foldable") or options.get("symmetric") else 1
    return max(1, round(weight * undrawn * conditions))


def _row(entry: CatalogueEntry, options: dict[str, Any]) -> Row:
    outcome: Outcome
    values: dict[str, Any]
    try:
        if isinstance(entry.mechanism, OrderOnCircle):
            raise UnsolvableError("an order of joints round a cone has no panels; try `synth template`")
        realised = realise(entry.mechanism, mode=entry.mode, **options)
        outcome, reason = "realised", ""
        values = {
            "code": map_id(realised.scd),
            "mobility": realised.mobility,
            "freedoms": realised.freedoms,
            "folds": realised.folds,
            "try": realised.number,
            "mechanism": fold_text(realised.sheet),
            **realised.figures.to_json(),
        }
    except SynthedraError as error:
        values, outcome, reason = {}, "not found" if isinstance(error, NotFoundError) else "refused", str(error)
    values |= {"number": entry.number, "name": entry.name, "outcome": outcome, "reason": reason}
    return tuple(values.get(column) for column in COLUMNS)


def _text_of(entry: CatalogueEntry) -> str:
    """Return an entry as text; for a string and an order their names and descriptions."""
    if isinstance(entry.mechanism, ChainString | OrderOnCircle):
        return f"{entry.name} {entry.said}"
    return fold_text(entry.mechanism) if isinstance(entry.mechanism, Sheet) else dumps(entry.mechanism)
