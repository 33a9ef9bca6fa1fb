"""Building an atlas: its plan, the rows of its job in a store of the runner, the views and indexes for questions.

Each kind of type is listed by its own job; its rows become rows of the atlas (`synth.synthesis.atlas.filling`) in the
table ``type`` of a store (`enumerate.runner.store_units`), so that a build that was killed can resume, and damage is
found. When all are there, views and indexes are made, and the table ``atlas``, which makes a file an atlas. Theory:
docs/theory/atlas.md.
"""

import shlex
import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, fields
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any

from enumerate.chains.jobs import ChainJob
from enumerate.chains.names import chain_named
from enumerate.chains.query import ChainQuery
from enumerate.machine_code.weights import without_kernels
from enumerate.runner._run import run
from enumerate.runner.job import Column, Job, Progress, Row, Unit
from enumerate.runner.store import SqliteSink
from enumerate.runner.store_units import naming, quoted
from enumerate.sc.jobs import SCJob
from enumerate.sc.query import SCQuery
from enumerate.scd.jobs import SCDJob
from enumerate.scd.query import PlacementQuery, SCDQuery
from enumerate.strings.panel_strings import strings
from graphs.errors import InvariantError
from graphs.files.formats import mechanism_of_id
from graphs.plain_data import fields_to_json
from synth.synthesis.atlas.columns import COLUMNS, RELATIONS, SCHEMA, stored_columns
from synth.synthesis.atlas.filling import filled
from synth.synthesis.candidates.job import CandidateJob

_FEWEST = 4
"""Fewest links of a chain: with less it is rigid, or not closed."""
_REALISED_AT_ONCE, _AT_ONCE = 8, 2000
"""Placements of a unit where each is realised, which takes long, and where none is."""


@dataclass(frozen=True)
class AtlasPlan:
    """Which types an atlas is to hold.

    Attributes
    ----------
    max_links : int
        SC and SCD graphs of 4 links to so many.
    dofs : tuple of int
        Degrees of freedom of chains, SC and SCD graphs.
    max_degree : int
        Most sides of a link of an SCD graph.
    chain_links : int, optional
        Chains of 4 links to so many; by default `max_links`.
    creases : int
        R/- strings of one crease to so many, with the limits of `enumerate.strings`; 0 for none.
    orders_of : tuple of str
        Chains, by name or id, whose joints are put round a cone in every order.
    spatial : int
        Also hybrids, with one spatial loop to so many.
    infinite : bool
        Also centres at infinity.
    realised : bool
        Whether SCD graphs get coordinates, and are folded.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> [kind for kind, job in AtlasPlan(6).parts()]
    ['chain', 'chain', 'sc', 'sc', 'scd', 'scd', 'order', 'order']
    """

    max_links: int = 8
    dofs: tuple[int, ...] = (1,)
    max_degree: int = 4
    chain_links: int | None = None
    creases: int = 6
    orders_of: tuple[str, ...] = ("watt", "stephenson")
    spatial: int = 0
    infinite: bool = False
    realised: bool = True

    def __post_init__(self) -> None:
        for name, value, least in (
            ("max links", self.max_links, _FEWEST),
            ("links of chains", self.most_chain_links, _FEWEST),
            ("creases", self.creases, 0),
            ("spatial loops", self.spatial, 0),
        ):
            if value < least:
                raise InvariantError("atlas", f"{name} {value}", f"{least} or more")
        if not self.dofs or len(set(self.dofs)) != len(self.dofs) or min(self.dofs) < 1:
            what = f"degrees of freedom {', '.join(map(str, self.dofs)) or 'missing'}"
            raise InvariantError("atlas", what, "numbers of 1 or more, each once")
        for _, job in self.parts():
            _ = job.key  # queries check themselves when they are made

    @property
    def most_chain_links(self) -> int:
        """Links of the largest chains."""
        return self.max_links if self.chain_links is None else self.chain_links

    @property
    def key(self) -> dict[str, Any]:
        """The plan in JSON values."""
        return fields_to_json(self)

    @property
    def command(self) -> str:
        """The command that builds it."""
        words = ["synth atlas build", f"--max-links {self.max_links}", *(f"--dof {dof}" for dof in self.dofs)]
        words += [f"--max-degree {self.max_degree}", f"--chain-links {self.most_chain_links}"]
        words += [f"--creases {self.creases}", *(f"--orders-of {shlex.quote(name)}" for name in self.orders_of)]
        words += ["--orders-of none"] * (not self.orders_of) + [f"--spatial {self.spatial}"] * (self.spatial > 0)
        words += ["--infinite"] * self.infinite + ["--no-realise"] * (not self.realised)
        return " ".join(words)

    def parts(self) -> Iterator[tuple[str, Job]]:
        """Yield the jobs that list the types of the atlas, but for strings, and the kinds of their types."""
        for links, dof in self._sizes(self.most_chain_links):
            query = ChainQuery(links, dof, fractionated=dof > 1)
            if query.possible:
                yield "chain", ChainJob(query)
        for links, dof, spatial in self._drawn_sizes():
            yield "sc", SCJob(SCQuery(links, dof, spatial=spatial, infinite=self.infinite))
        size = _REALISED_AT_ONCE if self.realised else _AT_ONCE
        for links, dof, spatial in self._drawn_sizes():
            placements = PlacementQuery(self.max_degree)
            scd = SCDQuery(links, dof, placements, spatial=spatial, infinite=self.infinite)
            yield "scd", SCDJob(scd, size)
        for name in self.orders_of:
            chain = mechanism_of_id(name if name.startswith("k1:") else chain_named(name))
            if len(chain) <= self.max_links:
                yield "order", CandidateJob(chain)

    def _sizes(self, most: int) -> Iterator[tuple[int, int]]:
        for dof in self.dofs:
            for links in range(_FEWEST, most + 1):
                yield links, dof

    def _drawn_sizes(self) -> Iterator[tuple[int, int, int]]:
        """Yield links, degrees of freedom and spatial loops of which there are SC graphs."""
        for links, dof in self._sizes(self.max_links):
            for spatial in range(self.spatial + 1):
                if links - 1 > dof and SCQuery(links, dof, spatial=spatial).possible:
                    yield links, dof, spatial


_REALISED = 1000
"""Weight of a type that gets coordinates: it takes as long as so many rows of a list."""


@dataclass(frozen=True)
class AtlasJob:
    """All types of a plan, as rows of an atlas."""

    plan: AtlasPlan

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for a worker, without jobs that have found their units."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row; None where a kind of type has no value."""
        return stored_columns()

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the job, in JSON values."""
        return {"atlas": SCHEMA, **self.plan.key}

    @cached_property
    def _parts(self) -> Sequence[tuple[str, Job]]:
        return tuple(self.plan.parts())

    def units(self) -> list[Unit]:
        """Units of each part, in order; the strings are the last."""
        units = []
        for part, (kind, job) in enumerate(self._parts):
            weight = _REALISED if kind == "scd" and self.plan.realised else 1
            units += [Unit((part, unit.payload), unit.weight * weight) for unit in job.units()]
        every = tuple(string for creases in range(1, self.plan.creases + 1) for string in strings(creases))
        return [*units, Unit((None, every), len(every))] if every else units

    def work(self, payload: tuple[int | None, Any]) -> list[Row]:
        """Return the rows of a unit."""
        part, inner = payload
        if part is None:
            return [self._row("string", {"string": string}) for string in inner]
        kind, job = self._parts[part]
        columns = tuple(job.columns)
        return [self._row(kind, dict(zip(columns, row, strict=True))) for row in job.work(inner)]

    def _row(self, kind: str, listed: dict[str, Any]) -> Row:
        with without_kernels():
            values = filled(kind, listed, realised=self.plan.realised)
        return tuple(values.get(column) for column in COLUMNS)


class AtlasSink(SqliteSink):
    """A store that becomes an atlas when all rows are there.

    `command` is the recorded command that made it; the options are those of `SqliteSink`.
    """

    _others = ("motions",)

    def __init__(self, path: str | Path, command: str, **options: Any) -> None:
        super().__init__(path, **options)
        self._command = command

    def finish(self) -> None:
        """Mark the store complete, and make its views and indexes."""
        super().finish()
        _make_askable(self.path, self._command)


def build_atlas(
    path: str | Path,
    plan: AtlasPlan,
    *,
    workers: int = 1,
    resume: bool = False,
    force: bool = False,
    report: Callable[[Progress], None] | None = None,
) -> Progress:
    """Build an atlas.

    Parameters
    ----------
    path : str or Path
        Ends in .sqlite, as stores do.
    plan : AtlasPlan
    workers : int, optional
        Number of processes.
    resume, force : bool, optional
        Continue the existing store, of a build that was stopped; or replace it.
    report : callable, optional
        Called with the progress after each unit.

    Raises
    ------
    StoreError
        If there is a file and it is neither to be resumed nor replaced, or it cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> plan = AtlasPlan(4, creases=0, orders_of=(), realised=False)
    >>> with TemporaryDirectory() as folder:
    ...     build_atlas(Path(folder) / "small.sqlite", plan).rows
    9
    """
    sink = AtlasSink(path, plan.command, resume=resume, force=force)
    return run(AtlasJob(plan), sink, workers=workers, report=report)


def _make_askable(path: Path, command: str) -> None:
    """Give a complete store of types its views and indexes; existing ones stay."""
    with naming(path), closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("BEGIN IMMEDIATE")
        connection.execute(f"CREATE VIEW IF NOT EXISTS types AS SELECT {quoted(COLUMNS)} FROM type")
        connection.execute(f"CREATE VIEW IF NOT EXISTS relations AS {_relations()}")
        for name, column in COLUMNS.items():
            if column.indexed or name in RELATIONS:
                connection.execute(f'CREATE INDEX IF NOT EXISTS "type_{name}" ON type ("{name}")')
        connection.execute("CREATE INDEX IF NOT EXISTS type_size ON type (kind, links, dof)")
        connection.execute("CREATE TABLE IF NOT EXISTS atlas (schema INTEGER, synthedra TEXT, command TEXT)")
        connection.execute(
            "INSERT INTO atlas SELECT ?, ?, ? WHERE NOT EXISTS (SELECT 1 FROM atlas)",
            (SCHEMA, version("synthedra"), command),
        )
        connection.execute("ANALYZE")


def _relations() -> str:
    """Return the statement that selects ``id``, ``relation``, ``other`` of all types."""
    return " UNION ALL ".join(
        f'SELECT id, \'{relation}\' AS relation, "{column}" AS other FROM type WHERE "{column}" IS NOT NULL'
        for column, (relation, _) in RELATIONS.items()
    )
