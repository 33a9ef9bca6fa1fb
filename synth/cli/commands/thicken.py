"""``synth thicken``: a crease pattern with panels of a thickness."""

import click

import synth.thickening
from graphs.errors import check_argument
from synth.cli import options
from synth.cli.output import about, check_output, print_answer, print_json, tell_written
from synth.cli.reading import MECHANISM, PRECISION, precise_sheet, read


@click.command()
@MECHANISM
@options.value("--thickness", "MM", "Thickness of panels, millimetres.", type=options.LENGTH, required=True)
@options.value(
    "--scale", None, "Millimetres per unit of the coordinates.", type=options.LENGTH, default=1.0
)
@options.output("Write the hinged solids (.json), or their shapes (.stl, .3mf, .obj; .gltf with the motion).")
@options.FORCE
@options.JSON
@PRECISION
def thicken(file: str, thickness: float, scale: float, output: str | None, force: bool, as_json: bool) -> None:
    """Give panels a thickness, and move hinges off the plane so that the pattern still folds.

    Each vertex becomes an overconstrained spatial linkage: Bennett's for four creases of a flat-foldable vertex,
    which keeps all fold angles; Myard's for five and the plane-symmetric one of Bricard for six, if sectors and
    assignment are symmetric. One linear programme finds the heights of all hinges with the lowest risers; if there
    are none, vertices and panels whose conditions exclude each other are named. The verdict is that of the solids
    and their hinges. Whether solids meet on the way is not checked.

    \b
    Examples:
      synth generate miura -o miura.fold
      synth thicken miura.fold --thickness 6 --scale 100
      synth thicken miura.fold --thickness 6 --scale 100 -o thick.json
      synth thicken miura.fold --thickness 6 --scale 100 -o thick.gltf
    """
    from graphs.mechanism import Sheet

    check_output(output, force=force)
    mechanism = read(file)
    with about(file):
        check_argument("thicken", mechanism, Sheet)
        thick = synth.thickening.thicken(precise_sheet(mechanism), thickness=thickness, scale=scale)
        lost = thick.write(output, force=force) if output else ()
    if as_json:
        print_json({"file": file, "output": output, **thick.to_json()})
        return
    print_answer(thick)
    if output:
        tell_written(output)
        for part in lost:
            click.echo(f"not in the file: {part}")
