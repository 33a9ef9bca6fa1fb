"""Layer orders in FOLD: ``faceOrders`` read, and patterns written with a folded frame that has them."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from graphs.errors import FileError, InvariantError
from graphs.files.patterns.fold import fold_text
from graphs.files.text import json_text, load_json
from synth.analysis.layering.orders import FlatFolding, LayerOrder
from synth.analysis.layering.space.orders import LayersInSpace

FaceOrder = tuple[int, int, int]
"""Faces f and g, and 1 if f lies on the side of g that its normal points to, -1 if on the other."""


def folded_fold_text(answer: FlatFolding, order: LayerOrder) -> str:
    """Return the text of a FOLD file: the crease pattern, and a frame of it folded flat with its ``faceOrders``."""
    places = order.image.panels.places.tolist()
    document = json.loads(fold_text(answer.sheet))
    document["file_frames"] = [
        {
            "frame_classes": ["foldedForm"],
            "frame_attributes": ["2D"],
            "frame_title": "folded flat",
            "frame_parent": 0,
            "frame_inherit": True,
            "vertices_coords": places,
            "faceOrders": [list(row) for row in order.face_orders()],
        }
    ]
    return json_text(document)


def fold_text_of_layers(answer: LayersInSpace, order: LayerOrder) -> str:
    """Return the text of a FOLD file: a sheet at a configuration, with the ``faceOrders`` of panels on each other.

    Parameters
    ----------
    answer : LayersInSpace
        Some panels lie on each other.
    order : LayerOrder
        One of its orders.

    Examples
    --------
    A strip of three squares, closed and then bent:

    >>> from math import pi
    >>> import synth
    >>> from graphs.mechanism.sheet import Sheet
    >>> corners = ((0, 0, 0), (1, 0, 0), (0, 0, 0), (0, 0, 1), (0, 1, 0), (1, 1, 0), (0, 1, 0), (0, 1, 1))
    >>> faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6))
    >>> strip = Sheet(8, ((1, 5), (2, 6)), "VM", faces, corners, fold_angles=(pi, -pi / 2))
    >>> answer = synth.layers_at(strip)
    >>> order = answer.order()
    >>> order.face_orders(), '"faceOrders"' in fold_text_of_layers(answer, order)
    ([(0, 1, 1)], True)
    """
    document = json.loads(fold_text(answer.sheet))
    document["frame_classes"] = ["foldedForm"]
    document["faceOrders"] = [list(row) for row in order.face_orders()]
    return json_text(document)


def read_face_orders(path: str | Path, frame: int | None = None) -> list[FaceOrder]:
    """Return the ``faceOrders`` of a FOLD file: of a frame, or the first frame that has any.

    Parameters
    ----------
    path : str or Path
        `FileError` if it has none, or they are no triples of two faces and -1, 0 or 1.
    frame : int, optional
        The frame; 0 is the key frame. Without it, the key frame comes first.

    Returns
    -------
    list of (int, int, int)
        Faces f and g, and 1 if f lies on the side of g that its normal points to, -1 if on the other, 0 if unknown.

    Examples
    --------
    >>> from contextlib import suppress
    >>> with suppress(FileError):  # it has none
    ...     read_face_orders("data/patterns/bird-base.fold")
    """
    document = load_json(Path(path))
    more = document.get("file_frames") if isinstance(document, dict) else None
    frames = [one for one in (document, *(more if isinstance(more, list) else ())) if isinstance(one, dict)]
    several = frames if frame is None else frames[frame : frame + 1]
    rows: Any = next((one["faceOrders"] for one in several if "faceOrders" in one), None)
    if not isinstance(rows, list):
        raise FileError(path, "faceOrders", "missing", "a list of [face, face, -1, 0 or 1]")
    for place, row in enumerate(rows):
        good = isinstance(row, list) and len(row) == 3 and all(type(x) is int for x in row)
        if not good or row[2] not in (-1, 0, 1) or min(row[:2]) < 0:
            raise FileError(path, f"faceOrders[{place}]", str(row)[:60], "[face, face, -1, 0 or 1]")
    return [(f, g, side) for f, g, side in rows]


def wishes_of(answer: FlatFolding, orders: Sequence[FaceOrder]) -> list[tuple[int, int]]:
    """Return pairs of panels, the upper one first, for ``faceOrders``, as `FlatFolding.nearest` takes them.

    Parameters
    ----------
    answer : FlatFolding
    orders : sequence of (int, int, int)
        Faces f and g of the pattern, and 1, -1 or 0, as in FOLD; `InvariantError` for a face that is not there. Those
        of two faces of one panel are left out.

    Examples
    --------
    >>> import synth
    >>> answer = synth.layers("data/patterns/bird-base.fold")
    >>> wishes_of(answer, [(0, 2, 1), (4, 6, 1)])
    [(2, 0), (6, 4)]
    """
    panels = answer.image.panels if answer.image is not None else None
    if panels is None:
        return []
    faces, wishes = len(panels.sheet.faces), dict[tuple[int, int], None]()
    for f, g, side in orders:
        if max(f, g) >= faces:
            raise InvariantError("faceOrders", f"face {max(f, g)}", f"a face from 0 to {faces - 1}")
        one, other = panels.panel_of_face[f], panels.panel_of_face[g]
        if one != other and side:
            first_on_top = (side > 0) == panels.faces_up[g]
            wishes[(one, other) if first_on_top else (other, one)] = None
    return list(wishes)
