"""Supplementary linkages: spherical four-bars that have the same joint lines.

A joint line has two ends; to take the other one replaces the two link angles there by their supplements. Source:
Hyatt et al. 2020, section 2.3. Theory: docs/theory/four-bars.md.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import numpy.typing as npt

from graphs.types import Floats
from synth.fourbar.rounding import rounding_of

__all__ = ["in_a_hemisphere", "minimal_supplementary", "supplementary"]


def supplementary(angles: npt.ArrayLike) -> Floats:
    """Return the 16 linkages that have the same joint lines (Hyatt et al. 2020, section 2.3).

    A joint line has two ends. To take the other end of a joint changes the two links there to their supplements.

    Parameters
    ----------
    angles : float[..., 4]
        Link angles in loop order, radians, between 0 and pi. Joint j is between links j - 1 and j.

    Returns
    -------
    float[..., 16, 4]
        The linkage itself first. Turning all four joints round changes no angle, so there are eight different
        ones at most; their T4 are plus and minus T1 to T4, and the product T1 T2 T3 T4 is the same for all.

    Examples
    --------
    >>> linkages = np.degrees(supplementary(np.radians([85, 120, 95, 45]))).round(9)
    >>> len(np.unique(linkages, axis=0)), linkages[1].tolist()
    (8, [85.0, 120.0, 85.0, 135.0])
    """
    angles = np.asarray(angles, dtype=float)
    ends = np.array(list(product((0, 1), repeat=4)))
    turned = (ends + np.roll(ends, -1, axis=1)) % 2  # link i lies between joints i and i + 1
    angles = angles[..., np.newaxis, :]
    return np.where(turned == 1, np.pi - angles, angles)


def minimal_supplementary(angles: npt.ArrayLike) -> Floats:
    """Return the supplementary linkage with the smallest sum of angles: the one whose T4 is largest.

    Parameters
    ----------
    angles : float[..., 4]

    Returns
    -------
    float[..., 4]

    Examples
    --------
    >>> np.degrees(minimal_supplementary(np.radians([170, 160, 150, 140]))).round(9).tolist()
    [10.0, 20.0, 30.0, 40.0]
    """
    every = supplementary(angles)
    sums = every.sum(axis=-1)
    least = (sums <= sums.min(axis=-1, keepdims=True) + rounding_of(every)).argmax(
        axis=-1
    )  # the first of equal ones
    return np.take_along_axis(every, least[..., np.newaxis, np.newaxis], axis=-2)[..., 0, :]


def in_a_hemisphere(axes: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Tell whether the joint axes of spherical four-bars point into one hemisphere (Hyatt et al. 2020, 2.3).

    Parameters
    ----------
    axes : float[..., 4, 3]
        Directions, of any length.

    Notes
    -----
    Four vectors lie in an open hemisphere unless a combination of them with weights >= 0 vanishes. In space the
    weights are the 3 x 3 minors with alternating sign, unique up to a factor where the vectors span space. Where
    they do not, in a linkage that lies flat, the answer is no.

    Examples
    --------
    >>> corner = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> in_a_hemisphere([[*corner, [-1, -1, -1]], [*corner, [1, 1, 1]]]).tolist()
    [False, True]
    """
    vectors = np.asarray(axes, dtype=float)
    minors = np.stack(
        [(-1) ** i * np.linalg.det(np.delete(vectors, i, axis=-2)) for i in range(4)],
        axis=-1,
    )
    size = np.abs(minors).max(axis=-1, keepdims=True)
    noise = 1e-12 * np.maximum(size, np.linalg.norm(vectors, axis=-1).prod(axis=-1)[..., np.newaxis])
    some = (minors > noise).any(axis=-1), (minors < -noise).any(axis=-1)
    return np.asarray(some[0] & some[1])
