"""Write where the bodies of a STEP file go in the motion of a mechanism, as JSON for freecad_load.py.

python placements.py miura.fold placements.json 300

For each configuration of the motion, the name of each body to the twelve numbers of its rotation and shift, row by
row, in millimetres: what moves it from its place in the STEP file. The last argument is the size in millimetres.
"""

import json
import sys
from pathlib import Path

import numpy as np

from synth.making.simulation.assembly import AssemblyOptions, assembly_of
from synth.making.simulation.tables import motions

mechanism, target, size = sys.argv[1:]
assembly = assembly_of(mechanism, AssemblyOptions(size=float(size)))
slides = np.array([assembly.size if hinge.slide else 1.0 for hinge in assembly.hinges])
frames = []
for angles in assembly.path / slides:
    rotations, shifts = motions(assembly, angles)
    rows = np.concatenate([rotations, 1000.0 * shifts[..., None]], axis=2).reshape(-1, 12).tolist()
    frames.append({body.name: row for body, row in zip(assembly.bodies, rows, strict=True)})
Path(target).write_text(json.dumps(frames))
