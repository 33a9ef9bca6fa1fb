"""Anything with panels as pieces to cut out and fold, at true scale.

Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from enumerate.strings.panel_strings import ChainString
from graphs.convert.conversions import Mechanism
from graphs.errors import InvariantError, SynthedraError, UnsolvableError, numbered, shown
from graphs.mechanism.precision import flattened, in_space, lies_flat
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Surface, SurfaceLinkage
from graphs.types import Floats
from synth.analysis.folding.motion import fold
from synth.analysis.motion.configuration import Configuration
from synth.analysis.moving._configuration_of import configuration_of, sheet_of
from synth.linkages.conformed.linkage_behaviour import OnSurface, linkage_on_surfaces, surface_of_number
from synth.linkages.conformed.orders import OrderOnCircle
from synth.making.drawing.mechanisms.space import folded_scene
from synth.making.drawing.scene.frame import PictureOptions
from synth.making.drawing.scene.writing import Scene
from synth.making.drawing.space.panels import same_side_up
from synth.making.templates.hinges import Hinges, with_hinges
from synth.making.templates.nets import CutNets, Joins, pieces_of_panels
from synth.making.templates.pieces import Kind, Piece, is_laid_out, piece_of_flat_sheet
from synth.making.templates.unfolding import panels_about_centre

if TYPE_CHECKING:
    from synth.catalogue.realisation._realise import Kind as RealisedKind

_UNITS = {"mm": 1.0, "cm": 10.0, "m": 1e3, "um": 1e-3, "nm": 1e-6, "in": 25.4, "pt": 25.4 / 72}
"""Units of length that FOLD names, in millimetres; its ``unit`` is not a length."""

FITTED = 150.0
"""Millimetres of the longer side of what has no size: a type that is realised, a file that names no unit."""
LEAST = 10.0
"""Millimetres: nobody can fold less; the unit of the coordinates was not a millimetre."""
GREATEST = 1e6
"""Millimetres: nobody cuts out more than a kilometre, whose curves would be millions of lines."""


def unit_of(sheet: Sheet) -> float | None:
    """Return the millimetres of the unit that the file of a sheet names; None if it names none.

    Raise UnsolvableError if FOLD does not know the unit.
    """
    name = None if sheet.frames is None else sheet.frames.unit
    if name is None or name == "unit":
        return None
    if name not in _UNITS:
        known = ", ".join(_UNITS)
        raise UnsolvableError(f"the file's unit is {shown(name)}; expected {known}; try --scale or --size")
    return _UNITS[name]


def scale_of(sheet: Sheet, scale: float | None, size: float | None) -> float | None:
    """Return the scale; without a scale and a size, that of the unit that the file of a sheet names."""
    return unit_of(sheet) if scale is None and size is None else scale


def millimetres(places: Floats, scale: float | None = None, size: float | None = None) -> float:
    """Return millimetres per unit of places float[vertices, 2 or 3]: the scale (1 by default), or that of a size.

    `size` is the longest side of the box round the places, in millimetres. Raise InvariantError if scale or size
    is not positive, or both are given; UnsolvableError if the box would be smaller than 10 mm, which nobody could
    fold, or larger than 1e6 mm.
    """
    if scale is not None and size is not None:
        raise InvariantError("scale", "both a scale and a size", "one of them")
    for name, value in (("scale", scale), ("size", size)):
        if value is not None and not (isfinite(value) and value > 0):
            raise InvariantError(name, f"{name} {value!r}", "a positive number")
    extent = np.ptp(places, axis=0)
    longest = float(extent.max())
    factor = size / longest if size is not None and longest > 0 else 1.0 if scale is None else scale
    if not LEAST <= longest * factor <= GREATEST:
        sides = " x ".join(f"{side:.3g}" for side in (extent * factor).tolist())
        way = "larger" if longest * factor < LEAST else "smaller"
        raise UnsolvableError(f"the template would be {sides} mm; try a {way} --scale, or --size")
    return factor


_FOLDS: dict[Kind, tuple[str, str, str]] = {
    "MOUNTAIN": ("mountain", "mountains", "red, dash and dot: away from you"),
    "VALLEY": ("valley", "valleys", "blue, dashes: towards you"),
    "CREASE": ("other crease", "other creases", "magenta, dots: either way"),
}


def steps_of_folds(pieces: Sequence[Piece]) -> list[str]:
    """Return the steps to cut and to fold."""
    counts = Counter(stroke.kind for piece in pieces for stroke in piece.strokes)
    cut = f"Cut out {numbered(len(pieces), 'piece')} along the full black lines."
    folds = [f"{numbered(counts[kind], *name)} ({how})" for kind, (*name, how) in _FOLDS.items() if counts[kind]]
    if not folds:
        return [cut]
    return [f"{cut} Score the folds first.", f"Fold {', '.join(folds)}. You see the printed side."]


def steps_of_joins(edges: int, without: int, *, slotted: bool = False) -> list[str]:
    """Return the steps that join edges: `edges` that meet others, of which `without` have no tab.

    Tabs are glued unless slotted.
    """
    if not edges:
        return []
    steps = []
    if edges > without and slotted:
        steps.append(
            f"Put {numbered(edges - without, 'tab')} through slots: each into the panel at whose edge its number "
            "stands again, from the side to which it is folded, until its fold lies along that edge."
        )
    elif edges > without:
        steps.append(
            f"Glue {numbered(edges - without, 'tab')}: each to the panel at whose edge its number stands again, "
            "on the side to which it is folded, its fold along that edge."
        )
    if without:
        steps.append(f"Tape {numbered(without, 'pair')} of edges of one number that have no tab, edge to edge.")
    return steps


def steps_of_hinges(hinges: Hinges | None) -> list[str]:
    """Return the steps for folds in thick material."""
    if hinges is None:
        return []
    wide = f"{hinges.width:g} mm"
    steps = {
        "offset": f"Each fold is two, {wide} apart: bend each half way; thick panels then have room between.",
        "living": f"Rows of cuts, {wide} wide, are the folds: bend them gently, M away from you, V towards you.",
        "gap": f"Panels stay {wide} apart where they hinge: join them with tape or cloth as they lie on the page, "
        "M to be folded away from you, V towards you.",
    }
    return [steps[hinges.kind]]


_MOST = 60
"""Most panels that are folded for a picture: more take longer than all the pages."""
_FRAMES = 2
"""Frames of a folding; the one half way is drawn, as at the end panels lie on each other."""
_BOX = (420.0, 420.0)
"""Largest width and height of the picture, in points."""


def folded_sheet(sheet: Sheet) -> tuple[Sheet | None, str]:
    """Return a folded configuration of a sheet, and which it is in words; None, and the reason, if there is none.

    It is the sheet itself if it is not flat, else the middle one of the frames of its file that are not flat;
    without one, the sheet is folded by its mountain-valley assignment.
    """
    placed = sheet if sheet.frames is None else sheet.frames.first_placed()
    if not lies_flat(placed):
        return placed, "as it stands"
    frames = [] if sheet.frames is None else list(map(sheet.frames.frame, range(1, sheet.frames.others + 1)))
    standing = [frame for frame in frames if frame.coordinates is not None and frame.faces and not lies_flat(frame)]
    if standing:
        return standing[len(standing) // 2], "in a frame of its file"
    if len(placed.faces) > _MOST:
        return None, f"{numbered(len(placed.faces), 'panel')}: more than {_MOST} are not folded for a picture"
    try:
        folding = fold(replace(placed, title=""), frames=_FRAMES)
    except SynthedraError as error:
        return None, f"it was not folded: {error}"
    half_way = len(folding.places) // 2
    if not np.abs(folding.path.angles[half_way]).max() > 0:
        return None, "it was not folded: nothing turns"
    return folding.sheets()[half_way], "folded half way"


TABS = 8.0
"""Depth of tabs, millimetres."""
_OTHER_QUESTION = "a template shows the links as they are drawn, and no branch of their motion"


@dataclass(frozen=True, repr=False)
class Template:
    """The pieces to cut out and fold, and how they are put together.

    Attributes
    ----------
    pieces : tuple of Piece
        In millimetres, each in a frame of its own.
    scale : float or None
        Millimetres per unit of the coordinates; None for a linkage on a surface.
    mechanism : Sheet, OnSurface or Configuration
        The mechanism of the template.
    title : str
    not_shown : tuple of str
        Parts of the mechanism that the lines do not show, by kind and number.
    steps : tuple of str
        Assembly instructions, once it is printed.
    picture : Scene or None
        The folded sheet.
    """

    pieces: tuple[Piece, ...]
    scale: float | None
    mechanism: Sheet | OnSurface | Configuration
    title: str = ""
    not_shown: tuple[str, ...] = ()
    steps: tuple[str, ...] = ()
    picture: Scene | None = None

    def __repr__(self) -> str:
        return f"<Template: {numbered(len(self.pieces), 'piece')} of {self.mechanism!r}>"

    @cached_property
    def configuration(self) -> Configuration | None:
        """The configuration of the mechanism; None if loops do not close, or it lies on any cone."""
        with suppress(SynthedraError):
            return configuration_of(self.mechanism)
        return None

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        at = self.configuration
        return {
            "configuration": None if at is None else at.to_json(other_question=_OTHER_QUESTION),
            "pieces": len(self.pieces),
            "mm_per_unit": self.scale,
            "not_shown": list(self.not_shown),
            "steps": list(self.steps),
        }


def template_of(
    sheet: Sheet,
    *,
    scale: float | None = None,
    size: float | None = None,
    tabs: float = TABS,
    slots: bool = False,
    hinges: Hinges | None = None,
    title: str = "",
    names: Mapping[tuple[int, int], str] | None = None,
) -> Template:
    """Return the template of a sheet; for panels that do not lie side by side, nets with tabs to glue.

    Parameters
    ----------
    sheet : Sheet
        With coordinates and faces; of several frames the first with coordinates.
    scale : float, optional
        Millimetres per unit of the coordinates. By default that of the file's unit, or 1 if it names none.
    size : float, optional
        Longer side of the sheet in millimetres, instead of a scale.
    tabs : float, optional
        Depth of tabs, millimetres; 0 for none.
    slots : bool, optional
        Join tabs through slots, without glue.
    hinges : Hinges, optional
        Hinges in place of folds, for thick material; a gap leaves no tabs.
    title : str, optional
        Instead of the sheet's own.
    names : mapping of (vertex, vertex) to str, optional
        Of edges; panels are then cut out as nets, with the names beside these edges.

    Returns
    -------
    Template

    Raises
    ------
    InvariantError
        If scale or size is not positive, or both are given, or tabs is negative or not a number.
    UnsolvableError
        If the sheet has no coordinates or faces, or would be smaller than 10 mm; if a panel is not planar, more
        than two meet in an edge, or hinges have no room.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> [stroke.kind for stroke in template_of(square, size=100).pieces[0].strokes]
    ['CREASE', 'CUT', 'CUT', 'CUT', 'CUT']
    """
    joins = Joins(0.0 if hinges is not None and hinges.kind == "gap" else tabs, slots)
    placed = sheet if sheet.frames is None else sheet.frames.first_placed()
    if placed.coordinates is None:
        raise UnsolvableError("a template requires coordinates, and the sheet has none; try `synth realise`")
    if not placed.faces:
        raise UnsolvableError("a template requires panels, and the sheet has none")
    whole = with_all_edges(placed)
    flat = flattened(whole)
    places = in_space(whole.coordinates or ()) if flat is None else flat.places
    factor = millimetres(places, scale_of(sheet, scale, size), size)
    title = title or placed.title
    if flat is not None and not names and is_laid_out(whole, flat.places):
        piece, not_shown = piece_of_flat_sheet(whole, flat.places * factor)
        nets = CutNets((piece,), ((),), 0, 0)
    else:
        nets = pieces_of_panels(whole, in_space(whole.coordinates or ()) * factor, joins, names)
        without = nets.without_tab if joins.depth else 0
        not_shown = (f"tabs at {numbered(without, 'edge')} with no room for one",) if without else ()
    pieces = nets.pieces
    if hinges is not None:
        pieces = tuple(with_hinges(piece, met, hinges) for piece, met in zip(pieces, nets.met, strict=True))
    meeting = steps_of_joins(nets.numbers, nets.without_tab, slotted=slots)
    steps = (*steps_of_folds(pieces), *steps_of_hinges(hinges), *meeting)
    return Template(pieces, factor, placed, title, not_shown, steps)


def template_of_axes(
    linkage: HingedSolids,
    *,
    scale: float | None = None,
    size: float | None = None,
    tabs: float = TABS,
    slots: bool = False,
    title: str = "",
) -> tuple[Template, Sheet]:
    """Return the template of a spherical linkage of axes, and its panels at the configuration.

    Each link is a piece: a triangle at the centre, or a pyramid that is glued; pieces are taped where they turn.

    Parameters
    ----------
    linkage : HingedSolids
        Its axes meet in one point.
    scale, size, tabs, slots, title
        As of `template_of`.

    Raises
    ------
    UnsolvableError
        As `template_of`; if the axes do not meet, or a link has less than two joints.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> pieces, _ = template_of_axes(generate("four-bar").mechanism, size=150)
    >>> len(pieces.pieces), pieces.steps[-1]
    (4, 'Tape edges of the same name, J0 to J3, edge to edge so that they turn: they are the joints.')
    """
    sheet, joints = panels_about_centre(linkage)
    name_of = {joint: joint if isinstance(joint, str) else f"J{joint}" for joint in linkage.chain.joints}
    names = {edge: name_of[joint] for edge, joint in joints.items()}
    result = template_of(sheet, scale=scale, size=size, tabs=tabs, slots=slots, title=title, names=names)
    every = list(name_of.values())
    some = f"{every[0]} to {every[-1]}" if len(every) > 2 else " and ".join(every)
    tape = f"Tape edges of the same name, {some}, edge to edge so that they turn: they are the joints."
    solids = (f"solids of {numbered(len(linkage.shapes), 'link')}",) if linkage.shapes else ()
    not_shown, steps = (*result.not_shown, *solids), (*result.steps, tape)
    return replace(result, mechanism=configuration_of(linkage), not_shown=not_shown, steps=steps), sheet


def pictured(template: Template, sheet: Sheet) -> tuple[Template, str]:
    """Return a template with a picture of the folded sheet, and the reason if there is none.

    Parameters
    ----------
    template : Template
    sheet : Sheet
        The sheet of the template.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> pictured(template_of(square, size=100), square)[0].steps[-1]
    'It then looks as below, folded half way; the printed side is grey, its back blue.'
    """
    folded, seen = folded_sheet(sheet)
    if folded is None:
        return template, seen
    picture = folded_scene(folded, PictureOptions(numbers=False, box=_BOX, caption=None))
    sides = "; the printed side is grey, its back blue" if list(folded.faces) == same_side_up(folded.faces) else ""
    return replace(template, picture=picture, steps=(*template.steps, f"It then looks as below, {seen}{sides}.")), ""


def panels_of_mechanism(
    mechanism: Mechanism | ChainString, *, kind: RealisedKind | None = None, mode: str | None = None
) -> tuple[Sheet, str]:
    """Return the panels of a mechanism, realised if it is a type, and a note on that.

    Parameters
    ----------
    mechanism : Mechanism or ChainString
        A sheet, a model of panels, or a type, which is realised.
    kind : {"sheet", "space"}, optional
        Kind of realisation of a type; a flat sheet by default.
    mode : str, optional
        Mode of an R/- string.

    Returns
    -------
    sheet : Sheet
    note : str
        How it was realised; empty for a mechanism with coordinates.

    Raises
    ------
    UnsolvableError
        If it has no panels, or cannot be realised; or if a kind or a mode is given for one with coordinates.

    Examples
    --------
    >>> panels_of_mechanism(ChainString((2, 1)))
    (<Sheet: 4 faces, 3 creases, 9 vertices, flat>, 'no coordinates: realised as a flat sheet')
    """
    sheet = sheet_of(mechanism) if not isinstance(mechanism, ChainString) else None
    if sheet is not None:
        if kind is not None or mode is not None:
            raise UnsolvableError("a kind or a mode of realisation requires a type, and the mechanism has coordinates")
        return sheet, ""
    if not isinstance(mechanism, SCGraph | SCDGraph | ChainString):
        raise UnsolvableError(f"a template requires panels, and {mechanism!r} has none")
    from synth.catalogue.realisation._realise import realise  # it loads numba, which only types need

    form = "a flat sheet" if kind != "space" else "a pose in space"
    return realise(mechanism, kind=kind or "sheet", mode=mode).sheet, f"no coordinates: realised as {form}"


def linkage_on_a_surface(
    linkage: SurfaceLinkage | OrderOnCircle, *, surface: Surface | None = None, number: int | None = None
) -> OnSurface:
    """Return a linkage, or the cyclic order of a conical candidate, on one of its surfaces.

    `surface` is for azimuths; `number`, from 1, chooses a surface of link angles or lengths. Raise
    UnsolvableError if the linkage lies on none, on several without a choice, or the chosen one does not exist.
    """
    if isinstance(linkage, OrderOnCircle):
        return OnSurface(linkage.chain, list(linkage.azimuths), surface)
    return surface_of_number(linkage_on_surfaces(linkage, surface), number, linkage.kind)
