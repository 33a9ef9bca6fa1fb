"""Pictures: crease patterns, chains, graphs, models; loop sums, linkages on cones, orientations; folded panels.

Scenes are in `synth.drawing.scene`, places of links and joints in `synth.drawing.layout`, panels in space in
`synth.drawing.space`, pictures of mechanisms in `synth.drawing.mechanisms`, of many in `synth.drawing.catalogue`.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
