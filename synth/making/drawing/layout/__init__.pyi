from synth.making.drawing.layout.mechanisms import Layout as Layout, layout_of as layout_of
