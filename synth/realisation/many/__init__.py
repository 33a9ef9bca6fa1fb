"""Many types realised at once: a job for the runner of enumerations, and the folder where their files go."""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
