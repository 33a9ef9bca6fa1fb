"""The atlas: all types up to a size in one file, queried in SQL.

Building: `AtlasPlan` says which types, `build_atlas` lists them, resumably. Queries: `open_atlas`; `Atlas.query`
by conditions on `COLUMNS`, `Atlas.sql`, `Atlas.show`, `find_type`. Search by motion: `add_motions`, `like`. Theory:
docs/theory/atlas.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
