"""Conical candidates evaluated: a job for the runner, whose rows tell circuits, layers, ranks, ways to go."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.candidates.job import CandidateCountJob as CandidateCountJob
    from synth.candidates.job import CandidateJob as CandidateJob
    from synth.candidates.job import Filter as Filter
    from synth.candidates.pictures import PictureSink as PictureSink
    from synth.candidates.pictures import picture_of_row as picture_of_row
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "job": "CandidateCountJob CandidateJob Filter",
            "pictures": "PictureSink picture_of_row",
        },
    )
