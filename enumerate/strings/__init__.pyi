from enumerate.strings.panel_strings import (
    ChainString as ChainString,
    chain_scd as chain_scd,
    count_strings as count_strings,
    joint_chain as joint_chain,
    strings as strings,
)
