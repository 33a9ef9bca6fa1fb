from enumerate.strings.panel_strings import (
    ChainString as ChainString,
    chain_sc as chain_sc,
    chain_scd as chain_scd,
    count_strings as count_strings,
    joint_chain as joint_chain,
    string_of_chain as string_of_chain,
    strings as strings,
)
