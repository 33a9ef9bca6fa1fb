"""Sheets and solids on their way: a strip of poses, or a GIF that moves, drawn as at rest, from one place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import BytesIO
from math import ceil
from pathlib import Path

import numpy as np
import numpy.typing as npt

from graphs.files.atomic import Beside
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.drawing.scene.frame import Frame, framed, page_of
from synth.drawing.scene.moving import moved
from synth.drawing.scene.palette import SMALL
from synth.drawing.scene.raster import pixels
from synth.drawing.scene.shapes import Label, Layer, Scene
from synth.drawing.space.panels import Panels, front_up, panel_shapes, panels_of
from synth.drawing.space.view import view_of_motion

__all__ = ["pose_scenes", "save_moving_poses", "strip_of_poses"]

_IN_STRIP, _IN_ROW = 12, 4
"""Poses of a strip, and in one row of it, at most."""
_SIZE, _MOVING = 120.0, 288.0
"""Sides of the square of a pose in a strip, and of a moving picture, points."""
_DOTS = 100
_MILLISECONDS, _PAUSE = 80, 1000
_COLOURS = 128


def pose_scenes(thing: Sheet | Panels, places: Floats, side: float = _MOVING, air: float = 8.0) -> Iterator[Scene]:
    """Yield a square picture of each pose, all from one place and at one scale.

    Parameters
    ----------
    thing : Sheet or Panels
    places : float[F, vertices, 3]
        Where the vertices are in each pose, any unit of length.
    side : float, optional
        Of the square, points.
    air : float, optional
        Points left free on each side.

    Examples
    --------
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> scenes = list(pose_scenes(Sheet(4, (), "", ((0, 1, 2, 3),)), np.stack([square, square / 2])))
    >>> len(scenes), scenes[0].width
    (2, 288.0)
    """
    view = view_of_motion(places[0])
    panels = thing if isinstance(thing, Panels) else front_up(panels_of(thing), places[0], view)
    frame = _square(view.places(places).reshape(-1, 2), side, air)
    for points in places:
        shapes, _ = panel_shapes(panels, points, view, frame.row(view.places(points).tolist()))
        yield page_of(frame, [Layer("panels", tuple(shapes))])


def _square(seen: Floats, side: float, air: float) -> Frame:
    """Return the frame of a square that holds all that is seen, in its middle."""
    low, high = seen.min(axis=0), seen.max(axis=0)
    middle, half = (low + high) / 2.0, float((high - low).max() / 2.0) or 1.0
    corners = [(middle - half).tolist(), (middle + half).tolist()]
    return framed(corners, (side - 2 * air) / (2 * half), (2 * side, 2 * side), air)


def strip_of_poses(thing: Sheet | Panels, places: Floats) -> Scene:
    """Return a strip of poses: at most twelve, equally far from each other, numbered.

    Parameters
    ----------
    thing : Sheet or Panels
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
    solid = isinstance(thing, Panels) and thing.solid
    said = "frames by number, seen from one place; " + ("hinges orange" if solid else "front grey, back blue")
    return page_of(frame, [*layers, Layer("numbers", tuple(numbers))], [said])


def save_moving_poses(thing: Sheet | Panels, places: Floats, path: str | Path, *, force: bool = False) -> None:
    """Write poses as a GIF that moves: there and back, again and again.

    Parameters
    ----------
    thing : Sheet or Panels
    places : float[F, vertices, 3]
        Where the vertices are in each pose.
    path : str or Path
    force : bool, optional
        Replace a file that is there.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.
    FileError
        If the file cannot be written, or is there already.

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
    beside = Beside(Path(path), force=force)
    try:
        beside.write(_gif(frames))
        beside.commit()
    finally:
        beside.discard()


def _gif(frames: Sequence[npt.NDArray[np.uint8]]) -> bytes:
    from PIL import Image

    there = [Image.fromarray(frame).quantize(_COLOURS) for frame in frames]
    images = [*there, *there[-2:0:-1]]
    durations = [_MILLISECONDS] * len(images)
    durations[0] = durations[len(there) - 1] = _PAUSE
    stream = BytesIO()
    images[0].save(stream, "GIF", save_all=True, append_images=images[1:], duration=durations, loop=0)
    return stream.getvalue()
