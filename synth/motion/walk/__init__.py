"""One path of closed poses, step by step: how far a step can be trusted, and what happens on the way.

`stepping` takes the steps, `leg` goes from one frame to the next, `between` finds a pose within a step, `rank`
watches for singular poses, `parting` says how many ways there are, `event` names what was met. `freedoms`: which
joints drive a pose. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.motion.walk.event import PathEvent as PathEvent
    from synth.motion.walk.stepping import Allowance as Allowance
    from synth.motion.walk.stepping import PathOptions as PathOptions
else:
    __getattr__, __dir__, __all__ = offered(__name__, {"event": "PathEvent", "stepping": "Allowance PathOptions"})
