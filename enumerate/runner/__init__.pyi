from enumerate.runner._run import rows_of as rows_of, run as run, total_of as total_of
from enumerate.runner.job import (
    Counting as Counting,
    Job as Job,
    Limits as Limits,
    Progress as Progress,
    Row as Row,
    Sink as Sink,
    Unit as Unit,
)
from enumerate.runner.sinks import (
    CountSink as CountSink,
    RowSink as RowSink,
    SortedSink as SortedSink,
    sink_for as sink_for,
)
from enumerate.runner.stopping import Interrupted as Interrupted
from enumerate.runner.store import SqliteSink as SqliteSink, read_meta as read_meta, read_rows as read_rows
