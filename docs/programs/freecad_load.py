"""Load a STEP file of synthedra into FreeCAD, in a configuration of its motion, and save it as a document.

PLACEMENTS=placements.json FRAME=-1 STEP=miura.step OUT=miura.FCStd freecadcmd freecad_load.py

Placements are those of placements.py, by the names of bodies; the hinge axes stay. Parts keep their names and their
group: by default, freecadcmd 0.20 merges an assembly into one shape, and crashes, also on files of its own.
"""

import json
import os
from pathlib import Path

import FreeCAD
import Import

document = FreeCAD.newDocument("mechanism")
Import.insert(os.environ["STEP"], document.Name, merge=False)
parts = {part.Label: part for part in document.Objects}
frames = json.loads(Path(os.environ["PLACEMENTS"]).read_text())
placements = frames[int(os.environ.get("FRAME", "-1"))]
for name, row in placements.items():
    motion = FreeCAD.Placement(FreeCAD.Matrix(*row, 0.0, 0.0, 0.0, 1.0))
    parts[name].Placement = motion.multiply(parts[name].Placement)
document.recompute()
document.saveAs(os.environ["OUT"])
print(f"{len(document.Objects)} objects, {len(placements)} bodies placed")
