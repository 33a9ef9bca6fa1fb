"""Motions as files: FOLD with a frame for each pose, OBJ files, a strip of pictures, a GIF that moves.

All poses are drawn from one place and at one scale.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import BytesIO
from math import ceil
from pathlib import Path

import numpy as np
import numpy.typing as npt

from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import check_place, write_text
from graphs.files.patterns.fold import fold_text_of_poses
from graphs.files.patterns.obj import obj_text
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.drawing.scene.frame import Frame, framed, page_of
from synth.drawing.scene.shapes import SMALL, Label, Layer, Scene, moved
from synth.drawing.scene.writing import check_matplotlib, pixels, save_scene, whole_file
from synth.drawing.space.panels import (
    SpatialPanels,
    bodies_of,
    front_up,
    panel_shapes,
    panels_of,
    places_of_hinges,
    view_of_motion,
)
from synth.folding.configuration import SheetConfiguration
from synth.motion.motion import Motion

__all__ = ["check_output", "pose_scenes", "save_moving_poses", "strip_of_poses", "write_motion"]

_IN_STRIP, _IN_ROW = 12, 4
"""Poses of a strip, and in one row of it, at most."""
_SIZE, _MOVING = 120.0, 288.0
"""Sides of the square of a pose in a strip, and of a moving picture, points."""
_DOTS = 100
_MILLISECONDS, _PAUSE = 80, 1000
_COLOURS = 128
_STRIPS = (".png", ".svg")
_PIXELS = (".gif", ".png")


def pose_scenes(
    thing: Sheet | SpatialPanels, places: Floats, side: float = _MOVING, air: float = 8.0
) -> Iterator[Scene]:
    """Yield a square picture of each pose, all from one place and at one scale.

    `places`, float[F, vertices, 3], are the vertices in each pose, in any unit of length. `side` is that of the
    square, `air` is left free on each side, in points.
    """
    view = view_of_motion(places[0])
    panels = thing if isinstance(thing, SpatialPanels) else front_up(panels_of(thing), places[0], view)
    frame = _square(view.places(places).reshape(-1, 2), side, air)
    for points in places:
        shapes, _ = panel_shapes(panels, points, view, frame.row(view.places(points).tolist()))
        yield page_of(frame, [Layer("panels", tuple(shapes))])


def _square(seen: Floats, side: float, air: float) -> Frame:
    """Return the frame of a square with all points of the view in its middle."""
    low, high = seen.min(axis=0), seen.max(axis=0)
    middle, half = (low + high) / 2.0, float((high - low).max() / 2.0) or 1.0
    corners = [(middle - half).tolist(), (middle + half).tolist()]
    return framed(corners, (side - 2 * air) / (2 * half), (2 * side, 2 * side), air)


def strip_of_poses(thing: Sheet | SpatialPanels, places: Floats) -> Scene:
    """Return a strip of poses: at most twelve, equally far from each other, numbered.

    Parameters
    ----------
    thing : Sheet or SpatialPanels
    places : float[F, vertices, 3]

    Examples
    --------
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> strip = strip_of_poses(Sheet(4, (), "", ((0, 1, 2, 3),)), np.stack([square, square / 2]))
    >>> [label.text for label in strip.labels()]
    ['0', '1', 'frames by number, seen from one place; front grey, back blue']
    """
    chosen = np.unique(np.linspace(0, len(places) - 1, min(len(places), _IN_STRIP)).round().astype(int))
    columns = min(len(chosen), _IN_ROW)
    layers: list[Layer] = []
    numbers: list[Label] = []
    scenes = pose_scenes(thing, places[chosen], _SIZE)
    for place, (number, scene) in enumerate(zip(chosen.tolist(), scenes, strict=True)):
        right, down = place % columns * _SIZE, place // columns * _SIZE
        layers += [moved(layer, right, down) for layer in scene.layers if layer.shapes]
        numbers.append(Label((right + SMALL, down + SMALL), str(number), SMALL, "grey"))
    frame = Frame(1.0, 0.0, 0.0, 0.0, 0.0, columns * _SIZE, ceil(len(chosen) / columns) * _SIZE)
    solid = isinstance(thing, SpatialPanels) and thing.solid
    said = "frames by number, seen from one place; " + ("hinges orange" if solid else "front grey, back blue")
    return page_of(frame, [*layers, Layer("numbers", tuple(numbers))], [said])


def save_moving_poses(
    thing: Sheet | SpatialPanels, places: Floats, path: str | Path, *, force: bool = False
) -> None:
    """Write poses as a GIF that moves: there and back, again and again.

    Parameters
    ----------
    thing : Sheet or SpatialPanels
    places : float[F, vertices, 3]
        Vertices in each pose.
    path : str or Path
    force : bool, optional
        Overwrite an existing file.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.
    FileError
        If the file exists already or cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "square.gif")
    ...     save_moving_poses(Sheet(4, (), "", ((0, 1, 2, 3),)), np.stack([square, square / 2]), path)
    ...     print(path.read_bytes()[:6])
    b'GIF89a'
    """
    frames = [pixels(scene, dots=_DOTS) for scene in pose_scenes(thing, places)]
    with whole_file(Path(path), force=force) as beside:
        beside.write(_gif(frames))


def _gif(frames: Sequence[npt.NDArray[np.uint8]]) -> bytes:
    from PIL import Image

    forth = [Image.fromarray(frame).quantize(_COLOURS) for frame in frames]
    images = [*forth, *forth[-2:0:-1]]
    durations = [_MILLISECONDS] * len(images)
    durations[0] = durations[len(forth) - 1] = _PAUSE
    stream = BytesIO()
    images[0].save(stream, "GIF", save_all=True, append_images=images[1:], duration=durations, loop=0)
    return stream.getvalue()


def check_output(path: str | Path, *, force: bool = False) -> None:
    """Refuse a path that a folding cannot be written to.

    Raise FileError if the extension is unknown or the file exists, UnsolvableError for a raster image (.gif,
    .png) if matplotlib is not installed.
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
        A motion of a sheet, or of solids hinged at edges, which can only be drawn.
    path : str or Path
        ``.fold``: one file with a frame per pose. ``.obj``: one file per pose, numbered from 000. ``.gif``: a
        moving picture. ``.png``, ``.svg``: a strip of at most twelve poses.
    force : bool, optional
        Overwrite existing files.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    FileError
        If the extension is unknown, or a file exists already or cannot be written.
    UnsolvableError
        If it is a raster image (.gif, .png), and matplotlib is not installed; if there are no panels to write.

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
    is_picture = path.suffix.lower() in (*_STRIPS, ".gif")
    if not isinstance(at, SheetConfiguration):
        are_solids = isinstance(at.given, HingedSolids | JointedLinkage)
        if not are_solids or not is_picture:
            solids = "solids are drawn as .png, .svg, .gif; " if are_solids else ""
            raise UnsolvableError(
                f"there are no panels to write: {solids}--json gives the joint angles of each frame"
            )
        places = places_of_hinges(motion.linkage, motion.path.angles)
        _draw(bodies_of(motion.linkage)[0], places, path, force=force)
        return [path]
    if is_picture:
        _draw(at.sheet, motion.places, path, force=force)
        return [path]
    poses = [pose for pose in motion.frames() if isinstance(pose, Sheet)]
    if path.suffix.lower() == ".fold":
        write_text(path, fold_text_of_poses(at.sheet, poses), force=force)
        return [path]
    series = [_of_series(path, number) for number in range(len(poses))]
    for place in series:
        check_place(place, force=force)
    for place, pose in zip(series, poses, strict=True):
        write_text(place, obj_text(pose), force=force)
    return series


def _draw(panels: Sheet | SpatialPanels, places: Floats, path: Path, *, force: bool) -> None:
    """Write a moving picture, or a strip of poses."""
    if path.suffix.lower() == ".gif":
        save_moving_poses(panels, places, path, force=force)
    else:
        save_scene(strip_of_poses(panels, places), path, force=force)


def _of_series(path: Path, number: int) -> Path:
    return path.with_name(f"{path.stem}-{number:03d}{path.suffix}")
