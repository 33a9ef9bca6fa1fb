"""Where vertices are at fold angles, and derivatives of a folded sheet by the coordinates of its vertices.

Creases that are driven are held at their angles. Theory: docs/theory/folding.md, docs/theory/derivatives.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from graphs.convert.duality import SheetMechanism
from graphs.errors import UnsolvableError
from graphs.geometry import crossing
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, corners_of_faces, panel_of_faces
from graphs.types import Floats, Ints
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.derivatives import AxisDependence, BodyPoses, BodyTree, Sensitivity, spatial
from synth.analysis.motion.linkage import Creases, Linkage, creases_of, placed_links


def vertex_places(sheet: Sheet, mechanism: SheetMechanism, linkage: Linkage, angles: Floats) -> tuple[Floats, Floats]:
    """Return where vertices are at fold angles float[F, J], and how far panels disagree on that.

    Places are float[F, vertices, 3] in the unit of the coordinates, distances float[F] in units of the extent.
    """
    assert sheet.coordinates is not None
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    rotation, shift = placed_links(linkage, angles, largest_panel(mechanism.panels))
    vertices, _, faces = corners_of_faces(sheet.faces)
    links = panel_of_faces(mechanism.panels)[faces]
    order = np.argsort(links, kind="stable")
    links, vertices = links[order], vertices[order]
    placed, first = np.unique(vertices, return_index=True)  # each by the first of its panels
    places = np.broadcast_to(local, (len(angles), *local.shape)).copy()
    apart = np.zeros(len(angles))
    for frame in range(len(angles)):
        moved = (rotation[frame, links] @ local[vertices, :, None])[..., 0] + shift[frame, links]
        places[frame, placed] = moved[first]
        apart[frame] = np.linalg.norm(moved - places[frame, vertices], axis=1).max(initial=0.0)
    return places * linkage.extent + linkage.middle, apart


def largest_panel(panels: Sequence[Sequence[Any]]) -> int:
    """Return the link with most faces: the fixed one of a sheet."""
    return max(range(len(panels)), key=lambda link: len(panels[link]))


def axis_motions(ends: Ints, corners: Floats) -> scipy.sparse.csr_matrix:
    """Return how axes through two vertices each (ends: int[J, 2]) rotate and translate: sparse float[6 J, 3 V]."""
    near, far = corners[ends[:, 0]], corners[ends[:, 1]]
    along = far - near
    turn = crossing(along / (along**2).sum(axis=1, keepdims=True))  # w = along x (far - near) / length^2
    shift = crossing((near + far) / 2.0) @ turn  # v = (near + far) / 2 - w x middle
    halves = np.broadcast_to(np.eye(3) / 2.0, turn.shape)
    blocks = [np.concatenate([-turn, halves - shift], axis=1), np.concatenate([turn, halves + shift], axis=1)]
    return _in_blocks(np.stack(blocks, axis=1), ends, len(corners))


def _in_blocks(blocks: Floats, columns: Ints, width: int) -> scipy.sparse.csr_matrix:
    """Return the sparse matrix of blocks float[n, k, a, b] in the columns int[n, k] of their rows."""
    count, each, rows, across = blocks.shape
    data = blocks.reshape(-1, rows, across)
    starts = np.arange(0, count * each + 1, each)
    shape = (rows * count, across * width)
    return scipy.sparse.bsr_matrix((data, columns.ravel(), starts), shape=shape).tocsr()


def dependence_on_vertices(sheet: Sheet, mechanism: SheetMechanism, linkage: Linkage) -> AxisDependence:
    """Return how the linkage of a sheet depends on the coordinates of its vertices, two or three of each."""
    if sheet.coordinates is None:
        raise UnsolvableError("derivatives by vertices need coordinates, and the sheet has none")
    corners = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    creases = creases_of(sheet, mechanism)
    numbers = len(sheet.coordinates[0])
    kept = (3 * np.arange(len(corners))[:, None] + np.arange(numbers)).ravel()
    twists = axis_motions(creases.ends, corners)[:, kept] / linkage.extent
    return AxisDependence(twists.tocsr(), (_fold_angles(creases, corners)[:, kept] / linkage.extent).tocsr())


def _fold_angles(creases: Creases, corners: Floats) -> scipy.sparse.csr_matrix:
    """Return the derivatives of the fold angles that a sheet has: sparse float[J, 3 V].

    The angle is atan2((m x n) . a, m . n), m and n the normals beside the crease and a its axis. Panels are
    planar, so m x n is along a, and how a turns does not count.
    """
    vectors = creases.area_vectors(corners)
    sizes = np.linalg.norm(vectors, axis=1)
    sizes = np.where(sizes == 0.0, 1.0, sizes)
    normals = vectors / sizes[:, None]
    of = np.repeat(np.arange(len(creases.faces)), [len(face) for face in creases.faces])
    around = np.array([v for face in creases.faces for v in face], dtype=np.int64)
    spans = [corners[np.roll(face, -1)] - corners[np.roll(face, 1)] for face in map(np.array, creases.faces)]
    across = np.eye(3) - normals[:, :, None] * normals[:, None, :]
    blocks = -(across / sizes[:, None, None])[of] @ crossing(np.concatenate([np.zeros((0, 3)), *spans]))
    starts = np.concatenate([[0], np.cumsum([len(face) for face in creases.faces])])
    shape = (3 * len(creases.faces), 3 * len(corners))
    by_normals = scipy.sparse.bsr_matrix((blocks, around, starts), shape=shape).tocsr()

    axes = creases.directions(corners)
    m, n = normals[creases.sides[:, 0]], normals[creases.sides[:, 1]]
    sine = (np.cross(m, n) * axes).sum(axis=1, keepdims=True)
    cosine = (m * n).sum(axis=1, keepdims=True)
    first = cosine * np.cross(n, axes) - sine * n
    second = cosine * np.cross(axes, m) - sine * m
    beside = _in_blocks(np.stack([first, second], axis=1)[:, :, None, :], creases.sides, len(creases.faces))
    return (beside @ by_normals).tocsr()


@dataclass(frozen=True, slots=True)
class SheetChange:
    """How a folded sheet follows a change of its vertices: a `ConfigurationChange`, and places float[V, 3]."""

    angles: Floats
    places: Floats
    residual: Floats
    rank_residual: float


class SheetDerivatives:
    """The derivatives of a sheet by the coordinates of its vertices, at any of its configurations.

    The sheet is held by its largest panel, as `vertex_places` holds it: there places are those of the coordinates.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, flat or folded.
    mechanism : SheetMechanism
        Of the sheet.
    linkage : Linkage
        Of both.

    Attributes
    ----------
    dependence : AxisDependence
        How the axes of creases and the fold angles of the file depend on the coordinates.
    closure : ClosureEquations
        With six equations for loops of parallel creases, which a change may turn.
    tree : BodyTree
        Of the panels, from the largest.

    Examples
    --------
    A flat Miura sheet folded by one crease, in the family of Miura sheets of other sectors, which fold too:

    >>> from graphs.convert.duality import mechanism_of_sheet
    >>> from synth.analysis.folding.motion import fold
    >>> from synth.analysis.motion.derivatives import derivatives_by_parameters
    >>> from synth.analysis.motion.linkage import linkage_of_sheet
    >>> from synth.catalogue.patterns.creases import miura
    >>> sheet = miura(3, 3, 1.0)
    >>> mechanism = mechanism_of_sheet(sheet)
    >>> shape = SheetDerivatives(sheet, mechanism, linkage_of_sheet(sheet, mechanism))
    >>> at = shape.at(fold(sheet, frames=4).path.angles[-1], [0])
    >>> sectors = derivatives_by_parameters(lambda p: np.array(miura(3, 3, p[0]).coordinates), np.array([1.0]))
    >>> change = at.forward(sectors.matrix[:, 0].reshape(16, 2))
    >>> bool(np.abs(change.residual).max() < 1e-12), bool(change.rank_residual < 1e-6)
    (True, True)
    """

    def __init__(self, sheet: Sheet, mechanism: SheetMechanism, linkage: Linkage) -> None:
        self.dependence = dependence_on_vertices(sheet, mechanism, linkage)
        self.linkage = linkage
        parallel = any(loop.centre is Centre.INFINITE for loop in linkage.loops)
        self.closure = ClosureEquations(spatial(linkage) if parallel else linkage)
        assert sheet.coordinates is not None
        self.numbers = len(sheet.coordinates[0])
        self.local: Floats = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
        self.tree = BodyTree(linkage, largest_panel(mechanism.panels))
        self.link_of = np.full(sheet.vertices, -1, dtype=np.int64)
        for link in reversed(range(len(mechanism.panels))):  # the first panel of a vertex puts it in its place
            around = [vertex for face in mechanism.panels[link] for vertex in sheet.faces[face]]
            self.link_of[around] = self.tree.row[link]
        self.placed: Ints = np.flatnonzero(self.link_of >= 0)

    def at(self, angles: Floats, driven: Sequence[int] = ()) -> SheetSensitivity:
        """Return the derivatives at a closed configuration float[J], driven creases (places of joints) held."""
        return SheetSensitivity(self, Sensitivity(self.closure, angles, driven))


class SheetSensitivity:
    """The derivatives of a sheet by the coordinates of its vertices at one configuration."""

    def __init__(self, shape: SheetDerivatives, sensitivity: Sensitivity) -> None:
        self.shape = shape
        self.sensitivity = sensitivity
        self.poses: BodyPoses = shape.tree.at(sensitivity.angles)

    @property
    def degenerate(self) -> bool:
        """Whether the configuration is singular and has no derivative: as of `Sensitivity`."""
        return self.sensitivity.degenerate

    def forward(self, change: Floats) -> SheetChange:
        """Return how the folded sheet follows a change of its coordinates, float[V, 2 or 3]."""
        shape = self.shape
        axes = shape.dependence.forward(np.ravel(change))
        follows = self.sensitivity.forward(axes)
        twists = self.poses.forward(follows.angles, axes)
        places = np.zeros((len(shape.local), 3))
        places[:, : shape.numbers] = change
        vertices, links = shape.placed, shape.link_of[shape.placed]
        local = shape.local[vertices]
        own = places[vertices] / shape.linkage.extent
        places[vertices] = self.poses.places_forward(links, local, twists, own) * shape.linkage.extent
        rank_residual = self.sensitivity.rank_residual(axes, follows)
        return SheetChange(follows.angles, places, follows.residual, rank_residual)

    def adjoint(self, by_angles: Floats | None = None, by_places: Floats | None = None) -> Floats:
        """Return the gradient by coordinates from those by fold angles float[J] and places float[V, 3]."""
        shape = self.shape
        angles = np.zeros(len(shape.linkage.angles)) if by_angles is None else by_angles
        if by_places is None:
            return shape.dependence.adjoint(self.sensitivity.adjoint(angles)).reshape(-1, shape.numbers)
        vertices, links = shape.placed, shape.link_of[shape.placed]
        by_links = by_places[vertices] * shape.linkage.extent
        wrenches, own = self.poses.places_adjoint(links, shape.local[vertices], by_links)
        turned, direct = self.poses.adjoint(wrenches)
        axes = self.sensitivity.adjoint(angles + turned) + direct
        gradient = shape.dependence.adjoint(axes).reshape(-1, shape.numbers)
        unplaced = by_places.copy()  # vertices that no panel places stay where they are
        unplaced[vertices] = 0.0
        gradient += unplaced[:, : shape.numbers]
        gradient[vertices] += own[:, : shape.numbers] / shape.linkage.extent
        return gradient
