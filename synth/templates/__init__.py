"""Templates: sheets as lines to cut and to fold, at true scale on pages; panels as thin solids.

`template_of` makes pieces of a thing with panels; `pages_of` puts them on pages of a `Paper`, whole or in tiles
that overlap; `write_template` writes PDF, SVG or DXF. `panels_of_thing` takes types, `pictured` adds a picture.
Below them: `lines` (what is drawn, how each kind looks), `marks` (gauge, frame, crosses), `tiles`;
`synth.templates.pieces` (flat sheets, panels in space as nets with tabs), `synth.templates.note` (how it is put
together). `write_solids` writes panels as thin solids. Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
