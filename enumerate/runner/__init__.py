"""The runner of every enumerator: jobs in units of work, worker processes, sinks and stores."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.runner.job import Counting as Counting
    from enumerate.runner.job import Job as Job
    from enumerate.runner.job import Progress as Progress
    from enumerate.runner.job import Row as Row
    from enumerate.runner.job import Sink as Sink
    from enumerate.runner.job import Unit as Unit
    from enumerate.runner.limits import Limits as Limits
    from enumerate.runner.running import Interrupted as Interrupted
    from enumerate.runner.running import rows_of as rows_of
    from enumerate.runner.running import run as run
    from enumerate.runner.running import total_of as total_of
    from enumerate.runner.sinks import RowSink as RowSink
    from enumerate.runner.sinks import SortedSink as SortedSink
    from enumerate.runner.sinks import sink_for as sink_for
    from enumerate.runner.store import SqliteSink as SqliteSink
    from enumerate.runner.store import read_meta as read_meta
    from enumerate.runner.store import read_rows as read_rows
    from enumerate.runner.totals import CountSink as CountSink
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "job": "Counting Job Progress Row Sink Unit",
            "limits": "Limits",
            "running": "Interrupted rows_of run total_of",
            "sinks": "RowSink SortedSink sink_for",
            "store": "SqliteSink read_meta read_rows",
            "totals": "CountSink",
        },
    )
