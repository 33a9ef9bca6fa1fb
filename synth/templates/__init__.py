"""Templates: sheets as lines to cut and to fold, at true scale on pages; panels as thin solids.

`template_of` makes pieces of a thing with panels; `pages_of` puts them on pages of a `Paper`, whole or in tiles
that overlap; `write_template` writes PDF, SVG or DXF. `panels_of_thing` takes types, `pictured` adds a picture.
Below them: `lines` (what is drawn, how each kind looks), `marks` (gauge, frame, crosses), `tiles`;
`synth.templates.pieces` (flat sheets, panels in space as nets with tabs), `synth.templates.note` (how it is put
together). `write_solids` writes panels as thin solids. Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.templates.paper import Paper as Paper
    from synth.templates.paper import paper_named as paper_named
    from synth.templates.solids import write_solids as write_solids
    from synth.templates.template import Template as Template
    from synth.templates.template import pictured as pictured
    from synth.templates.template import template_of as template_of
    from synth.templates.things import panels_of_thing as panels_of_thing
    from synth.templates.writing import write_template as write_template
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "paper": "Paper paper_named",
            "solids": "write_solids",
            "template": "Template pictured template_of",
            "things": "panels_of_thing",
            "writing": "write_template",
        },
    )
