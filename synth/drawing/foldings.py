"""Foldings and motions as files: FOLD with a frame for each pose, OBJ files, a strip of pictures, a moving one."""

from __future__ import annotations

from pathlib import Path

from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import check_place, write_text
from graphs.files.patterns.fold_poses import fold_text_of_poses
from graphs.files.patterns.obj import obj_text
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.drawing.scene.raster import check_matplotlib
from synth.drawing.scene.writing import save_scene
from synth.drawing.space.bodies import bodies_of, places_of_hinges
from synth.drawing.space.panels import Panels
from synth.drawing.space.poses import save_moving_poses, strip_of_poses
from synth.folding.configuration import SheetConfiguration
from synth.motion.motion import Motion

__all__ = ["check_output", "write_motion"]

_STRIPS = (".png", ".svg")
_PIXELS = (".gif", ".png")


def check_output(path: str | Path, *, force: bool = False) -> None:
    """Refuse a path that a folding cannot be written to.

    Raise FileError if the extension is unknown or the file exists, UnsolvableError for a raster image (.gif, .png)
    if matplotlib is not installed.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in (".fold", ".obj", ".gif", *_STRIPS):
        known = ".fold, .obj for a series, .gif, or .png or .svg for a strip"
        raise FileError(path, "", f"files ending in {suffix!r} cannot hold a folding", known)
    if suffix in _PIXELS:
        check_matplotlib()
    check_place(_of_series(path, 0) if suffix == ".obj" else path, force=force)


def write_motion(motion: Motion, path: str | Path, *, force: bool = False) -> list[Path]:
    """Write a motion.

    Parameters
    ----------
    motion : Motion
        Of a sheet, or of solids hinged at edges, which are drawn only.
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
        If it is of pixels (.gif, .png), and matplotlib is not installed; if there are no panels to write.

    Examples
    --------
    A vertex of four creases, its poses as frames of one file:

    >>> from tempfile import TemporaryDirectory
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.motion import fold
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> motion = fold(Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners), frames=3)
    >>> with TemporaryDirectory() as folder:
    ...     [path] = write_motion(motion, Path(folder, "vertex.fold"))
    ...     print(path.name, path.read_text().count("foldedForm"))
    vertex.fold 4
    """
    path = Path(path)
    check_output(path, force=force)
    at = motion.configuration
    if not isinstance(at, SheetConfiguration):
        _check_panels(motion, path)
        _draw(
            bodies_of(motion.linkage)[0], places_of_hinges(motion.linkage, motion.path.angles), path, force=force
        )
        return [path]
    if path.suffix.lower() in (*_STRIPS, ".gif"):
        _draw(at.sheet, motion.places, path, force=force)
        return [path]
    poses = motion.frames()
    if path.suffix.lower() == ".fold":
        write_text(path, fold_text_of_poses(at.sheet, poses), force=force)
        return [path]
    series = [_of_series(path, number) for number in range(len(poses))]
    for place in series:
        check_place(place, force=force)
    for place, pose in zip(series, poses, strict=True):
        write_text(place, obj_text(pose), force=force)
    return series


def _draw(panels: Sheet | Panels, places: Floats, path: Path, *, force: bool) -> None:
    """Write a moving picture, or a strip of poses."""
    if path.suffix.lower() == ".gif":
        save_moving_poses(panels, places, path, force=force)
    else:
        save_scene(strip_of_poses(panels, places), path, force=force)


def _check_panels(motion: Motion, path: Path) -> None:
    """Refuse to write what has no panels, but pictures of solids."""
    given = motion.configuration.given
    drawn = isinstance(given, HingedSolids | JointedLinkage)
    if not drawn or path.suffix.lower() not in (*_STRIPS, ".gif"):
        can = "solids are drawn as .png, .svg, .gif; " if drawn else ""
        raise UnsolvableError(f"there are no panels to write: {can}--json gives the joint angles of each frame")


def _of_series(path: Path, number: int) -> Path:
    return path.with_name(f"{path.stem}-{number:03d}{path.suffix}")
