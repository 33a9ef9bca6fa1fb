"""``synth fold``, ``positions``, ``explain``, ``advise``, ``states``, ``limits``: motion from a configuration."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import wraps
from math import radians
from typing import TYPE_CHECKING, Any

import click

import synth.analysis.compliance
import synth.analysis.moving
from graphs.errors import UnsolvableError
from graphs.garbage import set_aside
from synth.cli import options
from synth.cli.output import about, console, plain, print_json, print_result, progress_line, table, tell_written
from synth.cli.reading import AT, MECHANISM, PRECISION, precise, read

if TYPE_CHECKING:
    from graphs.convert import Mechanism
    from graphs.types import LinkId


def _answering(
    no: Callable[[Any], bool] = lambda _answer: False,
) -> Callable[[Callable[..., Any]], Callable[..., None]]:
    """Return what makes a command of a function of a mechanism: it reads FILE, and prints the answer.

    With the answer "no" the exit status is 1.
    """

    def decorated(answer_of: Callable[..., Any]) -> Callable[..., None]:
        @wraps(answer_of)
        def run_command(file: str, as_json: bool, **values: Any) -> None:
            mechanism = read(file)
            with about(file):
                answer = answer_of(precise(mechanism), **values)
            print_result(answer, {"file": file}, as_json=as_json)
            if no(answer):
                sys.exit(1)

        return AT(options.JSON(PRECISION(run_command)))

    return decorated


@click.command()
@MECHANISM
@options.repeated(
    "--drive", "JOINT=DEGREES", "Fold a crease to this angle, or rotate another joint by it; may be repeated."
)
@options.repeated(
    "--along", "JOINT=RATE", "Initial joint rates; the motion keeps their direction if it can. May be repeated."
)
@options.repeated(
    "--point points", "LINK=X,Y[,Z]",
    "Print the position of this point of a link in each frame (a coupler curve); may be repeated."
)  # fmt: skip
@options.flag(
    "--all whole",
    "Fold all creases together, with one degree of freedom. This is the default without --drive and --along.",
)
@options.branch("Folding branch from a flat state, by its number or its signs; --branches lists them.")
@options.flag("--branches listed", "List the motion branches from this configuration.")
@options.number("--frames", "N", "Number of frames after the first.", most=10_000, default=20)
@options.flag("--collisions", "Stop the motion before panels pass through each other.")
@AT
@options.output(
    "Write the motion: .fold with frames, a series of .obj files, a .gif, or a strip of pictures (.png, .svg)."
)
@options.FORCE
@options.JSON
@PRECISION
def fold(
    file: str, drive: tuple[str, ...], along: tuple[str, ...], whole: bool, listed: bool, frames: int,
    points: tuple[str, ...], output: str | None, force: bool, as_json: bool, **how: Any,
) -> None:  # fmt: skip
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
    from synth.making.drawing.space.motion_files import check_motion_file, write_motion

    if sum(map(bool, (whole, drive, along))) > 1:
        raise click.UsageError("--drive, --along and --all exclude each other; try one of them")
    if output is not None:
        check_motion_file(output, force=force)
    with set_aside(until=click.get_current_context().call_on_close):
        mechanism = read(file, warn=False)
        with about(file):
            at = synth.analysis.moving.configuration_of(precise(mechanism))
            graph = at.linkage.graph
    with about(file):
        with progress_line() as show:
            motion = synth.move(
                at, drive=options.driven_angles(graph, drive),
                along=options.numbers_of_joints(graph, along, "--along", "JOINT=RATE"),
                frames=frames, report=lambda n: show(f"{n} of {frames + 1} frames"), **how,
            )  # fmt: skip
        curves = {text: motion.path_of(*_point(graph, text)).tolist() for text in points}
        written = [] if output is None else write_motion(motion, output, force=force)
    if as_json:
        print_json({"file": file, "output": output, **motion.to_json(), "points": curves})
        return
    if listed and motion.branches is not None:
        rows = table("branch", "DOF", "evidence", "immobile", "signs", numbers=["branch", "DOF", "immobile"])
        for number, folding in enumerate(motion.branches.branches):
            freedoms = "?" if folding.freedoms is None else str(folding.freedoms)
            immobile = str(len(folding.immobile))
            rows.add_row(str(number), freedoms, folding.certainty, immobile, plain(folding.signs, 4096))
        console().print(rows)
    click.echo(str(motion))
    for text, places in curves.items():
        rows = table("frame", "x", "y", "z", title=f"point {plain(text)}", numbers=["frame", "x", "y", "z"])
        for number, place in enumerate(places):
            rows.add_row(str(number), *(f"{x + 0.0:.9g}" for x in place))
        console().print(rows)
    tell_written(*written)


def _graph(mechanism: Any) -> synth.SCGraph:
    """Return the graph of a mechanism at its configuration, whose links and joints are named."""
    return synth.analysis.moving.configuration_of(mechanism).linkage.graph


def _point(graph: synth.SCGraph, text: str) -> tuple[LinkId, list[float]]:
    """Return a link and the coordinates of a point, as they were typed."""
    name, place = options.named_value(text, "--point", "LINK=X,Y or LINK=X,Y,Z", (2, 3))
    return options.link_of(graph, name), place


@click.command()
@MECHANISM
@options.repeated(
    "--drive", "JOINT=DEGREES",
    "Angle of a driven joint in degrees, or length of a prismatic one; once for each degree of freedom."
)  # fmt: skip
@options.flag("--circuits/--no-circuits", "Sort the assembly modes by circuit and branch of the circuit.", default=True)
@options.seed("Random seed.")
@_answering(no=lambda modes: not modes.positions or not modes.exhaustive)
def positions(mechanism: Any, drive: tuple[str, ...], **how: Any) -> Any:
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
    at = synth.analysis.moving.configuration_of(mechanism, slides=True)
    slides = {joint for place, joint in enumerate(at.joints) if place in at.linkage.slides}
    values = options.numbers_of_joints(at.linkage.graph, drive, "--drive", "JOINT=DEGREES")
    inputs = {joint: value if joint in slides else radians(value) for joint, value in values.items()}
    return synth.positions(at, drive=inputs, **how)


@click.command()
@MECHANISM
@_answering()
def explain(mechanism: Any) -> Any:
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
    return synth.explain(mechanism)


@click.command()
@MECHANISM
@options.number("--freedoms", "K", "Number of degrees of freedom to reach.", 0, required=True)
@options.branch(
    "Folding branch from a flat state, by its number or its signs; `synth fold --branches` lists them.", "B"
)
@options.repeated("--weight", "JOINT=W", "Cost of locking a joint, 1 by default; may be repeated.")
@options.repeated("--protect-joint", "JOINT", "Joint that must not be locked; may be repeated.")
@options.repeated(
    "--protect-link", "LINK",
    "Link whose joints must not be locked, and which must not be creased; may be repeated."
)  # fmt: skip
@options.flag(
    "--flaps/--no-flaps",
    "Lock the joints of flaps too, and allow diagonals that cut off a corner as a flap.",
    default=True,
)
@options.number("--limit", "N", "Largest number of sets to list.", most=10_000, default=20)
@options.number("--size", "N", "Largest number of diagonals in a set. By default K - M + 1.")
@options.flag("--leave-out", "For a flat sheet: also report its degrees of freedom without the locked creases.")
@_answering(no=lambda advice: advice.wanted > advice.freedoms and not advice.creases)
def advise(
    mechanism: Any, freedoms: int, weight: tuple[str, ...], protect_joint: tuple[str, ...],
    protect_link: tuple[str, ...], **how: Any,
) -> Any:  # fmt: skip
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
    from graphs.convert import mechanism_of_sheet
    from synth.analysis.moving._configuration_of import sheet_of

    sheet = sheet_of(mechanism)
    graph = _graph(mechanism) if sheet is None else mechanism_of_sheet(sheet).sc
    return synth.advise(
        mechanism, freedoms,
        weights=options.numbers_of_joints(graph, weight, "--weight", "JOINT=W"),
        joints=[options.joint_of(graph, name) for name in protect_joint],
        links=[options.link_of(graph, name) for name in protect_link], **how,
    )  # fmt: skip


@click.command()
@MECHANISM
@options.repeated("--joint joints", "JOINT", "Compliant joint; may be repeated.")
@options.repeated("--link links", "LINK", "Compliant link; may be repeated.")
@options.repeated(
    "--stiffness", "JOINT=K",
    "Stiffness of a torsion spring at a joint, as moment per radian; the joint is compliant. May be repeated."
)  # fmt: skip
@options.repeated(
    "--rest", "JOINT=DEGREES", "Rest angle of a spring. By default the angle in the file. May be repeated."
)
@options.repeated("--moment", "JOINT=M", "Constant moment at a joint; may be repeated.")
@options.value("--drive", "JOINT=DEGREES", "Joint and final angle of the load path.")
@options.number("--frames", "N", "Number of configurations on the path after the first.", most=10_000, default=20)
@options.repeated("--mass", "LINK=M@X,Y,Z", "Point mass on a link; may be repeated.")
@options.value("--density", "D", "For a sheet: mass per unit area of its panels.", type=options.LENGTH)
@options.value("--ground", "LINK", "Fixed link, for frequencies.")
@_answering()
def states(
    mechanism: Any, joints: tuple[str, ...], links: tuple[str, ...], stiffness: tuple[str, ...],
    rest: tuple[str, ...], moment: tuple[str, ...], drive: str | None, frames: int, mass: tuple[str, ...],
    density: float | None, ground: str | None,
) -> Any:  # fmt: skip
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
    graph = _graph(mechanism)
    springs = synth.analysis.compliance.Springs(
        options.numbers_of_joints(graph, stiffness, "--stiffness", "JOINT=K"),
        options.driven_angles(graph, rest, "--rest"),
        options.numbers_of_joints(graph, moment, "--moment", "JOINT=M"),
    )
    load_path = None
    if drive is not None:
        [(joint, angle)] = options.driven_angles(graph, (drive,)).items()
        load_path = synth.analysis.compliance.DrivenJoint(joint, angle, frames)
    return synth.states(
        mechanism,
        joints=[options.joint_of(graph, name) for name in joints],
        links=[options.link_of(graph, name) for name in links],
        springs=springs if stiffness or rest or moment else None,
        drive=load_path,
        masses=_masses(mechanism, graph, mass, density, ground),
    )


def _masses(
    mechanism: Mechanism, graph: synth.SCGraph, words: tuple[str, ...], density: float | None, ground: str | None
) -> synth.analysis.compliance.Masses | None:
    """Return the masses of the options --mass, --density and --ground."""
    from synth.analysis.moving._configuration_of import sheet_of

    if not words and density is None:
        if ground is not None:
            raise click.UsageError("--ground requires --mass or --density: it is the fixed link for frequencies")
        return None
    points = [_mass(graph, word) for word in words]
    if density is not None:
        sheet = sheet_of(mechanism)
        if sheet is None:
            raise UnsolvableError("--density requires panels, and the mechanism has none; try --mass")
        points += synth.analysis.compliance.sheet_masses(sheet, density)
    return synth.analysis.compliance.Masses(tuple(points), options.link_of(graph, ground))


def _mass(graph: synth.SCGraph, word: str) -> synth.analysis.compliance.Mass:
    """Return the point mass of a word ``LINK=M@X,Y,Z``."""
    link, _, rest = word.rpartition("=")
    value, _, place = rest.partition("@")
    try:
        weight, (x, y, z) = float(value), map(float, place.split(","))
    except ValueError:
        link = ""
    if not link:
        raise click.BadParameter(f"{plain(word)!r} is not LINK=M@X,Y,Z", param_hint="--mass")
    return synth.analysis.compliance.Mass(options.link_of(graph, link.strip()), weight, (x, y, z))


@click.command()
@MECHANISM
@options.repeated("--keep", "LINK", "Link that belongs to the mechanism proper, not to a ride-along; may be repeated.")
@_answering()
def limits(mechanism: Any, keep: tuple[str, ...]) -> Any:
    """Find the joint limits that ride-alongs impose, and the mobility while one is held straight.

    The analysis starts at the configuration of the file. A ride-along stops its joint where its own two links are
    in line: stretched, one beyond the other, or folded, one on the other. Angles are those of `synth fold`, in
    degrees.

    \b
    Examples:
      synth generate deployable-cylinder --pleats 3 -o cylinder.fold
      synth limits cylinder.fold
    """
    graph = _graph(mechanism)
    return synth.analysis.compliance.limits(mechanism, keep=[options.link_of(graph, name) for name in keep])
