"""Templates: sheets as lines to cut and to fold, at true scale on pages; panels as thin solids.

`template_of` makes pieces of panels, `panels_of_mechanism` takes types, `pictured` adds a picture;
`write_template` puts the pieces on pages of a `Paper`, and writes PDF, SVG or DXF; `write_solids` writes panels as
thin solids. Files: `pieces` (lines, cuts, overlays, flat sheets), `unfolding` and `nets` (panels in space as nets
with tabs), `hinges` (thick material), `template`, `on_surface` (linkages on cones and cylinders), `pages` (paper,
tiles, the note of assembly), `writing`, `solids`. Theory: docs/theory/templates.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
