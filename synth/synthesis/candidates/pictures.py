"""A picture of each candidate: the circle with links, ICRL and shadow, and with a cone angle the cone."""

from collections.abc import Collection, Mapping
from math import radians
from pathlib import Path
from typing import Any

from enumerate.runner.job import Job, Row, Sink, row_as_dict
from enumerate.runner.sinks import FolderSink
from graphs.errors import UnsolvableError
from graphs.mechanism.surfaces import Cone
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.conformed.rates_over_angles import links_in_layers
from synth.making.drawing.conformed import draw_conformed
from synth.making.drawing.scene.writing import Scene
from synth.synthesis.candidates.job import CandidateJob

_MOST = 10_000
_ANY = Cone(radians(30.0))
"""The cone of the picture where the candidate has no surface of its own."""


def picture_of_row(job: CandidateJob, row: dict[str, Any]) -> Scene:
    """Return a picture of a candidate.

    Parameters
    ----------
    job : CandidateJob
    row : dict
        Column to value. An order is drawn with joints, and opposites, evenly spaced.

    Returns
    -------
    Scene

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)])), [Loop(tuple("OABC"))])
    >>> job = CandidateJob(chain, (0,))
    >>> [picture_of_row(job, row).title.split("   ")[:2] for row in job.rows()]
    [['O A B C', 'open'], ['O A C B', 'crossed'], ['O B A C', 'crossed']]
    """
    linkage = job.linkage(row)
    chain = ConformedChain.of(linkage.chain, linkage.chain.ground)
    title = title_of_picture(row, int(links_in_layers(chain, job.places(row)).layers.max()) + 1)
    return draw_conformed(chain, job.places(row), job.surface or _ANY, title, grounded=bool(row["ground"]))


def title_of_picture(row: Mapping[str, Any], layers: int) -> str:
    """Return the title of a picture of a candidate: order, circuits, and the number of layers in it.

    A cyclic order is drawn at one choice of angles; its row, and the title, have the layers of all choices.
    """
    low, high = row["layers"], row.get("most_layers", row["layers"])
    every = "" if low == high else f" ({low} to {high} over all angles)"
    return f"{' '.join(row['order'])}   {' '.join(row['circuits'])}   layers {layers}{every}"


class PictureSink(FolderSink):
    """A sink that draws each row to a new folder, then passes it on.

    Parameters
    ----------
    inner : Sink
    job : CandidateJob
    folder : Path
    """

    def __init__(self, inner: Sink, job: CandidateJob, folder: Path) -> None:
        super().__init__(folder)
        self._inner, self._job = inner, job

    def start(self, job: Job) -> Collection[int]:
        """Make a folder beside its place; FileError if something is there, or it cannot be made."""
        super().start(job)
        return self._inner.start(job)

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Draw the rows and pass them on; UnsolvableError if there are too many."""
        for row in rows:
            self._number += 1
            if self._number > _MOST:
                raise UnsolvableError(f"more than {_MOST} pictures; try fewer candidates")
            scene = picture_of_row(self._job, row_as_dict(self._job.columns, row))
            scene.save(self._begun.path / f"{self._number:05d}.png")
        self._inner.take(number, rows, seconds)

    def finish(self) -> None:
        """Move the folder to its place."""
        self._inner.finish()
        super().finish()

    def abort(self) -> None:
        """Remove the pictures."""
        super().abort()
        self._inner.abort()
