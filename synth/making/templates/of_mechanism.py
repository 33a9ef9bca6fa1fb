"""The template of any mechanism in one call, as `synth template` makes it."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from enumerate.strings.panel_strings import ChainString
from graphs.convert.conversions import Mechanism
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.mechanism_like import MechanismLike, mechanism_for, with_stated_precision
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Cone, SurfaceLinkage
from graphs.printing import plain
from synth.catalogue.realisation._realise import Kind
from synth.linkages.conformed.orders import OrderOnCircle
from synth.making.templates.hinges import Hinges
from synth.making.templates.on_surface import TemplateSizes, surface_of, template_on_surface
from synth.making.templates.template import (
    FITTED,
    TABS,
    Template,
    linkage_on_a_surface,
    panels_of_mechanism,
    pictured,
    template_of,
    template_of_axes,
    unit_of,
)


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
        Panels with coordinates; a type, which is realised first, by default with a longer side of 150 mm; a spherical
        linkage of axes, whose links become triangles and pyramids at its centre; or a linkage on a cone or cylinder.
    kind : {"sheet", "space"}, optional
        For a type: the kind of realisation; a flat sheet by default.
    mode : str, optional
        For an R/- string: its mode.
    scale : float, optional
        For panels: millimetres per unit of the coordinates. By default that of the file's unit; without a unit
        the longer side is 150 mm.
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
    of_panels: dict[str, Any] = {"kind": kind, "mode": mode, "scale": scale, "tabs": tabs, "slots": slots or None}
    of_panels["hinges"] = hinges
    of_surface = {"cone_angle": cone_angle, "number": number, "radius": radius, "thickness": thickness}
    if isinstance(source, SurfaceLinkage | OrderOnCircle):
        _refuse({**of_panels, "precision": precision}, "a mechanism with panels")
        result = template_of_linkage(source, name, size=size, **_stated(of_surface))
    else:
        _refuse(of_surface, "a linkage on a cone or cylinder")
        panels = with_stated_precision(source, precision)
        result, _ = template_of_panels(panels, name, size=size, picture=note, **_stated(of_panels))
    return result if note else replace(result, steps=())


def _stated(options: dict[str, Any]) -> dict[str, Any]:
    return {option: value for option, value in options.items() if value is not None}


def _refuse(options: dict[str, Any], required: str) -> None:
    """Refuse options that belong to another kind of mechanism."""
    if _stated(options):
        raise InvariantError("template", f"{', '.join(_stated(options))} for another mechanism", required)


def template_of_linkage(
    linkage: SurfaceLinkage | OrderOnCircle,
    name: str,
    *,
    cone_angle: float | None = None,
    number: int | None = None,
    radius: float | None = None,
    **sizes: float | None,
) -> Template:
    """Return the template of a linkage on a cone or a cylinder; `sizes` are those of `TemplateSizes`."""
    cone = None if cone_angle is None else Cone(cone_angle)
    placed = linkage_on_a_surface(linkage, surface=cone, number=number)
    return template_on_surface(placed, surface_of(placed, radius), TemplateSizes(**_stated(sizes)), name)


def template_of_panels(
    mechanism: Mechanism | ChainString,
    name: str,
    *,
    kind: Kind | None = None,
    mode: str | None = None,
    scale: float | None = None,
    size: float | None = None,
    tabs: float = TABS,
    slots: bool = False,
    hinges: Hinges | None = None,
    picture: bool = True,
) -> tuple[Template, list[str]]:
    """Return the template of panels, those of a type realised first, and notes for the command to print."""
    if isinstance(mechanism, HingedSolids):
        if kind is not None or mode is not None or hinges is not None:
            raise UnsolvableError("a kind, a mode or hinges require panels or a type; the links have axes only")
        realised, fitted = "", scale is None and size is None
        size = FITTED if fitted else size
        result, sheet = template_of_axes(mechanism, scale=scale, size=size, tabs=tabs, slots=slots, title=name)
    else:
        sheet, realised = panels_of_mechanism(mechanism, kind=kind, mode=mode)
        fitted = scale is None and size is None and (bool(realised) or unit_of(sheet) is None)
        size = FITTED if fitted else size
        title = sheet.title or name
        result = template_of(sheet, scale=scale, size=size, tabs=tabs, slots=slots, hinges=hinges, title=title)
    notes = [f"{realised}, as by `synth realise`"] if realised else []
    if fitted and realised:
        notes.append(f"a type has no size: its longer side is {FITTED:g} mm; --size changes it")
    elif fitted and result.scale is not None:
        of_unit = f"{result.scale:.4g} mm per unit"
        notes.append(
            f"the file names no unit: the longer side is {FITTED:g} mm, {of_unit}; --scale or --size changes it"
        )
    notes += [f"not shown: {', '.join(result.not_shown)}"] if result.not_shown else []
    if picture:
        result, reason = pictured(result, sheet)
        notes += [f"no picture of the folded sheet: {plain(reason, 1000)}"] if reason else []
    return result, notes
