from enumerate.chains.counting import count_by_burnside as count_by_burnside, count_by_orbits as count_by_orbits
from enumerate.chains.fractionated import count_connected as count_connected
from enumerate.chains.jobs import (
    ChainGraph as ChainGraph,
    ChainJob as ChainJob,
    CountJob as CountJob,
    chain_rows as chain_rows,
    chains as chains,
    count_chains as count_chains,
    count_job as count_job,
)
from enumerate.chains.names import chain_named as chain_named, chain_names as chain_names, name_of as name_of
from enumerate.chains.query import ChainQuery as ChainQuery
