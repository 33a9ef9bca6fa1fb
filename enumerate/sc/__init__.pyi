from enumerate.sc.jobs import (
    SCCountJob as SCCountJob,
    SCJob as SCJob,
    count_sc_graphs as count_sc_graphs,
    sc_count_job as sc_count_job,
    sc_graphs as sc_graphs,
    sc_rows as sc_rows,
)
from enumerate.sc.query import SCQuery as SCQuery
