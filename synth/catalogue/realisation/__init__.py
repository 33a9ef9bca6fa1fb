"""Types with coordinates: flat sheets of panels, configurations in space, linkages on cones.

`realise` draws the panels of a type (`realised`): `pattern` has its panels in numbers, `drawing` draws them with
the `conditions` of flat-foldable and symmetric sheets, `measures` has angles, lengths and shape, `space` lifts
drawings. `strips` are those of R/- strings; `on_cone` lays a type with one centre round a cone; `many` realises
stores and folders; `special` finds members that move although counts say no. Theory: docs/theory/realisation.md.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
