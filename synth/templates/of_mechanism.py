"""The template of any mechanism in one call, as `synth template` makes it."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from enumerate.strings.panel_strings import ChainString
from graphs.convert.table import Mechanism
from graphs.errors import InvariantError
from graphs.files.accepted import MechanismLike, mechanism_for, with_stated_precision
from graphs.mechanism.surfaces import Cone, SurfaceLinkage
from synth.drawing.mechanisms.chains import OrderOnCircle
from synth.realisation.realised import Kind
from synth.templates.hinges import Hinges
from synth.templates.on_surface import Dimensions, surface_of, template_on_surface
from synth.templates.template import (
    TABS,
    Template,
    linkage_on_a_surface,
    panels_of_mechanism,
    pictured,
    template_of,
)

_REALISED = 150.0
"""Millimetres of the longer side of a type that is realised: its coordinates have no size of their own."""


def template(
    mechanism: MechanismLike | ChainString | OrderOnCircle,
    *,
    kind: Kind | None = None,
    mode: str | None = None,
    scale: float | None = None,
    size: float | None = None,
    tabs: float | None = None,
    slots: bool = False,
    hinges: Hinges | None = None,
    cone_angle: float | None = None,
    number: int | None = None,
    radius: float | None = None,
    thickness: float | None = None,
    note: bool = True,
    precision: float | None = None,
) -> Template:
    """Return the template of a mechanism at true scale, to cut out and fold; `write_template` writes it.

    Parameters
    ----------
    mechanism : Mechanism, str, Path, ChainString or OrderOnCircle
        Panels with coordinates; a type, which is realised first, by default with a longer side of 150 mm; or a
        linkage on a cone or cylinder.
    kind : {"sheet", "space"}, optional
        For a type: the kind of realisation; a flat sheet by default.
    mode : str, optional
        For an R/- string: its mode.
    scale : float, optional
        For panels: millimetres per unit of the coordinates. By default that of the file's unit, or 1.
    size : float, optional
        Longer side of the template in millimetres; on a cone or cylinder, length of the ruling lines.
    tabs : float, optional
        For panels: depth of tabs in millimetres, 8 by default; 0 leaves them out.
    slots : bool, optional
        For panels: join tabs through slots, without glue.
    hinges : Hinges, optional
        For panels: hinges in place of folds, for thick material.
    cone_angle : float, optional
        For a linkage that fits every cone: the angle of the cone, radians.
    number : int, optional
        For a linkage that lies on several cones or cylinders: the one to take, from 1.
    radius : float, optional
        For a linkage on a cylinder: its radius in millimetres.
    thickness : float, optional
        For a linkage on a surface: that of the material in millimetres, 0.3 by default.
    note : bool, optional
        Add assembly instructions, with a picture.
    precision : float, optional
        The error that a coordinate of panels may have, in their unit.

    Returns
    -------
    Template

    Raises
    ------
    UnsolvableError
        If it has no panels, cannot be realised, or lies on no surface or on several.
    InvariantError
        If a size is not positive, or an option is for another kind of mechanism.

    Examples
    --------
    >>> result = template("m1:a-b.ac-.b-d.cd-", size=200)
    >>> len(result.pieces), result.not_shown, result.steps[0]
    (1, (), 'Cut out 1 piece along the full black lines. Score the folds first.')
    """
    source: Mechanism | ChainString | OrderOnCircle = mechanism_for(
        "template", mechanism, Mechanism | ChainString | OrderOnCircle
    )
    name = Path(mechanism).name if isinstance(mechanism, str | Path) else ""
    of_panels = {
        "kind": kind,
        "mode": mode,
        "scale": scale,
        "tabs": tabs,
        "slots": slots or None,
        "hinges": hinges,
        "precision": precision,
    }
    of_surface = {"cone_angle": cone_angle, "number": number, "radius": radius, "thickness": thickness}
    if isinstance(source, SurfaceLinkage | OrderOnCircle):
        _refuse(of_panels, "a mechanism with panels")
        cone = None if cone_angle is None else Cone(cone_angle)
        linkage = linkage_on_a_surface(source, surface=cone, number=number)
        sizes = {key: value for key, value in (("size", size), ("thickness", thickness)) if value is not None}
        result = template_on_surface(linkage, surface_of(linkage, radius), Dimensions(**sizes), name)
        return result if note else replace(result, steps=())
    _refuse(of_surface, "a linkage on a cone or cylinder")
    panels = with_stated_precision(source, precision)
    sheet, realised = panels_of_mechanism(panels, kind=kind, mode=mode)
    if realised and scale is None and size is None:
        size = _REALISED
    depth = TABS if tabs is None else tabs
    title = sheet.title or name
    result = template_of(sheet, scale=scale, size=size, tabs=depth, slots=slots, hinges=hinges, title=title)
    return pictured(result, sheet)[0] if note else replace(result, steps=())


def _refuse(options: Mapping[str, object], required: str) -> None:
    """Refuse options that belong to another kind of mechanism."""
    refused = [option for option, value in options.items() if value is not None]
    if refused:
        raise InvariantError("template", f"{', '.join(refused)} for another mechanism", required)
