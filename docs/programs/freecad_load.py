"""Load a STEP file of synthedra into FreeCAD, in a configuration of its motion, and save it as a document.

PLACEMENTS=placements.json FRAME=-1 STEP=miura.step OUT=miura.FCStd freecadcmd freecad_load.py

Placements are those of placements.py, whose bodies are in the order of the parts; the hinge axes come last and stay.
"""

import json
import os
from pathlib import Path

import FreeCAD
import Part

document = FreeCAD.newDocument("mechanism")
Part.insert(os.environ["STEP"], document.Name)
frames = json.loads(Path(os.environ["PLACEMENTS"]).read_text())
for part, (name, row) in zip(document.Objects, frames[int(os.environ.get("FRAME", "-1"))].items(), strict=False):
    part.Label = name
    part.Placement = FreeCAD.Placement(FreeCAD.Matrix(*row, 0.0, 0.0, 0.0, 1.0)).multiply(part.Placement)
document.recompute()
document.saveAs(os.environ["OUT"])
print(f"{len(document.Objects)} objects, {len(frames[0])} bodies placed")
