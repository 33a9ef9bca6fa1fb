"""One verdict: whether a mechanism moves, its degrees of freedom, its immobile joints, and the evidence.

`mobility` gives the counts and ranks of `graphs.answer` with the verdict first. `verdict` holds the verdict and
writes its sentences, `judged` makes it of a configuration, or of counts and ranks. Theory: docs/theory/verdict.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
