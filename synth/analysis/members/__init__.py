"""Many members of one type at once, arrays in and out: `sweep`.

Members come of arcs, axes or coordinates (`dimensions`), and are taken through inputs (`kernel`: in C, or by numpy),
or round whole circuits (`circuits_of`).
Theory: docs/theory/members.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
