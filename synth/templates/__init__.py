"""Templates: sheets as lines to cut and to fold, at true scale on pages.

`template_of` makes pieces of a thing with panels; `layout` puts them on pages of a `Paper`, whole or in tiles that
overlap; `write_template` writes PDF, SVG or DXF. Below them: `lines` (what is
drawn, and how each kind looks), `marks` (gauge, frame, what meets), `tiles`; `synth.templates.pieces` (sheets that lie
flat, panels in space as nets with tabs). Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.templates.paper import Paper as Paper
    from synth.templates.paper import paper_named as paper_named
    from synth.templates.template import Template as Template
    from synth.templates.template import template_of as template_of
    from synth.templates.writing import write_template as write_template
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "paper": "Paper paper_named",
            "template": "Template template_of",
            "writing": "write_template",
        },
    )
