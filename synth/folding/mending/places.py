"""A linkage as a function of where the vertices of its crease pattern are.

Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy.sparse

from graphs.convert.duality import SheetMechanism
from graphs.geometry import crossing, principal_axes, unit
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.rank.singular_values import row_space
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.folding.derivatives import axis_motions
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = ["VertexPlaces"]


class VertexPlaces:
    """Vertices that may be moved: in the plane of a flat sheet, else in space with panels kept planar.

    Lengths are those of the linkage: in units of the extent, about the middle. `given`, float[V, 3], are the
    places as written, `ends`, int[J, 2], the vertices at the ends of each crease; `along`, float[2 or 3, 3], are
    the directions in which vertices may be moved, `unknowns` their number.
    """

    def __init__(self, sheet: Sheet, mechanism: SheetMechanism, linkage: PosedLinkage) -> None:
        assert sheet.coordinates is not None
        self.given: Floats = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
        self.loops = linkage.loops
        self._linkage = replace(linkage, loops=tuple(_with_all_equations(loop) for loop in linkage.loops))
        ends = [mechanism.hinges[joint] for joint in linkage.graph.joints]  # type: ignore[index]
        self.ends: Ints = np.array(ends, dtype=np.int64).reshape(-1, 2)
        ways = ((self.given[self.ends[:, 1]] - self.given[self.ends[:, 0]]) * linkage.directions).sum(axis=1)
        self._ways: Floats = np.sign(ways)
        self.along = _plane_of(self.given)
        self._on_lines = np.array(list(_between(mechanism, linkage)), dtype=np.int64).reshape(-1, 3)
        self._panels = [] if len(self.along) == 2 else [panel for panel in sheet.faces if len(panel) > 3]
        self.unknowns = len(self.given) * len(self.along)
        self._into_space = scipy.sparse.kron(scipy.sparse.eye(len(self.given)), self.along.T, "csr")

    @property
    def bent(self) -> float:
        """How far vertices on creases of several pieces are off their lines, at most."""
        return float(np.abs(self.off_lines(self.given)[0]).max(initial=0.0))

    @property
    def lengths(self) -> Floats:
        """The lengths of the creases: float[J]."""
        return np.asarray(np.linalg.norm(self.given[self.ends[:, 1]] - self.given[self.ends[:, 0]], axis=1))

    def moved(self, by: Floats) -> Floats:
        """Return the vertices, moved by unknowns float[unknowns]: float[V, 3]."""
        return np.asarray(self.given + by.reshape(len(self.given), -1) @ self.along)

    def linkage(self, corners: Floats) -> PosedLinkage:
        """Return the linkage with vertices at float[V, 3]; loops with parallel axes close with six equations."""
        ends = corners[self.ends]
        along = ends[:, 1] - ends[:, 0]
        directions = unit(along) * self._ways[:, None]
        return replace(self._linkage, points=ends.mean(axis=1), directions=directions)

    def motions_of_axes(self, corners: Floats) -> scipy.sparse.csr_matrix:
        """Return how each axis turns and shifts with the unknowns: sparse float[6 J, unknowns]."""
        return (axis_motions(self.ends, corners) @ self._into_space).tocsr()

    def off_lines(self, corners: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return how far vertices on creases of several pieces are off their lines, with the derivatives."""
        vertices, near, far = corners[self._on_lines.T]
        along = far - near
        sizes = np.linalg.norm(along, axis=1, keepdims=True)
        direction = along / np.where(sizes == 0.0, 1.0, sizes)
        off = np.cross(vertices - near, direction)
        part = ((vertices - near) * direction).sum(axis=1, keepdims=True) / np.where(sizes == 0.0, 1.0, sizes)
        across = -crossing(direction) @ self.along.T
        count, free = len(vertices), len(self.along)
        rows = np.broadcast_to((3 * np.arange(count)[:, None] + np.arange(3))[..., None], across.shape).ravel()
        matrix = scipy.sparse.csr_matrix((3 * count, self.unknowns))
        for share, which in zip((np.ones_like(part), part - 1.0, -part), self._on_lines.T, strict=True):
            columns = np.broadcast_to((free * which[:, None] + np.arange(free))[:, None], across.shape).ravel()
            values = (share[..., None] * across).ravel()
            matrix = matrix + scipy.sparse.csr_matrix((values, (rows, columns)), shape=matrix.shape)
        return off.ravel(), matrix.tocsr()

    def off_planes(self, corners: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return how far vertices are off the planes of their panels, with the derivatives by the unknowns."""
        rows: list[Floats] = []
        off: list[Floats] = []
        places: list[tuple[Ints, int]] = []
        for panel in self._panels:
            around = np.array(panel)
            middle = corners[around] - corners[around].mean(axis=0)
            *inside, normal = principal_axes(middle)[1]
            here = middle @ normal
            # to first order the best plane takes up what is linear along the panel
            linear = np.column_stack([np.ones(len(around)), middle @ np.transpose(inside)])
            basis = row_space(linear.T)
            across = np.eye(len(around)) - basis @ basis.T
            off.append(across @ here)
            rows.append(np.einsum("ij,c->ijc", across, normal).reshape(len(around), -1))
            places.append((around, len(around)))
        total = sum(size for _, size in places)
        matrix = scipy.sparse.lil_matrix((total, self.unknowns))
        start = 0
        for (around, size), values in zip(places, rows, strict=True):
            columns = (3 * around[:, None] + np.arange(3)).ravel()
            matrix[start : start + size, columns] = values
            start += size
        return np.concatenate([np.zeros(0), *off]), matrix.tocsr()


def _between(mechanism: SheetMechanism, linkage: PosedLinkage) -> Iterator[tuple[int, int, int]]:
    """Yield vertices on creases of several pieces, each with the ends of its crease."""
    for joint in linkage.graph.joints:
        near, far = mechanism.hinges[joint]  # type: ignore[index]
        inside = {vertex for edge in mechanism.pieces[joint] for vertex in edge} - {near, far}  # type: ignore[index]
        yield from ((vertex, near, far) for vertex in sorted(inside))


def _with_all_equations(loop: PosedLoop) -> PosedLoop:
    """Return a loop whose axes need not stay parallel."""
    return replace(loop, centre=Centre.NONE) if loop.centre is Centre.INFINITE else loop


def _plane_of(points: Floats) -> Floats:
    """Return two directions of the plane of flat points, or three of space: float[d, 3]."""
    sizes, directions = principal_axes(points)
    return directions[:2] if sizes[2] <= DOUBLE.same_point * sizes[0] else np.eye(3)
