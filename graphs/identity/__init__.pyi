from graphs.identity.chains import (
    automorphisms_of as automorphisms_of,
    chain_from_id as chain_from_id,
    chain_id as chain_id,
    class_code as class_code,
    symmetries_of_links as symmetries_of_links,
)
from graphs.identity.drawings import (
    drawing_of as drawing_of,
    map_code as map_code,
    map_id as map_id,
    mechanism_from_map_id as mechanism_from_map_id,
)
