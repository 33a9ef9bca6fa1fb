from enumerate.contracted.graphs import (
    MOST_LOOPS as MOST_LOOPS,
    contracted_graphs as contracted_graphs,
    cubic_graphs as cubic_graphs,
    descendants as descendants,
)
from enumerate.contracted.maps import MOST_MAP_LOOPS as MOST_MAP_LOOPS, contracted_maps as contracted_maps
