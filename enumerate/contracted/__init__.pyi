from enumerate.contracted.graphs import (
    MOST_LOOPS as MOST_LOOPS,
    contracted_graphs as contracted_graphs,
    cubic_graphs as cubic_graphs,
    descendants as descendants,
    streamed_graphs as streamed_graphs,
)
from enumerate.contracted.maps import (
    MOST_MAP_LOOPS as MOST_MAP_LOOPS,
    contracted_maps as contracted_maps,
    cubic_maps as cubic_maps,
)
