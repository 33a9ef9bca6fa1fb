"""Types as things: realised, generated, advised, as templates, in pictures and on the page that folds them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import filterfalse
from math import degrees, hypot, radians

import synth
from drawings.altered import cropped, legible, thinned, without
from drawings.examples import DATA
from drawings.pieces import arrow, in_rows, of_shapes, on_air, words
from drawings.together import above, beside, said
from graphs.convert.conversions import Mechanism
from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import numbered
from graphs.mechanism.sheet import Sheet
from synth.making.drawing import Scene
from synth.making.drawing.mechanisms.creases import places_on_page
from synth.making.drawing.scene.frame import signed
from synth.making.drawing.scene.shapes import FINE, NORMAL, STRONG, Disc, Label, Layer, Line, Point, Shape
from synth.making.drawing.space.motion_files import frame_scenes
from synth.making.templates.pieces import Kind, Piece
from synth.making.templates.template import template_of

__all__ = ["DRAWINGS"]

_SIDE = 130.0


def realisation() -> Scene:
    """A type, its flat sheet, and a pose in space."""
    teller = synth.read(DATA / "wiener" / "fortune-teller.json")
    sheet = synth.realise(teller, symmetric=True).sheet
    pose = synth.realise(teller, kind="space").sheet
    type_of_it = _unnumbered(teller, 150.0)
    flat = cropped(synth.draw(sheet, numbers=False, caption=None, box=(_SIDE, _SIDE)))
    raised = cropped(synth.draw(pose, numbers=False, caption=None, box=(_SIDE, _SIDE)))
    return beside(
        said(type_of_it, "the type"),
        arrow("coordinates"),
        said(flat, "a flat sheet"),
        arrow("heights"),
        said(raised, "a pose in space"),
        gap=8.0,
    )


def _unnumbered(thing: Mechanism, side: float) -> Scene:
    """Return links, joints and centres of a thing, without numbers."""
    scene = without(synth.draw(thing, kind="graph", caption=None, box=(side, side)), "ride-alongs", "labels")
    layers = (Layer(one.name, tuple(filterfalse(_is_label, one.shapes))) for one in scene.layers)
    return cropped(replace(scene, layers=tuple(layers)))


def _is_label(shape: Shape) -> bool:
    return isinstance(shape, Label)


def generators() -> Scene:
    """Some of what generators make, sheets partly folded."""
    shown: list[tuple[str, float | None, dict[str, float]]] = [
        ("miura", 100, {}),
        ("waterbomb", 60, {}),
        ("square-twist", 70, {}),
        ("kresling", None, {}),
        ("miura-tube", None, {}),
        ("kaleidocycle", None, {"solids": 8}),
        ("box-pop-up", 80, {}),
        ("crash-lock", None, {}),
    ]
    pictures = []
    for name, fold, values in shown:
        made = synth.generate(name, fold=None if fold is None else radians(fold), **values)
        scene = thinned(synth.draw(made.mechanism, numbers=False, caption=None, box=(112, 100)))
        pictures.append(said(cropped(scene), name))
    return in_rows(pictures, 4, gap=14.0)


def advice() -> Scene:
    """A pattern with too many freedoms and creases to lock, one with too few and a diagonal to crease."""
    loose, rigid = synth.generate("waterbomb-base").mechanism, synth.generate("miura", rows=2, columns=2).mechanism
    locking, creasing = synth.advise(loose, 1), synth.advise(rigid, 2)
    pieces = mechanism_of_sheet(loose).pieces
    locked = [edge for joint in locking.locks[0].joints for edge in pieces[joint]]
    diagonals = [one.ends for one in creasing.creases[0].diagonals]
    return beside(
        said(
            _marked(loose, locked, ()),
            f"{numbered(locking.freedoms, 'freedom')}, {locking.wanted} wanted:",
            f"lock {numbered(len(locked), 'crease')} (barred)",
        ),
        said(
            _marked(rigid, (), diagonals),
            f"{numbered(creasing.freedoms, 'freedom')}, {creasing.wanted} wanted:",
            f"add {numbered(len(diagonals), 'crease')} (double line)",
        ),
        gap=50.0,
    )


def _marked(sheet: Sheet, locked: Sequence[Sequence[int]], added: Sequence[Sequence[int]]) -> Scene:
    """Return a pattern with bars across creases, and with double lines from vertex to vertex."""
    box = (_SIDE, _SIDE)
    scene, places = synth.draw(sheet, numbers=False, caption=None, box=box), places_on_page(sheet, box)
    shapes: list[Shape] = []
    for a, b in locked:
        (ax, ay), (bx, by) = places[a], places[b]
        x, y, long = (ax + bx) / 2, (ay + by) / 2, hypot(bx - ax, by - ay)
        across, along = (-(by - ay) / long, (bx - ax) / long), ((bx - ax) / long, (by - ay) / long)
        for part in (-2.0, 2.0):
            middle = (x + part * along[0], y + part * along[1])
            bar = [(middle[0] + k * across[0], middle[1] + k * across[1]) for k in (-6.0, 6.0)]
            shapes.append(Line(bar, "ink", 1.5 * STRONG))
    for a, b in added:
        shapes += [Line([places[a], places[b]], "class1", 3.2), Line([places[a], places[b]], "paper", 1.4)]
    return cropped(Scene(scene.width, scene.height, (*scene.layers, Layer("marks", tuple(shapes))), scene.title))


def templates() -> Scene:
    """A thing in space and its pieces with tabs."""
    thing = synth.generate("crash-lock").mechanism
    template = template_of(thing, size=120.0)
    picture = cropped(synth.draw(thing, numbers=False, caption=None, box=(120, 140)))
    pieces = [_piece(piece, 0.9) for piece in template.pieces]
    key = [_kind("CUT", "cut"), _kind("MOUNTAIN", "mountain"), _kind("VALLEY", "valley")]
    return above(beside(picture, arrow("laid out"), *pieces, gap=14.0), beside(*key, gap=24.0), gap=10.0)


_STROKES: dict[Kind, Line] = {
    "CUT": Line((), "ink", NORMAL),
    "MOUNTAIN": Line((), "mountain", NORMAL, (5.0, 1.5, 1.0, 1.5)),
    "VALLEY": Line((), "valley", NORMAL, (4.0, 2.0)),
    "CREASE": Line((), "unassigned", NORMAL, (1.0, 1.5)),
    "MARKS": Line((), "grey", FINE),
}
"""How strokes look here: as on templates, in the colours of pictures."""


def _kind(kind: Kind, said_of_it: str) -> Scene:
    look = _STROKES[kind]
    line = Line([(0.0, 5.0), (26.0, 5.0)], look.colour, look.width, look.dash)
    return beside(of_shapes(26.0, 10.0, [line]), words(said_of_it), gap=5.0)


def _piece(piece: Piece, scale: float) -> Scene:
    """Return a piece of a template, so many points a millimetre."""
    _, high = piece.size
    placed = piece.at_origin()

    def at(place: Point) -> Point:
        return scale * place[0], scale * (high - place[1])

    shapes: list[Shape] = []
    for stroke in placed.strokes:
        look = _STROKES[stroke.kind]
        shapes.append(Line([at(stroke.start), at(stroke.end)], look.colour, look.width, look.dash))
    shapes += [Label(at(text.at), text.words) for text in placed.texts]
    return cropped(of_shapes(1.0, 1.0, shapes))


def pictures() -> Scene:
    """One mechanism in the kinds of pictures that it has."""
    sheet = synth.read(DATA / "realised" / "fortune-teller.fold")
    box = (_SIDE, _SIDE)
    drawn = [
        ("pattern", synth.draw(sheet, "pattern", numbers=False, caption=None, box=box)),
        ("pattern with its graph", synth.draw(sheet, "pattern", graph=True, numbers=False, caption=None, box=box)),
        ("folded", synth.draw(synth.realise(sheet, kind="space").sheet, numbers=False, caption=None, box=box)),
        ("chain", synth.draw(sheet, "chain", numbers=False, caption=None, box=box)),
        ("graph", _unnumbered(sheet, _SIDE)),
        ("model: vertices and rods", legible(synth.draw(sheet, "model", caption=None, box=box))),
    ]
    return in_rows([said(cropped(thinned(scene)), name) for name, scene in drawn], 3, gap=24.0, down=8.0)


def viewer() -> Scene:
    """A pattern on its way, and where its slider is then."""
    folding = synth.fold(synth.generate("miura").mechanism, frames=4)
    [(joint, goal)] = folding.driven.items()
    angles = folding.path.angles[:, folding.joints.index(joint)].tolist()
    poses = [cropped(thinned(scene)) for scene in frame_scenes(folding.configuration.sheet, folding.places, 104.0)]
    high = max(pose.height for pose in poses)
    columns = [
        above(_slider(angle / goal, f"{signed(round(degrees(angle)))}°"), on_air(pose, 92.0, high), gap=4.0)
        for angle, pose in zip(angles, poses, strict=True)
    ]
    return said(beside(*columns, gap=0.0), f"crease {joint} is driven by its slider; the others follow")


def _slider(part: float, told: str) -> Scene:
    """Return a slider with its knob at a part of its length."""
    wide = 76.0
    x = 8.0 + part * (wide - 16.0)
    track = Line([(8.0, 18.0), (wide - 8.0, 18.0)], "ground", 3.0)
    return of_shapes(wide, 26.0, [track, Disc((x, 18.0), 4.0, "class0", "ink", NORMAL), Label((x, 6.0), told)])


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "realisation": realisation,
    "generators": generators,
    "advice": advice,
    "templates": templates,
    "pictures": pictures,
    "viewer": viewer,
}
