"""A thing with panels as pieces to cut out and fold, at true scale.

Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphs.errors import SynthedraError, UnsolvableError, numbered
from graphs.mechanism.precision import flattened, in_space
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.conformed.linkages import OnSurface
from synth.drawing.scene.shapes import Scene
from synth.motion.configuration import Configuration
from synth.moving.made import configuration_of
from synth.templates.lines import Piece
from synth.templates.note.folded import folded_picture
from synth.templates.note.steps import steps_of_folds, steps_of_hinges, steps_of_joins
from synth.templates.pieces.flat import is_laid_out, piece_of_flat_sheet
from synth.templates.pieces.hinges import Hinges, with_hinges
from synth.templates.pieces.nets import CutNets, pieces_of_panels
from synth.templates.pieces.tabs import Joins
from synth.templates.scale import millimetres, scale_of

__all__ = ["TABS", "Template", "pictured", "template_of"]

TABS = 8.0
"""Depth of tabs, millimetres."""
_OTHER_QUESTION = "a template shows the links as they are drawn, and no branch of their motion"


@dataclass(frozen=True)
class Template:
    """What is cut out and folded.

    Attributes
    ----------
    pieces : tuple of Piece
        Each by itself, millimetres.
    scale : float or None
        Millimetres for a unit of the coordinates; None of what has none.
    mechanism : Sheet, OnSurface or Configuration
        What it is made of.
    title : str
    told : tuple of str
        What the lines do not show, by kind and number.
    steps : tuple of str
        How it is put together, once it is printed.
    picture : Scene or None
        What it looks like then (`synth.templates.note`).
    """

    pieces: tuple[Piece, ...]
    scale: float | None
    mechanism: Sheet | OnSurface | Configuration
    title: str = ""
    told: tuple[str, ...] = ()
    steps: tuple[str, ...] = ()
    picture: Scene | None = None

    @cached_property
    def configuration(self) -> Configuration | None:
        """What it is made of, at a configuration; None where loops do not close, or on any cone."""
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
            "not_shown": list(self.told),
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
) -> Template:
    """Return the template of a sheet; of panels that do not lie side by side, nets with tabs to glue.

    Parameters
    ----------
    sheet : Sheet
        With coordinates and faces; of several frames the first that has coordinates.
    scale : float, optional
        Millimetres for a unit of the coordinates; without it that of the file's unit, and 1 where it names none.
    size : float, optional
        Millimetres of the longer side of the sheet as it lies, instead of a scale.
    tabs : float, optional
        Depth of tabs, millimetres; 0 for none.
    slots : bool, optional
        Tabs go through slots, without glue.
    hinges : Hinges, optional
        What is made of folds in thick material; a gap leaves no tabs.
    title : str, optional
        Instead of the sheet's own.

    Returns
    -------
    Template

    Raises
    ------
    InvariantError
        If scale or size is no positive number, or both are given, or tabs is no number from 0 on.
    UnsolvableError
        If the sheet has no coordinates or faces, or would be smaller than 10 mm; if a panel is not plane, or
        more than two meet in an edge, or hinges have no room.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> [stroke.kind for stroke in template_of(square, size=100).pieces[0].strokes]
    ['CREASE', 'CUT', 'CUT', 'CUT', 'CUT']
    """
    joins = Joins(0.0 if hinges is not None and hinges.kind == "gap" else tabs, slots)
    placed = sheet if sheet.frames is None else sheet.frames.first_placed()
    if placed.coordinates is None:
        raise UnsolvableError("a template needs coordinates, and the sheet has none")
    if not placed.faces:
        raise UnsolvableError("a template needs panels, and the sheet has none")
    whole = with_all_edges(placed)
    flat = flattened(whole)
    places = in_space(whole.coordinates or ()) if flat is None else flat.places
    factor = millimetres(places, scale_of(sheet, scale, size), size)
    title = title or placed.title
    if flat is not None and is_laid_out(whole, flat.places):
        piece, told = piece_of_flat_sheet(whole, flat.places * factor)
        nets = CutNets((piece,), ((),), 0, 0)
    else:
        nets = pieces_of_panels(whole, in_space(whole.coordinates or ()) * factor, joins)
        told = _without_tab(nets.without_tab) if joins.depth else ()
    pieces = nets.pieces
    if hinges is not None:
        pieces = tuple(with_hinges(*one, hinges) for one in zip(pieces, nets.met, strict=True))
    meeting = steps_of_joins(nets.numbers, nets.without_tab, slotted=slots)
    steps = (*steps_of_folds(pieces), *steps_of_hinges(hinges), *meeting)
    return Template(pieces, factor, placed, title, told, steps)


def _without_tab(edges: int) -> tuple[str, ...]:
    return (f"tabs at {numbered(edges, 'edge')} with no room for one",) if edges else ()


def pictured(template: Template, sheet: Sheet) -> tuple[Template, str]:
    """Return a template with a picture of the thing folded, and why it has none where it was not folded.

    Parameters
    ----------
    template : Template
    sheet : Sheet
        That it was made of.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> pictured(template_of(square, size=100), square)[0].steps[-1]
    'It then looks as below, folded half way; the printed side is grey, its back blue.'
    """
    picture, seen = folded_picture(sheet)
    if picture is None:
        return template, seen
    return replace(template, picture=picture, steps=(*template.steps, f"It then looks as below, {seen}.")), ""
