"""The first picture of README.md: a crease pattern, what is said of it, and poses on its way.

``make pictures`` runs it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import synth
from synth.making.drawing.scene.shapes import Label, Layer, moved
from synth.making.drawing.scene.writing import Scene
from synth.making.drawing.space.motion_files import frame_scenes

PLACE = Path(__file__).resolve().parent / "pictures" / "overview.svg"
POSES = (2, 6, 10, 14)
SIZE, GAP = 130.0, 16.0


def main() -> None:
    """Draw it."""
    made = synth.generate("miura", rows=4, columns=5)
    sheet = made.mechanism
    folding = synth.fold(sheet, frames=16)
    pattern = synth.draw(sheet, numbers=False, box=(190.0, 190.0), caption=None)
    poses = list(frame_scenes(sheet, folding.places[np.array(POSES)], SIZE))
    high = max(pattern.height, SIZE)
    verdict = synth.mobility(sheet).verdict
    assert verdict is not None
    layers = [moved(layer, 0.0, (high - pattern.height) / 2) for layer in pattern.layers]
    for place, pose in enumerate(poses):
        right = pattern.width + GAP + place * SIZE
        layers += [moved(layer, right, (high - SIZE) / 2) for layer in pose.layers if layer.shapes]
    width = pattern.width + GAP + len(poses) * SIZE
    answer = verdict.text.partition(". ")[0] + "."
    layers.append(Layer("verdict", (Label((width / 2, high + 14), answer, 9.0, halo=False, widest=200),)))
    Scene(width, high + 28, tuple(layers), "Miura sheet").save(PLACE, force=True)


if __name__ == "__main__":
    main()
