"""From a task to types: what bodies are to do, which types can do it, with dimensions, ranked.

A task (`record`, read by `task_files`) names bodies by their roles, and says what the type must be like and how the
bodies are to move. All types of the sizes are listed, and those that cannot do it are counted by reasons
(`structure`); roles are placed in all ways (`placements`); each placement is designed from many starts by successive
halving (`dimensioning`); designs are ranked (`ranking`) and reported (`report`). Guide: docs/guides/from-a-task.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
