"""``synth realise``: types given coordinates, as flat sheets, as poses in space, or on cones."""

from __future__ import annotations

from math import ceil, log10, radians
from typing import TYPE_CHECKING, Any

import click

from synth.cli.lengths import LENGTH
from synth.cli.output import FORCE, about, check_output, print_answer, print_json, tell_written
from synth.cli.runner import RunOptions
from synth.cli.things.given import MODE, given
from synth.cli.things.realise_many import realise_many
from synth.cli.things.realise_special import SpecialOutput, refuse_others, search_special_geometry

if TYPE_CHECKING:
    from graphs.convert.table import Mechanism
    from synth.realisation.on_cone import OnOneCone
    from synth.realisation.realised import Realised

__all__ = ["realise"]

_FIGURES = 12
"""Decimals of coordinates, in units of the size: those after are other ones on another processor."""


@click.command(short_help="Give a type coordinates: as a flat sheet, as panels in space, or on a cone.")
@click.argument("file", metavar="FILE")
@click.option(
    "--as",
    "kind",
    type=click.Choice(["sheet", "space", "cone"]),
    default="sheet",
    show_default=True,
    help="Kind of realisation.",
)
@click.option(
    "--size", type=LENGTH, help="Longer side of the bounding box of the panels, in any unit.  [default: 1]"
)
@click.option(
    "--lambda", "cone_angle", type=float, metavar="DEGREES",
    help="For --as cone: cone angle, from the plane across its axis.  [default: 30]",
)  # fmt: skip
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    metavar="N",
    default=0,
    show_default=True,
    help="Random seed; another seed gives other coordinates.",
)
@click.option(
    "--tries",
    type=click.IntRange(1, 10_000),
    metavar="N",
    default=12,
    show_default=True,
    help="Largest number of drawings to try.",
)
@click.option(
    "--flat-foldable",
    is_flag=True,
    help="For a sheet: make it flat-foldable; alternate sector angles round each vertex sum to 180 degrees.",
)
@click.option("--symmetric", is_flag=True, help="For a sheet: draw it with symmetries of the type.")
@MODE
@click.option(
    "--freedoms",
    type=click.IntRange(min=1),
    metavar="K",
    help="Find a realisation of special geometry with K degrees of freedom, where a generic one has fewer.",
)
@click.option("--geometry", metavar="TEXT", help="With --freedoms: try only families with TEXT in their name.")
@click.option("--every", is_flag=True, help="With --freedoms: try every family, not only until one moves.")
@click.option("--some-joints", is_flag=True, help="With --freedoms: joints may stay immobile.")
@click.option("--mark", metavar="OUT.json", help="With --freedoms: write the type with a mark of what was found.")
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    help="Write the realisation: .fold, .obj or .svg; .json on a cone; a folder or .sqlite for many types.",
)
@click.option(
    "--workers",
    type=click.IntRange(min=1),
    metavar="N",
    help="For many types: number of processes. By default one per core.",
)
@click.option("--resume", is_flag=True, help="For many types: continue a run that was stopped.")
@click.option("--quiet", is_flag=True, help="For many types: show no progress.")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def realise(
    file: str,
    kind: str,
    size: float | None,
    cone_angle: float | None,
    seed: int,
    tries: int,
    flat_foldable: bool,
    symmetric: bool,
    mode: str | None,
    freedoms: int | None,
    geometry: str | None,
    every: bool,
    some_joints: bool,
    mark: str | None,
    output: str | None,
    workers: int | None,
    resume: bool,
    quiet: bool,
    force: bool,
    as_json: bool,
) -> None:
    """Give a type coordinates. FILE is a file, an id m1:... or k1:..., or an R/- string.

    For a store or an atlas (.sqlite), rows (.jsonl), a graph6 file or a folder, every type is realised: OUT is a
    folder of .fold files, with a store of the result for each type beside it, or a store alone.

    Panels are convex where they can be, creases round a hole point to their centre, and the output reads back as
    the same type. For a graph without a drawing the simplest drawing is taken, and a note says so; a string
    becomes a strip of panels, rectangles between parallel creases. A flat sheet is drawn again until it has a
    folding branch on which every crease turns; its mountains and valleys are those of that branch. It can be made
    flat-foldable and symmetric.

    With --freedoms the type is searched for members that move although counts say they are rigid: flat sheets with
    flat-foldable vertices whose ratios agree, straight lines, parallel creases or symmetries; axes in space that
    are symmetric, parallel or meet in groups, equal links, poses along a motion that close (--as space: axes
    alone). Each is followed by a finite motion in which all joints move. The answer lists what was tried, found or
    not; the first member is written, a sheet as .fold, axes as .json. Exit status 1: none was found.

    A type with one centre can lie on a cone, with all its axes on ruling lines; the output is a file for `synth
    cone`.

    \b
    Examples:
      synth realise m1:a-b.ac-.b-d.cd- -o four-bar.fold
      synth realise RR-R-RRR --mode D -o ups.fold
      synth realise data/wiener/six-bar.json --as space -o six-bar.obj
      synth realise data/wiener/stephenson.json --as cone --lambda 25 -o stephenson.json
      synth realise types.sqlite --as space -o things
      synth realise k1:Cr --freedoms 1 --as space
      synth realise data/linkages/bennett.json --freedoms 1 -o bennett.json --mark type.json
    """
    from graphs.errors import FileError
    from graphs.files.formats import write
    from synth.drawing.catalogue.entries import is_catalogue

    if freedoms is not None:
        search = {"kind": kind, "seed": seed, "tries": tries, "freedoms": freedoms, "geometry": geometry or ""}
        search |= {"every": every, "all_joints": not some_joints}
        others = kind == "cone" or size is not None or flat_foldable or symmetric or mode or workers or resume
        refuse_others(bool(others), "--freedoms goes with --as sheet|space, --seed and --tries, and with one type")
        search_special_geometry(file, search, SpecialOutput(output, mark, force, as_json))
        return
    others = geometry is not None or every or some_joints or mark is not None
    refuse_others(others, "--geometry, --every, --some-joints and --mark are for --freedoms")
    if kind == "cone" and size is not None:
        raise click.UsageError("--size is of panels: a linkage on a cone is given by its angles")
    if kind != "cone" and cone_angle is not None:
        raise click.UsageError("--lambda is for --as cone")
    if kind != "sheet" and (flat_foldable or symmetric):
        raise click.UsageError("--flat-foldable and --symmetric are for --as sheet")
    if mode and (kind == "cone" or is_catalogue(file)):
        raise click.UsageError("--mode is of one R/- string as panels; rows of a list of modes say their own")
    options = {"kind": kind, "size": 1.0 if size is None else size, "seed": seed, "tries": tries}
    options |= {"flat_foldable": True} if flat_foldable else {}
    options |= {"symmetric": True} if symmetric else {}
    if is_catalogue(file):
        if kind == "cone":
            raise click.UsageError("--as cone is for one type at a time")
        running = RunOptions(output, workers, None, resume, quiet, as_json=False, force=force)
        realise_many(file, running, options, as_json=as_json)
        return
    if workers or resume:
        raise click.UsageError("--workers and --resume are for many types: a store, a list or a folder")
    check_output(output, force=force)
    if kind == "cone" and output is not None and not output.lower().endswith(".json"):
        raise FileError(output, "", "a linkage on a cone in a file of another kind", "a name that ends in .json")
    with about(file):
        found, made = (
            _on_cone(file, cone_angle, seed, tries) if kind == "cone" else _as_panels(file, mode, options)
        )
    if output is not None:
        write(made, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **found.to_json()})
        return
    print_answer(found)
    tell_written(output)


def _on_cone(file: str, cone_angle: float | None, seed: int, tries: int) -> tuple[OnOneCone | Realised, Mechanism]:
    from enumerate.strings.panel_strings import ChainString
    from graphs.errors import FileError
    from synth.realisation.on_cone import CONE_ANGLE, realise_on_cone

    thing: Any = given(file).thing
    if isinstance(thing, ChainString):
        raise FileError(file, "", "an R/- string, which has no loop", "a linkage whose axes meet in one centre")
    angle = CONE_ANGLE if cone_angle is None else radians(cone_angle)
    found = realise_on_cone(thing, cone_angle=angle, seed=seed, tries=tries)
    return found, found.linkage


def _as_panels(file: str, mode: str | None, options: dict[str, Any]) -> tuple[OnOneCone | Realised, Mechanism]:
    from synth.patterns.panels import rounded
    from synth.realisation.realised import realise as realised

    thing: Any = given(file).thing
    found = realised(thing, mode=mode, **options)
    return found, rounded(found.sheet, _FIGURES - ceil(log10(options["size"])))
