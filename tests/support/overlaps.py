"""Solids of thick sheets checked by manifold3d, a second method."""

from itertools import combinations

import numpy as np
import pytest


def volume_in_common(thick, frame):
    """The volume that solids of different panels have in common in a frame."""
    manifold3d = pytest.importorskip("manifold3d")
    rotations, shifts = thick.panel_motions()
    parts = [
        manifold3d.Manifold(manifold3d.Mesh64(mesh.corners, mesh.triangles.astype("u8")))
        for mesh in thick.plates.placed(rotations[frame], shifts[frame])
    ]
    assert sum(part.volume() for part in parts) == pytest.approx(thick.plates.volume)
    return sum(
        (one ^ other).volume()
        for (one, panel), (other, beside) in combinations(zip(parts, thick.plates.panels, strict=True), 2)
        if panel != beside
    )


def check_overlaps(thick):
    """No solids meet up to 179 degrees, each hinge keeps a part, and in no frame is there a volume in common."""
    assert thick.collisions.meeting.panels is None
    assert np.degrees(thick.collisions.meeting.angle) > 178.999
    assert thick.collisions.overlaps.max() <= 1e-9 * thick.plates.volume
    assert all(thick.hinge_lines.values())
    for frame in range(len(thick.angles)):
        assert volume_in_common(thick, frame) <= 1e-9 * thick.plates.volume
