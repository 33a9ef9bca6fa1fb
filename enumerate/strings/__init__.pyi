from enumerate.strings.graphs import (
    chain_sc as chain_sc,
    chain_scd as chain_scd,
    string_of_chain as string_of_chain,
)
from enumerate.strings.panel_strings import (
    ChainString as ChainString,
    count_strings as count_strings,
    joint_chain as joint_chain,
    strings as strings,
)
