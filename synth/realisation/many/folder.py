"""A folder of realised types, and beside it the store of what became of each, by which a run goes on.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

from enumerate.runner.job import Job, Row, row_as_dict
from enumerate.runner.store import SqliteSink, read_rows
from graphs.errors import FileError
from graphs.files.atomic import check_new_folder, write_text

__all__ = ["FolderOfThings", "store_beside"]


def store_beside(folder: Path) -> Path:
    """Return where the store of a folder is: beside it, with the ending .sqlite."""
    return folder.with_name(folder.name + ".sqlite")


class FolderOfThings:
    """A sink: a FOLD file for each row that holds one, named by its number, and a store of all rows.

    Parameters
    ----------
    folder : str or Path
    resume : bool
        Go on with what is there. Without it a folder or a store that is there is refused.
    tell : callable, optional
        Takes a line on the state of the store (`SqliteSink`).
    looking : callable, optional
        Takes the part of the store that has been looked through.
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
        """Open the store, make the folder; return the units that are there.

        Raises
        ------
        FileError
            If there is something at the place of the folder, or it cannot be made.
        StoreError
            If the store is that of another job, or cannot be opened.
        """
        if not (self._resume and self._folder.is_dir()):
            check_new_folder(self._folder)
        self._columns = tuple(job.columns)
        there = self._store.start(job)
        try:
            self._folder.mkdir(exist_ok=True)
        except OSError as error:
            raise FileError(self._folder, "", f"cannot be made: {error.strerror}", "a new folder") from None
        return there

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write the files of a unit, then its rows: what is in the store has its files."""
        self._write(row_as_dict(self._columns, row) for row in rows)
        self._store.take(number, rows, seconds)

    def finish(self) -> None:
        """Mark the store complete; files that somebody removed since are written again."""
        self._store.finish()
        if self._resume:
            rows = (row_as_dict(self._columns, row) for row in read_rows(self._store.path))
            self._write(row for row in rows if not self._place_of(row).exists())

    def abort(self) -> None:
        """Close the store; what is there stays."""
        self._store.abort()

    def _write(self, rows: Iterable[Mapping[str, Any]]) -> None:
        for row in rows:
            if row["mechanism"] is not None:
                write_text(self._place_of(row), row["mechanism"], force=True)

    def _place_of(self, row: Mapping[str, Any]) -> Path:
        return self._folder / f"{row['number']:07d}.fold"
