"""All R/- strings: chains of panels between two bodies, and the mechanisms they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.strings.graphs import chain_sc as chain_sc
    from enumerate.strings.graphs import chain_scd as chain_scd
    from enumerate.strings.graphs import string_of_chain as string_of_chain
    from enumerate.strings.panel_strings import ChainString as ChainString
    from enumerate.strings.panel_strings import count_strings as count_strings
    from enumerate.strings.panel_strings import joint_chain as joint_chain
    from enumerate.strings.panel_strings import strings as strings
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "graphs": "chain_sc chain_scd string_of_chain",
            "panel_strings": "ChainString count_strings joint_chain strings",
        },
    )
