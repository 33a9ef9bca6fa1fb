"""A site written: a job of types whose files go into a new folder, which is there when it is whole."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from enumerate.runner.job import Column, Job, Progress, Row, Unit
from enumerate.runner.running import run
from enumerate.runner.sinks import FolderSink
from graphs.errors import FileError, UnsolvableError
from synth.atlas.asked.guarded import open_guarded
from synth.atlas.asked.opened import Atlas
from synth.atlas.asked.type_report import report_of
from synth.atlas.asked.values import damaged
from synth.atlas.site.index_page import SEARCHED, data_script, index_page
from synth.atlas.site.type_page import TypeFiles, files_of_type
from synth.viewer.building import BUILT
from synth.viewer.pages import check_built

__all__ = ["Site", "SiteSink", "site_of", "write_site"]

_UNIT = 16
"""Types of a unit."""
_WEIGHT = 1000
"""Of a type: it takes as long as so many rows of a list."""
_MOST = 100_000
"""Types of a site: a file system and a page that is searched take no more."""
_SCRIPTS = ("page.js", "page.css", "gallery.js", "gallery.css", "LICENSES.txt")


@dataclass(frozen=True)
class Site:
    """The pages of types of an atlas, by its path and their ids, as a job whose rows are files: name and text."""

    atlas: str
    ids: tuple[str, ...]

    @property
    def columns(self) -> dict[str, Column]:
        """Where a file is in the folder, and what is in it."""
        return {"name": str, "text": str}

    @property
    def key(self) -> dict[str, Any]:
        """What the job is."""
        return {"site": self.atlas, "types": len(self.ids)}

    @property
    def digits(self) -> int:
        """Of the numbers in names of files."""
        return len(str(len(self.ids)))

    def units(self) -> list[Unit]:
        """Units of some types each, by their numbers."""
        starts = range(0, len(self.ids), _UNIT)
        return [Unit((start, min(start + _UNIT, len(self.ids))), _UNIT * _WEIGHT) for start in starts]

    def work(self, payload: tuple[int, int]) -> list[Row]:
        """Return the files of a unit."""
        places = {code: self._file(number) for number, code in enumerate(self.ids)}
        rows: list[Row] = []
        with open_guarded(Path(self.atlas)) as connection:
            for number in range(*payload):
                report = report_of(connection, self.ids[number], Path(self.atlas))
                if report is None:  # its id was read a moment ago
                    raise damaged(Path(self.atlas), "the index", self.ids[number], "an id that it finds")
                rows += self._rows(self._file(number), files_of_type(report, self._file(number), places))
        return rows

    def _file(self, number: int) -> str:
        return f"{number + 1:0{self.digits}d}"

    @staticmethod
    def _rows(file: str, made: TypeFiles) -> Iterable[Row]:
        yield f"types/{file}.html", made.page
        yield f"pictures/{file}.svg", made.picture
        yield f"pictures/{file}-graph.svg", made.graph
        if made.fold is not None:
            yield f"types/{file}.fold", made.fold
        if made.template is not None:
            yield f"types/{file}-template.svg", made.template


class SiteSink(FolderSink):
    """A sink that writes the files of a site into a new folder; `first` are those that belong to no type."""

    def __init__(self, path: str | Path, first: Mapping[str, str]) -> None:
        super().__init__(Path(path))
        self._first = first

    def start(self, job: Job) -> Collection[int]:
        """Make a folder beside its place, with the files that belong to no type.

        Raise FileError if something is at its place, or it cannot be made.
        """
        there = super().start(job)
        assert self._folder is not None
        for name in ("types", "pictures"):
            (self._folder.path / name).mkdir()
        self.take(0, list(self._first.items()), 0.0)
        return there

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write the files of a unit: a row is a name and a text."""
        assert self._folder is not None
        for name, text in rows:
            try:
                (self._folder.path / name).write_text(text, encoding="utf-8")
            except OSError as error:
                raise FileError(self._path, "", f"cannot be written: {error.strerror}") from None


def site_of(atlas: Atlas, condition: str = "", title: str = "") -> tuple[Site, dict[str, str]]:
    """Return the job of a site, for the types with a condition (by default all), and its other files.

    Raise UnsolvableError if there are no such types, or too many, or the scripts were not built.
    """
    check_built()
    rows = atlas.query(condition, columns=SEARCHED, limit=_MOST)
    if rows.more or not rows.rows:
        what = f"more than {_MOST} types" if rows.more else "no types"
        raise UnsolvableError(f"{what} for a site: choose others by a condition")
    site = Site(str(atlas.path), tuple(row["id"] for row in rows))
    about = atlas.about()
    made = f"{len(rows)} types; made by synthedra {about['synthedra']}: {about['command']}"
    name = title or "Atlas of types"
    first = {script: (BUILT / script).read_text(encoding="utf-8") for script in _SCRIPTS}
    first["index.html"] = index_page(name, made)
    first["data.js"] = data_script(rows.rows, name, made, site.digits)
    return site, first


def write_site(
    atlas: Atlas,
    path: str | Path,
    condition: str = "",
    *,
    title: str = "",
    workers: int = 1,
    report: Callable[[Progress], None] | None = None,
) -> Path:
    """Write a site of an atlas into a new folder; return its first page.

    It has the types with a condition, by default all. It uses so many worker processes, and calls `report` with
    the progress from time to time. Raise FileError if something is at the place, or it cannot be written;
    UnsolvableError if there are no such types, or too many, or the scripts were not built.
    """
    site, first = site_of(atlas, condition, title)
    job: Job = site
    run(job, SiteSink(path, first), workers=workers, report=report)
    return Path(path) / "index.html"
