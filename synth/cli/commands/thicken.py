"""``synth thicken``: a crease pattern with panels of a thickness."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import TYPE_CHECKING

import click

import synth.making.thickening
from synth.cli import options
from synth.cli.output import about, check_output, print_answer, print_json, tell_written
from synth.cli.reading import MECHANISM, PRECISION, precise_sheet, read

if TYPE_CHECKING:
    from graphs.mechanism import Sheet
    from synth.making.thickening import ThickSheet


@click.command()
@MECHANISM
@options.value("--thickness", "MM", "Thickness of panels, millimetres.", type=options.LENGTH, required=True)
@options.choice(
    "--how",
    ("spatial", "tapered", "offset", "hinge", "best"),
    "How panels get their thickness: hinges off the plane; sides of panels tapered; panels stepped away by layers; "
    "gaps at flexible strips; or the best of these.",
    default="spatial",
)
@options.value("--angle", "DEG", "Greatest fold angle, degrees; by default 179, for tapered and hinge 150.", type=float)
@options.value(
    "--scale",
    None,
    "Millimetres per unit of the coordinates.  [default: that of the file's unit; without one 1]",
    type=options.LENGTH,
)
@options.value("--size", "MM", "Longer side of the flat sheet, millimetres, in place of --scale.", type=options.LENGTH)
@options.value(
    "--clearance",
    "MM",
    "Clearance between panels that no hinge joins, millimetres; by default a fiftieth of the thickness.",
    type=options.LENGTH,
)
@options.choice(
    "--hinges",
    ("screws", "tape"),
    "Join panels by butt hinges with screws in bores, or by tape; --how hinge uses neither, but a flexible strip over "
    "each gap.",
    default="screws",
)
@options.flag("--no-collisions", "Neither cut panels back nor check whether solids meet.")
@options.output(
    "Write the hinged solids (.json), their shapes (.stl, .3mf, .obj; .gltf with the motion), or templates with holes "
    "and a parts list (.dxf, .svg, .pdf)."
)
@options.FORCE
@options.JSON
@PRECISION
def thicken(
    file: str,
    thickness: float,
    how: str,
    angle: float | None,
    scale: float | None,
    size: float | None,
    clearance: float | None,
    hinges: str,
    no_collisions: bool,
    output: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Give panels a thickness, and move hinges off the plane so that the pattern still folds.

    Each vertex becomes an overconstrained spatial linkage: Bennett's for four creases of a flat-foldable vertex,
    which keeps all fold angles; Myard's for five and the plane-symmetric one of Bricard for six, if sectors and
    assignment are symmetric. One linear programme finds the heights of all hinges with the lowest risers; if there
    are none, vertices and panels whose conditions exclude each other are named. The verdict is that of the solids
    and their hinges. Panels are cut back where they would meet; up to which fold angle none meet is then checked
    for the whole motion, without gaps between frames.

    \b
    Examples:
      synth generate miura -o miura.fold
      synth thicken miura.fold --thickness 6 --scale 100
      synth thicken miura.fold --thickness 6 --size 300 -o thick.json
      synth thicken miura.fold --thickness 6 --scale 100 -o thick.gltf
    """
    from graphs.files.mechanism_like import mechanism_for
    from graphs.mechanism import Sheet

    check_output(output, force=force)
    mechanism = read(file)
    with about(file):
        sheet = precise_sheet(mechanism_for("thicken", mechanism, Sheet))
        thick = synth.making.thickening.thicken(
            sheet,
            thickness=thickness,
            how=how,
            angle=None if angle is None else radians(angle),
            scale=_scale(sheet, scale, size),
            clearance=clearance,
            hinges=hinges,
            collisions=not no_collisions,
        )
        written, lost = _written(thick, output, force=force) if output else ((), ())
    if as_json:
        print_json({"file": file, "output": output, **thick.to_json()})
        return
    print_answer(thick)
    for name in written:
        tell_written(name)
    for part in lost:
        click.echo(f"not in the file: {part}")


def _scale(sheet: Sheet, scale: float | None, size: float | None) -> float:
    """Return the millimetres per unit of the coordinates of a sheet, by a scale, a size, or the unit of its file."""
    from graphs.mechanism.precision import in_space
    from synth.making.templates.template import millimetres, scale_of

    if size is None or sheet.coordinates is None:
        return scale_of(sheet, scale, size) or 1.0
    return millimetres(in_space(sheet.coordinates), scale, size)


def _written(thick: ThickSheet, output: str, *, force: bool) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Write what the extension says; return the files, and what they do not hold."""
    from synth.exporters import EXPORTERS
    from synth.making.templates.writing import write_template

    if Path(output).suffix.lower() in EXPORTERS["templates"]:
        return tuple(map(str, write_template(thick.template(), output, force=force))), ()
    return (output,), thick.write(output, force=force)
