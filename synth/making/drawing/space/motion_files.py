"""Motions as files: FOLD with a frame for each frame, OBJ files, a strip of pictures, a GIF that moves.

All frames are drawn from one place and at one scale.
"""

from collections.abc import Iterator, Sequence
from io import BytesIO
from math import ceil
from pathlib import Path
from typing import NamedTuple

import numpy as np

from graphs.errors import UnsolvableError
from graphs.files.atomic import check_place
from graphs.files.outputs import check_writable, listed, write_as
from graphs.files.patterns.fold import fold_text_of_frames
from graphs.files.patterns.obj import obj_text
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.motion import Motion
from synth.exporters import EXPORTERS
from synth.making.drawing.scene.frame import PictureFrame, framed, page_of
from synth.making.drawing.scene.shapes import SMALL, Label, Layer, moved, text_width
from synth.making.drawing.scene.writing import Pages, Scene, pixels
from synth.making.drawing.space.panels import (
    SpatialPanels,
    bodies_of,
    front_up,
    panel_shapes,
    panels_of,
    places_of_hinges,
    view_of_motion,
)
from synth.making.drawing.space.solids import faces_of_shapes

_IN_STRIP, _IN_ROW = 12, 4
"""MotionFrames of a strip, and in one row of it, at most."""
_SIZE, _MOVING = 120.0, 288.0
"""Sides of the square of a frame in a strip, and of a moving picture, points."""
_DOTS = 100
_MILLISECONDS, _PAUSE = 80, 1000
_COLOURS = 128


def frame_scenes(
    panels: Sheet | SpatialPanels, places: Floats, side: float = _MOVING, air: float = 8.0
) -> Iterator[Scene]:
    """Yield a square picture of each frame, all from one place and at one scale.

    `places`, float[F, vertices, 3], are the vertices in each frame, in any unit of length. `side` is that of the
    square, `air` is left free on each side, in points.
    """
    view = view_of_motion(places[0])
    if isinstance(panels, Sheet):
        panels = front_up(panels_of(panels), places[0], view)
    seen = view.places(places).reshape(-1, 2)
    low, high = seen.min(axis=0), seen.max(axis=0)
    middle, half = (low + high) / 2.0, float((high - low).max() / 2.0) or 1.0
    corners = [(middle - half).tolist(), (middle + half).tolist()]
    frame = framed(corners, (side - 2 * air) / (2 * half), (2 * side, 2 * side), air)
    for points in places:
        shapes, _ = panel_shapes(panels, points, view, frame.row(view.places(points).tolist()))
        yield page_of(frame, [Layer("panels", tuple(shapes))])


def strip_of_frames(
    panels: Sheet | SpatialPanels, places: Floats, *, names: Sequence[str] = (), said: Sequence[str] = ()
) -> Scene:
    """Return a strip of frames: at most twelve, equally far from each other, numbered.

    Parameters
    ----------
    panels : Sheet or SpatialPanels
    places : float[F, vertices, 3]
    names : sequence of str, optional
        What is written beside each frame, in place of its number.
    said : sequence of str, optional
        Lines below the strip, after the one that explains it.

    Examples
    --------
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> strip = strip_of_frames(Sheet(4, (), "", ((0, 1, 2, 3),)), np.stack([square, square / 2]))
    >>> [label.text for label in strip.labels()]
    ['0', '1', 'frames by number, seen from one place; front grey, back blue']
    """
    chosen = np.unique(np.linspace(0, len(places) - 1, min(len(places), _IN_STRIP)).round().astype(int))
    columns = min(len(chosen), _IN_ROW)
    layers: list[Layer] = []
    numbers: list[Label] = []
    scenes = frame_scenes(panels, places[chosen], _SIZE)
    for place, (number, scene) in enumerate(zip(chosen.tolist(), scenes, strict=True)):
        right, down = place % columns * _SIZE, place // columns * _SIZE
        layers += [moved(layer, right, down) for layer in scene.layers if layer.shapes]
        name = names[number] if names else str(number)
        middle = right + SMALL + text_width(name, SMALL) / 2 - text_width("0", SMALL) / 2
        numbers.append(Label((middle, down + SMALL), name, SMALL, "grey"))
    frame = PictureFrame(1.0, 0.0, 0.0, 0.0, 0.0, columns * _SIZE, ceil(len(chosen) / columns) * _SIZE)
    solid = isinstance(panels, SpatialPanels) and panels.solid
    first = "frames by number, seen from one place; " + ("hinges orange" if solid else "front grey, back blue")
    return page_of(frame, [*layers, Layer("numbers", tuple(numbers))], [first, *said])


class MotionFrames(NamedTuple):
    """What a file of a motion holds: panels or solids, and float[F, vertices, 3], their vertices in each frame.

    The sheets, one for each frame, are for FOLD and OBJ.
    """

    panels: Sheet | SpatialPanels
    places: Floats
    sheets: Sequence[Sheet] = ()


def gif_bytes(frames: MotionFrames) -> bytes:
    """Return a moving picture: there and back, again and again."""
    from PIL import Image

    pictures = (pixels(scene, dots=_DOTS) for scene in frame_scenes(frames.panels, frames.places))
    forth = [Image.fromarray(picture).quantize(_COLOURS) for picture in pictures]
    images = [*forth, *forth[-2:0:-1]]
    durations = [_MILLISECONDS] * len(images)
    durations[0] = durations[len(forth) - 1] = _PAUSE
    stream = BytesIO()
    images[0].save(stream, "GIF", save_all=True, append_images=images[1:], duration=durations, loop=0)
    return stream.getvalue()


def fold_bytes(frames: MotionFrames) -> bytes:
    """Return frames as FOLD, a frame each."""
    assert isinstance(frames.panels, Sheet)
    return fold_text_of_frames(frames.panels, frames.sheets).encode("utf-8")


def obj_bytes(frames: MotionFrames) -> bytes:
    """Return the first frame as OBJ."""
    return obj_text(frames.sheets[0]).encode("utf-8")


def strip_pages(frames: MotionFrames) -> Pages:
    """Return frames as a strip, on one page."""
    return Pages([strip_of_frames(frames.panels, frames.places)])


def save_moving_frames(panels: Sheet | SpatialPanels, places: Floats, path: str | Path, *, force: bool = False) -> None:
    """Draw frames: as a GIF that moves there and back, or as a strip.

    Parameters
    ----------
    panels : Sheet or SpatialPanels
    places : float[F, vertices, 3]
        Vertices in each frame.
    path : str or Path
        Ends in .gif, .png or .svg.
    force : bool, optional
        Overwrite an existing file.

    Raises
    ------
    UnsolvableError
        If it is a raster image (.gif, .png), and matplotlib is not installed.
    FileError
        If the extension is unknown, or the file exists already or cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "square.gif")
    ...     save_moving_frames(Sheet(4, (), "", ((0, 1, 2, 3),)), np.stack([square, square / 2]), path)
    ...     print(path.read_bytes()[:6])
    b'GIF89a'
    """
    write_as(MotionFrames(panels, places), path, EXPORTERS["pictures of motions"], force=force)


def check_motion_file(path: str | Path, *, force: bool = False) -> None:
    """Refuse a path that a motion cannot be written to, as `graphs.files.outputs.check_writable` does."""
    path = Path(path)
    first = _of_series(path, 0) if path.suffix.lower() == ".obj" else path
    check_writable(first, EXPORTERS["motions"], force=force)


def write_motion(motion: Motion, path: str | Path, *, force: bool = False) -> list[Path]:
    """Write a motion.

    Parameters
    ----------
    motion : Motion
        A motion of a sheet, or of solids hinged at edges, which can only be drawn.
    path : str or Path
        ``.fold``: one file with a frame per frame. ``.obj``: one file per frame, numbered from 000. ``.gif``: a
        moving picture. ``.png``, ``.svg``: a strip of at most twelve frames.
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
    A vertex of four creases, its frames as frames of one file:

    >>> from tempfile import TemporaryDirectory
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.analysis.folding.motion import fold
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> motion = fold(Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners), frames=3)
    >>> with TemporaryDirectory() as folder:
    ...     [path] = write_motion(motion, Path(folder, "vertex.fold"))
    ...     print(path.name, path.read_text().count("foldedForm"))
    vertex.fold 4
    """
    path = Path(path)
    check_motion_file(path, force=force)
    at = motion.configuration
    is_picture = path.suffix.lower() in EXPORTERS["pictures of motions"]
    if isinstance(at, SheetConfiguration):
        sheets = () if is_picture else motion.sheets()
        frames = MotionFrames(at.sheet, motion.places, sheets)
    elif is_picture and isinstance(at.given, HingedSolids | JointedLinkage):
        if isinstance(at.given, HingedSolids) and at.given.shapes:
            shown = faces_of_shapes(at.given, motion.linkage)
            frames = MotionFrames(shown.panels(motion.linkage), shown.places(motion.linkage, motion.path.angles))
        else:
            frames = MotionFrames(bodies_of(motion.linkage)[0], places_of_hinges(motion.linkage, motion.path.angles))
    else:
        are_solids = isinstance(at.given, HingedSolids | JointedLinkage)
        solids = f"solids are drawn as {listed(EXPORTERS['pictures of motions'])}; " if are_solids else ""
        raise UnsolvableError(f"there are no panels to write: {solids}--json gives the joint angles of each frame")
    if path.suffix.lower() != ".obj":
        write_as(frames, path, EXPORTERS["motions"], force=force)
        return [path]
    series = [_of_series(path, number) for number in range(len(frames.sheets))]
    for place in series:
        check_place(place, force=force)
    for place, sheet in zip(series, frames.sheets, strict=True):
        write_as(frames._replace(sheets=[sheet]), place, EXPORTERS["motions"], force=force)
    return series


def _of_series(path: Path, number: int) -> Path:
    return path.with_name(f"{path.stem}-{number:03d}{path.suffix}")
