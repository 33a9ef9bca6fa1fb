"""All SC graphs of a size: planar chains drawn on the sphere with an outer face, and their centres."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.sc.graphs import chain_forms as chain_forms
    from enumerate.sc.graphs import count_sc_graphs as count_sc_graphs
    from enumerate.sc.graphs import sc_graphs as sc_graphs
    from enumerate.sc.graphs import sc_rows as sc_rows
    from enumerate.sc.jobs import SCCountJob as SCCountJob
    from enumerate.sc.jobs import SCJob as SCJob
    from enumerate.sc.jobs import sc_count_job as sc_count_job
    from enumerate.sc.query import SCQuery as SCQuery
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "graphs": "chain_forms count_sc_graphs sc_graphs sc_rows",
            "jobs": "SCCountJob SCJob sc_count_job",
            "query": "SCQuery",
        },
    )
