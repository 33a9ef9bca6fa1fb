"""Contracted graphs and maps, and binary links placed on their joints: what chains and drawings are made of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from enumerate.contracted.descent import descendants as descendants
    from enumerate.contracted.descent import streamed_graphs as streamed_graphs
    from enumerate.contracted.graphs import MOST_LOOPS as MOST_LOOPS
    from enumerate.contracted.graphs import contracted_graphs as contracted_graphs
    from enumerate.contracted.graphs import cubic_graphs as cubic_graphs
    from enumerate.contracted.maps import MOST_MAP_LOOPS as MOST_MAP_LOOPS
    from enumerate.contracted.maps import contracted_maps as contracted_maps
    from enumerate.contracted.maps import cubic_maps as cubic_maps
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "descent": "descendants streamed_graphs",
            "graphs": "MOST_LOOPS contracted_graphs cubic_graphs",
            "maps": "MOST_MAP_LOOPS contracted_maps cubic_maps",
        },
    )
