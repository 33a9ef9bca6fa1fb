"""``synth convert``, ``synth reconstruct`` and ``synth id``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import synth
from graphs.errors import UnsolvableError
from synth.cli import options
from synth.cli.output import about, check_output, plain, print_json, print_result, tell_lost
from synth.cli.reading import AT, DRAWN, MECHANISM, read
from synth.exporters import EXPORTERS

if TYPE_CHECKING:
    from graphs.convert import Mechanism
    from graphs.mechanism import SurfaceLinkage

_SOLIDS = tuple(suffix for suffix in EXPORTERS["solids"] if suffix != ".obj")
"""Suffixes of solids alone: OBJ holds sheets too."""


_OF_SOLIDS = {
    "thickness": "--thickness", "gap": "--gap", "scale": "--scale", "size": "--size", "number": "--cone",
}  # fmt: skip
"""Options of files of solids, by their parameters."""
_OF_MODELS = ("density", "drive", "branch", "stiffness", "rest", "moment")


@click.command()
@click.argument("source", metavar="IN", type=options.FILE_NAME)
@click.argument("target", metavar="OUT", type=options.FILE_NAME)
@DRAWN
@options.choice(
    "--to kind", ("sc", "scd", "polyhedron", "vertex-edge", "sheet", "solids", "joints"),
    "Kind of mechanism to convert to first. By default the kind that IN holds.",
)  # fmt: skip
@options.number(
    "--max-degree", "D",
    "If the sides of the links are not known, take the SCD graph whose links have up to D sides, if it is the only "
    "one; with --to scd, polyhedron or sheet.", 3,
)  # fmt: skip
@options.choice(
    "--form", ("planar", "spherical", "general"),
    "Change the centres: planar analogue, spherical analogue, or most general form.",
)  # fmt: skip
@options.choice("--table", ("axes", "vertices"), "Table for a .csv file: joint axes or vertices, in every frame.")
@options.value(
    "--thickness", "MM",
    "Thickness of panels as solids; with --as also of shells and bars.  [default: 1; with --as, extent / 100]",
    type=options.THICKNESS,
)  # fmt: skip
@options.value(
    "--gap", "MM", "Gap between solids at a hinge.  [default: twice the thickness]", type=options.LENGTH_OR_NONE
)
@options.value(
    "--scale", None,
    "For solids: millimetres per unit of the coordinates.  [default: that of the file's unit; without one 1, unless "
    "the longer side would be less than 10 mm: then it is 150 mm; with --as, 1000]",
    type=options.LENGTH,
)  # fmt: skip
@options.value(
    "--size", "MM", "For solids: longest side; for a linkage on a cone or cylinder, length of the ruling lines.",
    type=options.LENGTH,
)  # fmt: skip
@options.NUMBER_OF_SURFACE
@AT
@options.choice(
    "--as model", tuple(EXPORTERS["models"]), "Write rigid bodies and joints for a simulator, or a table of the motion."
)
@options.value("--density", "D", "With --as: density of the bodies in kg/m³.  [default: 1000]", type=options.LENGTH)
@options.repeated(
    "--drive", "JOINT=DEGREES", "With --as: a joint that gets an actuator, and the end of its motion; may be repeated."
)
@options.branch("With --as: motion branch, as for `synth fold`.")
@options.repeated("--stiffness", "JOINT=K", "With --as: torsion spring at a joint, in N m per radian; may be repeated.")
@options.repeated(
    "--rest", "JOINT=DEGREES", "With --as: rest angle of a spring; by default the angle in the file. May be repeated."
)
@options.repeated("--moment", "JOINT=M", "With --as: constant moment at a joint, in N m; may be repeated.")
@options.FORCE
@options.LOSSY
@options.flag("--json as_json", "Print the conversion and its notes as JSON.")
def convert(
    source: str, target: str, kind: str | None, form: str | None, table: str | None, force: bool, lossy: bool,
    as_json: bool, model: str | None, max_degree: int | None, **values: Any,
) -> None:  # fmt: skip
    """Convert a mechanism from one file format to another; the extensions name the formats.

    \b
    Formats read and written:
      .json                native: SC and SCD graphs, models, vertex-edge graphs, linkages on surfaces,
                           solids by their axes, linkages with joints of all kinds
      .fold .svg .cp .obj  crease patterns
      .dxf                 crease patterns (R12 written)
      .g6 .s6              graph6 and sparse6 (nauty): bare link-joint graphs
      .graphml             bare link-joint graphs, or with the type of each joint (R P U S C E)
      .edges .txt          bare link-joint graphs, one joint per line
    Formats read:
      .gml .edgelist       bare link-joint graphs
      .opx                 crease patterns (ORIPA)
      .xml .urdf .sdf      robots (MJCF, ROS, Gazebo): solids by their axes, or joints of all kinds
      .csv                 bare link-joint graphs, as a table of edges

    \b
    Formats written:
      .csv                 with --table: joint axes and angles, or vertices, in each frame of a .fold file
      .stl .3mf .gltf      panels as thin solids, with gaps at hinges, shapes of hinged solids; .obj
                           too, of panels with --thickness;
                           .gltf animates the frames of a .fold file; a linkage on a surface in layers

    \b
    With --as, rigid bodies for simulators:
      mjcf (.xml)          MuJoCo: panels of a thickness, or bars between joint axes; exact hinges, a spanning tree,
                           connections that close the loops, an actuator at the driven joint. Coordinates are
                           metres unless the file, --scale or --size says otherwise
      urdf (.urdf)         ROS: the tree; beside it the loops (.loops.json) and panels (.stl)
      sdf (.sdf)           Gazebo: all joints, those that close loops too
      usd (.usda)          USD Physics: joints that close loops are excluded from the articulation
      step (.step)         CAD: exact solids, an assembly of them, hinge axes as curves
      table (.csv)         joint angles at steps of the driven joint, and the moment that it needs against weight,
                           springs and moments

    Notes list what OUT cannot hold, by kind and number. If OUT would read back as another type (its links, joints
    or centres do not correspond), nothing is written, unless --lossy is given.

    \b
    Examples:
      synth convert crease-pattern.fold mechanism.json
      synth convert crease-pattern.fold model.json --to polyhedron
      synth convert data/hyatt/spherical-four-bar.json four-panels.json --to scd --max-degree 3
      synth convert folded.fold motion.csv --table axes
      synth convert folded.fold folded.stl --size 120 --thickness 0.8
      synth convert watt.json planar-watt.json --form planar
      synth convert stewart.json creases.json --to solids
      synth convert creases.json platform.json --to joints
      synth convert miura.fold miura.xml --as mjcf --size 300 --thickness 1
      synth convert ring.json ring.urdf --as urdf --drive 0=90
    """
    check_output(target, force=force)
    if max_degree is not None and kind not in ("scd", "polyhedron", "sheet"):
        raise click.UsageError("--max-degree: only with --to scd, polyhedron or sheet")
    for_model = {name: values.pop(name) for name in _OF_MODELS}
    if model is None and (Path(target).suffix.lower() == ".csv") != (table is not None):
        raise click.UsageError("--table and an output .csv require each other")
    solid = {name: values[name] for name in _OF_SOLIDS if values[name] is not None}
    if model is None:
        _check_no_model(for_model)
    of_solids = model is None and _is_of_solids(target, solid)
    original = read(source)
    notes: tuple[str, ...] = getattr(original, "notes", ())
    with about(source):
        mechanism = synth.convert(original, kind, form=form, max_degree=max_degree)
        notes = (*notes, *_on_sides(original, max_degree))
        of_solids = of_solids or (model is None and Path(target).suffix.lower() == ".obj" and _has_shapes(mechanism))
        if table is not None:
            from graphs.files.atomic import write_text
            from synth.analysis.moving import table_text

            text, lost = table_text(mechanism, table)
            write_text(Path(target), text, force=force)
        elif model is not None:
            lost, of_model = _write_model(mechanism, target, model, force=force, **solid, **for_model)
            notes = (*notes, *of_model)
        elif of_solids:
            lost, on_size = _write_solids(mechanism, target, force=force, **solid)
            notes = (*notes, *on_size)
        else:
            from graphs.files.formats import write_converted

            source_sheet = original if kind == "sheet" and form is None else None  # a sheet holds less than others
            lost = write_converted(mechanism, target, source_sheet, lossy=lossy, force=force)
    if as_json:
        keys = {"input": source, "output": target, "kind": type(mechanism).__name__, "lost": list(lost)}
        print_json({**keys, "notes": list(notes)})
        return
    from graphs.convert.conversions import kind_in_words

    click.echo(f"written: {plain(target, 4096)} (from: {kind_in_words(mechanism)})")
    tell_lost(lost)
    for note in notes:
        click.echo(f"note: {plain(note, 1000)}")


def _on_sides(original: Mechanism, max_degree: int | None) -> tuple[str, ...]:
    """Return the note on where the sides of the links come from, if the file did not have them."""
    if max_degree is None:
        return ()
    if isinstance(original, synth.SCDGraph | synth.Sheet | synth.PolyhedronModel):
        return ("the file has the sides of the links: --max-degree was not needed",)
    return (f"the only SCD graph of the file whose links have up to {max_degree} sides",)


def _is_of_solids(target: str, solid: dict[str, Any]) -> bool:
    """Check whether a file is written as solids, and refuse options of solids for any other."""
    suffix = Path(target).suffix.lower()
    if solid and suffix not in (*_SOLIDS, ".obj"):
        spelled = ", ".join(_OF_SOLIDS[name] for name in solid)
        raise click.UsageError(f"{spelled}: for solids only ({', '.join(_SOLIDS)} and .obj)")
    return suffix in _SOLIDS or bool(solid)


def _check_no_model(values: dict[str, Any]) -> None:
    """Refuse options of models for simulators for any other file."""
    given = [f"--{name}" for name, value in values.items() if value not in (None, ())]
    if given:
        raise click.UsageError(f"{', '.join(given)}: only with --as")


def _write_model(
    mechanism: Mechanism, target: str, model: str, *, force: bool, drive: tuple[str, ...],
    stiffness: tuple[str, ...], rest: tuple[str, ...], moment: tuple[str, ...], density: float | None, **values: Any,
) -> tuple[tuple[str, ...], tuple[str, ...]]:  # fmt: skip
    """Write a model; return what its format does not hold, and notes on the motion."""
    from graphs.mechanism.solids import HingedSolids
    from synth.analysis.moving import configuration_of
    from synth.making.simulation.assembly import DENSITY, AssemblyOptions, in_unit_of
    from synth.making.simulation.writing import write_assembly

    if "number" in values or "gap" in values:
        raise click.UsageError("--cone and --gap: not with --as")
    at = configuration_of(mechanism, slides=True)
    graph = at.linkage.graph
    how = AssemblyOptions(
        density=density or DENSITY, **values,
        shapes=mechanism.shapes if isinstance(mechanism, HingedSolids) and model == "step" else (),
        drive=options.driven_angles(graph, drive),
        springs=synth.Springs(
            options.numbers_of_joints(graph, stiffness, "--stiffness", "JOINT=K"),
            options.driven_angles(graph, rest, "--rest"),
            options.numbers_of_joints(graph, moment, "--moment", "JOINT=M"),
        ),
    )  # fmt: skip
    assembly = write_assembly(at, target, model, in_unit_of(mechanism, how), force=force)
    return EXPORTERS["models"][model].lost(assembly), assembly.notes


def _has_shapes(mechanism: Mechanism) -> bool:
    """Check whether a mechanism is of hinged solids whose links have shapes."""
    from graphs.mechanism.solids import HingedSolids

    return isinstance(mechanism, HingedSolids) and bool(mechanism.shapes)


def _write_solids(
    mechanism: Mechanism, target: str, *, force: bool, **solid: Any
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Write solids; return what their format does not hold, and notes on their size."""
    from graphs.mechanism.solids import HingedSolids
    from synth.analysis.moving._configuration_of import sheet_of
    from synth.making.templates.solids import fitted_size, write_solids

    if isinstance(mechanism, synth.SurfaceLinkage):
        return _write_on_surface(mechanism, target, force=force, **solid), ()
    if isinstance(mechanism, HingedSolids) and mechanism.shapes:
        from synth.making.templates.solids import write_shapes

        if solid:
            spelled = ", ".join(_OF_SOLIDS[name] for name in solid)
            raise click.UsageError(f"{spelled}: not for hinged solids, whose links have shapes of their own")
        return write_shapes(mechanism, target, force=force), ()
    sheet = sheet_of(mechanism)
    if sheet is None:
        raise UnsolvableError(f"solids require panels, and {mechanism!r} has none")
    solid.pop("number", None)
    fitted = None if {"scale", "size"} & set(solid) else fitted_size(sheet)
    noted = f"the file names no unit: the longer side is {fitted:g} mm; --scale or --size changes it" if fitted else ""
    return write_solids(sheet, target, force=force, **solid), (noted,) if noted else ()


def _write_on_surface(
    linkage: SurfaceLinkage, target: str, *, force: bool, number: int | None = None, **solid: float
) -> tuple[str, ...]:
    from synth.making.templates.on_surface import TemplateSizes, surface_of
    from synth.making.templates.solids import THICKNESS, write_linkage_on_surface
    from synth.making.templates.template import linkage_on_a_surface

    if "scale" in solid:
        raise click.UsageError("--scale is for panels; try --size, the length of the ruling lines")
    placed = linkage_on_a_surface(linkage, number=number)
    gap = solid.pop("gap", 2 * solid.setdefault("thickness", THICKNESS))
    sizes = TemplateSizes(**solid)
    return write_linkage_on_surface(placed, surface_of(placed), target, dimensions=sizes, gap=gap, force=force)


@click.command()
@MECHANISM
@options.output("Write the model to this file (.json or .fold).")
@options.FORCE
@options.LOSSY
@options.flag("--json as_json", "Print the vertices and the counts as JSON.")
def reconstruct(file: str, output: str | None, force: bool, lossy: bool, as_json: bool) -> None:
    """Reconstruct the polyhedron model of a mechanism, vertex by vertex.

    FILE holds an SCD graph, or a crease pattern without flat edges, cuts and split hinges (.fold). The table lists
    the links that meet in each vertex, and the kind of face of the graph in which it lies.

    \b
    Example:
      synth reconstruct data/wiener/six-bar.json -o model.json
    """
    check_output(output, force=force)
    mechanism = read(file)
    with about(file):
        reconstruction = synth.reconstruct(mechanism)
        lost = () if output is None else synth.write(reconstruction.model, output, force=force, lossy=lossy)
    keys = {"file": file, "output": output, "lost": list(lost)}
    print_result(reconstruction, keys, as_json=as_json, written=[output], lost=lost)


@click.command("id")
@options.FILES
@DRAWN
@options.flag("--group", "List one row per type: its id, and the mechanisms that have it.")
@options.choice(
    "--by", ("chain", "drawing"),
    "With --group: group by link-joint graphs, or by drawings with centres.  [default: drawing where all have one]",
)  # fmt: skip
@options.JSON
def id_command(files: tuple[str, ...], group: bool, by: Any, as_json: bool) -> None:
    """Print the canonical ids of mechanisms: equal for mechanisms of one type, different for all others.

    k1:... is the id of the link-joint graph, a chain without centres. m1:... is the id of the mechanism drawn on
    the sphere, with its centres, and with the sides of its links where they are known. Every command that takes a
    FILE takes an id too; write ./k1:... for a file of that name. Several files, or a file of several mechanisms,
    are grouped by type.

    \b
    Examples:
      synth id data/wiener/six-bar.json
      synth id k1:Cr
      synth id --group chains.g6
    """
    if by is not None and not group and len(files) == 1:
        raise click.UsageError("--by requires --group")
    if group or len(files) > 1:
        print_result(synth.types_of(files, by=by), {}, as_json=as_json)
        return
    mechanism = read(files[0])
    with about(files[0]):
        identity = synth.identify(mechanism)
    print_result(identity, {}, as_json=as_json)
