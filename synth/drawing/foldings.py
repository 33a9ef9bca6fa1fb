"""Foldings and motions as files: FOLD with a frame for each pose, OBJ files, a strip of pictures, a moving one."""

from __future__ import annotations

from pathlib import Path

from graphs.convert.table import Mechanism
from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import check_place, write_text
from graphs.files.patterns.fold_poses import fold_text_of_poses
from graphs.files.patterns.obj import obj_text
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.solids import HingedSolids
from synth.drawing.scene.raster import check_matplotlib
from synth.drawing.scene.writing import save_scene
from synth.drawing.space.bodies import bodies_of, places_of_hinges
from synth.drawing.space.poses import save_moving_poses, strip_of_poses
from synth.folding.motion import Folding
from synth.moving.motion import Motion

__all__ = ["check_motion_output", "check_output", "write_folding", "write_motion"]

_STRIPS = (".png", ".svg")
_PIXELS = (".gif", ".png")


def check_output(path: str | Path, *, force: bool = False) -> None:
    """Refuse a name that a folding cannot be written to.

    Raises
    ------
    FileError
        If the extension is not known, or something is there already.
    UnsolvableError
        If it is of pixels (.gif, .png), and matplotlib is not installed.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in (".fold", ".obj", ".gif", *_STRIPS):
        known = ".fold, .obj for a series, .gif, or .png or .svg for a strip"
        raise FileError(path, "", f"files ending in {suffix!r} cannot hold a folding", known)
    if suffix in _PIXELS:
        check_matplotlib()
    check_place(_of_series(path, 0) if suffix == ".obj" else path, force=force)


def write_folding(folding: Folding, path: str | Path, *, force: bool = False) -> list[Path]:
    """Write a folding.

    Parameters
    ----------
    folding : Folding
    path : str or Path
        ``.fold``: one file, its frames the poses. ``.obj``: a file for each pose, numbered from 000. ``.gif``: a
        moving picture. ``.png``, ``.svg``: a strip of at most twelve poses.
    force : bool, optional
        Replace files that are there.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    FileError
        If the extension is not known, or a file cannot be written or is there already.
    UnsolvableError
        If it is of pixels (.gif, .png), and matplotlib is not installed.

    Examples
    --------
    A vertex of four creases, its poses as frames of one file:

    >>> from tempfile import TemporaryDirectory
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.motion import fold
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> folding = fold(Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners), frames=3)
    >>> with TemporaryDirectory() as folder:
    ...     [path] = write_folding(folding, Path(folder, "vertex.fold"))
    ...     print(path.name, path.read_text().count("foldedForm"))
    vertex.fold 4
    """
    path = Path(path)
    check_output(path, force=force)
    if path.suffix.lower() == ".gif":
        save_moving_poses(folding.sheet, folding.places, path, force=force)
        return [path]
    if path.suffix.lower() in _STRIPS:
        save_scene(strip_of_poses(folding.sheet, folding.places), path, force=force)
        return [path]
    poses = folding.frames()
    if path.suffix.lower() == ".fold":
        write_text(path, fold_text_of_poses(folding.sheet, poses), force=force)
        return [path]
    places = [_of_series(path, number) for number in range(len(poses))]
    for place in places:
        check_place(place, force=force)
    for place, pose in zip(places, poses, strict=True):
        write_text(place, obj_text(pose), force=force)
    return places


def check_motion_output(thing: Mechanism, path: str | Path) -> None:
    """Refuse to write the motion of what has no panels, but pictures of solids.

    Raises
    ------
    UnsolvableError
        If the thing is no solids hinged at edges, or the file is to have panels.
    """
    if not isinstance(thing, HingedSolids | JointedLinkage) or Path(path).suffix.lower() not in (*_STRIPS, ".gif"):
        can = "solids are drawn as .png, .svg, .gif; " if isinstance(thing, HingedSolids | JointedLinkage) else ""
        raise UnsolvableError(f"there are no panels to write: {can}--json gives the joint angles of each frame")


def write_motion(motion: Motion, path: str | Path, *, force: bool = False) -> list[Path]:
    """Draw the motion of solids hinged at edges.

    Parameters
    ----------
    motion : Motion
        Of `synth.moving.motion.move`.
    path : str or Path
        ``.gif``: a moving picture. ``.png``, ``.svg``: a strip of at most twelve poses.
    force : bool, optional
        Replace files that are there.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    FileError
        If the file cannot be written or is there already.
    UnsolvableError
        If it is of pixels (.gif, .png), and matplotlib is not installed.
    """
    path = Path(path)
    panels, _ = bodies_of(motion.linkage)
    places = places_of_hinges(motion.linkage, motion.path.angles)
    if path.suffix.lower() == ".gif":
        save_moving_poses(panels, places, path, force=force)
    else:
        save_scene(strip_of_poses(panels, places), path, force=force)
    return [path]


def _of_series(path: Path, number: int) -> Path:
    return path.with_name(f"{path.stem}-{number:03d}{path.suffix}")
