"""All kinematic chains of a size, listed and counted in two ways."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.chains.counting import count_by_burnside as count_by_burnside
    from enumerate.chains.counting import count_by_orbits as count_by_orbits
    from enumerate.chains.cycle_index import count_connected as count_connected
    from enumerate.chains.jobs import ChainJob as ChainJob
    from enumerate.chains.jobs import CountJob as CountJob
    from enumerate.chains.jobs import count_job as count_job
    from enumerate.chains.kinematic import chain_rows as chain_rows
    from enumerate.chains.kinematic import chains as chains
    from enumerate.chains.kinematic import count_chains as count_chains
    from enumerate.chains.names import chain_named as chain_named
    from enumerate.chains.names import chain_names as chain_names
    from enumerate.chains.names import name_of as name_of
    from enumerate.chains.query import ChainQuery as ChainQuery
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "counting": "count_by_burnside count_by_orbits",
            "cycle_index": "count_connected",
            "jobs": "ChainJob CountJob count_job",
            "kinematic": "chain_rows chains count_chains",
            "names": "chain_named chain_names name_of",
            "query": "ChainQuery",
        },
    )
