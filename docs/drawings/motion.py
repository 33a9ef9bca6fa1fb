"""Motion: branches, linkages that move, positions, joints of all kinds, mended sheets."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import cos, degrees, radians, sin

import numpy as np
from scipy.spatial.transform import Rotation

import synth
from drawings.altered import DASH, DOTTED, over
from drawings.examples import generated_sheet, generated_solids, sheet_of_file, with_places
from drawings.patterned import Patterned
from drawings.pieces import head, on_air
from drawings.together import above, beside, said
from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import numbered
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.derivatives import SheetDerivatives
from synth.analysis.members import arcs_of
from synth.analysis.motion.branches import branches_of
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.motion import Motion
from synth.analysis.motion.path import circuit_through
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.drawing import Scene
from synth.making.drawing.mechanisms.flat_folded import flat_folded_scene
from synth.making.drawing.scene.frame import PictureOptions, Plot, signed
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Shape,
    colour_of_class,
)
from synth.making.drawing.space.motion_files import frame_scenes
from synth.making.drawing.space.panels import bodies_of, places_of_hinges

__all__ = ["DRAWINGS"]

_POSE = 2
"""The frame of a folding that is shown, of six."""
_STILL = 1e-6
_HALF_FOLDED, _CORNERS, _ARROW = 3, [0, 8], 18.0
"""The frame of which derivatives are drawn, the corners between which a distance is, and points per unit."""
_ASLANT, _LARGER = 0.5, 300
"""How far a sheet is turned before its coordinates are rounded; how much larger the errors are drawn."""


def folding() -> Scene:
    """The branches of a flat Miura sheet: creases as they begin, and a pose on each."""
    sheet = generated_sheet("miura", rows=3, columns=3)
    branches = configuration_of_sheet(sheet).branches
    assert branches is not None
    columns = [_branch(sheet, number, branch.freedoms) for number, branch in enumerate(branches.branches)]
    words = "creases as each way begins: mountains red, valleys blue and dashed, immobile creases dotted"
    return said(beside(*columns, gap=4.0), words)


def branches() -> Scene:
    """The four branches of a triangulated square with two inner vertices, each vertex popped up or down."""
    corners = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.35, 0.4), (0.65, 0.62))
    sheet = Sheet(6, (), "", ((0, 1, 4), (1, 5, 4), (1, 2, 5), (2, 3, 5), (3, 4, 5), (3, 0, 4)), corners)
    found = configuration_of_sheet(sheet).branches
    assert found is not None
    columns = [_branch(sheet, number, branch.freedoms) for number, branch in enumerate(found.branches)]
    words = "creases as each branch begins: mountains red, valleys blue and dashed"
    return said(beside(*columns, gap=4.0), words)


def _branch(sheet: Sheet, number: int, freedoms: int | None) -> Scene:
    """Return a pattern by what its creases do on one branch, above a pose on it."""
    followed = synth.fold(sheet, branch=number, frames=6)
    _, pose = frame_scenes(_lettered(sheet, followed, _POSE), followed.places[[0, _POSE]], 108.0)
    pattern = Patterned(sheet, 108.0).scene(colour="branch", branch=number)
    assert freedoms is not None
    return said(above(pattern, pose, gap=0.0), f"way {number}: {numbered(freedoms, 'freedom')}")


def _lettered(sheet: Sheet, followed: Motion, frame: int) -> Sheet:
    """Return a sheet with the letters that its creases have in a frame; immobile ones are unassigned."""
    angles = dict(zip(followed.joints, followed.path.angles[frame].tolist(), strict=True))
    letters = {joint: "U" if abs(angle) < _STILL else "V" if angle > 0 else "M" for joint, angle in angles.items()}
    assigned = (letters.get(edge, letter) for edge, letter in enumerate(sheet.assignments))
    return replace(sheet, assignments="".join(assigned))


def moving() -> Scene:
    """A kaleidocycle at four poses of its circuit."""
    linkage = configuration_of(generated_solids("kaleidocycle", solids=6)).linkage
    circuit = circuit_through(ClosureEquations(linkage), linkage.angles).angles
    poses = circuit[[round(eighth * (len(circuit) - 1) / 8) for eighth in range(4)]]
    panels, _ = bodies_of(linkage)
    scenes = frame_scenes(panels, _steadied(places_of_hinges(linkage, poses)), 114.0)
    words = (f"{signed(round(degrees(angle)))}°" for angle in poses[:, 0])
    row = beside(*map(said, scenes, words), gap=0.0)
    return said(row, "six solids in a ring of six hinges (orange), by the turn of one hinge")


def _steadied(places: Floats) -> Floats:
    """Return poses moved as wholes, each to where it is least apart from the one before."""
    steady = [places[0] - places[0].mean(axis=0)]
    for pose in places[1:] - places[1:].mean(axis=1, keepdims=True):
        turn, _ = Rotation.align_vectors(steady[-1], pose)
        steady.append(turn.apply(pose))
    return np.stack(steady)


def positions() -> Scene:
    """Two four-bars: a joint against the driven one, all round their circuits, with the positions at one angle."""
    crank = generated_solids("four-bar", arc1=0.5, arc2=1.3, arc3=1.2, arc4=1.4)
    rocker = generated_solids("four-bar", arc1=1.4, arc2=0.8, arc3=1.0, arc4=1.0)
    return beside(
        said(_circuits(crank, 30.0), "it turns all round:", "a circuit for each position"),
        said(_circuits(rocker, 30.0), "it turns back:", "one circuit, a branch for each position"),
    )


def members() -> Scene:
    """Four-bars whose arcs are a few degrees off: a joint against the driven one, of cranks and of rockers."""
    crank = generated_solids("four-bar", arc1=0.5, arc2=1.3, arc3=1.2, arc4=1.4)
    rocker = generated_solids("four-bar", arc1=1.4, arc2=0.8, arc3=1.0, arc4=1.0)
    return beside(
        said(_members(crank, 61), "12 members turn all round"),
        said(_members(rocker, 61), "12 members turn back, each at its angles"),
    )


def _members(four_bar: HingedSolids, rows: int) -> Scene:
    """Return the angle of joint 2 against that of joint 0, degrees, of members with arcs off by up to 3 degrees."""
    arcs = list(arcs_of(four_bar).values()) + np.radians(np.random.default_rng(4).uniform(-3.0, 3.0, (12, 4)))
    up, down = np.linspace(0.0, np.pi, rows), np.linspace(0.0, -np.pi, rows)
    swept = synth.sweep(four_bar, {"arcs": arcs}, drive={0: np.concatenate([up, down])}, joints=[2])
    plot = Plot(34.0, 20.0, 170.0, 150.0, (-180.0, 180.0), (-180.0, 180.0))
    shapes: list[Shape] = [*plot.below((-180, -90, 0, 90, 180), "driven angle, degrees")]
    shapes += plot.beside((-180, -90, 0, 90, 180), "angle of another joint")
    for member in range(len(swept)):
        driven = np.concatenate([down[::-1], up])
        angles = np.concatenate([swept.angles[member, rows:][::-1, 0], swept.angles[member, :rows, 0]])
        there = np.isfinite(angles)
        curve = np.degrees(np.stack([driven, angles], axis=1)[there])
        shapes += [Line(plot.row(*piece.T), colour_of_class(0), FINE) for piece in _unbroken(curve)]
    return Scene(plot.left + plot.width + 10.0, plot.top + plot.height + 26.0, (Layer("members", tuple(shapes)),))


def _circuits(four_bar: HingedSolids, driven: float) -> Scene:
    """Return the angle of joint 2 against that of joint 0, degrees, on all circuits that a driven angle meets."""
    found = synth.positions(four_bar, drive={0: radians(driven)})
    closure = ClosureEquations(configuration_of(four_bar).linkage)
    plot = Plot(34.0, 20.0, 170.0, 150.0, (-180.0, 180.0), (-180.0, 180.0))
    shapes: list[Shape] = [*plot.below((-180, -90, 0, 90, 180), "driven angle, degrees")]
    shapes += plot.beside((-180, -90, 0, 90, 180), "angle of another joint")
    shapes.append(Line([plot.at(driven, -180.0), plot.at(driven, 180.0)], "grey", FINE, DASH))
    drawn: set[int | None] = set()
    for number, position in enumerate(found.positions, 1):
        if position.circuit not in drawn:
            look = (colour_of_class(len(drawn)), STRONG, (5.0, 2.0) if drawn else ())
            drawn.add(position.circuit)
            curve = np.degrees(circuit_through(closure, position.angles).angles[:, [0, 2]])
            shapes += [Line(plot.row(*piece.T), *look) for piece in _unbroken(curve)]
        x, y = plot.at(*np.degrees(position.angles[[0, 2]]).tolist())
        shapes += [Disc((x, y), 5.0), Label((x, y), str(number), SMALL, bold=True, halo=False)]
    return Scene(plot.left + plot.width + 10.0, plot.top + plot.height + 26.0, (Layer("circuits", tuple(shapes)),))


def _unbroken(curve: Floats) -> Iterator[Floats]:
    """Yield the pieces of a curve of angles, brought between -180 and 180 degrees."""
    wrapped = (curve + 180.0) % 360.0 - 180.0
    jumps = np.flatnonzero((np.abs(np.diff(wrapped, axis=0)) > 180.0).any(axis=1)) + 1
    yield from (piece for piece in np.split(wrapped, jumps) if len(piece) > 1)


def joints() -> Scene:
    """Joints and a leg as the creases that stand for them."""
    kinds = {"R": "R: one crease", "U": "U: two that meet", "S": "S: three that meet", "UPS": "leg UPS: 2 + 1 + 3"}
    return beside(
        *(
            said(Patterned(sheet_of_file(f"realised/chain-{kind}.fold"), 100.0).scene(colour="letters"), words)
            for kind, words in kinds.items()
        )
    )


def mending() -> Scene:
    """A Miura sheet with rounded coordinates, its errors enlarged, beside the mended one and a pose of that."""
    rounded = _rounded(generated_sheet("miura", rows=3, columns=4, sector=1.2))
    assert not branches_of(linkage_of_sheet(rounded)).branches
    found = configuration_of_sheet(rounded)
    assert found.branches is not None
    (repair,) = found.repairs
    _, pose = frame_scenes(found.sheet, synth.fold(found.sheet, frames=6).places[[0, 3]], 120.0)
    return beside(
        said(
            _looking_like(_enlarged(rounded, found.sheet), Line([], "grey", NORMAL, DOTTED)),
            "as written, to three decimals: rigid",
            f"(errors drawn {_LARGER} times as large)",
        ),
        said(
            _looking_like(found.sheet, Line([], "class1", STRONG)),
            "mended: vertices moved by at most",
            f"{100 * repair.moved:.2f} percent of the extent",
        ),
        said(pose, f"it folds, in {len(found.branches.branches)} ways"),
    )


def _looking_like(sheet: Sheet, look: Line) -> Scene:
    """Return a pattern with all creases drawn like a line."""
    pattern = Patterned(sheet, 150.0)
    return over(pattern.scene(), [replace(look, points=pattern.crease(joint)) for joint in pattern.joints])


def _rounded(sheet: Sheet) -> Sheet:
    """Return a sheet that lies aslant, its coordinates written to three decimals."""
    turn = np.array([[cos(_ASLANT), sin(_ASLANT)], [-sin(_ASLANT), cos(_ASLANT)]])
    return with_places(sheet, (np.array(sheet.coordinates)[:, :2] @ turn).round(3))


def _enlarged(written: Sheet, exact: Sheet) -> Sheet:
    """Return a sheet with its vertices so many times as far from where they should be."""
    places = np.array(exact.coordinates)[:, :2]
    errors = np.array(written.coordinates) - places
    return with_places(written, places + _LARGER * errors)


def derivatives() -> Scene:
    """How to move the vertices of a pattern so that two corners of it, folded, come closer."""
    sheet = generated_sheet("miura", rows=2, columns=2, sector=1.2)
    followed = synth.fold(sheet, frames=6)
    places, ends = followed.places[_HALF_FOLDED], _CORNERS
    towards = places[ends[1]] - places[ends[0]]
    by_places = np.zeros_like(places)
    by_places[ends, :] = np.outer([-1.0, 1.0], towards / np.linalg.norm(towards))
    shape = SheetDerivatives(sheet, mechanism_of_sheet(sheet), followed.linkage)
    at = shape.at(followed.path.angles[_HALF_FOLDED], [0])
    moves = -at.adjoint(by_places=by_places)
    pattern = Patterned(sheet, 150.0)
    shapes: list[Shape] = []
    for (x, y), (right, up) in zip(pattern.places, (_ARROW * moves).tolist(), strict=True):
        tip = (x + right, y - up)
        if max(abs(right), abs(up)) > 1.0:
            shapes += [Line([(x, y), tip], "class1", STRONG), head((x, y), tip, "class1")]
    _, pose = frame_scenes(_lettered(sheet, followed, _HALF_FOLDED), followed.places[[0, _HALF_FOLDED]], 150.0)
    flat = [pattern.places[end] for end in ends]
    spots: list[Shape] = [Disc(place, 3.0) for place in flat]
    return beside(
        said(on_air(over(pattern.scene(), [*shapes, *spots]), 190.0), "vertices moved along minus the gradient"),
        said(pose, "bring the marked corners closer", "at the same angle of the driven crease"),
    )


def layer_orders() -> Scene:
    """The bird base folded flat, from the front, from the back and against the light; panels are numbered."""
    bird_base = synth.layers(sheet_of_file("patterns/bird-base.fold"))
    picture = flat_folded_scene(bird_base.order(), PictureOptions(box=(420.0, 200.0), caption=None))
    return said(picture, f"{numbered(bird_base.orders, 'layer order')} of 16 panels; the first is shown")


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "branches": branches,
    "folding": folding,
    "moving": moving,
    "positions": positions,
    "members": members,
    "joints": joints,
    "mending": mending,
    "derivatives": derivatives,
    "layer-orders": layer_orders,
}
"""Theory page to what draws its picture."""
