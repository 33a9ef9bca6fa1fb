"""Building an atlas: the rows of its job in a store of the runner, then what makes it quick to ask.

The rows are in the table ``type`` of a store (`enumerate.runner.store_units`), so that a build that was killed
goes on, and damage is found. When all are there, the view ``types`` is made (the columns of
`synth.atlas.columns`), the view ``relations`` (which type is what of which), and an index for each column that
people ask for. What makes a file an atlas is the table ``atlas``: versions of the schema and of synthedra, the
command.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from importlib.metadata import version
from pathlib import Path
from typing import Any

from enumerate.runner.job import Job, Progress
from enumerate.runner.running import run
from enumerate.runner.store import SqliteSink
from enumerate.runner.store_units import naming, quoted
from synth.atlas.columns import COLUMNS, SCHEMA
from synth.atlas.made.job import AtlasJob
from synth.atlas.made.plan import AtlasPlan

__all__ = ["RELATIONS", "AtlasSink", "build_atlas"]

RELATIONS = {
    "chain_id": "has the chain",
    "sc_id": "is a drawing, with open edges, of",
    "reduced": "reduces to",
    "planar_analogue": "has the planar analogue",
    "spherical_analogue": "has the spherical analogue",
    "general_form": "has the general form",
}
"""Columns that hold the id of another type, and what that is."""


class AtlasSink(SqliteSink):
    """A store that becomes an atlas when all rows are there.

    `command` is the recorded command that made it; the options are those of `SqliteSink`.
    """

    def __init__(self, path: str | Path, command: str, **options: Any) -> None:
        super().__init__(path, **options)
        self._command = command

    def finish(self) -> None:
        """Mark the store complete, and make what it is asked by."""
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
    """Build an atlas; one that was stopped goes on with ``resume``.

    Parameters
    ----------
    path : str or Path
        Ends in .sqlite, as stores do.
    plan : AtlasPlan
    workers : int, optional
        Processes.
    resume, force : bool, optional
        Go on with what is there; or begin anew.
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
    job: Job = AtlasJob(plan)
    return run(job, sink, workers=workers, report=report)


def _make_askable(path: Path, command: str) -> None:
    """Give a complete store of types its views and indexes; those that are there stay."""
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
        for column, relation in RELATIONS.items()
    )
