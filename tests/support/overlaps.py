"""Solids of thick sheets checked by manifold3d, a second method."""

from itertools import combinations

import numpy as np
import pytest


def check_overlaps(manifold3d, thick):
    assert thick.collisions.meeting.panels is None
    assert np.degrees(thick.collisions.meeting.angle) > 178.999
    assert thick.collisions.overlaps.max() <= 1e-9 * thick.plates.volume
    assert all(thick.hinge_lines.values())
    rotations, shifts = thick.panel_motions()
    for turns, moved in zip(rotations, shifts, strict=True):
        parts = [
            manifold3d.Manifold(manifold3d.Mesh64(mesh.corners, mesh.triangles.astype("u8")))
            for mesh in thick.plates.placed(turns, moved)
        ]
        whole = sum(part.volume() for part in parts)
        assert whole == pytest.approx(thick.plates.volume)
        common = 0.0
        for (one, panel), (other, beside) in combinations(zip(parts, thick.plates.panels, strict=True), 2):
            if panel != beside:
                common += (one ^ other).volume()
        assert common <= 1e-9 * whole
