"""The atlas: all types up to a size in one file, asked in plain words.

Building: `AtlasPlan` says what is in it, `build_atlas` lists it, resumably. Asking: `open_atlas`; `Atlas.query` by
conditions on `COLUMNS`, `Atlas.sql`, `Atlas.show`, `find_type`. Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.atlas.asked.expression import ExpressionError as ExpressionError
    from synth.atlas.asked.expression import condition_of as condition_of
    from synth.atlas.asked.finding import find_type as find_type
    from synth.atlas.asked.opened import Atlas as Atlas
    from synth.atlas.asked.opened import open_atlas as open_atlas
    from synth.atlas.columns import COLUMNS as COLUMNS
    from synth.atlas.made.building import build_atlas as build_atlas
    from synth.atlas.made.plan import AtlasPlan as AtlasPlan
    from synth.atlas.names import named_types as named_types
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "synth.atlas.made.building": "build_atlas",
            "columns": "COLUMNS",
            "synth.atlas.asked.expression": "ExpressionError condition_of",
            "synth.atlas.asked.finding": "find_type",
            "names": "named_types",
            "synth.atlas.asked.opened": "Atlas open_atlas",
            "synth.atlas.made.plan": "AtlasPlan",
        },
    )
