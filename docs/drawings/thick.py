"""Thick panels on their way from flat to stacked, as solids seen from the side."""

from __future__ import annotations

from typing import Any

import numpy as np

import synth
from drawings.pieces import in_rows, of_shapes
from graphs.types import Floats
from synth.making.drawing import Scene
from synth.making.drawing.scene.shapes import SMALL, Label, Polygon, Shape

_COLOURS = ((232, 201, 160), (217, 179, 130), (205, 162, 110), (190, 145, 95))
_LIGHT = np.array([0.2, -0.3, 0.93])
_SEEN_FROM = np.array([0.35, -0.8, 0.5])
_ANGLES = (0.0, 60.0, 120.0, 179.0)


def thick_panels() -> Scene:
    """Thick panels of the Miura sheet, flat to stacked; three other ways; a waterbomb tessellation, flat to folded."""
    sheet = synth.generate("miura", rows=2, columns=2).mechanism
    spatial = synth.thicken(sheet, thickness=0.1, collisions=False, hinges="tape")
    scenes = [_pictured(spatial, angle, f"{angle:g}°") for angle in _ANGLES]
    for how in ("tapered", "offset", "hinge"):
        thick = synth.thicken(sheet, thickness=0.1, how=how, angle=np.radians(120.0), collisions=False, hinges="tape")
        scenes.append(_pictured(thick, 0.0, f"{how}, flat"))
    scenes.append(_pictured(thick, 100.0, "hinge, 100°"))
    bases = synth.generate("waterbomb", rows=2, columns=2).mechanism
    waterbomb = synth.thicken(bases, thickness=0.08, collisions=False, hinges="tape")
    scenes += [_pictured(waterbomb, angle, f"waterbomb, {angle:g}°") for angle in (0.0, 60.0, 179.0)]
    return in_rows(scenes, 4, gap=8.0)


def _pictured(thick: Any, angle: float, words: str) -> Scene:
    """Return the solids where the largest fold angle is nearest to one, the nearest faces drawn last."""
    frame = int(np.abs(np.degrees(np.abs(thick.angles).max(axis=1)) - angle).argmin())
    rotations, shifts = thick.panel_motions()
    ahead = _SEEN_FROM / np.linalg.norm(_SEEN_FROM)
    right = np.cross([0.0, 0.0, 1.0], ahead)
    right /= np.linalg.norm(right)
    up = np.cross(ahead, right)
    faces: list[tuple[float, Floats, str]] = []
    for mesh, panel in zip(thick.plates.placed(rotations[frame], shifts[frame]), thick.plates.panels, strict=True):
        for corners in mesh.corners[mesh.triangles]:
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            if normal @ ahead > 0.0:
                lit = 0.6 + 0.4 * abs(float(normal @ _LIGHT)) / float(np.linalg.norm(normal) * np.linalg.norm(_LIGHT))
                shade = "#" + "".join(f"{int(lit * part):02x}" for part in _COLOURS[panel % 4])
                faces.append((float((corners @ ahead).mean()), corners @ np.column_stack([right, up]), shade))
    every = np.concatenate([face for _, face, _ in faces])
    scale = 100.0 / float(np.ptp(every, axis=0).max())
    low, high = every.min(axis=0), every.max(axis=0)
    wide, tall = (scale * (high - low)).tolist()
    shapes: list[Shape] = []
    for _, face, colour in sorted(faces, key=lambda one: one[0]):
        places = [(scale * float(x - low[0]), scale * float(high[1] - y)) for x, y in face]
        shapes.append(Polygon(places, colour))
    shapes.append(Label((wide / 2, tall + SMALL), words))
    return of_shapes(wide, tall + 2.0 * SMALL, shapes)


DRAWINGS = {"thick-panels": thick_panels}
