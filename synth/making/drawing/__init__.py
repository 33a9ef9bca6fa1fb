"""Pictures: crease patterns, chains, graphs, models; loop sums, linkages on cones, orientations; folded panels.

Scenes are in `synth.making.drawing.scene`, places of links and joints in `synth.making.drawing.layout`, panels in
space in `synth.making.drawing.space`, pictures of mechanisms in `synth.making.drawing.mechanisms`, of many in
`synth.making.drawing.list_pages`.
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
