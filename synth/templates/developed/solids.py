"""Layered links as solids: shells between ruling lines, slots left out, a gap at each hinge."""

from __future__ import annotations

from itertools import pairwise
from math import pi

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.files.solids.mesh import Mesh
from graphs.types import Floats
from synth.templates.developed.layered import LayeredLink, LayeredLinkage

__all__ = ["solids_on_surface"]

_STEP = np.radians(3.0)
"""Azimuth of a facet, at most."""


def solids_on_surface(linkage: LayeredLinkage, gap: float) -> list[Mesh]:
    """Return the surface and each link as a closed shell of the material's thickness.

    `gap` is that between a link that ends at a joint and its neighbour, at the inner edge, millimetres. Raise
    UnsolvableError if a link is narrower than the gap.
    """
    ends = linkage.dimensions.ends
    off = gap / 2 / linkage.surface.width(ends[0])
    whole = np.arange(0.0, 1.0, _STEP / (2 * pi)) * 2 * pi
    surface = _shell(linkage, "surface", -1, whole, np.array(ends), np.ones((len(whole), 1), bool), closed=True)
    return [surface, *(_link(linkage, link, off) for link in linkage.links)]


def _link(linkage: LayeredLinkage, link: LayeredLink, off: float) -> Mesh:
    """Return a link, as cells of azimuth and length of which those in slots are left out."""
    if link.width <= 2 * off:
        raise UnsolvableError(f"link {link.name} is narrower than the gap at its hinges")
    start, end = link.start + off, link.start + link.width - off
    slots = [(link.start + along - linkage.slot, link.start + along + linkage.slot) for _, along in link.slots]
    fixed = sorted({start, end, *(azimuth for slot in slots for azimuth in slot)})
    azimuths = [fixed[0]]
    for here, after in pairwise(fixed):
        count = max(1, int(np.ceil((after - here) / _STEP)))
        azimuths += [here + (after - here) * part / count for part in range(1, count)] + [after]
    inner, outer = linkage.dimensions.ends
    low, high = linkage.dimensions.slot_ends
    lengths = np.array([inner, low, high, outer] if slots else [inner, outer])
    middles = (np.array(azimuths)[1:] + np.array(azimuths)[:-1]) / 2
    there = np.ones((len(middles), len(lengths) - 1), bool)
    for first, last in slots:
        there[(middles > first) & (middles < last), 1] = False
    return _shell(linkage, f"link {link.name}", link.layer, np.array(azimuths), lengths, there, closed=False)


def _shell(
    linkage: LayeredLinkage,
    name: str,
    layer: int,
    azimuths: Floats,
    lengths: Floats,
    there: npt.NDArray[np.bool_],
    *,
    closed: bool,
) -> Mesh:
    """Return the closed mesh of the cells that are there, about the middle of a layer.

    `there` is bool[columns, rows], `lengths` float[rows + 1], `azimuths` float[columns + 1] (float[columns] if
    closed).
    """
    half = linkage.dimensions.thickness / 2
    heights = np.array([linkage.height(layer) - half, linkage.height(layer) + half])
    grid = np.meshgrid(heights, azimuths, lengths, indexing="ij")
    corners = linkage.surface.place(grid[1], grid[2], grid[0]).reshape(-1, 3)
    columns, rows = len(azimuths), len(lengths)

    def at(side: int, column: int, row: int) -> int:
        return (side * columns + column % columns) * rows + row

    def holds(column: int, row: int) -> bool:
        if closed:
            column %= len(there)
        return 0 <= column < len(there) and 0 <= row < rows - 1 and bool(there[column, row])

    quads: list[list[int]] = []
    for column, row in np.argwhere(there).tolist():
        ring = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)]
        beyond = [(column, row - 1), (column + 1, row), (column, row + 1), (column - 1, row)]
        quads.append([at(1, *one) for one in ring[::-1]])
        quads.append([at(0, *one) for one in ring])
        for side in range(4):
            if not holds(*beyond[side]):
                a, b = ring[side], ring[(side + 1) % 4]
                quads.append([at(0, *b), at(0, *a), at(1, *a), at(1, *b)])
    triangles = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
    used, renumbered = np.unique(triangles, return_inverse=True)
    return Mesh(name, corners[used], renumbered.reshape(-1, 3))
