"""The answer to "how does it move?", put together: counts, exact rank, freedoms at the pose.

`mobility` takes any mechanism and gives one object, which prints as the command line does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.answer.identity import Identity as Identity
    from graphs.answer.identity import identify as identify
    from graphs.answer.mechanisms import mobility as mobility
    from graphs.answer.reconstruction import Reconstruction as Reconstruction
    from graphs.answer.reconstruction import reconstruct as reconstruct
    from graphs.answer.report import MobilityAnswer as MobilityAnswer
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "identity": "Identity identify",
            "mechanisms": "mobility",
            "reconstruction": "Reconstruction reconstruct",
            "report": "MobilityAnswer",
        },
    )
