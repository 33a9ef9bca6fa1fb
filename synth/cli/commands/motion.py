"""``synth fold``, ``positions``, ``explain``, ``advise``, ``states``, ``limits``: motion from a configuration."""

from __future__ import annotations

import sys
from math import radians
from typing import TYPE_CHECKING

import click

from synth.cli.options import BRANCH, FORCE, LENGTH, driven_angles, named_value, numbers_of_joints
from synth.cli.output import about, console, plain, print_json, print_report, progress_line, table, tell_written
from synth.cli.reading import DRAWN, PRECISION, precise, read

if TYPE_CHECKING:
    from graphs.convert.table import Mechanism
    from graphs.mechanism.sc import SCGraph
    from graphs.types import LinkId
    from synth.compliance.compliance_states import DrivenJoint
    from synth.compliance.springs import Mass, Masses

__all__ = ["advise", "explain", "fold", "limits", "positions", "states"]


@click.command(short_help="Fold a crease pattern with rigid panels; list its folding branches.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--drive", multiple=True, metavar="JOINT=DEGREES", help="Fold a crease to this angle; may be repeated."
)
@click.option(
    "--along", multiple=True, metavar="JOINT=RATE",
    help="Initial joint rates; the motion keeps their direction if it can.",
)  # fmt: skip
@click.option(
    "--point", "points", multiple=True, metavar="LINK=X,Y[,Z]",
    help="Print where this point of a link is in each frame (a coupler curve); may be repeated.",
)  # fmt: skip
@click.option(
    "--all", "whole", is_flag=True,
    help="Fold all creases together, with one degree of freedom. This is the default without --drive and --along.",
)  # fmt: skip
@click.option(
    "--branch", type=BRANCH, metavar="K",
    help="Folding branch from a flat state, by its number or its signs; --branches lists them.",
)  # fmt: skip
@click.option("--branches", "listed", is_flag=True, help="List the motion branches from this configuration.")
@click.option(
    "--frames", type=click.IntRange(1, 10_000), metavar="N", default=20, show_default=True,
    help="Number of frames after the first.",
)  # fmt: skip
@click.option("--collisions", is_flag=True, help="Stop the motion before panels pass through each other.")
@click.option(
    "-o", "--output", metavar="OUT",
    help="Write the motion: .fold with frames, a series of .obj files, a .gif, or a strip of "
    "pictures (.png, .svg).",
)  # fmt: skip
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def fold(
    file: str,
    drive: tuple[str, ...],
    along: tuple[str, ...],
    whole: bool,
    branch: int | str | None,
    listed: bool,
    frames: int,
    points: tuple[str, ...],
    collisions: bool,
    output: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fold a crease pattern, or move another linkage, with rigid panels and closed loops.

    Fold angles are in degrees, valleys positive; the loop-closure residual is below 1e-12 in every frame. A flat
    state may have several folding branches; --branch chooses one, by default the one that agrees best with the
    mountains and valleys of the file. Without --drive, and with --all, the crease that moves most is folded until
    the motion stops, and the others follow. With several degrees of freedom, --along gives the direction: rates of
    some creases; the others move as little as possible. JOINT is an id, or two links A,B. Every fold angle keeps
    its sign as long as some motion allows it; the answer names creases that change sign, creases folded against
    their assignment, and frames in which panels pass through each other. A linkage without panels (solids hinged
    at edges, rods, a linkage on its cone) moves by joint angles, measured from the configuration of the file; -o
    draws solids (.png, .svg, .gif).

    \b
    Examples:
      synth fold data/patterns/bird-base.fold --branches
      synth fold data/patterns/four-bar-vertex.fold --drive 2=90 --frames 5 -o folded.fold
      synth fold data/patterns/bird-base.fold --all -o folded.gif
      synth fold data/linkages/sarrus.json --frames 11 -o rising.svg
    """
    from synth.drawing.space.poses import check_motion_file, write_motion
    from synth.moving.made import configuration_of
    from synth.moving.motion import move

    if sum(map(bool, (whole, drive, along))) > 1:
        raise click.UsageError("--drive, --along and --all exclude each other; try one of them")
    if output is not None:
        check_motion_file(output, force=force)
    mechanism = read(file, warn=False)
    with about(file):
        mechanism = precise(mechanism)
        at = configuration_of(mechanism)
        graph = at.linkage.graph
        with progress_line() as show:
            motion = move(
                at,
                drive=driven_angles(graph, drive),
                along=numbers_of_joints(graph, along, "--along", "JOINT=RATE"),
                branch=branch,
                frames=frames,
                collisions=collisions,
                report=lambda made: show(f"{made} of {frames + 1} frames"),
            )
        curves = {text: motion.path_of(*_point(graph, text)).tolist() for text in points}
        written = [] if output is None else write_motion(motion, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **motion.to_json(), "points": curves})
        return
    if listed and motion.branches is not None:
        rows = table("branch", "DOF", "evidence", "immobile", "signs", numbers=["branch", "DOF", "immobile"])
        for number, folding in enumerate(motion.branches.branches):
            freedoms = "?" if folding.freedoms is None else str(folding.freedoms)
            immobile = str(len(folding.still))
            rows.add_row(str(number), freedoms, folding.certainty, immobile, plain(folding.signs, 4096))
        console().print(rows)
    click.echo(str(motion))
    for text, places in curves.items():
        rows = table("frame", "x", "y", "z", title=f"point {plain(text)}", numbers=["frame", "x", "y", "z"])
        for number, place in enumerate(places):
            rows.add_row(str(number), *(f"{x + 0.0:.9g}" for x in place))
        console().print(rows)
    tell_written(*written)


def _point(graph: SCGraph, text: str) -> tuple[LinkId, list[float]]:
    """Return a link and the coordinates of a point, as they were typed."""
    from graphs.edit.named import link_named

    name, place = named_value(text, "--point", "LINK=X,Y or LINK=X,Y,Z", (2, 3))
    return link_named(graph, name), place


@click.command(short_help="Find all assembly modes of a spherical or planar linkage at given inputs.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--drive", multiple=True, metavar="JOINT=DEGREES",
    help="Angle of a driven joint in degrees, or length of a prismatic one; once for each degree of freedom.",
)  # fmt: skip
@click.option(
    "--circuits/--no-circuits", default=True, show_default=True,
    help="Sort the assembly modes by circuit and branch of the circuit.",
)  # fmt: skip
@click.option("--seed", type=click.IntRange(0), metavar="N", default=0, show_default=True, help="Random seed.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def positions(file: str, drive: tuple[str, ...], circuits: bool, seed: int, as_json: bool) -> None:
    """Find all assembly modes of a linkage of spherical and planar loops at given inputs.

    Crease angles are measured from flat, other joint angles from the configuration of the file, in degrees; a
    prismatic joint takes a length in the unit of the file. Configurations of one circuit can be reached from each
    other; on one branch of the circuit, without the driven joint turning back. A linkage of mobility 0 needs no
    driven joint; its assembly modes are found. JOINT is an id, or two links A,B.

    \b
    Examples:
      synth generate four-bar -o ring.json
      synth positions ring.json --drive 0=10
      synth positions data/patterns/four-bar-vertex.fold --drive 2=90

    Exit status 1: the linkage has no assembly mode at these inputs, or not all were found.
    """
    from synth.assembly.modes import positions as assembly_modes
    from synth.moving.made import configuration_of

    mechanism = read(file)
    with about(file):
        at = configuration_of(precise(mechanism), slides=True)
        slides = {joint for place, joint in enumerate(at.joints) if place in at.linkage.slides}
        values = numbers_of_joints(at.linkage.graph, drive, "--drive", "JOINT=DEGREES")
        inputs = {joint: value if joint in slides else radians(value) for joint, value in values.items()}
        modes = assembly_modes(at, drive=inputs, circuits=circuits, seed=seed)
    print_report(file, modes, as_json=as_json)
    if not modes.positions or not modes.exhaustive:
        sys.exit(1)


@click.command(short_help="Explain why a mechanism moves although counts say that it is rigid.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def explain(file: str, as_json: bool) -> None:
    """Find the redundant closure equations, the geometry that causes them, and the axis errors they tolerate.

    The analysis is at the configuration of the file; fold a flat pattern first. Axis errors are for one axis at a
    time, in the worst direction: the size at which a redundant equation constrains as much as the weakest
    independent one.

    \b
    Examples:
      synth explain data/linkages/bennett.json
      synth generate miura --rows 4 --columns 4 --fold 60 -o miura.fold
      synth explain miura.fold
    """
    from synth.overconstraint.explanation import explain as explained

    mechanism = read(file)
    with about(file):
        explanation = explained(precise(mechanism))
    print_report(file, explanation, as_json=as_json)


@click.command(short_help="Find joints to lock, or panels to crease, for a number of degrees of freedom.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--freedoms", type=click.IntRange(0), required=True, metavar="K", help="Number of degrees of freedom to reach."
)
@click.option(
    "--branch", type=BRANCH, metavar="B",
    help="Folding branch from a flat state, by its number or its signs; `synth fold --branches` lists them.",
)  # fmt: skip
@click.option(
    "--weight", multiple=True, metavar="JOINT=W", help="Cost of locking a joint, 1 by default; may be repeated."
)
@click.option(
    "--protect-joint", multiple=True, metavar="JOINT", help="Joint that must not be locked; may be repeated."
)
@click.option(
    "--protect-link", multiple=True, metavar="LINK",
    help="Link whose joints must not be locked, and which must not be creased; may be repeated.",
)  # fmt: skip
@click.option(
    "--flaps/--no-flaps", default=True, show_default=True,
    help="Lock the joints of flaps too, and allow diagonals that cut off a corner as a flap.",
)  # fmt: skip
@click.option(
    "--limit", type=click.IntRange(1, 10_000), metavar="N", default=20, show_default=True,
    help="Largest number of sets to list.",
)  # fmt: skip
@click.option(
    "--size", type=click.IntRange(1), metavar="N",
    help="Largest number of diagonals in a set. By default K - M + 1.",
)  # fmt: skip
@click.option(
    "--leave-out", is_flag=True,
    help="For a flat sheet: also report its degrees of freedom without the locked creases.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def advise(
    file: str,
    freedoms: int,
    branch: int | str | None,
    weight: tuple[str, ...],
    protect_joint: tuple[str, ...],
    protect_link: tuple[str, ...],
    flaps: bool,
    limit: int,
    size: int | None,
    leave_out: bool,
    as_json: bool,
) -> None:
    """Find joints to lock, or panels to crease along diagonals, so that K degrees of freedom are left.

    To lower M degrees of freedom to K, M - K joints have to be locked: all such sets are listed, cheapest first.
    To raise M to K, at least K - M diagonals have to be creased: the smallest sets are listed, each tested by
    folding. From a flat state, the folding branch is the one of the mountain-valley assignment, or that of
    --branch. Play is the largest factor by which play in the locked joints is amplified in the others. JOINT is an
    id, or two links A,B.

    \b
    Examples:
      synth advise data/patterns/bird-base.fold --freedoms 0
      synth generate miura --rows 4 --columns 4 --fold 60 -o miura.fold
      synth advise miura.fold --freedoms 2

    Exit status 1: no set of diagonals was found.
    """
    from graphs.convert.duality import mechanism_of_sheet
    from graphs.edit.named import joint_named, link_named
    from synth.advice.advice import advise as advised
    from synth.moving.made import configuration_of, sheet_of

    mechanism = read(file)
    with about(file):
        mechanism = precise(mechanism)
        sheet = sheet_of(mechanism)
        graph = configuration_of(mechanism).linkage.graph if sheet is None else mechanism_of_sheet(sheet).sc
        advice = advised(
            mechanism,
            freedoms,
            branch=branch,
            weights=numbers_of_joints(graph, weight, "--weight", "JOINT=W"),
            joints=[joint_named(graph, name) for name in protect_joint],
            links=[link_named(graph, name) for name in protect_link],
            flaps=flaps,
            limit=limit,
            size=size,
            leave_out=leave_out,
        )
    print_report(file, advice, as_json=as_json)
    if advice.wanted > advice.freedoms and not advice.creases:
        sys.exit(1)


@click.command(short_help="Analyse compliant members: mobility in each compliance state, springs, frequencies.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("--joint", "joints", multiple=True, metavar="JOINT", help="Compliant joint; may be repeated.")
@click.option("--link", "links", multiple=True, metavar="LINK", help="Compliant link; may be repeated.")
@click.option(
    "--stiffness", multiple=True, metavar="JOINT=K",
    help="Stiffness of a torsion spring at a joint, as moment per radian; the joint is "
    "compliant. May be repeated.",
)  # fmt: skip
@click.option(
    "--rest", multiple=True, metavar="JOINT=DEGREES",
    help="Rest angle of a spring. By default the angle in the file. May be repeated.",
)  # fmt: skip
@click.option("--moment", multiple=True, metavar="JOINT=M", help="Constant moment at a joint; may be repeated.")
@click.option("--drive", metavar="JOINT=DEGREES", help="Joint and final angle of the load path.")
@click.option(
    "--frames", type=click.IntRange(1, 10_000), metavar="N", default=20, show_default=True,
    help="Number of configurations on the path after the first.",
)  # fmt: skip
@click.option("--mass", multiple=True, metavar="LINK=M@X,Y,Z", help="Point mass on a link; may be repeated.")
@click.option("--density", type=LENGTH, metavar="D", help="For a sheet: mass per unit area of its panels.")
@click.option("--ground", metavar="LINK", help="Fixed link, for frequencies.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def states(
    file: str,
    joints: tuple[str, ...],
    links: tuple[str, ...],
    stiffness: tuple[str, ...],
    rest: tuple[str, ...],
    moment: tuple[str, ...],
    drive: str | None,
    frames: int,
    mass: tuple[str, ...],
    density: float | None,
    ground: str | None,
    as_json: bool,
) -> None:
    """Check whether a mechanism moves with its compliant members at rest, and with some of them active.

    A member at rest is rigid, an active one is released. With springs, the answer has their equilibrium, the
    moments along the path of a driven joint, and the modes and frequencies of small motions. Use units of one
    system, such as N, mm and tonnes. JOINT is an id, or two links A,B; angles are those of `synth fold`, in
    degrees.

    \b
    Examples:
      synth generate four-bar -o four-bar.json
      synth states four-bar.json --joint 0 --joint 2
      synth states four-bar.json --stiffness 1=2 --drive 0=40 --frames 8
    """
    from graphs.edit.named import joint_named, link_named
    from synth.compliance.compliance_states import states as stated
    from synth.compliance.springs import Springs
    from synth.moving.made import configuration_of

    mechanism = read(file)
    with about(file):
        mechanism = precise(mechanism)
        graph = configuration_of(mechanism).linkage.graph
        springs = Springs(
            numbers_of_joints(graph, stiffness, "--stiffness", "JOINT=K"),
            driven_angles(graph, rest, "--rest"),
            numbers_of_joints(graph, moment, "--moment", "JOINT=M"),
        )
        report = stated(
            mechanism,
            joints=[joint_named(graph, name) for name in joints],
            links=[link_named(graph, name) for name in links],
            springs=springs if stiffness or rest or moment else None,
            drive=_drive(graph, drive, frames),
            masses=_masses(mechanism, graph, mass, density, ground),
        )
    print_report(file, report, as_json=as_json)


def _drive(graph: SCGraph, word: str | None, frames: int) -> DrivenJoint | None:
    from synth.compliance.compliance_states import DrivenJoint

    if word is None:
        return None
    [(joint, angle)] = driven_angles(graph, (word,)).items()
    return DrivenJoint(joint, angle, frames)


def _masses(
    mechanism: Mechanism, graph: SCGraph, words: tuple[str, ...], density: float | None, ground: str | None
) -> Masses | None:
    """Return the masses of the options --mass, --density and --ground."""
    from graphs.edit.named import link_named
    from graphs.errors import UnsolvableError
    from synth.compliance.springs import Masses, sheet_masses
    from synth.moving.made import sheet_of

    if not words and density is None:
        if ground is not None:
            raise click.UsageError("--ground requires --mass or --density: it is the fixed link for frequencies")
        return None
    points = [_mass(graph, word) for word in words]
    if density is not None:
        sheet = sheet_of(mechanism)
        if sheet is None:
            raise UnsolvableError("--density requires panels, and the mechanism has none; try --mass")
        points += sheet_masses(sheet, density)
    return Masses(tuple(points), None if ground is None else link_named(graph, ground))


def _mass(graph: SCGraph, word: str) -> Mass:
    """Return the point mass of a word ``LINK=M@X,Y,Z``."""
    from graphs.edit.named import link_named
    from synth.compliance.springs import Mass

    link, _, rest = word.rpartition("=")
    value, _, place = rest.partition("@")
    try:
        weight, (x, y, z) = float(value), map(float, place.split(","))
    except ValueError:
        link = ""
    if not link:
        raise click.BadParameter(f"{plain(word)!r} is not LINK=M@X,Y,Z", param_hint="--mass")
    return Mass(link_named(graph, link.strip()), weight, (x, y, z))


@click.command(short_help="Find the joint limits that ride-alongs impose, and the truss they form when held.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--keep", multiple=True, metavar="LINK",
    help="Link that belongs to the mechanism proper, not to a ride-along; may be repeated.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def limits(file: str, keep: tuple[str, ...], as_json: bool) -> None:
    """Find the joint limits that ride-alongs impose, and the mobility while one is held straight.

    The analysis starts at the configuration of the file. A ride-along stops its joint where its own two links are
    in line: stretched, one beyond the other, or folded, one on the other. Angles are those of `synth fold`, in
    degrees.

    \b
    Examples:
      synth generate deployable-cylinder --pleats 3 -o cylinder.fold
      synth limits cylinder.fold
    """
    from graphs.edit.named import link_named
    from synth.compliance.joint_limits import limits as limits_of
    from synth.moving.made import configuration_of

    mechanism = read(file)
    with about(file):
        mechanism = precise(mechanism)
        graph = configuration_of(mechanism).linkage.graph
        joint_limits = limits_of(mechanism, keep=[link_named(graph, name) for name in keep])
    print_report(file, joint_limits, as_json=as_json)
