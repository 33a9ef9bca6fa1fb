"""Pictures of panels in space, pose by pose: a strip of poses, or a GIF that moves.

Panels are seen from above, parallel to a slanting line, and painted in order of depth, the farthest first; each is
shaded by how it lies to the light, its two sides in colours of their own. Panels that pass through each other, or
overlap in a circle, are not cut.
"""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from math import ceil, cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np

from graphs.arrays import Floats
from graphs.files.atomic import Beside
from synth.drawing.figure import COLOURS, new_figure

__all__ = ["draw_poses", "save_moving_poses"]

_IN_STRIP, _IN_ROW = 12, 6
"""Poses of a strip, and in one row of it, at most."""
_SIZE = 2.2
"""Inches of one pose in a strip."""
_MOVING = 4.0
_DOTS = 100
"""Inches of a moving picture, and dots per inch."""
_MILLISECONDS, _PAUSE = 80, 1000
_FRONT, _BACK = COLOURS[5], COLOURS[4]
_LINE = "#333333"
_DARKEST = 0.45
"""Part of the light on a panel that is seen edge on to it."""
_AROUND, _ABOVE = radians(-60.0), radians(35.0)
"""Where it is seen from: the angle round the vertical, from x, and the height over the horizon."""
_TOWARDS = np.array([cos(_ABOVE) * cos(_AROUND), cos(_ABOVE) * sin(_AROUND), sin(_ABOVE)])
_ACROSS = np.array([-sin(_AROUND), cos(_AROUND), 0.0])
_UP = np.cross(_TOWARDS, _ACROSS)
_LIGHT = np.array([0.3, -0.4, 0.866]) / np.linalg.norm([0.3, -0.4, 0.866])


def draw_poses(faces: Sequence[Sequence[int]], places: Floats) -> Any:
    """Return a strip of poses as a matplotlib figure: at most twelve, equally far from each other.

    Parameters
    ----------
    faces : sequence of sequence of int
        Vertices round each panel.
    places : float[F, vertices, 3]
        Where the vertices are in each pose, any unit of length.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.

    Examples
    --------
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> len(draw_poses([(0, 1, 2, 3)], np.stack([square, square + 1])).axes)
    2
    """
    shown = np.unique(np.linspace(0, len(places) - 1, min(len(places), _IN_STRIP)).round().astype(int))
    columns = min(len(shown), _IN_ROW)
    rows = ceil(len(shown) / columns)
    figure = new_figure(_SIZE * columns, _SIZE * rows)
    window = _window(places)
    upwards = _turned_up(faces, places[0])
    for number, pose in enumerate(shown):
        axes = figure.add_subplot(rows, columns, number + 1)
        _paint(axes, upwards, places[pose], window)
        axes.set_title(f"{pose}", fontsize=8)
    return figure


def save_moving_poses(
    faces: Sequence[Sequence[int]], places: Floats, path: str | Path, *, force: bool = False
) -> None:
    """Write poses as a GIF that moves: there and back, again and again.

    Parameters
    ----------
    faces : sequence of sequence of int
        Vertices round each panel.
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
    """
    figure = new_figure(_MOVING, _MOVING)
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    canvas: Any = FigureCanvasAgg(figure)
    figure.set_dpi(_DOTS)
    axes = figure.add_subplot()
    window, upwards = _window(places), _turned_up(faces, places[0])
    there = []
    for pose in places:
        axes.clear()
        _paint(axes, upwards, pose, window)
        canvas.draw()
        there.append(Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy()).quantize(64))
    images = [*there, *there[-2:0:-1]]
    durations = [_MILLISECONDS] * len(images)
    durations[0] = durations[len(there) - 1] = _PAUSE
    stream = BytesIO()
    images[0].save(stream, "GIF", save_all=True, append_images=images[1:], duration=durations, loop=0)
    beside = Beside(Path(path), force=force)
    try:
        beside.write(stream.getvalue())
        beside.commit()
    finally:
        beside.discard()


def _window(places: Floats) -> tuple[Floats, float]:
    """Return the middle and half the side of the square, on paper, that holds all poses."""
    seen = (places @ np.stack([_ACROSS, _UP]).T).reshape(-1, 2)
    low, high = seen.min(axis=0), seen.max(axis=0)
    return (low + high) / 2.0, float((high - low).max() / 2.0 or 1.0)


def _turned_up(faces: Sequence[Sequence[int]], places: Floats) -> list[list[int]]:
    """Return the faces, of a flat pose all with the same side up."""
    if np.linalg.matrix_rank(places - places.mean(axis=0), tol=1e-6 * np.ptp(places)) > 2:
        return [list(face) for face in faces]
    first = _normal(places[list(faces[0])]) if len(faces) else _TOWARDS
    up = first if first @ _TOWARDS >= 0.0 else -first
    return [list(face) if _normal(places[list(face)]) @ up >= 0.0 else list(face)[::-1] for face in faces]


def _normal(corners: Floats) -> Floats:
    """Return the unit normal of a polygon (Newell); zeros if it has no area."""
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    size = float(np.linalg.norm(normal))
    return np.asarray(normal / size if size else normal)


def _paint(axes: Any, faces: Sequence[Sequence[int]], places: Floats, window: tuple[Floats, float]) -> None:
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgb

    panels = [places[list(face)] for face in faces]
    panels.sort(key=lambda corners: float((corners @ _TOWARDS).mean()))
    normals = [_normal(corners) for corners in panels]
    shades = [_DARKEST + (1.0 - _DARKEST) * abs(float(n @ _LIGHT)) for n in normals]
    sides = [to_rgb(_FRONT if float(n @ _TOWARDS) >= 0.0 else _BACK) for n in normals]
    colours = np.array(sides).reshape(-1, 3) * np.array(shades)[:, None]
    seen = [corners @ np.stack([_ACROSS, _UP]).T for corners in panels]
    axes.add_collection(PolyCollection(seen, facecolors=colours, edgecolors=_LINE, linewidths=0.5))
    (x, y), half = window
    axes.set_xlim(x - 1.05 * half, x + 1.05 * half)
    axes.set_ylim(y - 1.05 * half, y + 1.05 * half)
    axes.set_aspect("equal")
    axes.set_axis_off()
