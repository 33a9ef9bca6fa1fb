from enumerate.scd.jobs import (
    SCDCountJob as SCDCountJob,
    SCDJob as SCDJob,
    all_mechanisms as all_mechanisms,
    count_scd_graphs as count_scd_graphs,
    scd_count_job as scd_count_job,
    scd_graphs as scd_graphs,
    scd_graphs_of as scd_graphs_of,
    scd_rows as scd_rows,
    simplest_scd_graph as simplest_scd_graph,
)
from enumerate.scd.query import PlacementQuery as PlacementQuery, SCDQuery as SCDQuery
