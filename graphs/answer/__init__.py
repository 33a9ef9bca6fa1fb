"""Answers for any mechanism: mobility (counts, exact rank, degrees of freedom at a configuration), ids, models.

`counts_and_ranks` takes any mechanism and gives one object, which prints as the command line does.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
