"""One honest verdict: does it move, with how many freedoms, which joints stay stiff, and how is that known.

`mobility` is the question of the front door: counts and ranks of `graphs.answer`, with the verdict first.
`verdict` holds it, `of_motion` makes it of a crease pattern, `of_type` of counts and ranks, `words` puts it in a
sentence.
Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
