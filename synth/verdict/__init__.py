"""One honest verdict: does it move, with how many freedoms, which joints stay stiff, and how is that known.

`mobility` is the question of the front door: counts and ranks of `graphs.answer`, with the verdict first.
`verdict` holds it, `of_motion` makes it of a crease pattern, `of_type` of counts and ranks, `words` puts it in a
sentence.
Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.verdict.judged import JudgedMobility as JudgedMobility
    from synth.verdict.judged import mobility as mobility
    from synth.verdict.of_motion import verdict_of_motion as verdict_of_motion
    from synth.verdict.verdict import Verdict as Verdict
    from synth.verdict.verdict import Way as Way
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "judged": "JudgedMobility mobility",
            "of_motion": "verdict_of_motion",
            "verdict": "Verdict Way",
        },
    )
