"""The answer to "how does it move?", put together: counts, exact rank, freedoms at the pose.

`mobility` takes any mechanism and gives one object, which prints as the command line does.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
