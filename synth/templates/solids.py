"""Panels as solids written to files, whole or not at all: STL, 3MF, OBJ, and glTF with the motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from graphs.errors import FileError, UnsolvableError, numbered
from graphs.files.atomic import Beside, check_place
from graphs.files.solids.gltf import gltf_text
from graphs.files.solids.mesh import Mesh
from graphs.files.solids.obj import obj_of_meshes
from graphs.files.solids.stl import stl_bytes
from graphs.files.solids.three_mf import three_mf_bytes
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.mechanism.surfaces import Surface
from graphs.types import Floats
from synth.conformed.linkages import OnSurface
from synth.templates.developed.layered import Dimensions, layered
from synth.templates.developed.solids import solids_on_surface
from synth.templates.scale import millimetres, scale_of
from synth.templates.thick import plates_in_space, plates_of

__all__ = ["SOLIDS", "THICKNESS", "poses_of", "write_linkage_on_surface", "write_meshes", "write_solids"]

SOLIDS = (".stl", ".3mf", ".gltf", ".obj")
"""Extensions of files of solids."""
_WRITERS: dict[str, Callable[[Sequence[Mesh]], bytes]] = {
    ".stl": stl_bytes,
    ".3mf": three_mf_bytes,
    ".obj": lambda meshes: obj_of_meshes(meshes).encode(),
}
_HINGES = "hinges, but for the gaps"
THICKNESS = 1.0
"""Of panels, millimetres, where none is given."""


def poses_of(sheet: Sheet) -> tuple[Sheet, Floats, int]:
    """Return a sheet with all edges listed, its poses, and the number of frames of its file that are left out.

    Poses are float[poses, vertices, 3] in the unit of the file, the sheet's own first: the frames with the same
    panels. A frame with other panels, or no coordinates, is another sheet. Raise UnsolvableError if the sheet has
    no coordinates or no panels.
    """
    first = sheet if sheet.frames is None else sheet.frames.first_placed()
    if first.coordinates is None or not first.faces:
        raise UnsolvableError("solids need panels with coordinates, and the sheet has none")
    frames = [] if sheet.frames is None else [sheet.frames.frame(one) for one in range(1, sheet.frames.others + 1)]
    same = [one for one in frames if one.coordinates is not None and one.faces == first.faces]
    poses = [in_space(one.coordinates or ()) for one in (first, *same) if one.vertices == first.vertices]
    return with_all_edges(first), np.array(poses), 1 + len(frames) - len(poses)


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
        ``.stl``, ``.3mf``, ``.obj``: the pose of the sheet; ``.gltf``: with the frames of its file as a motion.
    thickness : float, optional
        Of panels, millimetres.
    gap : float, optional
        Between two panels at a hinge, millimetres; twice the thickness without it.
    scale, size : float, optional
        As of `synth.templates.template_of`.
    force : bool, optional
        Replace a file that is there.

    Returns
    -------
    tuple of str
        What the file does not hold.

    Raises
    ------
    FileError
        If the extension is not known, or the file cannot be written or is there already.
    InvariantError
        If a number is not one that can be.
    UnsolvableError
        If there are no panels with coordinates, one is not plane, or narrower than the gap, or changes its shape.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> with TemporaryDirectory() as folder:
    ...     write_solids(square, Path(folder, "square.stl"), size=50)
    ('hinges, but for the gaps',)
    """
    suffix = _checked(Path(path), force=force)
    whole, poses, left_out = poses_of(sheet)
    poses = poses * millimetres(poses[0], scale_of(sheet, scale, size), size)
    plates = plates_of(whole, poses[0], thickness=thickness, gap=2 * thickness if gap is None else gap)
    if suffix == ".gltf":
        meshes: Sequence[Mesh] = plates.meshes
        motion = plates.motions(whole, poses)
    else:
        left_out += len(poses) - 1
        meshes, motion = plates_in_space(plates), None
    write_meshes(meshes, path, title=whole.title, motion=motion, force=force)
    return (_HINGES, *((numbered(left_out, "other frame"),) if left_out else ()))


def write_meshes(
    meshes: Sequence[Mesh],
    path: str | Path,
    *,
    title: str = "",
    motion: tuple[Floats, Floats] | None = None,
    force: bool = False,
) -> None:
    """Write closed meshes as ``.stl``, ``.3mf``, ``.obj`` or ``.gltf``; equal meshes give equal files.

    The title and the motion are for glTF; a motion is (float[poses, meshes, 3, 3], float[poses, meshes, 3]), how
    meshes rotate and translate. `force` overwrites a file. Raise FileError if the extension is unknown, or the
    file cannot be written or exists.

    >>> write_meshes([], "a.doc")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.doc: the extension is not known; expected .stl, .3mf, .gltf, .obj
    """
    suffix = _checked(Path(path), force=force)
    if suffix == ".gltf":
        still = np.tile(np.eye(3), (1, len(meshes), 1, 1)), np.zeros((1, len(meshes), 3))
        data = gltf_text(meshes, *(still if motion is None else motion), title=title).encode()
    else:
        data = _WRITERS[suffix](meshes)
    beside = Beside(Path(path), force=force)
    try:
        beside.write(data)
        beside.commit()
    finally:
        beside.discard()


def write_linkage_on_surface(
    linkage: OnSurface,
    surface: Surface,
    path: str | Path,
    *,
    dimensions: Dimensions,
    gap: float,
    force: bool = False,
) -> tuple[str, ...]:
    """Write a linkage on a cone or a cylinder as solids in layers; return what the file does not hold.

    The surface is among the solids. `gap` is that at hinges, millimetres at the inner edge of links; `force`
    overwrites a file. Raise FileError if the extension is unknown, or the file cannot be written or exists;
    UnsolvableError if two joints are on one ruling line, or a link has one joint only, or is narrower than the
    gap.
    """
    _checked(Path(path), force=force)
    write_meshes(solids_on_surface(layered(linkage, surface, dimensions), gap), path, force=force)
    return (_HINGES,)


def _checked(place: Path, *, force: bool) -> str:
    """Return the extension of a place that can be written to."""
    suffix = place.suffix.lower()
    if suffix not in SOLIDS:
        raise FileError(place, "", "the extension is not known", ", ".join(SOLIDS))
    check_place(place, force=force)
    return suffix
