"""Orientations to guide a body through: those of Tipparthi and Larochelle 2011, and the coupler of a known linkage."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

PRINTED = [
    (1.0, 0.0, 0.0, 0.0),
    (0.37721, 0.82336, 0.38967, 0.16722),
    (0.0078934, 0.041131, 0.085164, -0.99549),
    (0.039457, 0.77456, -0.60494, -0.18041),
    (-0.30301, -0.36492, 0.85697, 0.20157),
]
"""Table 1 as printed; the third has one sign wrong (docs/misprints.md, 002-1)."""

CORRECTED = [*PRINTED[:2], (0.0078934, -0.041131, 0.085164, -0.99549), *PRINTED[3:]]


def crank_rocker() -> list[list[float]]:
    """Return five orientations of the coupler of a crank-rocker: ground 60, crank 20, coupler 55, rocker 50 degrees.

    The crank turns about z, at 10, 35, 65, 100 and 140 degrees from the ground, which lies along x; the rocker stays to
    the left. The coupler's x axis is along the crank's moving axis, its y axis towards that of the rocker.
    """
    ground, crank, coupler, rocker = np.radians([60.0, 20.0, 55.0, 50.0])
    pivot = np.array([np.sin(ground), 0.0, np.cos(ground)])
    made = []
    for turn in np.radians([10.0, 35.0, 65.0, 100.0, 140.0]):
        w = np.array([np.sin(crank) * np.cos(turn), np.sin(crank) * np.sin(turn), np.cos(crank)])
        k = w @ pivot
        # the follower's axis in terms of the pivot, the crank's axis and their normal
        x, y = np.linalg.solve([[1.0, k], [k, 1.0]], [np.cos(rocker), np.cos(coupler)])
        height = np.sqrt((1.0 - x * x - y * y - 2.0 * k * x * y) / (1.0 - k * k))
        v = x * pivot + y * w + height * np.cross(pivot, w)
        normal = np.cross(w, v) / np.linalg.norm(np.cross(w, v))
        frame = np.stack([w, np.cross(normal, w), normal], axis=1)
        made.append([round(q, 12) for q in Rotation.from_matrix(frame).as_quat(scalar_first=True).tolist()])
    return made


TASKS = {"tipparthi": CORRECTED, "tipparthi-as-printed": PRINTED, "crank-rocker": crank_rocker()}
