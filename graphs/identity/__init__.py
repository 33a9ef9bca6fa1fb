"""Canonical ids: of chains (``k1:``), of drawn mechanisms (``m1:``), and codes of centre classes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from graphs.identity.chains import automorphisms_of as automorphisms_of
    from graphs.identity.chains import chain_from_id as chain_from_id
    from graphs.identity.chains import chain_id as chain_id
    from graphs.identity.classes import class_code as class_code
    from graphs.identity.classes import symmetries_of_links as symmetries_of_links
    from graphs.identity.drawings import drawing_of as drawing_of
    from graphs.identity.drawings import map_code as map_code
    from graphs.identity.drawings import map_id as map_id
    from graphs.identity.drawings import mechanism_from_map_id as mechanism_from_map_id
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "chains": "automorphisms_of chain_from_id chain_id",
            "classes": "class_code symmetries_of_links",
            "drawings": "drawing_of map_code map_id mechanism_from_map_id",
        },
    )
