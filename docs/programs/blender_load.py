"""Load a glTF file of synthedra into Blender, with its motion, and save it as a .blend file.

blender --background --python blender_load.py -- folded.gltf folded.blend
"""

import sys
from pathlib import Path

import bpy
import numpy as np

if not hasattr(np, "bool"):  # the importer of Blender 3.4 needs a name that the numpy of Debian 12 no longer has
    np.bool = bool


def load(path: str) -> list:
    """Load the panels of a file into an empty scene whose frames are those of the motion; return them."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(Path(path).resolve()))
    panels = [each for each in bpy.data.objects if each.type == "MESH"]
    ends = [action.frame_range[1] for action in bpy.data.actions]
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 0, int(max(ends, default=0))
    return panels


if __name__ == "__main__":
    source, target = sys.argv[sys.argv.index("--") + 1 :]
    panels = load(source)
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(target).resolve()))
    print(f"{len(panels)} panels, {len(bpy.data.actions)} of them moving, {bpy.context.scene.frame_end} frames")
