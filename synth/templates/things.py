"""The panels of anything that a template can be asked of: as they lie, or of a type, realised."""

from __future__ import annotations

from typing import TYPE_CHECKING

from enumerate.strings.panel_strings import ChainString
from graphs.convert.table import Mechanism
from graphs.errors import UnsolvableError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.surfaces import Surface, SurfaceLinkage
from synth.conformed.linkages import OnSurface, linkage_on_surfaces, surface_of_number
from synth.drawing.mechanisms.orders import OrderOnCircle
from synth.moving.made import sheet_of

if TYPE_CHECKING:
    from synth.realisation.realised import Kind

__all__ = ["linkage_on_a_surface", "panels_of_thing"]


def panels_of_thing(
    thing: Mechanism | ChainString, *, kind: Kind | None = None, mode: str | None = None
) -> tuple[Sheet, str]:
    """Return the panels of a thing with coordinates, and what was done to have them.

    Parameters
    ----------
    thing : Mechanism or ChainString
        A sheet, or a model of panels; or a type, which is realised.
    kind : {"sheet", "space"}, optional
        How a type is realised; a flat sheet without it.
    mode : str, optional
        Of an R/- string.

    Returns
    -------
    sheet : Sheet
    told : str
        Empty for what has coordinates.

    Raises
    ------
    UnsolvableError
        If it has no panels, or cannot be realised; or if it has coordinates, and a kind or a mode is asked for.

    Examples
    --------
    >>> panels_of_thing(ChainString((2, 1)))
    (<Sheet: 4 faces, 3 creases, 9 vertices, flat>, 'no coordinates: realised as a flat sheet')
    """
    sheet = sheet_of(thing) if not isinstance(thing, ChainString) else None
    if sheet is not None:
        if kind is not None or mode is not None:
            raise UnsolvableError("the thing has coordinates: only a type is realised, as a sheet or in space")
        return sheet, ""
    if not isinstance(thing, SCGraph | SCDGraph | ChainString):
        raise UnsolvableError(f"a template needs panels, and {thing!r} has none")
    from synth.realisation.realised import realise  # it loads numba, which a thing with coordinates does without

    how = "a flat sheet" if kind != "space" else "a pose in space"
    return realise(thing, kind=kind or "sheet", mode=mode).sheet, f"no coordinates: realised as {how}"


def linkage_on_a_surface(
    thing: SurfaceLinkage | OrderOnCircle, *, surface: Surface | None = None, number: int | None = None
) -> OnSurface:
    """Return a linkage on one of its surfaces; a row of conical candidates is an order.

    `surface` is that of azimuths; `number` chooses, from 1, among those of given link angles or lengths. Raise
    UnsolvableError if the linkage lies on none, on several without a choice, or the chosen one does not exist.
    """
    if isinstance(thing, OrderOnCircle):
        return OnSurface(thing.chain, list(thing.azimuths), surface)
    return surface_of_number(linkage_on_surfaces(thing, surface), number, thing.kind)
