"""The runner of every enumerator: jobs in units of work, worker processes, sinks and stores."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
