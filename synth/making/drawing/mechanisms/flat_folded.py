"""Crease patterns folded flat: from the front, from the back, and with light through the layers."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from graphs.errors import UnsolvableError, numbered
from graphs.files.outputs import check_writable, write_as
from graphs.types import Floats
from synth.analysis.layering.face_orders import folded_fold_text
from synth.analysis.layering.image import OUTSIDE
from synth.analysis.layering.orders import FlatFolding, LayerOrder
from synth.exporters import EXPORTERS
from synth.making.drawing.mechanisms.creases import DrawnPattern, Overlay, crease_scene
from synth.making.drawing.scene.frame import PLAIN, PictureFrame, PictureOptions, captions_of, framed, page_of
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Polygon,
    Shape,
    moved,
)
from synth.making.drawing.scene.writing import Pages, Scene

_GAP = 6.0
_CLEAR = 0.85
"""The part of the light that a layer lets through."""


def flat_folded_scene(order: LayerOrder, options: PictureOptions) -> Scene:
    """Return a layer order as it is seen from the front, from the back (turned over) and through its layers."""
    nodes = order.image.nodes
    box = ((options.box[0] - 2 * _GAP) / 3, options.box[1])
    frame = framed(nodes.tolist(), max(options.box), box, _GAP)
    turned = nodes * (-1.0, 1.0)
    frame_back = framed(turned.tolist(), max(options.box), box, _GAP)
    views = [
        _seen(order, frame, nodes, back=False, numbers=options.numbers),
        _seen(order, frame_back, turned, back=True, numbers=options.numbers),
        _through(order, frame),
    ]
    layers = [moved(layer, place * (frame.width + _GAP), 0.0) for place, view in enumerate(views) for layer in view]
    width = 3 * frame.width + 2 * _GAP
    whole = PictureFrame(frame.scale, 0.0, 0.0, 0.0, 0.0, width, frame.height)
    layered = numbered(order.image.depth, "layer")
    return page_of(whole, layers, captions_of(options.caption, f"front, back and light through at most {layered}"))


def _seen(order: LayerOrder, frame: PictureFrame, nodes: Floats, *, back: bool, numbers: bool) -> Iterator[Layer]:
    """Yield the layers of a view from one side: what is on top of each cell, and the lines where that changes."""
    image = order.image
    on_top = [(stack[0] if back else stack[-1]) if stack else OUTSIDE for stack in order.stacks]
    panels: list[Shape] = []
    best: dict[int, tuple[float, Label]] = {}
    for cell, panel in zip(image.cells, on_top, strict=True):
        if panel == OUTSIDE:
            continue
        corners = frame.row(nodes[list(cell)].tolist())
        fill = "front" if bool(image.panels.flipped[panel]) == back else "back"
        panels.append(Polygon(corners, fill, fill, FINE, data=(("link", str(panel)),)))
        circle = shapely.maximum_inscribed_circle(shapely.Polygon(corners))
        (x, y), _ = circle.coords
        label = Label((x, y), str(panel), SMALL, data=(("link", str(panel)),))
        left, top, right, low = label.box
        room = circle.length - float(np.hypot(right - left, low - top)) / 2
        if room > best.get(panel, (0.0, label))[0]:
            best[panel] = (room, label)
    lines: list[Shape] = []
    for (one, other), sides in zip(image.segments.tolist(), image.sides.tolist(), strict=True):
        seen = {OUTSIDE if cell == OUTSIDE else on_top[cell] for cell in sides}
        if len(seen) > 1:
            width = NORMAL if OUTSIDE in seen else FINE
            lines.append(Line(frame.row([nodes[one].tolist(), nodes[other].tolist()]), "ink", width))
    yield Layer("panels", tuple(panels))
    yield Layer("edges", tuple(lines))
    yield Layer("labels", tuple(label for _, label in best.values()) if numbers else ())


def _through(order: LayerOrder, frame: PictureFrame) -> Iterator[Layer]:
    """Yield the layers of a view against the light: the more layers, the darker; all edges."""
    nodes = order.image.nodes
    shades = [
        Polygon(frame.row(nodes[list(cell)].tolist()), "shadow", None, opacity=1.0 - _CLEAR ** len(stack))
        for cell, stack in zip(order.image.cells, order.stacks, strict=True)
        if stack
    ]
    edges = [Line(frame.row(nodes[pair].tolist()), "ink", FINE) for pair in order.image.segments]
    yield Layer("shades", tuple(shades))
    yield Layer("edges", tuple(edges))


def fault_scene(answer: FlatFolding, options: PictureOptions = PLAIN) -> Scene:
    """Return the pattern with why it does not fold flat: the panels and creases of the core, the vertices at fault.

    Parameters
    ----------
    answer : FlatFolding
        `UnsolvableError` if it folds flat.
    options : PictureOptions, optional

    Examples
    --------
    >>> import synth
    >>> fault_scene(synth.layers("data/patterns/bird-base.fold"))
    Traceback (most recent call last):
    ...
    graphs.errors.UnsolvableError: the pattern folds flat: there is no fault to draw
    """
    if answer.foldable:
        raise UnsolvableError("the pattern folds flat: there is no fault to draw")
    core = answer.core
    panels, conditions = ((), ()) if core is None else (core.panels, core.conditions)
    joints = {joint for condition in conditions for joint in condition.joints}

    def shapes(drawn: DrawnPattern) -> list[Shape]:
        faces = [face for panel in panels for face in drawn.mechanism.panels[panel]]
        areas: list[Shape] = [
            Polygon([drawn.places[vertex] for vertex in drawn.sheet.faces[face]], "marked", None, opacity=0.6)
            for face in faces
        ]
        lines: list[Shape] = [
            Line([drawn.places[vertex] for vertex in edge], "class5", 3.0 * STRONG, data=(("joint", str(joint)),))
            for joint in sorted(joints)
            for edge in drawn.mechanism.pieces[joint]
        ]
        rings: list[Shape] = [
            Disc(drawn.places[vertex.vertex], 5.0, None, "class1", STRONG) for vertex in answer.local_faults
        ]
        return [*areas, *lines, *rings]

    said = [f"does not fold flat: {answer.fault}"]
    if core is not None:
        said.append(f"yellow: {numbered(len(panels), 'panel')} that cannot be layered, with their creases (light blue)")
    if answer.local_faults:
        said.append("circles: vertices that do not fold flat by themselves")
    return crease_scene(answer.sheet, options, overlay=Overlay("faults", shapes, tuple(said)))


@dataclass(frozen=True, slots=True)
class _WrittenOrder:
    """A layer order that is written, with the answer that it is of."""

    answer: FlatFolding
    order: LayerOrder


def order_bytes(written: _WrittenOrder) -> bytes:
    """Return a layer order as FOLD, with ``faceOrders`` in a folded frame."""
    return folded_fold_text(written.answer, written.order).encode()


def order_pages(written: _WrittenOrder) -> Pages:
    """Return a layer order as it is seen, on one page."""
    return Pages([flat_folded_scene(written.order, PLAIN)], "light")


def check_order_path(path: str | Path, *, force: bool = False) -> None:
    """Refuse a path that no layer order can be written to: `FileError`, `UnsolvableError`."""
    check_writable(path, EXPORTERS["layer orders"], force=force)


def write_order(answer: FlatFolding, order: LayerOrder, path: str | Path, *, force: bool = False) -> None:
    """Write a layer order: as FOLD with ``faceOrders`` in a folded frame, or as a picture.

    Parameters
    ----------
    answer : FlatFolding
    order : LayerOrder
        One of its orders.
    path : str or Path
        Ending in .fold, .svg, .png or .pdf.
    force : bool, optional
        Overwrite an existing file.

    Raises
    ------
    FileError
        If the extension is unknown, or the file cannot be written.

    Examples
    --------
    >>> import synth
    >>> answer = synth.layers("data/patterns/bird-base.fold")
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write_order(answer, answer.order(1), Path(folder) / "layered.fold")
    """
    write_as(_WrittenOrder(answer, order), path, EXPORTERS["layer orders"], force=force)
