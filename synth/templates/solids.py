"""Panels as solids written to files, whole or not at all: STL, 3MF, OBJ, and glTF with the motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from graphs.arrays import Floats
from graphs.errors import FileError, UnsolvableError, numbered
from graphs.files.atomic import Beside, check_place
from graphs.files.solids.gltf import gltf_text
from graphs.files.solids.mesh import Mesh
from graphs.files.solids.obj import obj_of_meshes
from graphs.files.solids.stl import stl_bytes
from graphs.files.solids.three_mf import three_mf_bytes
from graphs.mechanism.plane import in_space
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.templates.scale import millimetres
from synth.templates.thick import plates_in_space, plates_of

__all__ = ["SOLIDS", "THICKNESS", "poses_of", "write_solids"]

SOLIDS = (".stl", ".3mf", ".gltf", ".obj")
"""Extensions of files of solids."""
_WRITERS: dict[str, Callable[[Sequence[Mesh]], bytes]] = {
    ".stl": stl_bytes,
    ".3mf": three_mf_bytes,
    ".obj": lambda meshes: obj_of_meshes(meshes).encode(),
}
THICKNESS = 1.0
"""Of panels, millimetres, where none is given."""


def poses_of(sheet: Sheet) -> tuple[Sheet, Floats, int]:
    """Return a sheet with coordinates, its poses, and how many frames of its file are left out.

    Poses are the frames with the same panels; what has other panels, or no coordinates, is another sheet.

    Returns
    -------
    sheet : Sheet
        With all edges listed.
    poses : float[poses, vertices, 3]
        In the unit of the file; the first is the sheet's own.
    left_out : int

    Raises
    ------
    UnsolvableError
        If it has no coordinates or no panels.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> poses_of(square)[1].shape
    (1, 4, 3)
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
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in SOLIDS:
        raise FileError(place, "", "the extension is not known", ", ".join(SOLIDS))
    check_place(place, force=force)
    whole, poses, left_out = poses_of(sheet)
    poses = poses * millimetres(poses[0], scale, size)
    plates = plates_of(whole, poses[0], thickness=thickness, gap=2 * thickness if gap is None else gap)
    if suffix == ".gltf":
        data = gltf_text(plates.meshes, *plates.motions(whole, poses), title=whole.title).encode()
    else:
        left_out += len(poses) - 1
        meshes = plates_in_space(plates)
        data = _WRITERS[suffix](meshes)
    beside = Beside(place, force=force)
    try:
        beside.write(data)
        beside.commit()
    finally:
        beside.discard()
    return ("hinges, but for the gaps", *((numbered(left_out, "other frame"),) if left_out else ()))
