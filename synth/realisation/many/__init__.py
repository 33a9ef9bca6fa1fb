"""Many types realised at once: a job for the runner of enumerations, and the folder where their files go."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.realisation.many.folder import FolderOfThings as FolderOfThings
    from synth.realisation.many.job import RealisationJob as RealisationJob
    from synth.realisation.many.job import summary_of as summary_of
else:
    __getattr__, __dir__, __all__ = offered(
        __name__, {"folder": "FolderOfThings", "job": "RealisationJob summary_of"}
    )
