"""Panels as thin solids with open hinges, written to STL, 3MF, OBJ, and glTF with the motion."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.files.outputs import Lost, check_writable, write_as
from graphs.files.solids.gltf import gltf_text
from graphs.files.solids.meshes import SolidMesh, obj_of_meshes, stl_bytes, three_mf_bytes
from graphs.geometry import rigid_motion
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import FLAT, Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Surface
from graphs.types import Floats
from synth.analysis.moving.motion import FileConfigurations, configurations_of_file
from synth.exporters import EXPORTERS
from synth.linkages.conformed.linkage_behaviour import OnSurface
from synth.making.templates.on_surface import LayeredLinkage, TemplateSizes, solids_on_surface
from synth.making.templates.pieces import GRID, united
from synth.making.templates.template import FITTED, GREATEST, LEAST, millimetres, scale_of, unit_of
from synth.making.templates.unfolding import Panels, Plane

_RIGID = 1e-4
"""Largest change of the shape of a moving panel, as part of its extent."""
_STRAIGHT = 1e-6
"""Corners this close to a straight line, in millimetres, are left out."""


class SheetPlates:
    """The panels of a sheet with all edges listed as plates of a thickness, with a gap at each hinge.

    Each is in the frame of its plane at the places, float[vertices, 3], from which they are made; all in
    millimetres. `faces` gives the panel of each mesh: a panel whose middle is cut off by its hinges has several.
    Raise InvariantError if the thickness is not positive, the gap negative, or one of them larger than 1e6 mm;
    UnsolvableError if a panel is not planar, or narrower than the gap.
    """

    def __init__(self, sheet: Sheet, places: Floats, *, thickness: float, gap: float) -> None:
        if not 0 < thickness <= GREATEST:
            expected = f"a positive number, at most {GREATEST:g}"
            raise InvariantError("thickness", f"thickness {thickness!r}", expected)
        if not 0 <= gap <= GREATEST:
            raise InvariantError("gap", f"gap {gap!r}", f"a number from 0 to {GREATEST:g}")
        panels = Panels(sheet, places)
        self.planes, self.meshes, self.faces = panels.planes, list[SolidMesh](), list[int]()
        for face in range(len(sheet.faces)):
            for number, polygon in enumerate(_without_hinges(panels, face, gap / 2)):
                name = f"panel {face}" + (f" part {number}" if number else "")
                self.meshes.append(pierced_plate(polygon, thickness, name))
                self.faces.append(face)

    def motions(self, sheet: Sheet, frames: Floats) -> tuple[Floats, Floats]:
        """Return rotations, float[frames, meshes, 3, 3], and translations, float[frames, meshes, 3], of plates.

        Frames are float[frames, vertices, 3], millimetres. Raise UnsolvableError if a panel has another shape in a
        frame.
        """
        turns = np.empty((len(frames), len(self.faces), 3, 3))
        shifts = np.empty((len(frames), len(self.faces), 3))
        for frame, places in enumerate(frames):
            for mesh, face in enumerate(self.faces):
                corners = places[list(sheet.faces[face])]
                turns[frame, mesh], shifts[frame, mesh] = _frame(corners, self.planes[face], f"{face} in pose {frame}")
        return turns, shifts


def plates_in_space(plates: SheetPlates) -> list[SolidMesh]:
    """Return plates where their panels stand."""
    placed = zip(plates.meshes, plates.faces, strict=True)
    return [
        SolidMesh(mesh.name, mesh.corners @ plates.planes[face].axes.T + plates.planes[face].origin, mesh.triangles)
        for mesh, face in placed
    ]


def _without_hinges(panels: Panels, face: int, width: float) -> list[Any]:
    """Return a panel without the strips along its sides where another hangs that moves, or is cut off."""
    corners = panels.planes[face].flat
    rest = shapely.Polygon(corners)
    whole = rest.area
    strips = [
        shapely.LineString(corners[list(panels.ends(face, edge))]).buffer(width, cap_style="square")
        for edge, faces in (*panels.joins.items(), *panels.slits.items())
        if face in faces and panels.sheet.assignments[edge] not in FLAT
    ]
    if width and strips:
        rest = shapely.difference(rest, united(strips), grid_size=GRID).simplify(_STRAIGHT)
    parts = [part for part in getattr(rest, "geoms", [rest]) if part.area > _STRAIGHT * whole]
    if not parts:
        raise UnsolvableError(
            f"panel {face} is narrower than the gap of {2 * width:g} mm at its hinges; try a smaller --gap"
        )
    return parts


def plate_of(corners: Floats, thickness: float, name: str) -> SolidMesh:
    """Return a plate about the plane of a polygon with corners float[n, 2]."""
    return pierced_plate(shapely.Polygon(corners), thickness, name)


def pierced_plate(polygon: Any, thickness: float, name: str) -> SolidMesh:
    """Return a plate about the plane of a polygon, which may have holes."""
    around = shapely.orient_polygons(polygon)
    rings = [np.array(ring.coords)[:-1] for ring in (around.exterior, *around.interiors)]  # these go the other way
    corners = np.concatenate(rings)
    index = {tuple(corner): number for number, corner in enumerate(corners.tolist())}
    count = len(corners)
    top = [
        [index[tuple(corner)] for corner in shapely.orient_polygons(triangle).exterior.coords[:-1]]
        for triangle in shapely.constrained_delaunay_triangles(polygon).geoms
    ]
    triangles = [[corner + count for corner in triangle] for triangle in top]
    triangles += [triangle[::-1] for triangle in top]
    first = 0
    for ring in rings:
        for place in range(len(ring)):
            here, after = first + place, first + (place + 1) % len(ring)
            triangles += [[here, after, after + count], [here, after + count, here + count]]
        first += len(ring)
    heights = np.repeat([-thickness / 2, thickness / 2], count)
    return SolidMesh(name, np.column_stack([np.tile(corners, (2, 1)), heights]), np.array(triangles))


def _frame(corners: Floats, plane: Plane, where: str) -> tuple[Floats, Floats]:
    """Return how the frame of a panel stands where its corners are now: its rotation, and its origin."""
    was = np.column_stack([plane.flat, np.zeros(len(plane.flat))])
    turn, shift = rigid_motion(was, corners)
    apart = float(np.abs(was @ turn.T + shift - corners).max())
    if apart > _RIGID * float(np.abs(plane.flat).max()):
        raise UnsolvableError(f"panel {where} has another shape, by {apart:.3g} mm")
    return turn, shift


class Solids(NamedTuple):
    """Closed meshes to write. The title and the motion are for glTF.

    A motion is (float[frames, meshes, 3, 3], float[frames, meshes, 3]), how meshes rotate and translate.
    """

    meshes: Sequence[SolidMesh]
    title: str = ""
    motion: tuple[Floats, Floats] | None = None
    frames_left_out: int = 0


def gltf_of_solids(solids: Solids) -> bytes:
    """Return solids as glTF, with their motion."""
    count = len(solids.meshes)
    motion = solids.motion or (np.tile(np.eye(3), (1, count, 1, 1)), np.zeros((1, count, 3)))
    return gltf_text(solids.meshes, *motion, title=solids.title).encode()


def lost_as_solids(solids: Solids) -> Lost:
    """Return what files of solids do not hold."""
    frames = solids.frames_left_out
    return ("hinges, but for the gaps", *((numbered(frames, "other frame"),) if frames else ()))


def stl_of_solids(solids: Solids) -> bytes:
    """Return solids as STL."""
    return stl_bytes(solids.meshes)


def three_mf_of_solids(solids: Solids) -> bytes:
    """Return solids as 3MF."""
    return three_mf_bytes(solids.meshes)


def obj_of_solids(solids: Solids) -> bytes:
    """Return solids as OBJ."""
    return obj_of_meshes(solids.meshes).encode()


THICKNESS = 1.0
"""Default thickness of panels, millimetres."""


def frames_of(sheet: Sheet) -> tuple[Sheet, Floats, FileConfigurations]:
    """Return a sheet with all edges listed, its frames, and what of its file they are.

    Frames are float[frames, vertices, 3] in the unit of the file, in the order of its motion. Raise
    UnsolvableError if the sheet has no coordinates or no panels.
    """
    first = sheet if sheet.frames is None else sheet.frames.first_placed()
    if first.coordinates is None or not first.faces:
        raise UnsolvableError("solids require panels with coordinates, and the sheet has none")
    of_file = configurations_of_file(sheet)
    frames = [in_space(frame.coordinates or ()) for frame in of_file.sheets]
    return with_all_edges(first), np.array(frames), of_file


def write_solids(
    sheet: Sheet,
    path: str | Path,
    *,
    thickness: float = THICKNESS,
    gap: float | None = None,
    scale: float | None = None,
    size: float | None = None,
    force: bool = False,
) -> tuple[str, ...]:
    """Write the panels of a sheet as solids; equal sheets give equal files.

    Parameters
    ----------
    sheet : Sheet
    path : str or Path
        ``.stl``, ``.3mf``, ``.obj``: the sheet as it is; ``.gltf``: with the frames of its file as a motion.
    thickness : float, optional
        Of panels, millimetres.
    gap : float, optional
        Between two panels at a hinge, millimetres; by default twice the thickness.
    scale, size : float, optional
        As for `synth.making.templates.template_of`; without them, `fitted_size`.
    force : bool, optional
        Overwrite an existing file.

    Returns
    -------
    tuple of str
        Parts that the file cannot hold.

    Raises
    ------
    FileError
        If the extension is unknown, or the file cannot be written or exists.
    InvariantError
        If a number is out of range.
    UnsolvableError
        If there are no panels with coordinates, one is not planar, or narrower than the gap, or changes its shape.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> with TemporaryDirectory() as folder:
    ...     write_solids(square, Path(folder, "square.stl"), size=50)
    ('hinges, but for the gaps',)
    """
    check_writable(path, EXPORTERS["solids"], force=force)
    whole, frames, of_file = frames_of(sheet)
    if scale is None and size is None:
        size = fitted_size(sheet)
    frames = frames * millimetres(frames[of_file.resting], scale_of(sheet, scale, size), size)
    plates = SheetPlates(whole, frames[of_file.resting], thickness=thickness, gap=2 * thickness if gap is None else gap)
    if Path(path).suffix.lower() == ".gltf":
        solids = Solids(plates.meshes, whole.title, plates.motions(whole, frames), of_file.left_out)
    else:
        solids = Solids(plates_in_space(plates), frames_left_out=of_file.left_out + len(frames) - 1)
    return write_as(solids, path, EXPORTERS["solids"], force=force)


def fitted_size(sheet: Sheet) -> float | None:
    """Return the longer side, in millimetres, of solids whose size nothing states; None where the unit states it.

    That is so where the file names no unit, and its panels would be too small to make if it were a millimetre.
    """
    if unit_of(sheet) is not None:
        return None
    _, frames, of_file = frames_of(sheet)
    return FITTED if 0 < float(np.ptp(frames[of_file.resting], axis=0).max()) < LEAST else None


def write_shapes(solids: HingedSolids, path: str | Path, *, force: bool = False) -> tuple[str, ...]:
    """Write the shapes of the links of hinged solids, millimetres, as they stand; return what the file does not hold.

    Parameters
    ----------
    solids : HingedSolids
        With shapes.
    path : str or Path
        The extension, .stl, .3mf, .gltf or .obj, determines the format.
    force : bool, optional
        Overwrite an existing file.

    Raises
    ------
    FileError
        If the extension is unknown, or the file cannot be written or exists.
    UnsolvableError
        If there are no shapes.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import synth
    >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
    >>> with TemporaryDirectory() as folder:
    ...     write_shapes(thick.solids, Path(folder, "thick.stl"))
    ('hinges, but for the gaps',)
    """
    if not solids.shapes:
        raise UnsolvableError("solids require panels or shapes of links, and these hinged solids have axes only")
    meshes = [SolidMesh(shape.name, np.array(shape.corners), np.array(shape.triangles)) for shape in solids.shapes]
    return write_as(Solids(meshes, "hinged solids"), path, EXPORTERS["solids"], force=force)


def write_linkage_on_surface(
    linkage: OnSurface,
    surface: Surface,
    path: str | Path,
    *,
    dimensions: TemplateSizes,
    gap: float,
    force: bool = False,
) -> tuple[str, ...]:
    """Write a linkage on a cone or a cylinder as solids in layers; return what the file does not hold.

    The surface is among the solids. `gap` is that at hinges, millimetres at the inner edge of links; `force`
    overwrites a file. Raise FileError if the extension is unknown, or the file cannot be written or exists;
    UnsolvableError if two joints are on one ruling line, or a link has one joint only, or is narrower than the
    gap.
    """
    check_writable(path, EXPORTERS["solids"], force=force)
    meshes = solids_on_surface(LayeredLinkage(linkage, surface, dimensions), gap)
    return write_as(Solids(meshes), path, EXPORTERS["solids"], force=force)
