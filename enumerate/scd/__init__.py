"""All SCD graphs of a size: every placement of open edges on SC graphs that obeys the rules.

A *pattern* says which points of a face are one; *choices* lay the open edges of a link in the corners that are
left.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.scd.graphs import all_mechanisms as all_mechanisms
    from enumerate.scd.graphs import count_scd_graphs as count_scd_graphs
    from enumerate.scd.graphs import scd_graphs as scd_graphs
    from enumerate.scd.graphs import scd_graphs_of as scd_graphs_of
    from enumerate.scd.graphs import scd_rows as scd_rows
    from enumerate.scd.jobs import SCDCountJob as SCDCountJob
    from enumerate.scd.jobs import SCDJob as SCDJob
    from enumerate.scd.jobs import scd_count_job as scd_count_job
    from enumerate.scd.query import PlacementQuery as PlacementQuery
    from enumerate.scd.query import SCDQuery as SCDQuery
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "graphs": "all_mechanisms count_scd_graphs scd_graphs scd_graphs_of scd_rows",
            "jobs": "SCDCountJob SCDJob scd_count_job",
            "query": "PlacementQuery SCDQuery",
        },
    )
